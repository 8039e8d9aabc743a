// SPDX-License-Identifier: BSD-3-Clause
// The exponential and the logarithm by themselves, against eigenvalues. NodalMetricTest.cpp has
// them as inverses of each other.
#include "Metric/TensorFunctions.h"
#include "Metric/SymmetricEigen.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class TensorFunctions : public ::testing::Test
{
};
TYPED_TEST_SUITE(TensorFunctions, TestDimensions);

template <int D>
Tensor<D> randomSymmetric(TestRandom& random)
{
  Tensor<D> m;
  for (int i = 0; i < D; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      m(i, j) = m(j, i) = random();
    }
  }
  return m;
}

/// f of the eigenvalues.
template <int D, class F>
Tensor<D> apply(const Tensor<D>& m, F&& f)
{
  SymmetricEigen<D> e = SymmetricEigen<D>::of(m);
  for (int d = 0; d < D; ++d)
  {
    e.values[d] = f(e.values[d]);
  }
  return e.compose();
}
}

TYPED_TEST(TensorFunctions, ExponentialIsThatOfTheEigenvalues)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(1);
  for (const double scale : { 1e-9, 0.1, 1.0, 10.0, 100.0 })
  {
    for (int k = 0; k < 200; ++k)
    {
      const Tensor<D> l = scale * randomSymmetric<D>(random);
      const Tensor<D> wanted = apply<D>(l, [](double x) { return std::exp(x); });
      const Tensor<D> found = exponential<D>(l);
      EXPECT_LT((found - wanted).norm(), 1e-14 * std::max(1.0, l.norm()) * wanted.norm());
      EXPECT_EQ(found, Tensor<D>(found.transpose()));
    }
  }
}

TYPED_TEST(TensorFunctions, ExponentialOfDiagonalsAndMultiplesOfTheIdentity)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_EQ(exponential<D>(Tensor<D>::Zero()), Tensor<D>(Tensor<D>::Identity()));
  for (const double x : { -300.0, -1.0, 0.5, 300.0 })
  {
    const Tensor<D> found = exponential<D>(x * Tensor<D>::Identity());
    EXPECT_LT((found / std::exp(x) - Tensor<D>::Identity()).norm(), 1e-15);
  }
  Tensor<D> l = Tensor<D>::Zero();
  l(0, 0) = 3.0;
  l(D - 1, D - 1) = -2.0;
  const Tensor<D> found = exponential<D>(l);
  for (int i = 0; i < D; ++i)
  {
    for (int j = 0; j < D; ++j)
    {
      EXPECT_NEAR(found(i, j), i == j ? std::exp(l(i, i)) : 0.0, 1e-13);
    }
  }
}

TYPED_TEST(TensorFunctions, LogarithmIsThatOfTheEigenvalues)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(2);
  for (int k = 0; k < 500; ++k)
  {
    const Tensor<D> a = randomSymmetric<D>(random);
    const Tensor<D> m = a * a + 0.01 * Tensor<D>::Identity();
    const Tensor<D> wanted = apply<D>(m, [](double x) { return std::log(x); });
    Tensor<D> found;
    ASSERT_TRUE(logarithm<D>(m, found));
    EXPECT_LT((found - wanted).norm(), 1e-12);
    EXPECT_EQ(found, Tensor<D>(found.transpose()));
  }
}

TYPED_TEST(TensorFunctions, OfWhatIsNotPositiveThereIsNoLogarithm)
{
  constexpr int D = TypeParam::dimension;
  for (const double least : { 1e-14, 1e-16, 0.0, -1.0 }) // 1e-15 of the greatest is the limit
  {
    Tensor<D> m = Tensor<D>::Identity(), l = 7.0 * m;
    m(1, 1) = least;
    const bool isPositive = least > 1e-15;
    EXPECT_EQ(logarithm<D>(m, l), isPositive);
    EXPECT_NEAR(l(1, 1), isPositive ? std::log(least) : 7.0, 1e-13) << "left alone";
  }
  for (const double skew : { 1e-11, 1e-8 }) // symmetric to 1e-9
  {
    Tensor<D> m = Tensor<D>::Identity(), l;
    m(1, 0) = skew;
    EXPECT_EQ(logarithm<D>(m, l), skew < 1e-9);
  }
}
