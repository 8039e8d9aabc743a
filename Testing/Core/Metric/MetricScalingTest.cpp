// SPDX-License-Identifier: BSD-3-Clause
// The size for a wanted number of elements: closed formulas, and limits that hold at every point.
#include "Metric/MetricScaling.h"
#include "TestMeshes.h"

#include <Eigen/LU>

using namespace meshopt;

namespace
{
template <class>
class MetricScalingIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(MetricScalingIn, TestDimensions);

/// Elements of edge 1 that fill the volume 1 (5.3): by the area, or volume, of a regular one.
template <int D>
double perVolume()
{
  return D == 2 ? 4.0 / std::sqrt(3.0) : 6.0 * std::sqrt(2.0);
}

/// exp(a x0) times the identity at each point.
template <int D>
std::vector<SymmetricEigen<D>> growing(const SimplexMesh<D>& mesh, double a)
{
  std::vector<SymmetricEigen<D>> metric(mesh.numberOfPointSlots());
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    metric[p].values.setConstant(std::exp(a * mesh.point(p)[0]));
  }
  return metric;
}

/// Eigenvalues over many orders, in all directions.
template <int D>
std::vector<SymmetricEigen<D>> wild(const SimplexMesh<D>& mesh)
{
  TestRandom random(3);
  std::vector<SymmetricEigen<D>> metric(mesh.numberOfPointSlots());
  for (SymmetricEigen<D>& e : metric)
  {
    Tensor<D> m;
    for (int i = 0; i < D; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        m(i, j) = m(j, i) = random();
      }
    }
    e = SymmetricEigen<D>::of(m);
    for (int d = 0; d < D; ++d)
    {
      e.values[d] = std::exp(5.0 * random());
    }
    std::sort(e.values.data(), e.values.data() + D);
  }
  return metric;
}

/// The wanted lengths along the axes of a tensor, the shortest first.
template <int D>
Vec<D> lengths(const Tensor<D>& unit)
{
  return SymmetricEigen<D>::of(unit).values.cwiseSqrt().cwiseInverse().reverse();
}

template <int D>
ScaledMetric<D> withSize(const SimplexMesh<D>& mesh, const SizeLimits& limits, double h)
{
  return MetricScaling<D>(mesh, wild<D>(mesh), limits, 1.0).withSize(h);
}
}

TYPED_TEST(MetricScalingIn, OneSizeEverywhere)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2)); // of volume 1
  for (const double g : { 1.0, 7.0, 1e-12 })
  {
    for (const double correction : { 1.0, 0.8 })
    {
      std::vector<SymmetricEigen<D>> metric(mesh.numberOfPointSlots());
      for (SymmetricEigen<D>& e : metric)
      {
        e.values.setConstant(g);
      }
      MetricScaling<D> scaling(mesh, metric, SizeLimits(), correction);
      const ScaledMetric<D> found = scaling.withCount(1000.0);
      const double edge = std::pow(correction * perVolume<D>() / 1000.0, 1.0 / D);
      EXPECT_NEAR(found.desiredSize / (edge * std::sqrt(g)), 1.0, 1e-4);
      EXPECT_NEAR(found.predictedCount, 1000.0, 0.11);
      EXPECT_TRUE(found.isCountReached);
      for (const Tensor<D>& unit : found.unit)
      {
        EXPECT_NEAR(lengths<D>(unit)[0] / edge, 1.0, 1e-4);
      }
    }
  }
}

/// exp(D a x0 / 2) over the unit square or cube: the logarithm is linear, as it is interpolated.
TYPED_TEST(MetricScalingIn, CountIsTheIntegral)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const double a = 1.7, b = 0.5 * D * a;
  const double integral = (std::exp(b) - 1.0) / b;
  MetricScaling<D> scaling(mesh, growing<D>(mesh, a), SizeLimits(), 1.0);
  for (const double h : { 0.3, 0.05 })
  {
    const ScaledMetric<D> found = scaling.withSize(h);
    const double wanted = perVolume<D>() * integral / std::pow(h, D);
    EXPECT_EQ(found.desiredSize, h);
    EXPECT_NEAR(found.predictedCount / wanted, 1.0, 1e-12);
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      const Tensor<D> unit = std::exp(a * mesh.point(p)[0]) / (h * h) * Tensor<D>::Identity();
      EXPECT_LT((found.unit[p] - unit).norm(), 1e-12 * unit.norm());
    }
    EXPECT_NEAR(scaling.withCount(wanted).desiredSize / h, 1.0, 1e-4); // and the way back
  }
}

TYPED_TEST(MetricScalingIn, SizesAreWithinTheirLimitsAndOtherwiseAsWanted)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const double h = 0.3;
  const std::vector<SymmetricEigen<D>> metric = wild<D>(mesh);
  SizeLimits limits;
  limits.minimumSize = 0.1;
  limits.maximumSize = 0.5;
  const ScaledMetric<D> found = withSize<D>(mesh, limits, h);
  int cut = 0, left = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    for (int d = 0; d < D; ++d)
    {
      // Along the axis of the metric itself.
      const Vec<D> axis = metric[p].vectors.col(d);
      const double asked = h / std::sqrt(metric[p].values[d]);
      const double wanted = std::min(std::max(asked, 0.1), 0.5);
      EXPECT_NEAR(1.0 / std::sqrt(axis.dot(found.unit[p] * axis)), wanted, 1e-12);
      ++(asked == wanted ? left : cut);
    }
  }
  EXPECT_GT(cut, 5);
  EXPECT_GT(left, 5);
}

