// SPDX-License-Identifier: BSD-3-Clause
// What follows what where the surface takes part, and what is undone if facets cross.
#include "Optimize/SurfaceRounds.h"

#include "Bound/ApexBound.h"
#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "SlidingBoxes.h"
#include "WorstFirst/EngineBench.h"
#include "WorstFirst/WorstFirst.h"

using namespace meshopt;

namespace
{
/// Says that facets cross as often as it is told to, after it has said so often that none do.
class Crossing final : public StillSurface<3>
{
public:
  explicit Crossing(int crossings = 0, int soundAtFirst = 0)
    : StillSurface<3>(true)
    , crossings_(crossings)
    , soundAtFirst_(soundAtFirst)
  {
  }
  bool refuseCrossings(const SimplexMesh<3>&, const SimplexMesh<3>&) override
  {
    const int k = this->asked++ - this->soundAtFirst_;
    return k >= 0 && k < this->crossings_;
  }
  SurfaceAngles angles() const override { return this->held; }

  SurfaceAngles held;
  int asked = 0; ///< so often

private:
  int crossings_, soundAtFirst_;
};
constexpr int Always = 1000;

/// A box that the engine makes better, but not as good as that.
struct Rounds
{
  explicit Rounds(Crossing& surface, const Options& options = upTo(0.9))
    : bench(jitteredGrid<3>(3, 0.35, 7), options, &surface)
    , input(sortedQualities(this->bench.mesh))
  {
    this->bench.run.mostCells = this->bench.mesh.countCells() + 60;
  }
  std::vector<PassRecord> rows(const std::string& stage) const
  {
    std::vector<PassRecord> found;
    std::copy_if(this->bench.report.history.begin(), this->bench.report.history.end(),
      std::back_inserter(found), [&](const PassRecord& row) { return row.stage == stage; });
    return found;
  }

  EngineBench<3> bench;
  std::vector<double> input;
};
}

TEST(SurfaceRounds, ARunIsMadeOnceIfNoFacetsCross)
{
  Crossing surface;
  Rounds rounds(surface);
  optimizeOnSurface<3>(rounds.bench.run, surface, Effort::Quick, 1.0, true);
  EXPECT_EQ(surface.asked, 1);
  EXPECT_TRUE(rounds.rows("crossing facets undone").empty());
  EXPECT_GT(sortedQualities(rounds.bench.mesh).front(), rounds.input.front());
}

/// With more refused each time. If that does not help, nothing is done.
TEST(SurfaceRounds, ARunWhoseFacetsCrossIsMadeAgain)
{
  for (int crossings : { 2, 100 })
  {
    Crossing surface(crossings), still;
    Rounds rounds(surface), once(still);
    optimizeOnSurface<3>(rounds.bench.run, surface, Effort::Quick, 1.0, true);
    optimizeOnSurface<3>(once.bench.run, still, Effort::Quick, 1.0, true);
    const bool helps = crossings == 2;
    EXPECT_EQ(rounds.rows("crossing facets undone").size(), helps ? 2u : 5u);
    EXPECT_EQ(
      sortedQualities(rounds.bench.mesh), helps ? sortedQualities(once.bench.mesh) : rounds.input);
    EXPECT_EQ(rounds.bench.report.stopReason,
      helps ? once.bench.report.stopReason : StopReason::NoFurtherGain);
    expectSound(rounds.bench.mesh);
  }
}

/// The last run polishes more cells than the first one, whether or not an edge was divided.
TEST(SurfaceRounds, TheLastRunFollowsIfNoEdgeMayBeDivided)
{
  Crossing surface;
  Options options = upTo(0.9);
  options.insertNodes = false;
  Rounds rounds(surface, options), byHand(surface, options);
  optimizeSliding<3>(rounds.bench.run, surface);
  EXPECT_TRUE(rounds.rows("divisions undone").empty());
  EXPECT_TRUE(rounds.bench.run.dividesEdges) << "the last run knows that it is not the first";
  optimizeOnSurface<3>(byHand.bench.run, surface, Effort::Default, 0.3, false);
  const std::vector<double> first = sortedQualities(byHand.bench.mesh);
  byHand.bench.run.dividesEdges = true;
  optimizeOnSurface<3>(byHand.bench.run, surface, Effort::Default, 1.0, true);
  EXPECT_EQ(sortedQualities(rounds.bench.mesh), sortedQualities(byHand.bench.mesh));
  EXPECT_NE(sortedQualities(rounds.bench.mesh), first);
}

TEST(SurfaceRounds, NothingFollowsWhereTheTargetIsReached)
{
  Crossing surface;
  Rounds rounds(surface, upTo(0.2));
  optimizeSliding<3>(rounds.bench.run, surface);
  EXPECT_EQ(rounds.bench.report.stopReason, StopReason::TargetReached);
  EXPECT_EQ(surface.asked, 1); // after the first run
  const std::size_t rows = rounds.bench.report.history.size();
  Rounds once(surface, upTo(0.2));
  optimizeOnSurface<3>(once.bench.run, surface, Effort::Default, 0.3, false);
  EXPECT_EQ(once.bench.report.history.size(), rows);
}

