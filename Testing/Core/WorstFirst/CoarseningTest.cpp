// SPDX-License-Identifier: BSD-3-Clause
// Removal of nodes where cells are good: what it leaves, what it may take, and what a run makes of
// the room.
#include "WorstFirst/Coarsening.h"

#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "SlidingBoxes.h"

#include <algorithm>
#include <set>

using namespace meshopt;

namespace
{
/// One call of coarsen(), with what was there before.
struct Removal
{
  Removal(Sliding& sliding, double above, long most, Measure measure = Measure::Shape,
    double target = 0.6)
    : clock(this->control)
  {
    this->options.measure = measure;
    this->options.targetQuality = target;
    computeQualities<3>(sliding.editor, this->metric, Measure::Shape, 0.0);
    this->shapes = sortedQualities(sliding.mesh);
    this->cells = cellsOf(sliding.mesh);
    computeQualities<3>(sliding.editor, this->metric, measure, 0.0);
    Run<3> run{ sliding.editor, this->metric, &sliding.surface, this->options, this->control,
      this->clock, this->report };
    this->gone = coarsen(run, above, most);
    expectSound(sliding.mesh);
  }
  static std::set<Simplex<3>> cellsOf(const SimplexMesh<3>& mesh)
  {
    std::set<Simplex<3>> cells;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      if (mesh.isAlive(c))
      {
        Simplex<3> nodes = mesh.nodes(c);
        std::sort(nodes.begin(), nodes.end());
        cells.insert(nodes);
      }
    }
    return cells;
  }
  /// The worst quality of the cells that were not there before.
  double worstNew(const SimplexMesh<3>& mesh) const
  {
    double worst = 1.0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      Simplex<3> nodes = mesh.nodes(c);
      std::sort(nodes.begin(), nodes.end());
      if (mesh.isAlive(c) && this->cells.count(nodes) == 0)
      {
        worst = std::min(worst, mesh.quality(c));
      }
    }
    return worst;
  }

  NodalMetric<3> metric;
  Options options;
  Control control;
  Clock clock;
  Report report;
  std::vector<double> shapes; ///< before, sorted
  std::set<Simplex<3>> cells; ///< before, by sorted nodes
  long gone = 0;
};

std::array<int, 4> countFreedoms(const SimplexMesh<3>& mesh)
{
  std::array<int, 4> counts{};
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const auto k = static_cast<std::size_t>(mesh.freedom(p));
    if (mesh.cellOfPoint(p) != None && k < counts.size())
    {
      ++counts[k];
    }
  }
  return counts;
}
}

TEST(Coarsening, LeavesGoodCellsAndTheSurface)
{
  Sliding sliding(slidingBox(5, 0.2), tolerance(1e-3));
  const auto surface = surfaceOf(sliding.mesh);
  const long cells = sliding.mesh.countCells();
  const double volume = sliding.mesh.volume();
  const Removal removal(sliding, 1.5, AnyGrowth);
  EXPECT_GT(removal.gone, 0);
  EXPECT_EQ(sliding.mesh.countCells(), cells - removal.gone);
  EXPECT_GT(removal.worstNew(sliding.mesh), 1.5 * removal.shapes.front());
  EXPECT_NEAR(sliding.mesh.volume(), volume, 1e-12);
  EXPECT_LT(sampledDistance(surfaceOf(sliding.mesh), surface, 4), 1e-12);
  EXPECT_LT(sampledDistance(surface, surfaceOf(sliding.mesh), 4), 1e-12);
  ASSERT_EQ(removal.report.history.size(), 1u);
  const PassRecord& row = removal.report.history.back();
  EXPECT_EQ(row.stage, "coarsened");
  const auto k = static_cast<std::size_t>(Operation::EdgeContraction);
  EXPECT_GT(row.done[k], 0);
  EXPECT_GT(row.tried[k], row.done[k]);
}

TEST(Coarsening, NodesVanishInsideOnPatchesAndOnCurvesButNoCorner)
{
  Sliding sliding(slidingBox(5, 0.2), tolerance(1e-3));
  const auto before = countFreedoms(sliding.mesh);
  Removal(sliding, 1.0, AnyGrowth);
  const auto after = countFreedoms(sliding.mesh);
  for (Freedom f : { Freedom::Free, Freedom::Patch, Freedom::Curve })
  {
    EXPECT_LT(after[static_cast<int>(f)], before[static_cast<int>(f)]) << static_cast<int>(f);
  }
  EXPECT_EQ(sliding.count(Freedom::Corner), 8);
  EXPECT_EQ(after[static_cast<int>(Freedom::Corner)], before[static_cast<int>(Freedom::Corner)]);
}

