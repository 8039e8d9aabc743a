// SPDX-License-Identifier: BSD-3-Clause
// One pass: its row against its counts, growth against cells, the guard cell by cell, what is tried
// again and what not, and cells at the borders of chunks.
#include "WorstFirst/Pass.h"
#include "CappedCell.h"
#include "EngineBench.h"

#include <numeric>

using namespace meshopt;
using namespace meshopt::worstfirst;

namespace
{
constexpr auto Swaps = static_cast<int>(meshopt::Operation::EdgeRemoval);

/// In the plane each try is then one try of an edge removal, and each change swaps one edge.
Options swapsOnly(double target)
{
  Options options = frozen(upTo(target));
  options.reconnect = true;
  return options;
}

template <int D>
MeshInput<D> roughGrid()
{
  return jitteredGrid<D>(D == 3 ? 5 : 14, 0.3);
}

template <int D>
PassResult runPass(EngineBench<D>& bench, Phase phase, double target, int level)
{
  const std::vector<Index> bad = bench.cellsUnder(target);
  Task task{ phase, target, target, ThriftyGain, level };
  task.below = static_cast<long>(bad.size());
  return bench.pass.run(task, bad);
}

long sumOf(const std::array<long, NumberOfOperations>& counts)
{
  return std::accumulate(counts.begin(), counts.end(), 0L);
}

/// How bad the cells are in all, by the rule of Judge::setGuard().
template <int D>
int badness(const EngineBench<D>& bench, double guard)
{
  int sum = 0;
  for (const double quality : { guard, guard * (2.0 / 3.0), guard * (1.0 / 3.0) })
  {
    sum += static_cast<int>(bench.cellsUnder(quality).size());
  }
  return sum;
}
}

template <class T>
class PassOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(PassOf, TestDimensions);

TYPED_TEST(PassOf, TheRowHasTheCountsOfThePass)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(roughGrid<D>(), upTo(0.6));
  const PassResult result = runPass(bench, Phase::Lifting, 0.6, Level::Insertion);
  EXPECT_TRUE(result.goesOn);
  EXPECT_GT(result.accepted, 10);
  ASSERT_EQ(bench.rows(), 1u);
  const PassRecord& row = bench.report.history.back();
  EXPECT_EQ(row.tried, result.tried);
  EXPECT_EQ(row.done, result.done);
  EXPECT_EQ(row.stage, "towards 0.60, pass 1");
  EXPECT_GE(sumOf(row.done), result.accepted); // one try may move several nodes
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    EXPECT_LE(row.done[op], row.tried[op]) << OperationNames[op];
  }
  EXPECT_EQ(row.belowTarget, static_cast<long>(bench.cellsUnder(0.6).size()));
  EXPECT_GT(result.evaluations, 0);
  EXPECT_EQ(bench.report.evaluations, result.evaluations);
  const PassResult second = runPass(bench, Phase::Polishing, 0.6, Level::LongLookAhead);
  EXPECT_EQ(bench.report.history.back().tried, second.tried); // counts begin anew
  EXPECT_EQ(bench.report.evaluations, result.evaluations + second.evaluations);
  expectSound(bench.mesh);
}

TYPED_TEST(PassOf, NodesMayVanishAlthoughManyCellsAreGone)
{
  constexpr int D = TypeParam::dimension;
  Options options = frozen(upTo(0.6));
  options.removeNodes = true;
  const StillSurface<D> judging(true);
  const auto tried = [&](const StillSurface<D>* surface, double target)
  {
    EngineBench<D> bench(roughGrid<D>(), options, surface);
    // As if swaps had removed cells.
    bench.budget.takeBack(Phase::Lifting, 10 * bench.run.growth, false);
    EXPECT_GT(bench.cellsUnder(target).size(), 0u);
    constexpr auto contraction = static_cast<int>(meshopt::Operation::EdgeContraction);
    return runPass(bench, Phase::Lifting, target, Level::Removal).tried[contraction];
  };
  EXPECT_GT(tried(nullptr, Stages[0]), 0);
  EXPECT_GT(tried(nullptr, Stages[1]), 0);
  // Where the surface takes part only very bad cells get rid of them.
  EXPECT_GT(tried(&judging, Stages[0]), 0);
  EXPECT_EQ(tried(&judging, Stages[1]), 0);
}

