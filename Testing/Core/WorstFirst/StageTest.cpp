// SPDX-License-Identifier: BSD-3-Clause
// One stage: which passes it makes, at which levels, and when it ends. Mostly no operation is on:
// each try then fails.
#include "WorstFirst/Stage.h"
#include "CappedCell.h"
#include "EngineBench.h"

using namespace meshopt;
using namespace meshopt::worstfirst;

namespace
{
/// The names of the rows beside that of the input.
template <int D>
std::vector<std::string> stages(const EngineBench<D>& bench)
{
  std::vector<std::string> names;
  for (std::size_t k = 1; k < bench.report.history.size(); ++k)
  {
    names.push_back(bench.report.history[k].stage);
  }
  return names;
}

using Names = std::vector<std::string>;
}

template <class T>
class StageOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(StageOf, TestDimensions);

TYPED_TEST(StageOf, WithoutBadCellsNothingHappens)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(jitteredGrid<D>(4, 0.2), upTo(0.6));
  const double worst = sortedQualities(bench.mesh).front();
  const MeshBits<D> before = bitsOf(bench.mesh);
  EXPECT_TRUE(bench.stage.lift(worst)); // a cell at the target has reached it
  EXPECT_TRUE(bench.stage.polish(worst, 0.6, 1e-3));
  EXPECT_EQ(bench.rows(), 0u);
  EXPECT_EQ(bench.report.evaluations, 0);
  EXPECT_EQ(bitsOf(bench.mesh), before);
}

TEST(Stage3D, CappedCellsAreNotTried)
{
  EngineBench<3> bench(cellAtItsCap(), upTo(0.9));
  ASSERT_EQ(bench.cellsUnder(0.9).size(), 1u);
  EXPECT_TRUE(bench.stage.lift(0.9));
  EXPECT_TRUE(bench.stage.polish(0.9, 0.9, 1e-3));
  EXPECT_EQ(bench.rows(), 0u);
  EXPECT_EQ(bench.triedAt(0), None);
}

/// While a stage lifts, cells on facets with a tiny cap are judged by what they could reach.
/// Afterwards all qualities are true again.
TEST(Stage3D, CellsOnTinyFacetsAreSpared)
{
  constexpr double goal = 0.6;
  MeshInput<3> in = jitteredGrid<3>(4, 0.2);
  *std::find(in.points.begin(), in.points.end(), Vec<3>(0.25, 0.5, 0.0)) = { 0.025, 0.5, 0.0 };
  EngineBench<3> bench(in, frozen(upTo(goal)));
  const Caps<3>& caps = bench.workpiece.caps();
  std::vector<Index> expected;
  int spared = 0;
  for (Index c : bench.cellsUnder(goal))
  {
    const double weighed = caps.weight(bench.mesh.nodes(c)) * bench.mesh.quality(c);
    const bool isTried = weighed < goal && !caps.isCapped(bench.mesh, c);
    expected.insert(expected.end(), isTried, c);
    spared += !(weighed < goal);
  }
  EXPECT_GT(spared, 0);
  const std::vector<double> before = sortedQualities(bench.mesh);
  EXPECT_TRUE(bench.stage.lift(goal));
  EXPECT_EQ(bench.triedCells(), expected);
  EXPECT_EQ(sortedQualities(bench.mesh), before);
  EXPECT_FALSE(bench.workpiece.weights().areOn());
}

/// In vain: each level once, the last one by effort. Then all has failed, and there is no pass any
/// more until something changes.
TYPED_TEST(StageOf, PassesRiseToTheLevelOfTheEffort)
{
  constexpr int D = TypeParam::dimension;
  constexpr double goal = D == 3 ? 0.45 : 0.85;
  for (const Effort effort : { Effort::Quick, Effort::Default, Effort::Best })
  {
    EngineBench<D> bench(jitteredGrid<D>(4, 0.25), frozen(upTo(goal, effort)));
    const std::vector<Index> bad = bench.cellsUnder(goal);
    ASSERT_GE(bad.size(), 1u);
    ASSERT_LE(bad.size(), static_cast<std::size_t>(bench.workpiece.fewCells()));
    const std::string name = D == 3 ? "towards 0.45, pass " : "towards 0.85, pass ";
    Names expected{ name + "1", name + "2", name + "3" };
    expected.resize(effort == Effort::Quick ? 2 : 3);
    for (int again = 0; again < 2; ++again)
    {
      EXPECT_TRUE(bench.stage.lift(goal));
      EXPECT_EQ(stages(bench), expected);
      EXPECT_EQ(bench.triedCells(), bad);
      for (Index c : bad)
      {
        EXPECT_EQ(bench.triedAt(c), effort == Effort::Quick ? Level::Insertion : Level::LookAhead);
      }
    }
    bench.editor.stamp({ bad.front() });
    EXPECT_TRUE(bench.stage.lift(goal));
    EXPECT_EQ(bench.rows(), 2 * expected.size());
  }
}

