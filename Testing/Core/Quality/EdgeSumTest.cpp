// SPDX-License-Identifier: BSD-3-Clause
// Measures as functions of volume and edge sum: against the measures themselves.
#include "Quality/EdgeSum.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class S, int N>
struct Case
{
  using Shape = S;
  static constexpr int dimension = N;
};

template <int D>
Corners<D> randomCell(TestRandom& random)
{
  Corners<D> x;
  for (Vec<D>& p : x)
  {
    for (int d = 0; d < D; ++d)
    {
      p[d] = random();
    }
  }
  return x;
}

template <class Shape, int D>
double sumOf(const Corners<D>& x)
{
  double sum = 0.0;
  for (int a = 0; a <= D; ++a)
  {
    for (int b = 0; b < a; ++b)
    {
      sum += EdgeSum<Shape>::weight((x[a] - x[b]).squaredNorm());
    }
  }
  return sum;
}

/// D! V.
template <int D>
double determinant(const Corners<D>& x)
{
  return (D == 2 ? 2.0 : 6.0) * signedVolume(x);
}
}

template <class T>
class EdgeSums : public ::testing::Test
{
};
using Cases = ::testing::Types<Case<MeanEdgeShape<2>, 2>, Case<MeanEdgeShape<3>, 3>,
  Case<VolumeLengthShape<2>, 2>, Case<VolumeLengthShape<3>, 3>>;
TYPED_TEST_SUITE(EdgeSums, Cases);

TYPED_TEST(EdgeSums, AreTheMeasure)
{
  constexpr int D = TypeParam::dimension;
  using Shape = typename TypeParam::Shape;
  TestRandom random(3);
  int inverted = 0;
  for (int run = 0; run < 200; ++run)
  {
    const Corners<D> x = randomCell<D>(random);
    const double det = determinant<D>(x), sum = sumOf<Shape, D>(x);
    EXPECT_NEAR(EdgeSum<Shape>::quality(det, sum), Shape::value(x), 1e-14);
    inverted += det < 0.0;
  }
  EXPECT_GT(inverted, 50);
  EXPECT_LT(inverted, 150);
}

/// By the chain rule, for each node: grad det from Cramer's differences, grad sum by slope().
TYPED_TEST(EdgeSums, HaveTheGradientOfTheMeasure)
{
  constexpr int D = TypeParam::dimension;
  using Shape = typename TypeParam::Shape;
  using Sum = EdgeSum<Shape>;
  TestRandom random(4);
  for (int run = 0; run < 100; ++run)
  {
    const Corners<D> x = randomCell<D>(random);
    std::array<Vec<D>, D + 1> wanted;
    Shape::gradient(x, wanted);
    double byDet, bySum;
    Sum::derivatives(determinant<D>(x), sumOf<Shape, D>(x), byDet, bySum);
    for (int a = 0; a <= D; ++a)
    {
      Vec<D> ofDet, ofSum = Vec<D>::Zero();
      for (int d = 0; d < D; ++d)
      {
        // The determinant is linear in the place of one node: a difference is exact.
        Corners<D> moved = x;
        moved[a][d] += 1.0;
        ofDet[d] = determinant<D>(moved) - determinant<D>(x);
      }
      for (int b = 0; b <= D; ++b)
      {
        const Vec<D> along = x[a] - x[b];
        ofSum += Sum::slope(Sum::weight(along.squaredNorm())) * along;
      }
      const Vec<D> gradient = byDet * ofDet + bySum * ofSum;
      EXPECT_LT((gradient - wanted[a]).norm(), 1e-12 * (1.0 + wanted[a].norm()));
    }
  }
}

/// Collapsed elements have no shape, and nothing is divided by zero.
TYPED_TEST(EdgeSums, AreZeroWhereAllNodesCoincide)
{
  using Sum = EdgeSum<typename TypeParam::Shape>;
  EXPECT_EQ(Sum::quality(0.0, 0.0), 0.0);
  double byDet = 1.0, bySum = 1.0;
  Sum::derivatives(0.0, 0.0, byDet, bySum);
  EXPECT_EQ(byDet, 0.0);
  EXPECT_EQ(bySum, 0.0);
  EXPECT_TRUE(std::isfinite(Sum::slope(Sum::weight(0.0))));
}

TEST(EdgeSum, OtherMeasuresHaveNone)
{
  EXPECT_TRUE(EdgeSum<MeanEdgeShape<2>>::value && EdgeSum<VolumeLengthShape<3>>::value);
  EXPECT_FALSE(EdgeSum<MinimumSineShape<2>>::value);
  EXPECT_FALSE(EdgeSum<MinimumSineShape<3>>::value);
}
