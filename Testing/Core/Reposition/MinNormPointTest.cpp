// SPDX-License-Identifier: BSD-3-Clause
// The quadratic program (2.5) against enumeration of all
// faces of the simplex, and its KKT conditions.
#include "Reposition/MinNormPoint.h"
#include "TestMeshes.h"

#include <Eigen/Dense>

#include <limits>

using namespace meshopt;

namespace
{
constexpr int Blocks = 4;

template <int D>
Eigen::VectorXd dense(const SparsePoint<D>& w, int blocks)
{
  Eigen::VectorXd v = Eigen::VectorXd::Zero(1 + D * blocks);
  v[0] = w.first;
  for (int i = 0; i < w.count; ++i)
  {
    v.segment(1 + D * w.block[i], D) += w.value[i];
  }
  return v;
}

template <int D>
std::vector<SparsePoint<D>> randomPoints(int m, int blocks, double shift, TestRandom& random)
{
  std::vector<SparsePoint<D>> points(m);
  for (SparsePoint<D>& w : points)
  {
    w.first = std::abs(random());
    w.count = std::min(blocks, D + 1);
    const int start = static_cast<int>((random() + 1.0) * 0.499 * blocks);
    for (int i = 0; i < w.count; ++i)
    {
      w.block[i] = (start + i) % blocks;
      for (int d = 0; d < D; ++d)
      {
        w.value[i][d] = random() + shift;
      }
    }
  }
  return points;
}

// Least norm over all faces of the simplex: the affine minimum of each subset, where it is
// feasible.
template <int D>
double enumerate(const std::vector<SparsePoint<D>>& points, int blocks)
{
  const int m = static_cast<int>(points.size());
  double best = std::numeric_limits<double>::infinity();
  for (int subset = 1; subset < (1 << m); ++subset)
  {
    std::vector<Eigen::VectorXd> w;
    for (int k = 0; k < m; ++k)
    {
      if ((subset >> k) & 1)
      {
        w.push_back(dense<D>(points[k], blocks));
      }
    }
    const int n = static_cast<int>(w.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1);
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        a(i, j) = w[i].dot(w[j]);
      }
      a(i, n) = a(n, i) = 1.0;
    }
    b[n] = 1.0;
    const Eigen::VectorXd mu = a.completeOrthogonalDecomposition().solve(b);
    if ((a * mu - b).norm() < 1e-9 && mu.head(n).minCoeff() >= -1e-12)
    {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(w[0].size());
      for (int i = 0; i < n; ++i)
      {
        x += mu[i] * w[i];
      }
      best = std::min(best, x.squaredNorm());
    }
  }
  return best;
}

template <int D>
void expectKkt(const MinNormPoint<D>& solver, const std::vector<SparsePoint<D>>& points, int blocks)
{
  Eigen::VectorXd x = Eigen::VectorXd::Zero(1 + D * blocks);
  double sum = 0.0, scale = 0.0;
  for (std::size_t k = 0; k < solver.corral().size(); ++k)
  {
    EXPECT_GT(solver.weights()[k], 0.0);
    EXPECT_TRUE(k == 0 || solver.corral()[k] > solver.corral()[k - 1]);
    sum += solver.weights()[k];
    x += solver.weights()[k] * dense<D>(points[solver.corral()[k]], blocks);
  }
  EXPECT_NEAR(sum, 1.0, 1e-14);
  EXPECT_LE(solver.corral().size(), std::size_t(D * blocks + 2));
  EXPECT_NEAR(x.squaredNorm(), solver.squaredNorm(), 1e-12 * (1.0 + x.squaredNorm()));
  for (const SparsePoint<D>& w : points)
  {
    scale = std::max(scale, w.dot(w));
  }
  for (const SparsePoint<D>& w : points)
  {
    EXPECT_GE(dense<D>(w, blocks).dot(x), x.squaredNorm() - 1e-9 * scale);
  }
}
}

template <int D>
void againstEnumeration()
{
  TestRandom random(7);
  MinNormPoint<D> solver;
  for (int run = 0; run < 300; ++run)
  {
    const int m = 1 + run % 8;
    const int blocks = 1 + run % Blocks;
    const double shift = run % 3 == 0 ? 0.0 : 0.5; // with 0 often inside, or not
    const auto points = randomPoints<D>(m, blocks, shift, random);
    solver.solve(points, blocks);
    EXPECT_NEAR(solver.squaredNorm(), enumerate<D>(points, blocks), 1e-10);
    expectKkt<D>(solver, points, blocks);
  }
}

TEST(MinNormPoint, AgreesWithEnumeration2D) { againstEnumeration<2>(); }
TEST(MinNormPoint, AgreesWithEnumeration3D) { againstEnumeration<3>(); }

TEST(MinNormPoint, ManyPointsFulfilTheKktConditions)
{
  TestRandom random(3);
  MinNormPoint<3> solver;
  for (int run = 0; run < 40; ++run)
  {
    const auto points = randomPoints<3>(200, 30, 0.02 * run, random);
    solver.solve(points, 30);
    expectKkt<3>(solver, points, 30);
  }
}

TEST(MinNormPoint, OnePointAndEqualPoints)
{
  SparsePoint<2> w;
  w.first = 0.5;
  w.count = 1;
  w.block[0] = 0;
  w.value[0] = Vec<2>(3.0, 4.0);
  MinNormPoint<2> solver;
  solver.solve({ w }, 1);
  EXPECT_EQ(solver.corral(), std::vector<int>{ 0 });
  EXPECT_DOUBLE_EQ(solver.squaredNorm(), 25.25);
  solver.solve({ w, w, w }, 1);
  EXPECT_EQ(solver.corral(), std::vector<int>{ 0 }); // ties go to the lowest
  EXPECT_DOUBLE_EQ(solver.squaredNorm(), 25.25);
}

/// Such as gradients of cells whose volumes underflow.
TEST(MinNormPoint, NoDirectionComesOfSquaresOutOfRange)
{
  for (double value :
    { 1e200, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    SparsePoint<3> w;
    w.count = 1;
    w.value.fill(Vec<3>::Constant(value));
    MinNormPoint<3> solver;
    solver.solve({ w, w }, 1);
    EXPECT_TRUE(solver.corral().empty());
    EXPECT_TRUE(solver.weights().empty());
    EXPECT_EQ(solver.squaredNorm(), 0.0);
  }
}

TEST(MinNormPoint, OriginInsideIsFound)
{
  std::vector<SparsePoint<2>> points(3);
  const double angle[3] = { 0.3, 2.2, 4.4 };
  for (int k = 0; k < 3; ++k)
  {
    points[k].count = 1;
    points[k].value[0] = Vec<2>(std::cos(angle[k]), std::sin(angle[k]));
  }
  MinNormPoint<2> solver;
  solver.solve(points, 1);
  EXPECT_LT(solver.squaredNorm(), 1e-20);
  EXPECT_EQ(solver.corral().size(), 3u);
}

TEST(MinNormPoint, ScalingByPowersOfTwoScalesTheBits)
{
  TestRandom random(11);
  auto points = randomPoints<3>(20, 6, 0.3, random);
  MinNormPoint<3> a, b;
  a.solve(points, 6);
  for (SparsePoint<3>& w : points)
  {
    w.first *= 64.0;
    for (int i = 0; i < w.count; ++i)
    {
      w.value[i] *= 64.0;
    }
  }
  b.solve(points, 6);
  EXPECT_EQ(a.corral(), b.corral());
  EXPECT_EQ(a.weights(), b.weights());
  EXPECT_EQ(a.squaredNorm() * 4096.0, b.squaredNorm());
}
