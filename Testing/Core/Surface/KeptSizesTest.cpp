// SPDX-License-Identifier: BSD-3-Clause
// Which sizes can be had beside edges that stay: on the unit square, whose sides have the length 1.
#include "Surface/KeptSizes.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
/// What the sides of the unit square ask for at x, lengths being measured in diag(stretch^2, 1).
double floorOfSquare(const Vec<2>& x, double stretch, double least)
{
  constexpr double fall = 0.7; // of the size, by distance; see SizeFloor.cpp
  double result = least;
  for (int side = 0; side < 4; ++side)
  {
    const bool isHorizontal = side < 2;
    const double at = side % 2;
    const double length = isHorizontal ? stretch : 1.0;
    const Vec<2> nearest = isHorizontal ? Vec<2>(std::clamp(x[0], 0.0, 1.0), at)
                                        : Vec<2>(at, std::clamp(x[1], 0.0, 1.0));
    const Vec<2> d = x - nearest;
    if (length > least) // others ask for nothing
    {
      result = std::max(result, length - fall * std::hypot(stretch * d[0], d[1]));
    }
  }
  return result;
}

template <int D>
std::shared_ptr<const SizeFloor<D>> floorOf(const SimplexMesh<D>& mesh,
  const NodalMetric<D>& metric, double& longest, const Surface<D>* surface = nullptr)
{
  return keptSizeFloor<D>(mesh, metric, surface, longest);
}
}

TEST(KeptSizes, NoFloorWhereNoEdgeIsTwiceTooLong)
{
  const SimplexMesh<2> mesh = buildMesh(twoTriangles());
  for (double size : { 0.3, 0.45, 0.499, 0.501, 0.7, 2.0 })
  {
    double longest = -1.0;
    const auto floor = floorOf<2>(mesh, NodalMetric<2>(size), longest);
    EXPECT_NEAR(longest, 1.0 / size, 1e-15); // the diagonal, which is longer, need not stay
    EXPECT_EQ(floor == nullptr, size > 0.5) << size;
  }
}

TEST(KeptSizes, KeptEdgesInsideCount)
{
  MeshInput<2> in = twoTriangles();
  in.keptFacets = { { 0, 3 } };
  double longest = 0.0;
  EXPECT_NE(floorOf<2>(buildMesh(in), NodalMetric<2>(0.6), longest), nullptr);
  EXPECT_NEAR(longest, std::sqrt(2.0) / 0.6, 1e-15);
}

TEST(KeptSizes, TheFloorFallsWithTheDistanceFromTheSides)
{
  constexpr double least = 0.2;
  const SimplexMesh<2> mesh = buildMesh(twoTriangles());
  TestRandom random(2);
  for (double stretch : { 1.0, 2.0 })
  {
    NodalMetric<2> metric(least);
    if (stretch != 1.0)
    {
      Tensor<2> m = Tensor<2>::Identity();
      m(0, 0) = stretch * stretch;
      ASSERT_EQ(metric.set(mesh, {}, std::vector<Tensor<2>>(mesh.numberOfPointSlots(), m)), "");
    }
    double longest = 0.0;
    const auto floor = floorOf<2>(mesh, metric, longest);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(longest, stretch / least, 1e-12);
    for (int k = 0; k < 500; ++k)
    {
      const Vec<2> x(0.5 + random(), 0.5 + random());
      EXPECT_NEAR(std::max(floor->at(x), least), floorOfSquare(x, stretch, least), 1e-12);
    }
  }
}

/// Edges that are not longer than what is wanted ask for nothing: here those of one half.
TEST(KeptSizes, OnlyEdgesThatAreTooLongHaveAFloor)
{
  const SimplexMesh<2> mesh = buildMesh(jitteredGrid<2>(4, 0.0)); // sides of .25
  std::vector<double> sizes;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    sizes.push_back(mesh.point(p)[0] > 0.5 ? 1.0 : 0.05);
  }
  NodalMetric<2> metric;
  ASSERT_EQ(metric.set(mesh, sizes, {}), "");
  double longest = 0.0;
  const auto floor = floorOf<2>(mesh, metric, longest);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(longest, 0.25 / 0.05, 1e-12);
  EXPECT_NEAR(floor->at(Vec<2>(0.0, 0.6)), 0.25, 1e-12);
  EXPECT_NEAR(floor->at(Vec<2>(0.1, 0.5)), 0.25 - 0.7 * 0.1, 1e-12);
  EXPECT_EQ(floor->at(Vec<2>(1.0, 0.5)), 0.0);
}

TEST(KeptSizes, EdgesThatMayBeDividedAskForNothing)
{
  SimplexMesh<2> mesh = buildMesh(twoTriangles());
  MeshEditor<2> editor(mesh);
  BoundaryCurves curves;
  curves.build(editor, CurveOptions());
  double longest = -1.0;
  EXPECT_EQ(floorOf<2>(mesh, NodalMetric<2>(0.1), longest, &curves), nullptr);
  EXPECT_EQ(longest, 0.0);
}

TEST(KeptSizes, InSpaceThereIsNone)
{
  double longest = -3.0;
  EXPECT_EQ(floorOf<3>(buildMesh(oneCell<3>()), NodalMetric<3>(0.01), longest), nullptr);
  EXPECT_EQ(longest, -3.0);
}