/// A quick run looks ahead only where that spares it divisions of the surface.
TEST(Stage3D, AQuickRunLooksAheadForTheLastCellsOnTheSurface)
{
  struct Case
  {
    bool takesPart, dividesEdges;
    double goal, target;
    int level;
  };
  const Case cases[] = { { true, false, 0.45, 0.45, Level::LookAhead },
    { false, false, 0.45, 0.45, Level::Insertion }, { true, true, 0.45, 0.45, Level::Insertion },
    { true, false, 0.45, 0.6, Level::Insertion },
    { true, false, 0.9, 0.9, Level::Insertion } }; // these are many
  for (const Case& c : cases)
  {
    const StillSurface<3> surface(c.takesPart);
    EngineBench<3> bench(jitteredGrid<3>(4, 0.25), frozen(upTo(c.target, Effort::Quick)), &surface);
    bench.run.dividesEdges = c.dividesEdges;
    const std::vector<Index> bad = bench.cellsUnder(c.goal);
    ASSERT_EQ(bad.size() <= static_cast<std::size_t>(bench.workpiece.fewCells()), c.goal < 0.9);
    EXPECT_TRUE(bench.stage.lift(c.goal));
    EXPECT_EQ(bench.triedAt(bad.front()), c.level);
    EXPECT_EQ(bench.rows(), c.level == Level::LookAhead ? 3u : 2u);
  }
}

TYPED_TEST(StageOf, PolishingTriesOnlyWhatIsUnderItsOwnTarget)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(jitteredGrid<D>(4, 0.25), frozen(upTo(0.6)));
  const double middle = sortedQualities(bench.mesh)[7];
  EXPECT_TRUE(bench.stage.polish(middle, 0.6, 1e-3));
  EXPECT_EQ(stages(bench), Names{ "polish towards 0.60" });
  EXPECT_EQ(bench.triedCells(), bench.cellsUnder(middle));
  for (Index c : bench.triedCells())
  {
    EXPECT_EQ(bench.triedAt(c), rankOf(Phase::Polishing, Level::LongLookAhead));
  }
}

/// Cells at the border of a part are worked on up to the target only: polishing and further stages
/// leave them to other runs.
TEST(Stage2D, CellsAtTheBorderAreLeft)
{
  MeshInput<2> in = jitteredGrid<2>(6, 0.25);
  for (const Vec<2>& x : in.points)
  {
    in.borderPoints.push_back(x[0] == 0.0);
  }
  for (const int way : { 0, 1, 2 })
  {
    EngineBench<2> bench(in, frozen(upTo(0.85)));
    const double target = way == 0 ? 0.85 : 0.9;
    std::vector<Index> expected = bench.cellsUnder(target);
    const auto isLeft = [&](Index c) { return bench.workpiece.isLeft(c); };
    ASSERT_GT(std::count_if(expected.begin(), expected.end(), isLeft), 0);
    if (way > 0)
    {
      expected.erase(std::remove_if(expected.begin(), expected.end(), isLeft), expected.end());
    }
    EXPECT_TRUE(way < 2 ? bench.stage.lift(target) : bench.stage.polish(target, 0.85, 1e-3));
    EXPECT_EQ(bench.triedCells(), expected) << way;
  }
}

