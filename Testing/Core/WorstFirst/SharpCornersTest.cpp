// SPDX-License-Identifier: BSD-3-Clause
// Division of edges at sharp corners: what it makes, what it leaves, and what a run makes of it.
#include "WorstFirst/SharpCorners.h"

#include "Divisions.h"
#include "Optimize/Optimizer.h"

#include <algorithm>
#include <array>

using namespace meshopt;

namespace
{
/// A blade with its point at the origin, where two curves enclose an angle of 2 atan(half).
MeshInput<3> blade(double half, double height)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, -half, 0 }, { 1, half, 0 }, { 0.6, 0, height },
    { 0.6, 0, -height } };
  in.cells = { { 0, 1, 2, 3 }, { 0, 2, 1, 4 } };
  return in;
}

Division divided(Sliding& sliding, double below, long growth, bool moves = true)
{
  Options options;
  options.moveNodes = moves;
  return { sliding, growth, &sliding.surface, options,
    [below](Run<3>& run) { return divideAtCorners(run, below); } };
}

/// The worst shape at the point of the blade.
double worstAtPoint(const Sliding& sliding)
{
  std::vector<Index> star;
  sliding.mesh.star(0, star);
  return sliding.mesh.worstQuality(star);
}
}

TEST(SharpCorners, EdgesAreDividedAndTheNewNodesGoApart)
{
  Sliding still(blade(0.02, 0.5), tolerance(0.1)), sliding(blade(0.02, 0.5), tolerance(0.1));
  const Division only = divided(still, 1.0, AnyGrowth, false);
  const Division moved = divided(sliding, 1.0, AnyGrowth);
  EXPECT_GE(only.done, 2);
  EXPECT_GE(moved.done, 2);
  EXPECT_EQ(sliding.mesh.countPoints(), 5 + moved.done);
  EXPECT_GT(worstAtPoint(sliding), 1.2 * worstAtPoint(still));
  EXPECT_LE(sliding.surface.distance(sliding.mesh), 0.1);
  EXPECT_EQ(moved.report.history.back().stage, "edges at corners divided");
  EXPECT_EQ(
    moved.report.history.back().done[static_cast<int>(Operation::NodeInsertion)], moved.done);
}

TEST(SharpCorners, OnlyBadCellsAndWithinTheGrowth)
{
  Sliding good(blade(0.02, 0.5), tolerance(0.1));
  const Division nothing = divided(good, 1e-4, AnyGrowth);
  EXPECT_EQ(nothing.done, 0);
  EXPECT_TRUE(nothing.report.history.empty());
  Sliding full(blade(0.02, 0.5), tolerance(0.1));
  const Division none = divided(full, 1.0, 0);
  EXPECT_EQ(none.done, 0);
  EXPECT_EQ(full.mesh.countCells(), 2);
}

/// A right angle is not sharp, and a cell needs no smaller one.
TEST(SharpCorners, OtherCornersStayAsTheyAre)
{
  Sliding sliding(slidingBox(3, 0.1), tolerance(1e-3));
  EXPECT_EQ(sliding.count(Freedom::Corner), 8);
  EXPECT_EQ(divided(sliding, 1.0, AnyGrowth).done, 0);
}

/// Runs divide them where their first parts have not reached the target, and end higher (three
/// blades together: what one run does depends on small things, too).
TEST(SharpCorners, RunsDivideThem)
{
  constexpr std::array<double, 2> blades[] = { { 0.04, 0.1 }, { 0.06, 0.05 }, { 0.06, 0.1 } };
  double before = 0.0, after = 0.0;
  int divided = 0;
  for (const auto [half, height] : blades)
  {
    Sliding sliding(blade(half, height), tolerance(0.01));
    NodalMetric<3> metric;
    Options options;
    options.growthBudget = 30.0;
    options.effort = Effort::Quick;
    const Report report = optimize<3>(sliding.mesh, metric, options, {}, &sliding.surface);
    expectSound(sliding.mesh);
    EXPECT_LE(sliding.surface.distance(sliding.mesh), 0.01);
    const auto first = std::find_if(report.history.begin(), report.history.end(),
      [](const PassRecord& row) { return row.stage == "edges at corners divided"; });
    if (first != report.history.end())
    {
      ++divided;
      before += (first - 1)->worst;
      after += report.worstAfter;
    }
  }
  EXPECT_GE(divided, 2);
  EXPECT_GT(after, 1.1 * before);
}
