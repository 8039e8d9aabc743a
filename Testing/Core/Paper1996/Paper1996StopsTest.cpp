// SPDX-License-Identifier: BSD-3-Clause
// Why the paper's mode stops: a case for each reason.
#include "CappedCell.h"
#include "Optimize/Optimizer.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
Report run(SimplexMesh<D>& mesh, const Options& options, const Control& control = {})
{
  NodalMetric<D> metric;
  EXPECT_EQ(options.check(false), "");
  const Report report = optimize<D>(mesh, metric, options, control);
  expectSound(mesh, report.invertedAfter == 0);
  EXPECT_GE(report.worstAfter, report.worstBefore);
  EXPECT_EQ(report.worstAfter, report.history.back().worst);
  return report;
}

Options target(double quality)
{
  Options options;
  options.algorithm = Algorithm::Paper1996;
  options.targetQuality = quality;
  return options;
}

Options motionTo(double quality)
{
  Options options = target(quality);
  options.reconnect = options.insertNodes = options.removeNodes = false;
  return options;
}

template <int D>
MeshInput<D> testMesh()
{
  return jitteredGrid<D>(D == 3 ? 5 : 10, 0.35);
}
}

template <class T>
class PaperStops : public ::testing::Test
{
};
TYPED_TEST_SUITE(PaperStops, TestDimensions);

TYPED_TEST(PaperStops, AtTheTarget)
{
  constexpr int D = TypeParam::dimension;
  const double goal = D == 3 ? 0.35 : 0.5;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  const Report report = run<D>(mesh, target(goal));
  EXPECT_EQ(report.stopReason, StopReason::TargetReached);
  EXPECT_LT(report.worstBefore, goal);
  EXPECT_GE(report.worstAfter, goal);
  SimplexMesh<D> good = buildMesh(jitteredGrid<D>(3, 0.0)); // it has been there before
  const MeshBits<D> before = bitsOf(good);
  const Report none = run<D>(good, target(0.3));
  EXPECT_EQ(none.stopReason, StopReason::TargetReached);
  EXPECT_EQ(none.history.size(), 1u); // the input
  EXPECT_EQ(bitsOf(good), before);
}

TEST(PaperStops3D, WhereTheSurfaceCaps)
{
  const MeshInput<3> in = cellAtItsCap();
  const double cap = facetCap(in.points[0], in.points[1], in.points[2]);
  SimplexMesh<3> mesh = buildMesh(in);
  const MeshBits<3> before = bitsOf(mesh);
  const Report report = run<3>(mesh, target(cap + 0.1));
  EXPECT_EQ(report.stopReason, StopReason::CappedBySurface);
  EXPECT_EQ(report.cappedCells, 1);
  EXPECT_NEAR(report.bound, cap, 1e-6);
  EXPECT_EQ(bitsOf(mesh), before);
}

/// No node may move, and some of the cells under the target have no kept facet to cap them.
TYPED_TEST(PaperStops, WithoutFurtherGain)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  in.fixedPoints.assign(in.points.size(), 1);
  SimplexMesh<D> mesh = buildMesh(in);
  const MeshBits<D> before = bitsOf(mesh);
  const Report report = run<D>(mesh, motionTo(0.99));
  EXPECT_EQ(report.stopReason, StopReason::NoFurtherGain);
  EXPECT_LT(report.cappedCells, report.history.back().belowTarget);
  EXPECT_EQ(bitsOf(mesh), before);
}

TYPED_TEST(PaperStops, AfterMIterations)
{
  constexpr int D = TypeParam::dimension;
  for (int alternations : { 1, 20 }) // in the latter case one without gain comes before
  {
    Options options = motionTo(D == 3 ? 0.8 : 1.0);
    options.maximumNumberOfIterations = 3;
    options.maximumNumberOfAlternations = alternations;
    SimplexMesh<D> mesh = buildMesh(testMesh<D>());
    const Report report = run<D>(mesh, options);
    EXPECT_EQ(report.stopReason, StopReason::IterationLimit);
    for (std::size_t k = 1; k < report.history.size(); ++k)
    {
      EXPECT_LE(report.history[k].tried[static_cast<int>(Operation::NodeMotion)], 3);
    }
    EXPECT_EQ(report.history[1].tried[static_cast<int>(Operation::NodeMotion)], 3);
  }
}

TYPED_TEST(PaperStops, AfterSoManyAlternations)
{
  constexpr int D = TypeParam::dimension;
  Options options = target(D == 3 ? 0.8 : 1.0);
  options.maximumNumberOfAlternations = 1;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  const Report report = run<D>(mesh, options);
  EXPECT_EQ(report.stopReason, StopReason::IterationLimit);
  EXPECT_EQ(report.history.size(), 3u); // the input, one reconnection, one repositioning
  // should the last one that is allowed reach the target, that is what is said
  options.targetQuality = report.worstAfter;
  SimplexMesh<D> again = buildMesh(testMesh<D>());
  EXPECT_EQ(run<D>(again, options).stopReason, StopReason::TargetReached);
}

/// A limit that is over before the first change: none is made.
TYPED_TEST(PaperStops, WhenTimeIsOver)
{
  constexpr int D = TypeParam::dimension;
  for (const Options& options : { target(0.6), motionTo(0.6) })
  {
    Control control;
    control.deadline = std::chrono::steady_clock::now();
    SimplexMesh<D> mesh = buildMesh(testMesh<D>());
    const MeshBits<D> before = bitsOf(mesh);
    EXPECT_EQ(run<D>(mesh, options, control).stopReason, StopReason::TimeLimit);
    EXPECT_EQ(bitsOf(mesh), before);
  }
}

TYPED_TEST(PaperStops, WhenTheCallerWants)
{
  constexpr int D = TypeParam::dimension;
  for (const Options& options : { target(0.6), motionTo(0.6) })
  {
    SimplexMesh<D> mesh = buildMesh(testMesh<D>());
    const MeshBits<D> before = bitsOf(mesh);
    int calls = 0;
    Control control;
    control.progress = [&](double fraction, const std::string& text)
    {
      EXPECT_GE(fraction, 0.0);
      EXPECT_LE(fraction, 1.0);
      EXPECT_FALSE(text.empty());
      ++calls;
      return false;
    };
    EXPECT_EQ(run<D>(mesh, options, control).stopReason, StopReason::Aborted);
    EXPECT_EQ(calls, 1); // not asked again
    EXPECT_EQ(bitsOf(mesh), before);
  }
}

/// Progress is told at most about ten times a second; it never falls.
TYPED_TEST(PaperStops, ProgressNeverFalls)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  double last = 0.0;
  int calls = 0;
  Control control;
  control.progress = [&](double fraction, const std::string&)
  {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    ++calls;
    return true;
  };
  EXPECT_NE(run<D>(mesh, target(0.6), control).stopReason, StopReason::Aborted);
  EXPECT_GE(calls, 1);
}
