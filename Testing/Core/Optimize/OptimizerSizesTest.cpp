// SPDX-License-Identifier: BSD-3-Clause
// When the optimizer follows sizes, what it does if that lowers the worst quality, and in what
// state it leaves the metric.
#include "Run/Summary.h"
#include "SizeRuns.h"
#include "Surface/NewCrossings.h"

using namespace meshopt;

namespace
{
bool hasStage(const Report& report, const std::string& stage)
{
  return std::any_of(report.history.begin(), report.history.end(),
    [&](const PassRecord& row) { return row.stage == stage; });
}

/// The logarithm of the size is linear: so it is interpolated without error.
double sizeAt(const Vec<2>& x, double least) { return least * std::exp(0.3 * x[0] - 0.4 * x[1]); }

/// Sizes at the points of `in`, and room for more points than a run makes: what is missing is 0
/// then, not what happens to be in the memory.
NodalMetric<2> sizesOf(
  const MeshInput<2>& in, double least, const Tensor<2>& m = Tensor<2>::Identity())
{
  const std::vector<Tensor<2>> tensors(m.isIdentity() ? 0 : in.points.size(), m);
  NodalMetric<2> metric = sizesAt<2>(
    in, [=](const Vec<2>& x) { return sizeAt(x, least); }, tensors);
  metric.reserve(20000);
  return metric;
}

/// The metric at each point is that of the wanted sizes, times m; qualities are those in it.
void expectWantedSizes(
  Result<2> run, double least, double beta, const Tensor<2>& m = Tensor<2>::Identity())
{
  for (Index p = 0; p < run.mesh.numberOfPointSlots(); ++p)
  {
    if (run.mesh.isPointAlive(p))
    {
      const double h = sizeAt(run.mesh.point(p), least);
      EXPECT_LT((run.metric.unitTensor(p) * h * h - m).norm(), 1e-10 * m.norm()) << "point " << p;
    }
  }
  const std::vector<double> stored = sortedQualities(run.mesh);
  MeshEditor<2> editor(run.mesh);
  computeQualities<2>(editor, run.metric, Measure::Shape, beta);
  const std::vector<double> computed = sortedQualities(run.mesh);
  ASSERT_EQ(stored.size(), computed.size());
  for (std::size_t k = 0; k < stored.size(); ++k)
  {
    EXPECT_NEAR(stored[k], computed[k], 1e-12);
  }
}

/// A metric in which the corners of the unit square are sharp: no mesh has a better worst than the
/// two triangles in them.
struct SharpCorners
{
  MeshInput<2> in = jitteredGrid<2>(8, 0.0);
  Tensor<2> metric = (Tensor<2>() << 5.05, -4.95, -4.95, 5.05).finished(); // 45 degrees, 1 : 10
  double best;

  SharpCorners()
  {
    const double angle = std::acos(4.95 / 5.05), sine = std::sin(0.5 * angle);
    this->best = 1.5 * std::sqrt(3.0) * std::sin(angle) / ((1.0 + sine) * (1.0 + sine));
  }
};

/// Two discs of twelve edges each. Between the two edges that face each other is a gap, but not
/// between the circles.
MeshInput<2> twoDiscs(double gap)
{
  const Vec<2> apart(2.0 * std::cos(Pi / 12.0) + gap, 0.0);
  MeshInput<2> in = fan(circle(12, 1.0, 0.5), Vec<2>::Zero());
  const MeshInput<2> one = in;
  const auto first = static_cast<Index>(one.points.size());
  for (const Vec<2>& x : one.points)
  {
    in.points.push_back(apart - x);
  }
  for (const Simplex<2>& t : one.cells)
  {
    in.cells.push_back({ t[0] + first, t[1] + first, t[2] + first });
  }
  return in;
}
}

/// What would cross stays as it is; the rest is as fine as wanted.
TEST(OptimizerSizes, CurvesDoNotCrossEachOtherAcrossAGap)
{
  for (const double gap : { 0.02, 0.3 })
  {
    const MeshInput<2> in = twoDiscs(gap);
    const SimplexMesh<2> before = buildMesh(in);
    const Result<2> run = optimized(in, NodalMetric<2>(0.2), options(0.5, 0.9), true);
    EXPECT_EQ(hasStage(run.report, "crossing boundary undone"), gap < 0.1);
    EXPECT_TRUE(findNewCrossings(before, run.mesh).empty()) << gap;
    EXPECT_GT(run.cells, 250);
  }
}

/// They have nodes at different places, so that their edges cross: a slit that is straight, by
/// rounding, and one that is bent.
TEST(OptimizerSizes, TheLipsOfASlitMayBeDividedIndependently)
{
  for (const double bend : { 0.0, 0.15 })
  {
    MeshInput<2> in = slitSquare(8, 0.25, 0.75);
    for (Vec<2>& x : in.points)
    {
      x = Vec<2>(x[0] - 0.3 * x[1], x[1] + 0.3 * x[0] + bend * std::sin(3.0 * x[0]));
    }
    const Result<2> run = optimized(in, NodalMetric<2>(0.03), options(0.5, 0.9), true);
    EXPECT_FALSE(hasStage(run.report, "crossing boundary undone")) << bend;
    EXPECT_FALSE(findNewCrossings<2>(buildMesh(in), run.mesh).empty()) << bend;
  }
}

