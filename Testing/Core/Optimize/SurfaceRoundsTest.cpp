// SPDX-License-Identifier: BSD-3-Clause
// What follows what where the surface takes part, and what is undone if facets turn.
#include "Optimize/SurfaceRounds.h"

#include "Bound/ApexBound.h"
#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "SlidingBoxes.h"
#include "WorstFirst/EngineBench.h"

using namespace meshopt;

namespace
{
/// Says what it is told to say when turned facets are counted; then, that there are none. The
/// engine counts those of the mesh first, then those of the mesh before.
class Turning final : public StillSurface<3>
{
public:
  explicit Turning(std::vector<long> answers = {})
    : StillSurface<3>(true)
    , answers_(std::move(answers))
  {
  }
  long countTurned(const SimplexMesh<3>&) const override
  {
    const std::size_t k = this->asked++;
    return k < this->answers_.size() ? this->answers_[k] : 0;
  }
  void refuseTurned(bool on) override { this->refused.push_back(on); }
  bool refuseCrossings(const SimplexMesh<3>&, const SimplexMesh<3>&) override
  {
    return this->crossings-- > 0;
  }
  SurfaceAngles angles() const override { return this->held; }

  SurfaceAngles held;
  mutable std::size_t asked = 0;
  std::vector<bool> refused;
  int crossings = 0; ///< so often facets are said to cross

private:
  std::vector<long> answers_;
};

/// A box that the engine makes better, but not as good as that.
struct Rounds
{
  explicit Rounds(Turning& surface, const Options& options = upTo(0.9))
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

TEST(SurfaceRounds, ARunIsMadeOnceIfNoFacetTurns)
{
  Turning surface;
  Rounds rounds(surface);
  optimizeOnSurface<3>(rounds.bench.run, surface, Effort::Quick, 1.0, true);
  EXPECT_TRUE(surface.refused.empty());
  EXPECT_TRUE(rounds.rows("turned facets undone").empty());
  EXPECT_GT(sortedQualities(rounds.bench.mesh).front(), rounds.input.front());
}

/// More facets look the wrong way than before, not only as many.
TEST(SurfaceRounds, ARunThatTurnsFacetsIsMadeOnceMore)
{
  for (long before : { 0, 1 })
  {
    Turning surface({ 1, before });
    Rounds rounds(surface);
    Rounds once(surface);
    optimizeOnSurface<3>(rounds.bench.run, surface, Effort::Quick, 1.0, true);
    const std::vector<PassRecord> undone = rounds.rows("turned facets undone");
    ASSERT_EQ(undone.size(), before == 0 ? 1u : 0u);
    if (before == 0)
    {
      EXPECT_EQ(undone[0].worst, rounds.input.front());
      EXPECT_EQ(surface.refused, (std::vector<bool>{ true, false }));
    }
    // This surface does not care: the second run is as good as the first.
    optimizeOnSurface<3>(once.bench.run, surface, Effort::Quick, 1.0, true);
    EXPECT_EQ(sortedQualities(rounds.bench.mesh), sortedQualities(once.bench.mesh));
    expectSound(rounds.bench.mesh);
  }
}

/// And once more, with more refused each time. If that does not help, nothing is done.
TEST(SurfaceRounds, ARunWhoseFacetsCrossIsMadeAgain)
{
  for (int crossings : { 2, 100 })
  {
    Turning surface, still;
    surface.crossings = crossings;
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
  Turning surface;
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
  Turning surface;
  Rounds rounds(surface, upTo(0.2));
  optimizeSliding<3>(rounds.bench.run, surface);
  EXPECT_EQ(rounds.bench.report.stopReason, StopReason::TargetReached);
  EXPECT_EQ(surface.asked, 2u); // after the first run
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
    Turning surface, held;
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

/// Once more with a surface that refuses that; if some turn even then, the mesh is that of the run
/// before.
TEST(SurfaceRounds, DivisionsThatTurnFacetsAreUndone)
{
  std::vector<long> answers{ 0, 0 };
  for (int k = 0; k < 20; ++k)
  {
    answers.insert(answers.end(), { 1, 0 });
  }
  Turning surface(answers);
  Rounds rounds(surface), first(surface);
  optimizeSliding<3>(rounds.bench.run, surface);
  // The last of a run's repeats may be undone, too.
  const std::string& last = rounds.bench.report.history.back().stage;
  EXPECT_EQ(std::count(surface.refused.begin(), surface.refused.end(), true),
    static_cast<long>(rounds.rows("turned facets undone").size()) -
      (last == "turned facets undone"));
  EXPECT_FALSE(rounds.rows("turned facets undone").empty());
  surface = Turning();
  optimizeOnSurface<3>(first.bench.run, surface, Effort::Default, 0.3, false);
  const double worst = sortedQualities(first.bench.mesh).front();
  const std::vector<PassRecord> undone = rounds.rows("divisions undone");
  ASSERT_FALSE(undone.empty());
  for (const PassRecord& row : undone)
  {
    EXPECT_EQ(row.worst, worst);
  }
  expectSound(rounds.bench.mesh);
}

/// Where each division is undone, the run ends when they have cost a few times what the first part
/// has. With all three ways, first narrowly and then widely, six would be undone.
TEST(SurfaceRounds, DivisionsInVainEndWhenTheyHaveCostTooMuch)
{
  std::vector<long> answers{ 0, 0 };
  for (int k = 0; k < 20; ++k)
  {
    answers.insert(answers.end(), { 1, 0 });
  }
  for (const Effort effort : { Effort::Quick, Effort::Default })
  {
    Options options = upTo(0.9);
    options.effort = effort;
    Turning surface(answers);
    Rounds rounds(surface, options);
    optimizeSliding<3>(rounds.bench.run, surface);
    const std::size_t undone = rounds.rows("divisions undone").size();
    EXPECT_GE(undone, 3u);
    EXPECT_LT(undone, 6u);
  }
}