TEST(Coarsening, EndsWhenEnoughIsGone)
{
  Sliding sliding(slidingBox(5, 0.2), tolerance(1e-3));
  const Removal removal(sliding, 1.0, 20);
  EXPECT_GE(removal.gone, 20);
  EXPECT_LT(removal.gone, 60); // one node more at most
}

/// New cells need not be better than the target; and where none would be good enough, all stays.
TEST(Coarsening, TheFloorIsAtMostTheTarget)
{
  constexpr double far = 100.0;
  Sliding sliding(slidingBox(3, 0.0), tolerance(1e-3));
  const Removal removal(sliding, far, AnyGrowth);
  EXPECT_GT(removal.gone, 0);
  EXPECT_GT(removal.worstNew(sliding.mesh), removal.options.targetQuality);
  Sliding all(slidingBox(3, 0.0), tolerance(1e-3));
  const Removal nothing(all, far, AnyGrowth, Measure::Shape, 1.0);
  EXPECT_EQ(nothing.gone, 0);
  EXPECT_TRUE(nothing.report.history.empty());
}

/// Of neighbours only one: each cell that was there has lost one node at most.
TEST(Coarsening, OfNeighboursOnlyOneVanishes)
{
  Sliding sliding(slidingBox(5, 0.2), tolerance(1e-3));
  const Removal removal(sliding, 0.5, AnyGrowth);
  ASSERT_GT(removal.gone, 0);
  for (const Simplex<3>& cell : removal.cells)
  {
    EXPECT_LE(std::count_if(cell.begin(), cell.end(),
                [&](Index p) { return sliding.mesh.cellOfPoint(p) == None; }),
      1);
  }
}

/// The floor is one of shapes; the qualities that are stored afterwards are the caller's.
TEST(Coarsening, KnowsTheCallersMeasure)
{
  Sliding sliding(slidingBox(4, 0.2), tolerance(1e-3));
  const Removal removal(sliding, 1.0, AnyGrowth, Measure::RadiusRatio);
  ASSERT_GT(removal.gone, 0);
  const std::vector<double> stored = sortedQualities(sliding.mesh);
  NodalMetric<3> metric;
  computeQualities<3>(sliding.editor, metric, Measure::RadiusRatio, 0.0);
  EXPECT_EQ(sortedQualities(sliding.mesh), stored);
  computeQualities<3>(sliding.editor, metric, Measure::Shape, 0.0);
  EXPECT_GT(removal.worstNew(sliding.mesh), removal.shapes.front());
}

/// Where the budget is short, a run takes nodes away at good cells, and ends higher for it (five
/// gears together: where one run ends depends on small things, too); not where nodes must stay, or
/// where there is room.
TEST(Coarsening, ARunExchangesNodesWhenItsBudgetIsShort)
{
  const auto run = [](int teeth, double growth, bool removes)
  {
    Sliding sliding(gear(teeth, 1.0), tolerance(1e-3));
    const auto most = static_cast<long>((1.0 + growth) * sliding.mesh.countCells());
    NodalMetric<3> metric;
    Options options;
    options.effort = Effort::Quick;
    options.growthBudget = growth;
    options.removeNodes = removes;
    const Report report = optimize<3>(sliding.mesh, metric, options, {}, &sliding.surface);
    expectSound(sliding.mesh);
    EXPECT_LE(sliding.mesh.countCells(), most);
    EXPECT_LE(sliding.surface.distance(sliding.mesh), 1e-3);
    return report;
  };
  const auto exchanges = [](const Report& report)
  {
    return std::any_of(report.history.begin(), report.history.end(),
      [](const PassRecord& row) { return row.stage == "coarsened"; });
  };
  double worstWith = 0.0, worstWithout = 0.0;
  int exchanging = 0;
  for (int teeth : { 12, 14, 16, 18, 20 })
  {
    const Report with = run(teeth, 3.0, true), without = run(teeth, 3.0, false);
    exchanging += exchanges(with);
    EXPECT_FALSE(exchanges(without));
    worstWith += with.worstAfter;
    worstWithout += without.worstAfter;
  }
  EXPECT_GE(exchanging, 3); // others stop before they have used so much of the budget
  EXPECT_GT(worstWith, 1.1 * worstWithout);
  EXPECT_FALSE(exchanges(run(12, 10.0, true)));
}