/// What follows a division aims at little more than the worst quality of before: the many that are
/// better wait for the last run. The rows of all count what is under the target of the user.
TEST(SurfaceRounds, WhatFollowsADivisionAimsLow)
{
  Sliding sliding(gear(12, 1.0), tolerance(1e-3));
  NodalMetric<3> metric;
  Options options = upTo(0.6, Effort::Quick);
  options.growthBudget = 2.0;
  const Report report = optimize<3>(sliding.mesh, metric, options, {}, &sliding.surface);
  const auto targetOf = [](const PassRecord& row)
  {
    const std::size_t at = row.stage.find("towards ");
    return at == std::string::npos ? 0.0 : std::stod(row.stage.substr(at + 8));
  };
  const auto isTowards = [&](const PassRecord& row) { return targetOf(row) > 0.0; };
  const auto divided = std::find_if(report.history.begin(), report.history.end(),
    [](const PassRecord& row) { return row.stage == "long edges divided"; });
  ASSERT_NE(divided, report.history.end());
  const double worst = (divided - 1)->worst;
  ASSERT_GT(worst, 0.3);
  ASSERT_LT(worst, 0.4);
  const auto end = std::find_if_not(divided + 1, report.history.end(), isTowards);
  ASSERT_GT(end - divided, 3);
  double most = 0.0;
  for (auto row = divided + 1; row != end; ++row)
  {
    most = std::max(most, targetOf(*row));
    EXPECT_GT(row->belowTarget, 40) << row->stage; // of 72 cells and more
  }
  EXPECT_NEAR(most, 1.3 * worst, 0.005); // two digits are written
  EXPECT_EQ(targetOf(report.history.back()), 0.6);
}

/// At a ridge that allows no more than the first run reaches, divisions would be in vain, and so
/// would stages past the target.
TEST(SurfaceRounds, NothingIsDividedAtTheBoundOfTheAngles)
{
  for (Effort effort : { Effort::Default, Effort::Best })
  {
    Crossing surface, held;
    Options options = upTo(0.9);
    options.effort = effort;
    Rounds first(surface, options), free(surface, options), rounds(held, options);
    optimizeOnSurface<3>(first.bench.run, surface, Effort::Default, 0.3, false);
    const double reached = sortedQualities(first.bench.mesh).front();
    held.held.dihedral = { lowestAngle(reached) };
    const double bound = boundOfAngles<3>(held, Measure::Shape);
    EXPECT_NEAR(bound, reached, 1e-5);
    optimizeSliding<3>(rounds.bench.run, held);
    EXPECT_EQ(rounds.bench.report.bound, bound);
    EXPECT_TRUE(rounds.rows("long edges divided").empty());
    optimizeSliding<3>(free.bench.run, surface);
    EXPECT_FALSE(free.rows("long edges divided").empty());
    EXPECT_LT(rounds.bench.report.history.size(), free.bench.report.history.size());
  }
}

/// After a second try; if some cross even then, the mesh is that of the run before.
TEST(SurfaceRounds, DivisionsWhoseFacetsCrossAreUndone)
{
  Crossing surface(Always, 1), still;
  Rounds rounds(surface), first(still);
  optimizeSliding<3>(rounds.bench.run, surface);
  optimizeOnSurface<3>(first.bench.run, still, Effort::Default, 0.3, false);
  const std::vector<double> reached = sortedQualities(first.bench.mesh);
  const std::vector<PassRecord> undone = rounds.rows("divisions undone");
  ASSERT_FALSE(undone.empty());
  // The last run is tried five times.
  EXPECT_EQ(rounds.rows("crossing facets undone").size(), undone.size() + 5);
  for (const PassRecord& row : undone)
  {
    EXPECT_EQ(row.worst, reached.front());
  }
  EXPECT_EQ(sortedQualities(rounds.bench.mesh), reached);
  expectSound(rounds.bench.mesh);
}

/// Where each division is undone, the run ends when they have cost a few times what the first part
/// has. With all three ways, first narrowly and then widely, six would be undone.
TEST(SurfaceRounds, DivisionsInVainEndWhenTheyHaveCostTooMuch)
{
  for (const Effort effort : { Effort::Quick, Effort::Default })
  {
    Options options = upTo(0.9);
    options.effort = effort;
    Crossing surface(Always, 1);
    Rounds rounds(surface, options);
    optimizeSliding<3>(rounds.bench.run, surface);
    const std::size_t undone = rounds.rows("divisions undone").size();
    EXPECT_GE(undone, 3u);
    EXPECT_LT(undone, 6u);
  }
}

/// After a division the few cells that it has made worse come first. If these do not reach what
/// was there before, nothing more is spent on the others.
TEST(SurfaceRounds, WhatDoesNotBeatTheMeshBeforeADivisionEndsEarly)
{
  for (double toBeat : { 0.0, 0.05, 0.8 })
  {
    Crossing surface;
    Rounds rounds(surface);
    rounds.bench.run.toBeat = toBeat;
    optimizeWorstFirst<3>(rounds.bench.run);
    const auto isSeen = [&](const std::string& stage) { return !rounds.rows(stage).empty(); };
    EXPECT_EQ(isSeen("towards 0.82, pass 1"), toBeat == 0.8);
    EXPECT_EQ(isSeen("towards 0.30, pass 1"), toBeat < 0.3);
    EXPECT_EQ(isSeen("towards 0.90, pass 1"), toBeat < 0.3) << "to beat: " << toBeat;
    EXPECT_LT(sortedQualities(rounds.bench.mesh).front(), 0.8);
  }
}
