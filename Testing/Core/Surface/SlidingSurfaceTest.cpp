// SPDX-License-Identifier: BSD-3-Clause
// Whole runs with a surface that takes part: what they reach, and what must stay.
#include "Mesh/Ids.h"
#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "Quality/Shape.h"
#include "SlidingBoxes.h"
#include "TestThreads.h"

#include <map>

using namespace meshopt;

namespace
{
struct Outcome
{
  SimplexMesh<3> mesh;
  Report report;
  double distance = 0.0;
};

Outcome optimized(const MeshInput<3>& in, double tolerance, bool slides = true, int n = 1,
  Effort effort = Effort::Default)
{
  Outcome outcome;
  Sliding made(in,
    [&]
    {
      SurfaceOptions options;
      options.tolerance = tolerance;
      return options;
    }());
  SimplexMesh<3> kept = buildMesh(in);
  NodalMetric<3> metric;
  Options options;
  options.effort = effort;
  const Control control = n > 1 ? threads(n) : Control();
  outcome.report = slides ? optimize<3>(made.mesh, metric, options, control, &made.surface)
                          : optimize<3>(kept, metric, options, control);
  outcome.distance = made.surface.distance(made.mesh);
  outcome.mesh = slides ? made.mesh : kept;
  expectSound(outcome.mesh);
  return outcome;
}

double areaOf(const SimplexMesh<3>& mesh)
{
  double area = 0.0;
  for (const auto& t : surfaceOf(mesh))
  {
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  }
  return area;
}

TEST(SlidingSurface, ABoxGetsBetterAndStaysABox)
{
  for (bool isTurned : { false, true })
  {
    MeshInput<3> in = slidingBox(6, 0.3, 7);
    if (isTurned)
    {
      turn(in);
    }
    const SimplexMesh<3> before = buildMesh(in);
    const Outcome kept = optimized(in, 0.0, false), slid = optimized(in, 0.0);
    EXPECT_GE(slid.report.worstAfter, 0.6);
    EXPECT_LT(kept.report.worstAfter, slid.report.worstAfter);
    const double rounding = isTurned ? 1e-14 : 0.0;
    EXPECT_LE(slid.distance, rounding);
    EXPECT_NEAR(slid.mesh.volume(), 1.0, 1e-13);
    EXPECT_NEAR(areaOf(slid.mesh), 6.0, 1e-13);
    EXPECT_LE(sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 3), rounding);
    EXPECT_LE(sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 3), rounding);
  }
}

/// A bump that is low enough to count as flat. Nodes are put on the plane of the face, which lies
/// between the bump and what is around it: both are off.
TEST(SlidingSurface, WhatIsReportedOfAlmostFlatFacesCountsBothSidesOfThePlane)
{
  const double tolerance = 1.5e-6; // less than 1e-6 of the diagonal
  MeshInput<3> in = slidingBox(6, 0.3, 7);
  for (Vec<3>& x : in.points)
  {
    const bool isOnTop = x[2] == 1.0 && std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.25;
    x[2] += isOnTop ? 5e-7 : 0.0;
  }
  const SimplexMesh<3> before = buildMesh(in);
  const Outcome slid = optimized(in, tolerance);
  const double there = sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 3);
  const double back = sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 3);
  EXPECT_GT(std::max(there, back), 1e-7);
  EXPECT_LE(std::max(there, back), slid.distance + 1e-14);
  EXPECT_LE(slid.distance, tolerance);
}

/// Nothing is off where nothing has changed.
TEST(SlidingSurface, AnAlmostFlatFaceThatStaysIsNowhereElse)
{
  MeshInput<3> in = slidingBox(3, 0.0);
  for (Vec<3>& x : in.points)
  {
    x[2] += x[2] == 1.0 && x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0 ? 5e-7 : 0.0;
  }
  const Sliding made(in, tolerance(1.5e-6));
  EXPECT_EQ(made.surface.distance(made.mesh), 0.0);
}

TEST(SlidingSurface, ACurvedBodyStaysWithinItsTolerance)
{
  MeshInput<3> in = slidingBox(6, 0.3, 3);
  bend(in);
  const SimplexMesh<3> before = buildMesh(in);
  double last = 0.0;
  for (double tolerance : { 2e-3, 2e-2 })
  {
    const Outcome slid = optimized(in, tolerance);
    EXPECT_GT(slid.report.worstAfter, last);
    last = slid.report.worstAfter;
    const double there = sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 6);
    const double back = sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 6);
    EXPECT_LE(there, slid.distance + 1e-12);
    EXPECT_LE(back, tolerance);
    EXPECT_LE(slid.distance, tolerance);
    EXPECT_GT(there, 0.0);
  }
  EXPECT_GE(last, 0.6);
}