/// Sizes are followed by the engine only; if there are any; and with beta, or where the boundary
/// slides.
TEST(OptimizerSizes, FollowedOnlyWhereTheyAreAskedFor)
{
  const MeshInput<2> in = jitteredGrid<2>(4, 0.1);
  for (const Algorithm algorithm : { Algorithm::Paper1996, Algorithm::WorstFirst })
  {
    for (const double size : { 0.0, 0.1 })
    {
      for (const double beta : { 0.0, 0.3 })
      {
        for (const bool slides : { false, true })
        {
          const bool isPaper = algorithm == Algorithm::Paper1996;
          if ((isPaper && slides) || (beta > 0.0 && size == 0.0)) // not allowed
          {
            continue;
          }
          SCOPED_TRACE(testing::Message()
            << int(algorithm) << ", size " << size << ", beta " << beta << ", slides " << slides);
          Options options;
          options.algorithm = algorithm;
          options.beta = beta;
          options.desiredSize = size;
          SimplexMesh<2> mesh = buildMesh(in);
          NodalMetric<2> metric(size);
          BoundaryCurves curves;
          {
            MeshEditor<2> editor(mesh);
            curves.build(editor, CurveOptions());
          }
          const Report report = optimize<2>(mesh, metric, options, {}, slides ? &curves : nullptr);
          const bool isAsked = !isPaper && size > 0.0 && (beta > 0.0 || slides);
          bool isFollowed = false;
          for (const PassRecord& row : report.history)
          {
            isFollowed = isFollowed || row.stage.rfind("sizes", 0) == 0;
          }
          EXPECT_EQ(isFollowed, isAsked);
          const double predicted = isAsked ? 4.0 / std::sqrt(3.0) / (size * size) : 0.0;
          EXPECT_NEAR(report.sizes.predictedCells, predicted, 1e-9);
        }
      }
    }
  }
}

/// A boundary that slides gets all its sizes.
TEST(OptimizerSizes, TheMetricFollowsTheMesh)
{
  constexpr double least = 0.05;
  const MeshInput<2> in = jitteredGrid<2>(6, 0.1);
  const Result<2> run = optimized<2>(in, sizesOf(in, least), options(0.3, 0.5), true);
  EXPECT_FALSE(run.metric.isRaised());
  EXPECT_FALSE(hasStage(run.report, "sizes as wanted"));
  EXPECT_NEAR(run.cells / run.predicted, 1.0, 0.1);
  expectWantedSizes(run, least, 0.3);
}

/// Beside edges that stay, larger sizes are followed; in the end the wanted ones count again.
TEST(OptimizerSizes, WantedSizesCountInTheEnd)
{
  constexpr double least = 0.05;
  const MeshInput<2> in = disc(16); // edges of .39
  const Result<2> run = optimized<2>(in, sizesOf(in, least), options(0.3, 0.5), false);
  ASSERT_TRUE(hasStage(run.report, "sizes as wanted"));
  EXPECT_FALSE(run.metric.isRaised());
  expectWantedSizes(run, least, 0.3);
}

/// In this metric two triangles in the corners already have the best shape, and with elements of
/// the wanted size they are worse. Then all is undone, to the last point.
TEST(OptimizerSizes, GivenUpWhereTheWorstWouldFall)
{
  const SharpCorners sharp;
  constexpr double least = 0.015;
  const NodalMetric<2> metric = sizesOf(sharp.in, least, sharp.metric);
  const Result<2> undone = optimized<2>(sharp.in, metric, options(), true);
  EXPECT_NEAR(undone.report.worstBefore, sharp.best, 1e-3);
  EXPECT_TRUE(undone.report.sizes.isGivenUp);
  EXPECT_LT(undone.report.sizes.worstWithSizes, undone.report.worstBefore);
  const auto& rows = undone.report.history;
  const auto given = std::find_if(
    rows.begin(), rows.end(), [](const PassRecord& row) { return row.stage == "sizes given up"; });
  ASSERT_NE(given, rows.end());
  const long before = static_cast<long>(sharp.in.cells.size());
  EXPECT_EQ(given->cells, before);
  EXPECT_EQ(given->points, static_cast<long>(sharp.in.points.size()));
  EXPECT_EQ(given->worst, undone.report.worstBefore);
  EXPECT_EQ(given->mean, undone.report.meanBefore);
  EXPECT_LE(undone.cells, before + growthOf(options(), before, 2)); // as without sizes
  EXPECT_EQ(rows.back().worst, undone.report.worstAfter);
  expectWantedSizes(undone, least, 0.0, sharp.metric);
  // For a target that they reach they are not.
  const Result<2> made = optimized<2>(sharp.in, metric, options(0.0, 0.35), true);
  EXPECT_NEAR(made.cells / made.predicted, 1.0, 0.1);
  EXPECT_FALSE(made.report.sizes.isGivenUp);
  EXPECT_LE(made.report.worstAfter, sharp.best + 1e-9); // no mesh has more
}

/// The worst may fall while sizes are followed, but not under the target.
TEST(OptimizerSizes, TheWorstStaysAboveTheTarget)
{
  const MeshInput<2> in = jitteredGrid<2>(4, 0.0); // right angled: .86 of the best
  for (const double target : { 0.3, 0.6 })
  {
    const Result<2> run = optimized<2>(in, NodalMetric<2>(0.04), options(0.0, target), true);
    EXPECT_LT(run.report.worstAfter, run.report.worstBefore);
    EXPECT_GE(run.report.worstAfter, target);
    EXPECT_NEAR(run.cells / run.predicted, 1.0, 0.1);
  }
}
