// SPDX-License-Identifier: BSD-3-Clause
// A surface that gives up ridges which it has kept at first: what goes, and what stays.
#include "Mesh/Ids.h"
#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "SlidingBoxes.h"
#include "StillSurface.h"

#include <functional>

using namespace meshopt;

namespace
{
/// A box with a gable roof whose ridge x = 0.5 turns by twice the angle with the tangent
/// slope(y). At the walls x = 0 and x = 1 it turns by 90 degrees less that angle.
MeshInput<3> house(int n, double jitter, const std::function<double(double)>& slope)
{
  MeshInput<3> in = jitteredGrid<3>(n, jitter);
  for (Vec<3>& x : in.points)
  {
    x[2] *= 2.0 - slope(x[1]) * std::fabs(x[0] - 0.5);
  }
  return in;
}

SurfaceOptions withRelease(double tolerance)
{
  SurfaceOptions options;
  options.tolerance = tolerance;
  options.featureAngle = 45.0;
  options.releaseAngle = 80.0;
  return options;
}

const double Slope60 = std::tan(std::acos(-1.0) / 6.0); ///< ridge and eaves turn by 60 degrees

/// The kept edges at the ridge, sorted ids, each once.
std::vector<std::array<Index, 2>> ridgeOf(const SimplexMesh<3>& mesh)
{
  std::vector<std::array<Index, 2>> edges;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int e = 0; e < 6 && mesh.isAlive(c); ++e)
    {
      const Simplex<3>& t = mesh.nodes(c);
      const Index a = t[Local<3>::edges[e][0]], b = t[Local<3>::edges[e][1]];
      // No other kept edge is near the plane of the ridge and along it.
      const Vec<3> d = mesh.point(b) - mesh.point(a);
      const bool isAlong = std::fabs(d[1]) > 0.9 * d.norm() && mesh.point(a)[2] > 1.5;
      if (isAlong && std::fabs(mesh.point(a)[0] - 0.5) < 0.1 && mesh.isEdgeKeptByItself(c, e))
      {
        edges.push_back(sortedIds(a, b));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

TEST(SlidingSurfaceRelease, PatchesGrowTogetherOverRidges)
{
  Sliding made(house(4, 0.0, [](double) { return Slope60; }), withRelease(0.01));
  EXPECT_EQ(made.surface.numberOfPatches(), 7); // floor, two walls, two gables, two sides
  EXPECT_EQ(made.surface.numberOfCurves(), 15u);
  EXPECT_EQ(made.count(Freedom::Corner), 10);
  EXPECT_EQ(ridgeOf(made.mesh).size(), 4u);
  ASSERT_TRUE(made.surface.mayRelease());
  ASSERT_TRUE(made.surface.release(made.editor));
  EXPECT_EQ(made.surface.numberOfPatches(), 4); // walls and roof are one
  EXPECT_EQ(made.surface.numberOfCurves(), 12u);
  // The outline of a gable turns by 60 degrees at the ridge, too.
  EXPECT_EQ(made.count(Freedom::Corner), 10);
  EXPECT_EQ(ridgeOf(made.mesh).size(), 0u);
  EXPECT_LT(made.surface.distance(made.mesh), 1e-15);
  EXPECT_FALSE(made.surface.mayRelease());
  EXPECT_FALSE(made.surface.release(made.editor));
}

TEST(SlidingSurfaceRelease, ARidgeStaysWhereItTurnsByMore)
{
  // From 60 degrees at y = 0 to 109 at y = 1: more than 80 from y = 0.32 on.
  const auto slope = [](double y) { return Slope60 + 0.82 * y; };
  Sliding made(house(8, 0.0, slope), withRelease(0.01));
  EXPECT_EQ(ridgeOf(made.mesh).size(), 8u);
  ASSERT_TRUE(made.surface.release(made.editor));
  const auto left = ridgeOf(made.mesh);
  EXPECT_EQ(left.size(), 5u);
  for (const std::array<Index, 2>& edge : left)
  {
    EXPECT_GE(std::min(made.mesh.point(edge[0])[1], made.mesh.point(edge[1])[1]), 0.375);
  }
  for (Index p = 0; p < made.mesh.numberOfPointSlots(); ++p)
  {
    const Vec<3>& x = made.mesh.point(p);
    if (x[0] == 0.5 && x[2] > 1.9 && x[1] < 0.9 && x[1] > 0.1)
    {
      EXPECT_EQ(made.mesh.freedom(p),
        x[1] < 0.3     ? Freedom::Patch
          : x[1] < 0.4 ? Freedom::Corner // where what is left begins
                       : Freedom::Curve);
    }
  }
}

TEST(SlidingSurfaceRelease, WhereTheSurfaceIsTooFarNothingIsGivenUp)
{
  Sliding made(house(4, 0.0, [](double) { return Slope60; }), withRelease(0.01));
  for (Index p = 0; p < made.mesh.numberOfPointSlots(); ++p)
  {
    const Vec<3> x = made.mesh.point(p);
    if (x == Vec<3>(0.5, 0.5, 0.0))
    {
      made.editor.movePoint(p, x + 0.02 * Vec<3>::UnitZ());
    }
  }
  EXPECT_FALSE(made.surface.release(made.editor));
  EXPECT_EQ(made.surface.numberOfPatches(), 7);
  EXPECT_EQ(ridgeOf(made.mesh).size(), 4u);
  EXPECT_FALSE(made.surface.mayRelease());
}

TEST(SlidingSurfaceRelease, PlacesAreThoseOfWhatIsLeft)
{
  const MeshInput<3> in = house(6, 0.35, [](double y) { return Slope60 + 0.82 * y; });
  const double tolerance = 0.01;
  Sliding made(in, withRelease(tolerance));
  const auto before = surfaceOf(made.mesh);
  NodalMetric<3> metric;
  Options options;
  options.targetQuality = 0.95; // not reached with the ridges
  const Report report = optimize<3>(made.mesh, metric, options, Control(), &made.surface);
  expectSound(made.mesh);
  EXPECT_FALSE(made.surface.mayRelease());
  const auto row = std::find_if(report.history.begin(), report.history.end(),
    [](const PassRecord& r) { return r.stage == "ridges given up"; });
  ASSERT_NE(row, report.history.end());
  EXPECT_GT(report.worstAfter, row->worst);
  long slid = 0;
  for (Index p = 0; p < made.mesh.numberOfPointSlots(); ++p)
  {
    const Place place = made.mesh.place(p);
    if (!made.mesh.isPointAlive(p) || made.mesh.isFree(p) || place.freedom == Freedom::Fixed)
    {
      continue;
    }
    const Vec<3>& x = made.mesh.point(p);
    if (place.freedom == Freedom::Curve)
    {
      EXPECT_LE((made.surface.at(place.part, place.parameter) - x).norm(), tolerance);
      ++slid;
    }
    else if (place.freedom == Freedom::Patch)
    {
      Vec<3> there;
      made.surface.project(place, x, there);
      EXPECT_LE((there - x).norm(), tolerance);
    }
  }
  EXPECT_GT(slid, 0);
  const double proved = made.surface.distance(made.mesh);
  EXPECT_LE(proved, tolerance);
  EXPECT_LE(sampledDistance(before, surfaceOf(made.mesh), 6), proved);
  EXPECT_LE(sampledDistance(surfaceOf(made.mesh), before, 6), proved);
}

/// A surface on which nothing moves, and that has more to keep now than in the end, but never lets
/// it go.
class Stubborn final : public StillSurface<3>
{
public:
  bool mayRelease() const override { return true; }
};

TEST(SlidingSurfaceRelease, WhereRidgesStayTheRunGoesOnWithThem)
{
  const MeshInput<3> in = jitteredGrid<3>(5, 0.45);
  Options options;
  options.targetQuality = 0.95; // out of reach
  const auto run = [&](Surface<3>* surface)
  {
    SimplexMesh<3> mesh = buildMesh(in);
    NodalMetric<3> metric;
    return optimize<3>(mesh, metric, options, Control(), surface);
  };
  Stubborn stubborn;
  const Report stayed = run(&stubborn);
  options.effort = Effort::Quick;
  options.growthBudget *= 0.5;
  const Report first = run(nullptr);
  // All that the first half does, and more.
  EXPECT_GT(stayed.history.size(), first.history.size());
  EXPECT_GE(stayed.worstAfter, first.worstAfter);
  EXPECT_EQ(std::count_if(stayed.history.begin(), stayed.history.end(),
              [](const PassRecord& r) { return r.stage == "ridges given up"; }),
    0);
}

TEST(SlidingSurfaceRelease, AnExactSurfaceHasNothingToGiveUp)
{
  Sliding made(house(4, 0.0, [](double) { return Slope60; }), withRelease(0.0));
  EXPECT_FALSE(made.surface.mayRelease());
  EXPECT_EQ(made.surface.numberOfPatches(), 7);
}
}
