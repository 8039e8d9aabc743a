// SPDX-License-Identifier: BSD-3-Clause
// Determinants, edges and their gradients: against formulas and differences.
#include "Mesh/SimplexGeometry.h"
#include "TestMeshes.h"

#include <Eigen/LU>

using namespace meshopt;

namespace
{
template <class>
class SimplexGeometry : public ::testing::Test
{
};
TYPED_TEST_SUITE(SimplexGeometry, TestDimensions);

template <int D>
Corners<D> randomCorners(TestRandom& random)
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

/// The difference quotient of f; exact to rounding where f is at most quadratic in each node.
template <int D, class F>
double difference(Corners<D> x, int node, int d, F&& f)
{
  constexpr double step = 1e-3;
  x[node][d] += step;
  const double high = f(x);
  x[node][d] -= 2.0 * step;
  return (high - f(x)) / (2.0 * step);
}
}

TYPED_TEST(SimplexGeometry, DeterminantOfAMappedCorner)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(1);
  for (int run = 0; run < 100; ++run)
  {
    Eigen::Matrix<double, D, D> map;
    for (int i = 0; i < D * D; ++i)
    {
      map(i) = random();
    }
    Corners<D> x;
    x[0].setConstant(random());
    for (int i = 1; i <= D; ++i)
    {
      x[i] = x[0] + map.col(i - 1);
    }
    const double factorial = D == 2 ? 2.0 : 6.0;
    EXPECT_NEAR(volumeDeterminant(x), map.determinant(), 1e-14);
    EXPECT_NEAR(volumeDeterminant(x), factorial * signedVolume(x), 1e-14);
    std::swap(x[0], x[D]);
    EXPECT_NEAR(volumeDeterminant(x), -map.determinant(), 1e-14);
  }
}

TYPED_TEST(SimplexGeometry, GradientOfTheDeterminant)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(2);
  for (int run = 0; run < 100; ++run)
  {
    const Corners<D> x = randomCorners<D>(random);
    std::array<Vec<D>, D + 1> g;
    EXPECT_EQ(volumeDeterminantGradient(x, g), volumeDeterminant(x));
    for (int i = 0; i <= D; ++i)
    {
      for (int d = 0; d < D; ++d)
      {
        const auto f = [](const Corners<D>& y) { return volumeDeterminant(y); };
        EXPECT_NEAR(g[i][d], difference<D>(x, i, d, f), 1e-11);
      }
    }
  }
}

TYPED_TEST(SimplexGeometry, SquaredEdgesAndTheirSum)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(3);
  for (int run = 0; run < 100; ++run)
  {
    const Corners<D> x = randomCorners<D>(random);
    double sum = 0.0;
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const double l2 = (x[Local<D>::edges[e][0]] - x[Local<D>::edges[e][1]]).squaredNorm();
      EXPECT_NEAR(squaredEdge(x, e), l2, 1e-14);
      sum += l2;
    }
    EXPECT_NEAR(sumOfSquaredEdges(x), sum, 1e-13);
    for (int i = 0; i <= D; ++i)
    {
      const Vec<D> half = sumOfDifferences<D + 1, D>(x, i);
      for (int d = 0; d < D; ++d)
      {
        const auto f = [](const Corners<D>& y) { return sumOfSquaredEdges(y); };
        EXPECT_NEAR(2.0 * half[d], difference<D>(x, i, d, f), 1e-11);
      }
    }
  }
}

/// Coordinates with few digits: shifted far they are exact still, and nothing may change.
TYPED_TEST(SimplexGeometry, AsExactFarFromTheOrigin)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(4);
  for (int run = 0; run < 50; ++run)
  {
    Corners<D> x = randomCorners<D>(random), y;
    for (int i = 0; i <= D; ++i)
    {
      for (int d = 0; d < D; ++d)
      {
        x[i][d] = std::round(1024.0 * x[i][d]) / 1024.0;
        y[i][d] = x[i][d] + 1048576.0;
      }
    }
    EXPECT_EQ(volumeDeterminant(y), volumeDeterminant(x));
    EXPECT_EQ(sumOfSquaredEdges(y), sumOfSquaredEdges(x));
    for (int i = 0; i <= D; ++i)
    {
      EXPECT_EQ((sumOfDifferences<D + 1, D>(y, i)), (sumOfDifferences<D + 1, D>(x, i)));
    }
  }
}

TYPED_TEST(SimplexGeometry, SetZero)
{
  constexpr int D = TypeParam::dimension;
  std::array<Vec<D>, D + 1> g;
  g.fill(Vec<D>(Vec<D>::Ones()));
  EXPECT_EQ(setZero<D>(g), 0.0);
  for (const Vec<D>& v : g)
  {
    EXPECT_EQ(v, Vec<D>(Vec<D>::Zero()));
  }
}

TEST(CubeRoot, IsTheCubeRoot)
{
  TestRandom random(5);
  for (double scale : { 1e-300, 1e-20, 1.0, 1e5, 1e300 })
  {
    for (int run = 0; run < 200; ++run)
    {
      const double x = scale * random();
      EXPECT_NEAR(cubeRoot(x) / std::cbrt(x), 1.0, 1e-15);
    }
  }
  EXPECT_EQ(cubeRoot(0.0), 0.0);
  // Not to the last bit: the C library's cbrt(3.375) is not exactly 1.5. A compiler that computes
  // the constant itself finds 3.
  EXPECT_DOUBLE_EQ(cubeRoot(27.0), 3.0);
  EXPECT_EQ(cubeRoot(-8.0), -2.0);
}

TEST(CubeRoot, KeepsItsBitsUnderPowersOfEight)
{
  TestRandom random(6);
  for (int run = 0; run < 200; ++run)
  {
    const double x = random();
    for (int k : { -100, -7, -1, 1, 2, 50, 300 })
    {
      EXPECT_EQ(cubeRoot(std::ldexp(x, 3 * k)), std::ldexp(cubeRoot(x), k));
    }
  }
}