TYPED_TEST(MetricScalingIn, NoEdgeIsLongerThanTheMesh)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(2, 0.2));
  MetricScaling<D> scaling(mesh, wild<D>(mesh), SizeLimits(), 1.0);
  EXPECT_NEAR(scaling.maximumSize(), std::sqrt(double(D)), 1e-15);
  for (const Tensor<D>& unit : scaling.withSize(100.0).unit)
  {
    EXPECT_NEAR(lengths<D>(unit)[0], std::sqrt(double(D)), 1e-12);
  }
}

TYPED_TEST(MetricScalingIn, AnisotropyIsLimitedByShorterEdges)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const ScaledMetric<D> free = withSize<D>(mesh, SizeLimits(), 0.01);
  for (const double most : { 1.0, 3.0 })
  {
    SizeLimits limits;
    limits.maximumAnisotropy = most;
    const ScaledMetric<D> found = withSize<D>(mesh, limits, 0.01);
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      const Vec<D> before = lengths<D>(free.unit[p]), after = lengths<D>(found.unit[p]);
      for (int d = 0; d < D; ++d) // the shortest stays
      {
        EXPECT_NEAR(after[d] / std::min(before[d], most * before[0]), 1.0, 1e-10);
      }
    }
  }
}

TYPED_TEST(MetricScalingIn, ACountThatTheLimitsDoNotAllow)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  SizeLimits limits;
  limits.minimumSize = 0.05;
  limits.maximumSize = 0.2;
  const double fewest = perVolume<D>() / std::pow(0.2, D),
               most = perVolume<D>() / std::pow(0.05, D);
  MetricScaling<D> scaling(mesh, wild<D>(mesh), limits, 1.0);
  const ScaledMetric<D> few = scaling.withCount(0.5 * fewest), many = scaling.withCount(2.0 * most),
                        some = scaling.withCount(0.5 * (fewest + most));
  EXPECT_FALSE(few.isCountReached);
  EXPECT_NEAR(few.predictedCount / fewest, 1.0, 1e-3);
  EXPECT_FALSE(many.isCountReached);
  EXPECT_NEAR(many.predictedCount / most, 1.0, 1e-3);
  EXPECT_TRUE(some.isCountReached);
  EXPECT_NEAR(some.predictedCount / (0.5 * (fewest + most)), 1.0, 1e-3);
  limits.minimumSize = limits.maximumSize; // one size, one count
  MetricScaling<D> uniform(mesh, wild<D>(mesh), limits, 1.0);
  EXPECT_FALSE(uniform.withCount(2.0 * fewest).isCountReached);
  EXPECT_TRUE(uniform.withCount(fewest).isCountReached);
  EXPECT_NEAR(uniform.withCount(2.0 * fewest).predictedCount / fewest, 1.0, 1e-9);
}

TYPED_TEST(MetricScalingIn, GradationMakesEdgesShorterAndKeepsTheCount)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 2 ? 8 : 4, 0.2));
  SizeLimits limits;
  const ScaledMetric<D> free =
    MetricScaling<D>(mesh, growing<D>(mesh, 8.0), limits, 1.0).withSize(0.5);
  limits.gradation = 1.05;
  MetricScaling<D> scaling(mesh, growing<D>(mesh, 8.0), limits, 1.0);
  const ScaledMetric<D> graded = scaling.withSize(0.5);
  EXPECT_GT(graded.predictedCount, 1.02 * free.predictedCount);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    EXPECT_LE(lengths<D>(graded.unit[p])[0], lengths<D>(free.unit[p])[0] * (1.0 + 1e-9));
  }
  const ScaledMetric<D> counted = scaling.withCount(free.predictedCount);
  EXPECT_TRUE(counted.isCountReached);
  EXPECT_NEAR(counted.predictedCount / free.predictedCount, 1.0, 2e-3);
  EXPECT_GT(counted.desiredSize, 0.5);
}

TEST(SizeLimits, WhatIsUnusableIsNamed)
{
  const auto check = [](double least, double most, double anisotropy, double gradation) {
    return SizeLimits{ least, most, anisotropy, gradation }.check();
  };
  const auto has = [](const std::string& text, const char* word)
  { return text.find(word) != std::string::npos; };
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check(0, 0, 0, 0), "");
  EXPECT_EQ(check(0.1, 0.1, 1.0, 1.01), "");
  EXPECT_EQ(check(0.1, 0.0, 5.0, 2.0), "");
  for (const double bad : { -1.0, nan, inf, 1e100, 1e-100 })
  {
    EXPECT_TRUE(has(check(bad, 0, 0, 0), "limits of the size"));
    EXPECT_TRUE(has(check(0, bad, 0, 0), "limits of the size"));
  }
  EXPECT_TRUE(has(check(0.2, 0.1, 0, 0), "minimum size 0.2 is above"));
  EXPECT_TRUE(has(check(0, 0, 0.5, 0), "anisotropy"));
  EXPECT_TRUE(has(check(0, 0, nan, 0), "anisotropy"));
  for (const double bad : { 1.0, 0.5, -2.0, nan, inf })
  {
    EXPECT_TRUE(has(check(0, 0, 0, bad), "gradation"));
  }
}
