// SPDX-License-Identifier: BSD-3-Clause
// Rows of the history, progress, the nodes of the worst cell, and why a run ends: by states that
// are made by hand.
#include "WorstFirst/Reporter.h"
#include "CappedCell.h"
#include "EngineBench.h"

using namespace meshopt;
using worstfirst::PassResult;
using worstfirst::Phase;
using worstfirst::Task;

namespace
{
constexpr auto Motion = static_cast<int>(Operation::NodeMotion);
constexpr auto Looks = static_cast<int>(Operation::LookAhead);

Task task(Phase phase, double aim, int number = 0)
{
  Task result{ phase, 0.1, aim, 1e-3 };
  result.number = number;
  return result;
}

/// Of cellAtItsCap().
double capOfCell()
{
  const MeshInput<3> in = cellAtItsCap();
  return facetCap(in.points[0], in.points[1], in.points[2]);
}

/// A mesh of 8 cells whose worst quality is set by hand.
struct Plane : EngineBench<2>
{
  explicit Plane(double worst)
    : EngineBench<2>(jitteredGrid<2>(2, 0.0), upTo(0.6))
  {
    this->editor.setQuality(0, worst);
  }
};
}

// ---- why a run ends -----------------------------------------------------------------------------

TEST(Reporter, TheTargetIsReachedIfNoCellIsUnderIt)
{
  Plane at(0.6), under(std::nextafter(0.6, 0.0));
  EXPECT_EQ(at.reporter.reason(at.budget), StopReason::TargetReached);
  EXPECT_EQ(under.reporter.reason(under.budget), StopReason::NoFurtherGain);
}

TEST(Reporter, TheSurfaceCapsIfAllCellsUnderTheTargetAreCapped)
{
  const double cap = capOfCell(), goal = cap + 0.1;
  EngineBench<3> bench(cappedCellAndCorner(), upTo(goal));
  bench.report.cappedCells = 7; // of an earlier run
  bench.editor.setQuality(1, 0.1);
  EXPECT_EQ(bench.reporter.reason(bench.budget), StopReason::NoFurtherGain);
  EXPECT_EQ(bench.report.cappedCells, 1);
  bench.editor.setQuality(1, goal);
  EXPECT_EQ(bench.reporter.reason(bench.budget), StopReason::CappedBySurface);
  EXPECT_EQ(bench.report.cappedCells, 1);
  bench.editor.setQuality(0, 0.9 * cap); // it could get better
  EXPECT_EQ(bench.reporter.reason(bench.budget), StopReason::NoFurtherGain);
  EXPECT_EQ(bench.report.cappedCells, 0);
}

TEST(Reporter, TheGrowthIsTheReasonOnlyIfMoreOfItWouldHelp)
{
  Plane plane(0.1);
  plane.budget.takeBack(Phase::Polishing, 0, false);
  EXPECT_EQ(plane.reporter.reason(plane.budget), StopReason::NoFurtherGain);
  plane.budget.takeBack(Phase::Polishing, 0, true);
  EXPECT_EQ(plane.reporter.reason(plane.budget), StopReason::GrowthLimit);
  plane.editor.setQuality(0, 0.7);
  EXPECT_EQ(plane.reporter.reason(plane.budget), StopReason::TargetReached);
  EngineBench<3> capped(cellAtItsCap(), upTo(capOfCell() + 0.1));
  capped.budget.takeBack(Phase::Polishing, 0, true);
  EXPECT_EQ(capped.reporter.reason(capped.budget), StopReason::CappedBySurface);
}

TEST(Reporter, WhatTheClockStopsIsSaidFirst)
{
  for (const double worst : { 0.1, 0.7 })
  {
    Plane late(worst), aborted(worst);
    EXPECT_TRUE(late.reporter.goesOn(0.3));
    late.control.deadline = std::chrono::steady_clock::now();
    EXPECT_FALSE(late.reporter.goesOn(0.3));
    EXPECT_EQ(late.reporter.reason(late.budget), StopReason::TimeLimit);
    aborted.control.progress = [](double, const std::string&) { return false; };
    EXPECT_FALSE(aborted.reporter.goesOn(0.3));
    aborted.control.deadline = std::chrono::steady_clock::now();
    EXPECT_EQ(aborted.reporter.reason(aborted.budget), StopReason::Aborted);
  }
}

TEST(Reporter, SaysHowFarItIs)
{
  Plane plane(0.123456);
  long inverted = 0;
  plane.workpiece.summary(inverted);
  std::string said;
  double done = 0.0;
  plane.control.progress = [&](double fraction, const std::string& text)
  {
    done = fraction;
    said = text;
    return true;
  };
  plane.reporter.setDone(0.25);
  EXPECT_TRUE(plane.reporter.goesOn(0.45));
  EXPECT_EQ(done, 0.25);
  EXPECT_EQ(said, "worst element 0.1235, working towards 0.45");
}

// ---- the worst cell -----------------------------------------------------------------------------