/// A target hardly in reach, and each pass gains a little.
TEST(Stage2D, EndsAfterTheMostPasses)
{
  std::size_t most = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    EngineBench<2> bench(jitteredGrid<2>(14, 0.3, seed), upTo(0.94));
    EXPECT_TRUE(bench.stage.lift(0.94));
    most = std::max(most, bench.rows());
    EXPECT_EQ(bench.report.history.back().stage,
      "towards 0.94, pass " + std::to_string(bench.rows())); // none is left out here
    expectSound(bench.mesh);
  }
  EXPECT_EQ(most, static_cast<std::size_t>(MaximumPasses));
}

TYPED_TEST(StageOf, LiftsAllThatItCan)
{
  constexpr int D = TypeParam::dimension;
  EngineBench<D> bench(jitteredGrid<D>(D == 3 ? 5 : 14, 0.3), upTo(0.6));
  const double target = D == 3 ? 0.3 : 0.6;
  EXPECT_GT(bench.cellsUnder(target).size(), 3u);
  EXPECT_TRUE(bench.stage.lift(target));
  EXPECT_TRUE(bench.cellsUnder(target).empty());
  EXPECT_EQ(bench.workpiece.worst(), sortedQualities(bench.mesh).front());
  expectSound(bench.mesh);
}

TEST(Stage2D, StopsWithTheTime)
{
  EngineBench<2> bench(jitteredGrid<2>(6, 0.25), frozen(upTo(0.9)));
  bench.control.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(bench.stage.lift(0.9));
  EXPECT_FALSE(bench.stage.polish(0.9, 0.9, 1e-3));
  EXPECT_EQ(bench.rows(), 2u);
  EXPECT_TRUE(bench.triedCells().empty());
}

// ---- many stuck cells ---------------------------------------------------------------------------

namespace
{
struct Stuck
{
  Effort effort;
  double target;
  std::size_t passes;
  bool leavesMany;
};
}

/// 392 cells, most of them stuck: a pass that gives enough tries for a window creeps.
TEST(Stage2D, ManyStuckCellsAreGivenUp)
{
  const MeshInput<2> in = jitteredGrid<2>(14, 0.1);
  EngineBench<2> bench(in, upTo(0.99));
  const double cells = bench.mesh.countCells();
  ASSERT_GT(bench.cellsUnder(0.99).size(), ManyStuck * cells);
  const double most = sortedQualities(bench.mesh)[static_cast<std::size_t>(0.7 * cells)];
  const double few = sortedQualities(bench.mesh)[CreepingTries - 1]; // not enough for a window
  const std::vector<Stuck> cases{
    { Effort::Quick, 0.99, 1, true },
    { Effort::Quick, most, 1, true },
    { Effort::Quick, few, 2, false },
    { Effort::Default, 0.99, 2, true }, // as many as before the pass
    { Effort::Default, most, 3, false },
    { Effort::Default, few, 3, false },
  };
  for (const Stuck& stuck : cases)
  {
    EngineBench<2> stage(in, frozen(upTo(0.99, stuck.effort)));
    EXPECT_TRUE(stage.stage.lift(stuck.target));
    EXPECT_EQ(stage.rows(), stuck.passes) << stuck.target;
    EXPECT_EQ(stage.stage.leavesMany(), stuck.leavesMany) << stuck.target;
    stage.editor.stamp(stage.cellsUnder(0.99)); // all may be tried again
    EXPECT_TRUE(stage.stage.lift(few));
    EXPECT_EQ(stage.stage.leavesMany(), stuck.leavesMany); // for the rest of the run
  }
}

/// In the first stage a quick run does not: the worst are among them.
TEST(Stage2D, AQuickRunGivesUpNothingInTheFirstStage)
{
  MeshInput<2> in = jitteredGrid<2>(14, 0.0);
  for (Vec<2>& x : in.points)
  {
    x[0] *= 0.1; // all are bad
  }
  for (const double target : { Stages[0], Stages[1] })
  {
    EngineBench<2> bench(in, frozen(upTo(0.6, Effort::Quick)));
    ASSERT_EQ(bench.cellsUnder(Stages[0]).size(), 392u);
    EXPECT_TRUE(bench.stage.lift(target));
    EXPECT_EQ(bench.stage.leavesMany(), target > Stages[0]);
  }
}