TEST(SlidingSurface, RegionsKeepTheirVolumes)
{
  MeshInput<3> in = slidingBox(6, 0.0);
  splitRegions(in);
  // The interface x = 1/2 is displaced in its plane.
  TestRandom random(11);
  for (Vec<3>& x : in.points)
  {
    const bool isInside = (x.array() > 0.0).all() && (x.array() < 1.0).all();
    x += isInside ? 0.3 / 6 * Vec<3>(x[0] == 0.5 ? 0.0 : random(), random(), random())
                  : Vec<3>(Vec<3>::Zero());
  }
  const Outcome kept = optimized(in, 0.0, false), slid = optimized(in, 0.0);
  EXPECT_GE(slid.report.worstAfter, std::max(0.6, kept.report.worstAfter));
  double volumes[2] = { 0.0, 0.0 };
  for (Index c = 0; c < slid.mesh.numberOfCellSlots(); ++c)
  {
    if (slid.mesh.isAlive(c))
    {
      volumes[slid.mesh.region(c)] += signedVolume(slid.mesh.corners(c));
    }
  }
  EXPECT_NEAR(volumes[0], 0.5, 1e-14);
  EXPECT_NEAR(volumes[1], 0.5, 1e-14);
}

TEST(SlidingSurface, TheSameBytesWithAnyNumberOfThreads)
{
  MeshInput<3> in = slidingBox(20, 0.3, 5); // 48 000 cells: several chunks
  bend(in);
  const Outcome one = optimized(in, 1e-3, true, 1, Effort::Quick),
                two = optimized(in, 1e-3, true, 2, Effort::Quick);
  ASSERT_EQ(one.mesh.numberOfCellSlots(), two.mesh.numberOfCellSlots());
  ASSERT_EQ(one.mesh.numberOfPointSlots(), two.mesh.numberOfPointSlots());
  for (Index c = 0; c < one.mesh.numberOfCellSlots(); ++c)
  {
    ASSERT_EQ(one.mesh.isAlive(c), two.mesh.isAlive(c));
    ASSERT_TRUE(!one.mesh.isAlive(c) || one.mesh.nodes(c) == two.mesh.nodes(c));
  }
  for (Index p = 0; p < one.mesh.numberOfPointSlots(); ++p)
  {
    ASSERT_EQ(one.mesh.point(p), two.mesh.point(p));
  }
}

TEST(SlidingSurface, ARidgeStaysWhereItWas)
{
  // Bent by 2 degrees at x = 1/2: with no tolerance the crease is a curve like the others.
  MeshInput<3> in = slidingBox(6, 0.3, 9);
  for (Vec<3>& x : in.points)
  {
    x[2] += 0.035 * std::max(0.0, x[0] - 0.5) * (x[2] == 1.0 ? 1.0 : x[2]);
  }
  const SimplexMesh<3> before = buildMesh(in);
  const Outcome slid = optimized(in, 0.0);
  EXPECT_LE(sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 4), 1e-15);
  EXPECT_LE(sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 4), 1e-15);
}

/// The number of edges with more than two outer facets.
long touchingEdges(const SimplexMesh<3>& mesh)
{
  std::map<std::array<Index, 2>, int> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      for (int k = 0; k < 3 && mesh.adjacent(c, i) == None; ++k)
      {
        ++facets[sortedIds(f[k], f[(k + 1) % 3])];
      }
    }
  }
  return std::count_if(facets.begin(), facets.end(), [](const auto& f) { return f.second > 2; });
}