// What borders of chunks hold up is tried again in further drains. These may not remove as many
// nodes once more.
TEST(Pass3D, AllDrainsTogetherRemoveNoMoreNodesThanMayVanish)
{
  constexpr int Chunks = 2;
  Options options = frozen(upTo(0.6));
  options.removeNodes = true;
  EngineBench<3> bench(jitteredGrid<3>(20, 0.45), options);
  ASSERT_EQ(bench.mesh.numberOfCellSlots() / CellsPerChunk, Chunks);
  bench.budget.takeBack(Phase::Lifting, 10 * bench.run.growth, false);
  // As if most of the nodes that may vanish were gone.
  const long before = bench.mesh.countPoints(), spare = 4;
  const double least = 1.0 - ShrinkBudget;
  const long first = static_cast<long>(static_cast<double>(before - spare) / least);
  bench.report.history.front().points = first;
  const PassResult result = runPass(bench, Phase::Lifting, Stages[0], Level::Removal);
  constexpr auto contraction = static_cast<int>(meshopt::Operation::EdgeContraction);
  EXPECT_GT(result.done[contraction], 0);
  // Each chunk may go on until it has removed its share of cells, and one node more.
  EXPECT_GE(
    static_cast<double>(bench.mesh.countPoints()), least * static_cast<double>(first) - Chunks);
}

TEST(Pass2D, EachChangeIsCountedOnce)
{
  EngineBench<2> bench(roughGrid<2>(), swapsOnly(0.6));
  const PassResult result = runPass(bench, Phase::Lifting, 0.6, Level::Topology);
  EXPECT_GT(result.accepted, 5);
  EXPECT_EQ(result.done[Swaps], result.accepted);
  EXPECT_EQ(sumOf(result.done), result.accepted);
  EXPECT_EQ(sumOf(result.tried), result.tried[Swaps]);
}

TYPED_TEST(PassOf, GrowthUsedIsCellsGained)
{
  constexpr int D = TypeParam::dimension;
  for (const Phase phase : { Phase::Lifting, Phase::Polishing })
  {
    for (const bool inserts : { false, true })
    {
      Options options = frozen(upTo(0.9));
      options.insertNodes = inserts;
      options.removeNodes = !inserts;
      EngineBench<D> bench(roughGrid<D>(), options);
      const long left = bench.growthLeft();
      const Index cells = bench.mesh.countCells();
      runPass(bench, phase, D == 3 ? 0.45 : 0.9, Level::Insertion);
      const long gained = bench.mesh.countCells() - cells;
      EXPECT_TRUE(inserts ? gained > 0 : gained < 0) << gained;
      EXPECT_EQ(left - bench.growthLeft(), gained);
    }
  }
}

TYPED_TEST(PassOf, WithoutGrowthNoNodeComes)
{
  constexpr int D = TypeParam::dimension;
  Options options = frozen(upTo(0.9));
  options.insertNodes = true;
  options.growthBudget = 0.0;
  EngineBench<D> bench(roughGrid<D>(), options);
  const MeshBits<D> before = bitsOf(bench.mesh);
  runPass(bench, Phase::Lifting, 0.9, Level::Insertion);
  EXPECT_EQ(bitsOf(bench.mesh), before);
  EXPECT_TRUE(bench.budget.isUsedUp()); // it was asked for
}

/// Cell by cell, each in a mesh of its own: in a pass over all a change that makes cells bad would
/// hide behind others. Weights say that a cell on a tiny facet is good, which others must not pay.
TEST(Pass3D, WithWeightsNoCellIsLiftedByMakingOthersBad)
{
  Options options = frozen(upTo(0.6));
  options.reconnect = true;
  MeshInput<3> in = jitteredGrid<3>(5, 0.45);
  const auto first = static_cast<Index>(in.points.size());
  const MeshInput<3> capped = cellAtItsCap(0.01);
  in.cells.push_back({ first, first + 1, first + 2, first + 3 });
  for (const Vec<3>& x : capped.points)
  {
    in.points.push_back(x + 9.0 * Vec<3>::Ones());
  }
  int lifted = 0, worse = 0;
  for (const bool areOn : { true, false })
  {
    const std::vector<Index> bad = EngineBench<3>(in, options).cellsUnder(0.6);
    for (std::size_t k = 0; k < std::min<std::size_t>(bad.size(), 100); ++k)
    {
      EngineBench<3> bench(in, options);
      if (areOn)
      {
        bench.workpiece.weights().switchOn();
      }
      ASSERT_EQ(bench.workpiece.model().weights != nullptr, areOn);
      const int before = badness(bench, Stages[0]);
      const Task task{ Phase::Lifting, 0.6, 0.6, 1e-3, Level::Removal };
      const bool isDone = bench.pass.run(task, { bad[k] }).accepted > 0;
      const int after = badness(bench, Stages[0]);
      EXPECT_TRUE(!areOn || after <= before) << "cell " << bad[k];
      lifted += areOn && isDone;
      worse += !areOn && after > before;
    }
  }
  EXPECT_GT(lifted, 5);
  EXPECT_GT(worse, 0); // without that guard some would be
}

