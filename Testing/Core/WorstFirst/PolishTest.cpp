// SPDX-License-Identifier: BSD-3-Clause
// Which cells are polished: so many of the worst, more of them while there is hope, those around
// them past the target; and none that a cap holds.
#include "WorstFirst/Polish.h"
#include "CappedCell.h"
#include "EngineBench.h"

#include <set>

using namespace meshopt;
using namespace meshopt::worstfirst;

namespace
{
const int Rank = rankOf(Phase::Polishing, Level::LongLookAhead);

std::vector<Index> firstOf(std::vector<Index> cells, std::size_t n)
{
  EXPECT_GE(cells.size(), n);
  cells.resize(n);
  return cells;
}

/// Frozen, with a bound that is not that of the mesh: by that of 1 there is no hope.
Options boundBy(double bound, double target)
{
  Options options = frozen(upTo(target));
  options.mostQuality = bound;
  return options;
}

/// How many layers around `from` each cell is away; a layer shares a node with the one before.
template <int D>
std::vector<int> layersAround(const SimplexMesh<D>& mesh, const std::vector<Index>& from)
{
  const Index cells = mesh.numberOfCellSlots();
  std::vector<int> layers(cells, cells); // far away
  for (Index c : from)
  {
    layers[c] = 0;
  }
  for (int layer = 1; layer <= LiftedLayers + 1; ++layer)
  {
    std::set<Index> nodes; // of the layers before
    for (Index c = 0; c < cells; ++c)
    {
      const Simplex<D>& t = mesh.nodes(c);
      nodes.insert(t.begin(), layers[c] < layer ? t.end() : t.begin());
    }
    for (Index c = 0; c < cells; ++c)
    {
      const Simplex<D>& t = mesh.nodes(c);
      const bool touches = std::any_of(t.begin(), t.end(), [&](Index p) { return nodes.count(p); });
      layers[c] = touches ? std::min(layers[c], layer) : layers[c];
    }
  }
  return layers;
}

/// A cell at its cap, and one beside it with a quality that is set by hand.
struct Capped : EngineBench<3>
{
  Capped(double ofFirst, double ofSecond)
    : EngineBench<3>(cappedCellAndCorner(0.1), frozen(upTo(0.95)))
  {
    this->editor.setQuality(0, ofFirst * this->mesh.quality(0));
    this->editor.setQuality(1, ofSecond);
  }
};
}

template <class T>
class PolishOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(PolishOf, TestDimensions);

/// In vain: one round, with all operations and without guard.
TEST(Polish, TriesTheFewWorstCells)
{
  EngineBench<2> bench(jitteredGrid<2>(10, 0.25), boundBy(1.0, 0.9));
  EXPECT_TRUE(bench.polish.run(0.9, false));
  const std::vector<Index> worst = firstOf(bench.cellsUnder(0.9), PolishedCells);
  EXPECT_EQ(bench.triedCells(), worst);
  for (Index c : worst)
  {
    EXPECT_EQ(bench.triedAt(c), Rank);
  }
  EXPECT_EQ(bench.rows(), 1u);
  EXPECT_EQ(bench.report.history.back().stage, "polish towards 0.90");
}

/// A quick run leaves the others as they are once nothing can lift the worst one.
TEST(Polish, AQuickRunEndsAtTheBound)
{
  const MeshInput<2> in = jitteredGrid<2>(10, 0.25);
  const double worst = sortedQualities(EngineBench<2>(in, {}).mesh).front();
  const auto polished = [&](Effort effort, double bound)
  {
    Options options = boundBy(bound, 0.9);
    options.effort = effort;
    EngineBench<2> bench(in, options);
    EXPECT_TRUE(bench.polish.run(0.9, false));
    return bench.triedCells().size();
  };
  EXPECT_EQ(polished(Effort::Quick, worst / CapReached - 1e-6), 0u);
  EXPECT_GE(polished(Effort::Quick, worst / CapReached + 1e-6), PolishedCells);
  EXPECT_GE(polished(Effort::Default, worst / CapReached - 1e-6), PolishedCells);
}

