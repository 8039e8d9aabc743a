// SPDX-License-Identifier: BSD-3-Clause
// Division of long edges at bad cells: what it makes, what it leaves, and what a run makes of it.
#include "WorstFirst/LongEdges.h"

#include "Divisions.h"
#include "Optimize/Optimizer.h"

#include <algorithm>

using namespace meshopt;

namespace
{
/// A plate of prisms, as long as a tooth of a gear is beside its width.
MeshInput<3> needles(double length)
{
  MeshInput<3> in = slidingBox(3, 0.1);
  for (Vec<3>& x : in.points)
  {
    x[2] *= length;
  }
  return in;
}

Division divided(Sliding& sliding, double below, long growth, const Surface<3>* surface)
{
  return { sliding, growth, surface, {},
    [below](Run<3>& run) { return divideLongEdges(run, below, 0.6); } };
}

double volumeOf(const SimplexMesh<3>& mesh)
{
  double sum = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    sum += mesh.isAlive(c) ? signedVolume(mesh.corners(c)) : 0.0;
  }
  return sum;
}

}

TEST(LongEdges, AreDividedAndTheSurfaceStays)
{
  Sliding sliding(needles(40.0), tolerance(1e-3));
  const auto surface = surfaceOf(sliding.mesh);
  const double volume = volumeOf(sliding.mesh);
  const long cells = sliding.mesh.countCells();
  const Division division = divided(sliding, 1.0, AnyGrowth, &sliding.surface);
  EXPECT_GE(sliding.mesh.countCells(), cells + division.done); // each divides a cell at least
  EXPECT_NEAR(volumeOf(sliding.mesh), volume, 1e-12 * volume);
  // All were under 1: each that is left has a new node.
  for (Index c = 0; c < sliding.mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<3>& t = sliding.mesh.nodes(c);
    EXPECT_TRUE(
      !sliding.mesh.isAlive(c) || std::any_of(t.begin(), t.end(), [](Index p) { return p >= 64; }));
  }
  EXPECT_LT(sampledDistance(surfaceOf(sliding.mesh), surface, 4), 1e-12);
  EXPECT_LT(sampledDistance(surface, surfaceOf(sliding.mesh), 4), 1e-12);
  EXPECT_LT(sliding.surface.distance(sliding.mesh), 1e-3);
  // By longest edges only, halves do not become much worse than what they are halves of.
  EXPECT_GT(sortedQualities(sliding.mesh).front(), 0.25 * division.before.front());
  EXPECT_EQ(division.report.history.back().stage, "long edges divided");
  EXPECT_EQ(
    division.report.history.back().done[static_cast<int>(Operation::NodeInsertion)], division.done);
}

TEST(LongEdges, OnlyBadCellsAndWithinTheGrowth)
{
  Sliding good(needles(40.0), tolerance(1e-3));
  const Division nothing = divided(good, 1e-4, AnyGrowth, &good.surface);
  EXPECT_EQ(nothing.done, 0);
  EXPECT_TRUE(nothing.report.history.empty());
  Sliding few(needles(40.0), tolerance(1e-3));
  const long cells = few.mesh.countCells();
  const Division division = divided(few, 1.0, 20, &few.surface);
  EXPECT_GT(division.done, 0);
  EXPECT_LE(few.mesh.countCells(), cells + 20);
}

/// Without a surface that takes part only edges inside can be divided.
TEST(LongEdges, AKeptSurfaceStaysFacetByFacet)
{
  Sliding kept(needles(40.0), tolerance(1e-3));
  const auto surface = surfaceOf(kept.mesh);
  divided(kept, 1.0, AnyGrowth, nullptr);
  const auto after = surfaceOf(kept.mesh);
  ASSERT_EQ(after.size(), surface.size());
  EXPECT_EQ(sampledDistance(after, surface, 1), 0.0); // corners: they are where they were
}

/// Changes that must each raise the worst cell do not get through a row of needles. What they had
/// reached stands in the history before the first division.
TEST(LongEdges, ARunGetsThroughARowOfNeedles)
{
  Sliding sliding(gear(16, 2.0), tolerance(1e-3));
  NodalMetric<3> metric;
  Options options;
  options.growthBudget = 12.0;
  options.targetQuality = 0.5;
  const Report report = optimize<3>(sliding.mesh, metric, options, {}, &sliding.surface);
  expectSound(sliding.mesh);
  EXPECT_LE(sliding.surface.distance(sliding.mesh), 1e-3);
  const auto isDivision = [](const PassRecord& row) { return row.stage == "long edges divided"; };
  const auto first = std::find_if(report.history.begin(), report.history.end(), isDivision);
  ASSERT_NE(first, report.history.end());
  EXPECT_GT(report.worstAfter, 1.2 * (first - 1)->worst);
}

TEST(LongEdges, WithoutNewNodesThereIsNoDivision)
{
  Sliding sliding(gear(16, 2.0), tolerance(1e-3));
  NodalMetric<3> metric;
  Options options;
  options.insertNodes = false;
  const Report report = optimize<3>(sliding.mesh, metric, options, {}, &sliding.surface);
  for (const PassRecord& row : report.history)
  {
    EXPECT_NE(row.stage, "long edges divided");
    EXPECT_GE(row.worst, report.worstBefore);
  }
}

/// Stopped anywhere, a run is no worse than what it had reached: what a division has made worse is
/// undone if it has not been improved. Where the clock stops it differs; what must hold does not.
TEST(LongEdges, ARunThatIsStoppedIsNoWorse)
{
  Options options;
  options.growthBudget = 12.0;
  options.targetQuality = 0.45;
  options.effort = Effort::Quick;
  double whole = 0.0;
  for (double part : { 0.0, 0.4, 0.6, 0.8 }) // of the time of the first run, which has no limit
  {
    Sliding sliding(gear(16, 2.0), tolerance(1e-3));
    NodalMetric<3> metric;
    Control control;
    control.deadline = deadlineIn(part * whole);
    const Report report = optimize<3>(sliding.mesh, metric, options, control, &sliding.surface);
    expectSound(sliding.mesh);
    double reached = report.worstBefore;
    bool isDivided = false;
    for (const PassRecord& row : report.history)
    {
      isDivided = isDivided || row.stage == "long edges divided";
      reached = isDivided ? reached : std::max(reached, row.worst);
    }
    EXPECT_TRUE(isDivided || part > 0.0);
    EXPECT_GE(report.worstAfter, reached) << part;
    whole = part > 0.0 ? whole : report.seconds;
  }
}
