// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues of symmetric tensors that were made of them.
#include "Metric/SymmetricEigen.h"
#include "TestMeshes.h"

#include <Eigen/QR>

using namespace meshopt;

namespace
{
template <class>
class SymmetricEigenIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(SymmetricEigenIn, TestDimensions);

template <int D>
Tensor<D> randomRotation(TestRandom& random)
{
  Eigen::Matrix<double, D, D> a;
  for (int i = 0; i < D * D; ++i)
  {
    a(i) = random();
  }
  return Eigen::HouseholderQR<Eigen::Matrix<double, D, D>>(a).householderQ() *
    Eigen::Matrix<double, D, D>::Identity();
}
}

TYPED_TEST(SymmetricEigenIn, FindsTheValuesOfWhichATensorWasMade)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(8);
  for (const double scale : { 1.0, 1e-200, 1e200 }) // squares would vanish or overflow
  {
    for (int run = 0; run < 200; ++run)
    {
      Vec<D> values;
      for (int d = 0; d < D; ++d)
      {
        values[d] = scale * random();
      }
      std::sort(values.data(), values.data() + D);
      const Tensor<D> q = randomRotation<D>(random);
      const Tensor<D> m = q * values.asDiagonal() * q.transpose();
      const SymmetricEigen<D> e = SymmetricEigen<D>::of(m);
      for (int d = 0; d < D; ++d)
      {
        EXPECT_NEAR(e.values[d], values[d], 1e-14 * scale);
        const Vec<D> v = e.vectors.col(d);
        EXPECT_LT((m * v - e.values[d] * v).cwiseAbs().maxCoeff(), 1e-14 * scale);
      }
      EXPECT_LT((e.vectors.transpose() * e.vectors - Tensor<D>::Identity()).norm(), 1e-14);
      const Tensor<D> again = e.compose();
      EXPECT_LT((again - m).cwiseAbs().maxCoeff(), 1e-14 * scale);
      EXPECT_EQ(again, Tensor<D>(again.transpose())); // to the last bit
    }
  }
}

TYPED_TEST(SymmetricEigenIn, OfTheLowerHalf)
{
  constexpr int D = TypeParam::dimension;
  Tensor<D> m = Tensor<D>::Identity();
  m(1, 0) = 0.5;
  m(0, 1) = -77.0; // is not read: the block 1, .5; .5, 1 has the values .5 and 1.5
  const Vec<D> values = SymmetricEigen<D>::of(m).values;
  EXPECT_NEAR(values[0], 0.5, 1e-13);
  EXPECT_NEAR(values[D - 1], 1.5, 1e-13);
}

TYPED_TEST(SymmetricEigenIn, ZeroHasTheAxes)
{
  constexpr int D = TypeParam::dimension;
  const SymmetricEigen<D> e = SymmetricEigen<D>::of(Tensor<D>::Zero());
  EXPECT_EQ(e.values, Vec<D>(Vec<D>::Zero()));
  EXPECT_EQ(e.vectors, Tensor<D>(Tensor<D>::Identity()));
  EXPECT_EQ(e.compose(), Tensor<D>(Tensor<D>::Zero()));
}