/// At the target of the run, if the worst cell is far below the bound. Then twice as many, up to
/// the most, as long as there is something left to spend; not in a run that others follow.
TEST(Polish, TakesMoreCellsWhereThereIsHope)
{
  const MeshInput<2> in = jitteredGrid<2>(10, 0.25);
  const double worst = sortedQualities(EngineBench<2>(in, {}).mesh).front();
  const auto polished = [&](double target, double bound, auto before)
  {
    EngineBench<2> bench(in, boundBy(bound, 0.9));
    before(bench);
    EXPECT_TRUE(bench.polish.run(target, false));
    const std::vector<Index> tried = bench.triedCells();
    EXPECT_EQ(tried, firstOf(bench.cellsUnder(0.9), tried.size()));
    EXPECT_EQ(bench.rows(), 1u);
    return tried.size();
  };
  const auto nothing = [](EngineBench<2>&) {};
  EXPECT_EQ(polished(0.9, 0.95, nothing), MostBelowBound);
  EXPECT_EQ(polished(0.89, 0.95, nothing), PolishedCells); // a stage on the way
  EXPECT_EQ(polished(0.9, worst / FarBelowBound + 1e-6, nothing), MostBelowBound);
  EXPECT_EQ(polished(0.9, worst / FarBelowBound - 1e-6, nothing), PolishedCells);
  EXPECT_EQ(polished(0.9, 0.95, [](EngineBench<2>& bench) { bench.allowance.noteLooks(1000); }),
    PolishedCells);
  EXPECT_EQ(polished(0.9, 0.95, [](EngineBench<2>& bench) { bench.run.polishesWidely = false; }),
    PolishedCells);
  const auto spendAll = [](EngineBench<2>& bench)
  {
    bench.allowance.notePolish(0, 1.0); // from now on nothing is a rise
    bench.allowance.notePolish(1000000000, 1.0);
  };
  EXPECT_EQ(polished(0.9, 0.95, spendAll), 0u);
}

/// Past the target: first more of the worst cells, then those around the worst, in ever wider
/// neighbourhoods and with higher targets. All qualities of this mesh are close together.
TYPED_TEST(PolishOf, PastTheTargetCellsAroundTheWorstAreTried)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(jitteredGrid<D>(D == 3 ? 5 : 14, 0.03), boundBy(1.0, 0.3));
  const std::vector<Index> all = bench.cellsUnder(0.95);
  const std::vector<Index> worst = firstOf(all, MostPolishedCells);
  const std::vector<int> layers = layersAround(bench.mesh, firstOf(all, PolishedCells));
  EXPECT_TRUE(bench.polish.run(0.95, false));
  EXPECT_EQ(bench.rows(), 1u);
  int around = 0, beyond = 0;
  for (Index c : all)
  {
    bool isAround = false;
    for (int layer = 1; layer <= LiftedLayers; ++layer)
    {
      const double target = bench.mesh.quality(all[0]) + layer * LiftStep;
      isAround = isAround || (layers[c] <= layer && bench.mesh.quality(c) < target);
    }
    const bool isWorst = std::find(worst.begin(), worst.end(), c) != worst.end();
    EXPECT_EQ(bench.triedAt(c),
      isWorst      ? Rank
        : isAround ? rankOf(Phase::Polishing, Level::Insertion)
                   : None)
      << c;
    around += isAround && !isWorst;
    beyond += !isAround && !isWorst && layers[c] <= LiftedLayers + 1;
  }
  EXPECT_GT(around, 10);
  EXPECT_GT(beyond, 10);
}

/// The rounds of one polish do not repeat the search around the worst cell, the next polish does.
TEST(Polish, BeginsAnewWithWhatWasInVain)
{
  Options options = boundBy(0.99, 0.95);
  options.insertNodes = true;
  EngineBench<3> bench(jitteredGrid<3>(7, 1e-7), options);
  const MeshBits<3> bits = bitsOf(bench.mesh);
  const std::vector<Index> all = bench.cellsUnder(1.0);
  const auto evaluations = [&]
  {
    const std::int64_t before = bench.report.evaluations;
    bench.editor.stamp(all);
    EXPECT_TRUE(bench.polish.run(0.9, false));
    EXPECT_EQ(bitsOf(bench.mesh), bits);
    return bench.report.evaluations - before;
  };
  const std::int64_t first = evaluations();
  EXPECT_GT(first, 0);
  EXPECT_EQ(evaluations(), first);
}

// ---- caps ---------------------------------------------------------------------------------------

/// If a cap holds the worst cell, the next ones are tried only if they are bad.
TEST(Polish, CellsThatACapHoldsAreSpared)
{
  ASSERT_LT(Capped(1.0, 0.9).mesh.quality(0), Stages[1] - 0.01);
  for (const double next : { Stages[1] - 1e-6, Stages[1] + 1e-6 })
  {
    Capped bench(1.0, next);
    EXPECT_TRUE(bench.polish.run(0.9, false));
    EXPECT_EQ(bench.triedAt(0), None);
    EXPECT_EQ(bench.triedAt(1), next < Stages[1] ? Rank : None);
  }
}