TEST(SlidingSurface, WhereItTouchesItselfItStays)
{
  // Two columns that share an edge, with bad cells.
  MeshInput<3> in = slidingBox(6, 0.35, 17);
  const MeshInput<3> regular = jitteredGrid<3>(6, 0.0);
  std::vector<Simplex<3>> cells;
  for (const Simplex<3>& cell : in.cells)
  {
    Vec<3> centre = Vec<3>::Zero();
    for (Index p : cell)
    {
      centre += 0.25 * regular.points[p];
    }
    if ((centre[0] < 0.5) == (centre[1] < 0.5))
    {
      cells.push_back(cell);
    }
  }
  in.cells = cells;
  ASSERT_EQ(touchingEdges(buildMesh(in)), 6);
  for (double tolerance : { 0.0, 1e-3, 0.05 })
  {
    const Outcome slid = optimized(in, tolerance);
    EXPECT_EQ(touchingEdges(slid.mesh), 6) << tolerance;
    EXPECT_GT(slid.report.worstAfter, slid.report.worstBefore);
    for (std::size_t p = 0; p < in.points.size(); ++p)
    {
      const Vec<3>& x = regular.points[p];
      if (x[0] == 0.5 && x[1] == 0.5)
      {
        EXPECT_EQ(slid.mesh.point(static_cast<Index>(p)), in.points[p]);
      }
    }
    // The qualities are those of the cells as they are.
    for (Index c = 0; c < slid.mesh.numberOfCellSlots(); ++c)
    {
      if (slid.mesh.isAlive(c))
      {
        ASSERT_GE(MeanEdgeShape<3>::value(slid.mesh.corners(c)), slid.report.worstAfter - 1e-12);
      }
    }
  }
}

/// Volumes of the regions 0, 1, 2.
std::array<double, 3> volumesOf(const SimplexMesh<3>& mesh)
{
  std::array<double, 3> volumes{};
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      volumes[mesh.region(c)] += signedVolume(mesh.corners(c));
    }
  }
  return volumes;
}

TEST(SlidingSurface, ThreeRegionsThatMeetInACurve)
{
  MeshInput<3> in = slidingBox(6, 0.0);
  for (const Simplex<3>& cell : in.cells)
  {
    Vec<3> centre = Vec<3>::Zero();
    for (Index p : cell)
    {
      centre += 0.25 * in.points[p];
    }
    in.regions.push_back(centre[0] < 0.5 ? 0 : centre[1] < 0.5 ? 1 : 2);
  }
  // All is displaced, but what is on a plane stays in it; then the body is bent.
  TestRandom random(29);
  for (Vec<3>& x : in.points)
  {
    const Vec<3> at = x;
    for (int d = 0; d < 3; ++d)
    {
      const double move = 0.3 / 6 * random();
      const bool isOnPlane = at[d] == 0.0 || at[d] == 1.0 || (d < 2 && at[d] == 0.5);
      x[d] += isOnPlane ? 0.0 : move;
    }
  }
  bend(in);
  const SimplexMesh<3> before = buildMesh(in);
  constexpr double tolerance = 2e-3;
  const Outcome kept = optimized(in, tolerance, false), slid = optimized(in, tolerance);
  EXPECT_GT(slid.report.worstAfter, kept.report.worstAfter);
  EXPECT_LE(slid.distance, tolerance);
  EXPECT_LE(sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 4), tolerance);
  EXPECT_LE(sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 4), tolerance);
  const auto was = volumesOf(before), is = volumesOf(slid.mesh);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(is[k], was[k], 0.5 * tolerance * areaOf(before)) << k;
  }
}

TEST(SlidingSurface, AThinPlateIsNotPressedFlat)
{
  // Thinner than the tolerance.
  constexpr double thickness = 8e-4, tolerance = 2e-3;
  MeshInput<3> in = slidingBox(8, 0.3, 31);
  for (Vec<3>& x : in.points)
  {
    x[2] *= thickness;
  }
  const SimplexMesh<3> before = buildMesh(in);
  const Outcome slid = optimized(in, tolerance);
  EXPECT_GT(slid.report.worstAfter, slid.report.worstBefore);
  EXPECT_LE(slid.distance, tolerance);
  // A seventh of the thickness from each side, at most.
  EXPECT_NEAR(slid.mesh.volume(), thickness, 0.22 * thickness);
  EXPECT_LE(sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 3), tolerance);
  // Only its rim, which no other sheet faces, has all of the tolerance, along the plate.
  for (Index p = 0; p < slid.mesh.numberOfPointSlots(); ++p)
  {
    const Vec<3>& x = slid.mesh.point(p);
    if (slid.mesh.isBoundary(p) && x[0] > tolerance && x[0] < 1.0 - tolerance && x[1] > tolerance &&
      x[1] < 1.0 - tolerance)
    {
      EXPECT_LE(std::min(std::abs(x[2]), std::abs(x[2] - thickness)), thickness / 7.0) << p;
    }
  }
}