/// Of a surface that takes part in space. Otherwise it says nothing: nodes are held there anyway.
TEST(Reporter, CountsTheNodesOfTheWorstCellByFreedom)
{
  using Counts = std::array<int, NumberOfFreedoms>;
  const StillSurface<3> judging(true), other(false);
  for (const StillSurface<3>* surface : { &judging, &other })
  {
    EngineBench<3> bench(jitteredGrid<3>(2, 0.0), upTo(0.9), surface);
    Index worst = 0; // one with the node inside
    while (bench.mesh.localIndex(worst, 13) < 0)
    {
      ++worst;
    }
    bench.editor.setQuality(worst, 0.01);
    const Freedom freedoms[] = { Freedom::Patch, Freedom::Corner, Freedom::Corner };
    int k = 0;
    for (Index p : bench.mesh.nodes(worst))
    {
      if (!bench.mesh.isFree(p))
      {
        bench.editor.setPlace(p, Place{ freedoms[k++], 0, 0.0 });
      }
    }
    ASSERT_EQ(k, 3);
    for (int again = 0; again < 2; ++again) // it counts anew
    {
      bench.reporter.reason(bench.budget);
      EXPECT_EQ(
        bench.report.worstNodes, surface == &judging ? (Counts{ 1, 1, 0, 2, 0 }) : Counts{});
    }
  }
}

// ---- rows of the history ------------------------------------------------------------------------

TEST(Reporter, ARowIsTheMeshAsItIs)
{
  Plane plane(-0.1);
  plane.editor.setQuality(1, 0.0);
  plane.editor.setQuality(2, 0.3);
  double sum = 0.0;
  for (Index c = 0; c < plane.mesh.numberOfCellSlots(); ++c)
  {
    sum += plane.mesh.quality(c);
  }
  EXPECT_EQ(plane.reporter.record(task(Phase::Lifting, 0.45, 2), {}), 2); // flat ones count, too
  const PassRecord& row = plane.report.history.back();
  EXPECT_EQ(row.stage, "towards 0.45, pass 3");
  EXPECT_EQ(row.pass, 1);
  EXPECT_EQ(row.worst, -0.1);
  EXPECT_EQ(row.mean, sum / 8);
  EXPECT_EQ(row.belowTarget, 3);
  EXPECT_EQ(row.cells, 8);
  EXPECT_EQ(row.points, 9);
  EXPECT_EQ(plane.workpiece.worst(), -0.1);
}

TEST(Reporter, PassesOfOnePolishBecomeOneRow)
{
  Plane plane(0.1);
  PassResult first, second;
  first.tried[Motion] = 5;
  first.done[Motion] = 2;
  first.surface = { 9, 4 };
  second.tried[Motion] = 10;
  second.tried[Looks] = 3;
  second.done[Looks] = 1;
  second.surface = { 1, 1 };
  const Task polish = task(Phase::Polishing, 0.6), lift = task(Phase::Lifting, 0.6);
  plane.reporter.record(lift, first);
  plane.reporter.record(polish, first);
  plane.editor.setQuality(0, 0.2);
  plane.reporter.record(polish, second);
  ASSERT_EQ(plane.rows(), 2u);
  const PassRecord row = plane.report.history[2];
  EXPECT_EQ(row.stage, "polish towards 0.60");
  EXPECT_EQ(row.pass, 2);
  EXPECT_EQ(row.tried[Motion], 15);
  EXPECT_EQ(row.done[Motion], 2);
  EXPECT_EQ(row.tried[Looks], 3);
  EXPECT_EQ(row.done[Looks], 1);
  EXPECT_EQ(row.surfaceTried, 10);
  EXPECT_EQ(row.surfaceDone, 5);
  EXPECT_EQ(row.worst, 0.2);                                  // what is there now
  EXPECT_EQ(plane.report.history[1].tried, first.tried);      // those of other rows stay
  plane.reporter.record(task(Phase::Polishing, 0.64), first); // another stage
  plane.reporter.record(polish, first);                       // not beside the first
  plane.reporter.record(lift, first);
  plane.reporter.record(task(Phase::Lifting, 0.6, 1), first);
  ASSERT_EQ(plane.rows(), 6u);
  EXPECT_EQ(plane.report.history[2].tried, row.tried);
  for (std::size_t k = 3; k <= 6; ++k)
  {
    EXPECT_EQ(plane.report.history[k].tried, first.tried) << k;
    EXPECT_EQ(plane.report.history[k].pass, static_cast<int>(k));
  }
}

TEST(Reporter, SecondsOfAllRowsAreThoseOfTheRun)
{
  Plane plane(0.1);
  double before = 0.0;
  for (const Phase phase : { Phase::Lifting, Phase::Polishing, Phase::Polishing })
  {
    before = plane.clock.seconds();
    plane.reporter.record(task(phase, 0.6), {});
  }
  const double after = plane.clock.seconds();
  double sum = 0.0;
  for (const PassRecord& row : plane.report.history)
  {
    sum += row.seconds;
  }
  EXPECT_EQ(plane.rows(), 2u);
  EXPECT_GE(sum, before - 1e-12);
  EXPECT_LE(sum, after + 1e-12);
}

/// A cell on a tiny facet; while a stage lifts, qualities are weighed.
TEST(Reporter, RowsShowTrueQualities)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0.02, 0 }, { 0.5, 0, 0.5 } };
  in.cells = { { 0, 1, 2, 3 } };
  EngineBench<3> bench(in, upTo(0.6));
  const double quality = bench.mesh.quality(0);
  bench.workpiece.weights().switchOn();
  const double weighed = bench.mesh.quality(0);
  ASSERT_GT(weighed, 2.0 * quality);
  bench.reporter.record(task(Phase::Lifting, 0.6), {});
  EXPECT_EQ(bench.report.history.back().worst, quality);
  EXPECT_EQ(bench.mesh.quality(0), weighed);
  EXPECT_TRUE(bench.workpiece.weights().areOn());
}