TEST(Polish, FinelyIsCloserToTheCap)
{
  const double between = 0.5 * (CapReached + CapReachedFinely);
  for (const bool finely : { false, true })
  {
    Capped bench(between, 0.9);
    EXPECT_TRUE(bench.polish.run(0.9, finely));
    EXPECT_EQ(bench.triedAt(0), finely ? Rank : None);
    EXPECT_TRUE(bench.workpiece.caps().isCapped(bench.mesh, 0)); // as before
  }
}

// ---- and repaired -------------------------------------------------------------------------------

/// The stage follows, unless the target is past that of the run. At the end of all that is to come
/// the reserve of the growth is opened.
TEST(Polish, WhatPolishingMakesWorseIsLifted)
{
  struct Case
  {
    double target, goal; ///< of the stage, and of the run
    bool isLast, repairs, opens;
  };
  const std::vector<Case> cases{
    { 0.62, 0.7, false, true, false },
    { 0.62, 0.7, true, true, true },
    { 0.62, 0.62, false, true, true }, // the target is not reached
    { 0.3, 0.3, false, false, false },
    { 0.3, 0.3, true, false, true },
    { 0.62, 0.3, true, false, false },
  };
  for (const Case& k : cases)
  {
    EngineBench<2> bench(jitteredGrid<2>(14, 0.25), boundBy(1.0, k.goal));
    const std::vector<Index> bad = bench.cellsUnder(k.target);
    ASSERT_TRUE(k.target < 0.5 ? bad.empty() : bad.size() > PolishedCells);
    ASSERT_LE(bad.size(), static_cast<std::size_t>(bench.workpiece.fewCells()));
    const long lifting = bench.growthLeft();
    EXPECT_TRUE(bench.polish.runAndRepair(k.target, k.isLast));
    EXPECT_EQ(bench.growthLeft(), k.opens ? bench.run.growth : lifting);
    EXPECT_LT(lifting, bench.run.growth);
    const auto isLifted = [&](Index c) { return bench.triedAt(c) == Level::LookAhead; };
    EXPECT_EQ(std::count_if(bad.begin(), bad.end(), isLifted) > 0, k.repairs) << k.target;
    EXPECT_EQ(bench.report.history.back().stage.rfind("towards", 0) == 0, k.repairs);
  }
}

/// Then more nodes may vanish than before, where the surface is kept.
TEST(Polish, AtTheEndMoreNodesMayVanish)
{
  const StillSurface<2> judging(true);
  const auto mayVanish = [](bool isLast, const StillSurface<2>* surface)
  {
    EngineBench<2> bench(jitteredGrid<2>(14, 0.25), boundBy(1.0, 0.7), surface);
    EXPECT_TRUE(bench.polish.runAndRepair(0.62, isLast));
    bench.budget.takeBack(Phase::Lifting, 10 * bench.run.growth, false); // many cells are gone
    return bench.budget.share(Phase::Lifting, 1, 1.0 - 1.5 * ShrinkBudget).mayShrink();
  };
  EXPECT_FALSE(mayVanish(false, nullptr));
  EXPECT_TRUE(mayVanish(true, nullptr));
  EXPECT_FALSE(mayVanish(true, &judging));
}

TYPED_TEST(PolishOf, TheWorstCellRises)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(jitteredGrid<D>(D == 3 ? 5 : 14, 0.3), upTo(0.6));
  const std::vector<double> before = sortedQualities(bench.mesh);
  EXPECT_TRUE(bench.polish.run(0.6, false));
  const std::vector<double> after = sortedQualities(bench.mesh);
  EXPECT_TRUE(isAbove(after, before));
  EXPECT_GT(after.front(), before.front() + 0.05);
  EXPECT_EQ(bench.report.history.back().worst, after.front());
  expectSound(bench.mesh);
}

TEST(Polish, StopsWithTheTime)
{
  EngineBench<2> bench(jitteredGrid<2>(10, 0.25), boundBy(1.0, 0.9));
  bench.control.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(bench.polish.run(0.9, false));
  EXPECT_FALSE(bench.polish.runAndRepair(0.9, false));
  EXPECT_TRUE(bench.triedCells().empty());
}