/// Keeps the facets whose points all are in the middle of the first direction, then bends the body.
/// Both sides of this sheet are of one region.
std::vector<Index> addBentSheet(MeshInput<3>& in, int n)
{
  std::vector<Index> points;
  const auto isOn = [&](Index p) { return p % (n + 1) == n / 2; };
  for (const Simplex<3>& t : in.cells)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f{ t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4] };
      if (std::all_of(f.begin(), f.end(), isOn))
      {
        in.keptFacets.push_back(f);
      }
    }
  }
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    Vec<3>& x = in.points[p];
    const bool on = isOn(static_cast<Index>(p));
    x[0] = (on ? 0.5 : x[0]) + 0.13 * x[1] * x[1] + 0.07 * x[2];
    if (on)
    {
      points.push_back(static_cast<Index>(p));
    }
  }
  return points;
}

TEST(SlidingSurface, PointsOfASheetInsideOfARegionSlideInIt)
{
  constexpr int n = 4;
  MeshInput<3> in = slidingBox(n, 0.2, 7);
  const std::vector<Index> points = addBentSheet(in, n);
  SurfaceOptions options;
  options.tolerance = 1e-2;
  Sliding made(in, options);
  int inside = 0;
  std::vector<Index> star;
  for (Index p : points)
  {
    if (made.mesh.freedom(p) == Freedom::Patch)
    {
      ++inside;
      made.editor.star(p, star);
      std::array<Vec<3>, 3> basis;
      ASSERT_EQ(made.surface.tangents(made.mesh, star, p, basis), 2) << p;
      const Vec<3> normal = Vec<3>(1.0, -0.26 * in.points[p][1], -0.07).normalized();
      EXPECT_NEAR(std::fabs(basis[0].cross(basis[1]).dot(normal)), 1.0, 0.02) << p;
    }
  }
  EXPECT_EQ(inside, (n - 1) * (n - 1));
}

TEST(SlidingSurface, ASheetInsideOfARegionStaysWithinItsTolerance)
{
  constexpr double tolerance = 1e-2;
  MeshInput<3> in = slidingBox(6, 0.3, 7);
  addBentSheet(in, 6);
  const SimplexMesh<3> before = buildMesh(in);
  const Outcome kept = optimized(in, tolerance, false), slid = optimized(in, tolerance);
  EXPECT_GT(slid.report.worstAfter, kept.report.worstAfter);
  EXPECT_LE(slid.distance, tolerance);
  EXPECT_LE(sampledDistance(surfaceOf(slid.mesh), surfaceOf(before), 4), tolerance);
  EXPECT_LE(sampledDistance(surfaceOf(before), surfaceOf(slid.mesh), 4), tolerance);
}

/// A plate thinner than the tolerance: a facet of its upper side reaches down to the lower one.
/// Parts of it are the same points, but one looks the wrong way where the surface is nearest.
TEST(SlidingSurface, TurnedPartsOfAFacetAreRefused)
{
  constexpr double thickness = 1e-3;
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  for (Vec<3>& x : in.points)
  {
    x[2] *= thickness;
  }
  const Sliding plate(in, tolerance(1e-2));
  SurfacePiece<3> upper;
  upper.patch = None;
  for (Index c = 0; c < plate.mesh.numberOfCellSlots() && upper.patch == None; ++c)
  {
    for (int i = 0; i < 4 && upper.patch == None; ++i)
    {
      const Facet<3> f = plate.mesh.facet(c, i);
      if (std::all_of(
            f.begin(), f.end(), [&](Index p) { return plate.mesh.point(p)[2] == thickness; }))
      {
        std::transform(
          f.begin(), f.end(), upper.x.begin(), [&](Index p) { return plate.mesh.point(p); });
        upper.patch = plate.mesh.patch(c, i);
        upper.region = plate.mesh.region(c);
      }
    }
  }
  ASSERT_NE(upper.patch, None);
  for (const bool isTurned : { false, true })
  {
    SurfaceChange<3> change;
    change.gone.push_back(upper);
    // The centre of the whole is nearer to the upper side, that of one half may be to the lower.
    change.gone[0].x[2][2] = (isTurned ? -0.2 : 0.4) * thickness;
    for (int k : { 0, 2 }) // halves
    {
      change.come.push_back(change.gone[0]);
      change.come.back().x[k] = 0.5 * (change.gone[0].x[0] + change.gone[0].x[2]);
    }
    EXPECT_EQ(plate.surface.allows(change), !isTurned);
  }
}
}