/// Where the surface takes part, and many cells are said to be bad, all changes are guarded at the
/// target.
TEST(Pass3D, WhereTheSurfaceSlidesNoneOfManyIsLiftedByMakingOthersBad)
{
  constexpr double target = 0.6;
  Options options = frozen(upTo(target));
  options.reconnect = true;
  const StillSurface<3> judging(true);
  const MeshInput<3> in = roughGrid<3>();
  const std::vector<Index> bad = EngineBench<3>(in, options).cellsUnder(target);
  const auto tryEach = [&](const StillSurface<3>* surface, bool many)
  {
    std::array<int, 2> counts{}; // lifted, and worse than before
    for (std::size_t k = 0; k < std::min<std::size_t>(bad.size(), 60); ++k)
    {
      EngineBench<3> bench(in, options, surface);
      const int before = badness(bench, target);
      Task task{ Phase::Lifting, target, target, 1e-3, Level::Removal };
      task.below = bench.workpiece.fewCells() + many;
      counts[0] += bench.pass.run(task, { bad[k] }).accepted > 0;
      counts[1] += badness(bench, target) > before;
    }
    return counts;
  };
  const auto guarded = tryEach(&judging, true);
  EXPECT_GT(guarded[0], 5);
  EXPECT_EQ(guarded[1], 0);
  EXPECT_GT(tryEach(&judging, false)[1], 0);
  EXPECT_GT(tryEach(nullptr, true)[1], 0);
}

/// Where nothing helps any more: a failed cell is tried again with more effort only, or if one of
/// its nodes has been stamped since.
TEST(Pass2D, FailedCellsAreTriedAgainOnlyIfSomethingHasChanged)
{
  constexpr double Goal = 0.9;
  EngineBench<2> bench(roughGrid<2>(), swapsOnly(Goal));
  while (runPass(bench, Phase::Lifting, Goal, Level::Topology).accepted > 0)
  {
  }
  const std::vector<Index> bad = bench.cellsUnder(Goal);
  ASSERT_GT(bad.size(), 40u);
  EXPECT_EQ(bench.triedCells(), bad);
  const PassResult again = runPass(bench, Phase::Lifting, Goal, Level::Topology);
  EXPECT_EQ(sumOf(again.tried), 0);
  EXPECT_EQ(again.evaluations, 0);

  const Index stamped = bad[20];
  bench.editor.stamp({ stamped });
  const auto touches = [&](Index c)
  {
    const Simplex<2>& nodes = bench.mesh.nodes(c);
    return std::any_of(
      nodes.begin(), nodes.end(), [&](Index p) { return bench.mesh.localIndex(stamped, p) >= 0; });
  };
  const long around = std::count_if(bad.begin(), bad.end(), touches);
  EXPECT_GT(around, 1);
  EXPECT_LT(around, static_cast<long>(bad.size()));
  EXPECT_EQ(runPass(bench, Phase::Lifting, Goal, Level::Topology).tried[Swaps], around);
  EXPECT_EQ(runPass(bench, Phase::Lifting, Goal, Level::Topology).tried[Swaps], 0);

  const long all = static_cast<long>(bad.size());
  EXPECT_EQ(runPass(bench, Phase::Lifting, Goal, Level::Removal).tried[Swaps], all);
  EXPECT_EQ(runPass(bench, Phase::Lifting, Goal, Level::Topology).tried[Swaps], 0);
  EXPECT_EQ(runPass(bench, Phase::Polishing, Goal, Level::Topology).tried[Swaps], all);
  EXPECT_EQ(runPass(bench, Phase::Lifting, Goal, Level::LookAhead).tried[Swaps], 0);
}

TYPED_TEST(PassOf, OnlyTheGivenCellsAreTried)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(roughGrid<D>(), frozen(upTo(0.6)));
  const std::vector<Index> bad = bench.cellsUnder(0.6);
  ASSERT_GT(bad.size(), 5u);
  const std::vector<Index> given(bad.begin(), bad.begin() + 5);
  const PassResult result = bench.pass.run({ Phase::Lifting, 0.6, 0.6, 1e-3 }, given);
  EXPECT_EQ(result.accepted, 0);
  EXPECT_TRUE(result.isInVain(given.size()));
  EXPECT_EQ(bench.triedCells(), given);
}

/// A part of the tries is for the worst cells alone.
TEST(Pass2D, LookAheadOnTheWayToTheTargetIsForAFewCells)
{
  for (const double target : { 0.9, 0.95 }) // the latter is past it
  {
    EngineBench<2> bench(jitteredGrid<2>(14, 0.25), frozen(upTo(0.9)));
    const std::vector<Index> bad = bench.cellsUnder(target);
    const std::size_t few = bench.workpiece.fewCells();
    ASSERT_GT(bad.size(), few);
    runPass(bench, Phase::Lifting, target, Level::LookAhead);
    for (std::size_t k = 0; k < bad.size(); ++k)
    {
      const bool isFull = k < few || target > 0.9;
      EXPECT_EQ(bench.triedAt(bad[k]), isFull ? Level::LookAhead : Level::Removal) << k;
    }
  }
}

TYPED_TEST(PassOf, StopsBeforeTheFirstChangeIfTheTimeIsOver)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(roughGrid<D>(), upTo(0.6));
  const MeshBits<D> before = bitsOf(bench.mesh);
  bench.control.deadline = std::chrono::steady_clock::now();
  const PassResult result = runPass(bench, Phase::Lifting, 0.6, Level::Insertion);
  EXPECT_FALSE(result.goesOn);
  EXPECT_EQ(result.accepted, 0);
  EXPECT_EQ(bench.rows(), 1u);
  EXPECT_EQ(bitsOf(bench.mesh), before);
}

// ---- several chunks -----------------------------------------------------------------------------

namespace
{
/// Large enough for two chunks.
struct TwoChunks : EngineBench<2>
{
  explicit TwoChunks(const Options& options)
    : EngineBench<2>(jitteredGrid<2>(142, 0.3), options)
  {
  }
};
}

/// On the way to the target what borders have held up is tried in the same pass. Past it, it waits.
TEST(PassInChunks, CellsAtBordersAreTriedInTheSamePassUpToTheTarget)
{
  for (const double target : { 0.5, 0.4 })
  {
    TwoChunks bench(swapsOnly(target));
    ASSERT_GE(bench.mesh.numberOfCellSlots(), 2 * CellsPerChunk);
    ASSERT_GE(bench.cellsUnder(0.5).size(), 2u * BadCellsPerChunk);
    const PassResult result = runPass(bench, Phase::Lifting, 0.5, Level::Topology);
    EXPECT_GT(result.accepted, 100);
    const std::vector<Index> bad = bench.cellsUnder(0.5);
    const auto untried = std::count_if(
      bad.begin(), bad.end(), [&](Index c) { return bench.triedAt(c) == None; });
    EXPECT_EQ(untried > 0, target < 0.5) << untried;
  }
}

/// Shares are whole numbers: one cell may be lost.
TEST(PassInChunks, GrowthComesBackFromAllChunks)
{
  Options options = upTo(0.5);
  options.moveNodes = options.reconnect = false;
  TwoChunks bench(options);
  const long left = bench.growthLeft();
  const Index cells = bench.mesh.countCells();
  runPass(bench, Phase::Lifting, 0.5, Level::Insertion);
  EXPECT_NE(bench.mesh.countCells(), cells);
  const long lost = left - bench.growthLeft() - (bench.mesh.countCells() - cells);
  EXPECT_GE(lost, 0);
  EXPECT_LE(lost, 4); // there are four drains at most
}

// ---- what was in vain ---------------------------------------------------------------------------

/// The many places around the worst cell of a good mesh in which all nodes stay.
TYPED_TEST(PassOf, ManyPlacesInVainAreNotTriedAgainUntilForgotten)
{
  constexpr int D = TypeParam::dimension;
  Options options = frozen(upTo(0.95));
  options.insertNodes = true;
  options.mostQuality = 0.99;
  EngineBench<D> bench(jitteredGrid<D>(D == 3 ? 7 : 30, 1e-7), options);
  const std::vector<Index> worst{ bench.cellsUnder(1.0).front() };
  const auto evaluations = [&]
  {
    bench.editor.stamp(worst); // not left out as a cell that has failed
    const PassResult result = bench.pass.run(
      { Phase::Polishing, 0.95, 0.95, ThriftyGain, Level::LongLookAhead }, worst);
    EXPECT_EQ(result.accepted, 0);
    return result.evaluations;
  };
  const std::int64_t first = evaluations();
  const std::int64_t second = evaluations();
  EXPECT_GT(second, 0);
  EXPECT_LT(4 * second, first);
  EXPECT_EQ(evaluations(), second);
  bench.pass.forgetInVain();
  EXPECT_EQ(evaluations(), first);
}
