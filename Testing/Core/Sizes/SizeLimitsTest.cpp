// SPDX-License-Identifier: BSD-3-Clause
// Sizes that cannot be had: kept edges, sharp corners of a metric, metrics that turn too fast, no
// time.
#include "Quality/Shape.h"
#include "SizeRuns.h"

using namespace meshopt;

namespace
{
/// How many regular triangles fill the cells of `in` where edges of the boundary stay and `wanted`
/// is wanted: 4 / sqrt(3) int dA / s^2, with s what the nearest edges of length l leave to the
/// distance d, the greatest l - .7 d (SizeFloor), or what is wanted. By the midpoint rule on n^2
/// parts of each cell.
double trianglesBeside(const MeshInput<2>& in, double wanted)
{
  constexpr int n = 60;
  constexpr double fall = 0.7;
  const SimplexMesh<2> mesh = buildMesh(in);
  std::vector<std::array<Vec<2>, 2>> edges;
  forKeptFacets(mesh,
    [&](Index c, int i)
    {
      const Facet<2> f = mesh.facet(c, i);
      edges.push_back({ mesh.point(f[0]), mesh.point(f[1]) });
    });
  const auto sizeAt = [&](const Vec<2>& x)
  {
    double size = wanted;
    for (const auto& [a, b] : edges)
    {
      const Vec<2> along = b - a;
      const double part = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      size = std::max(size, along.norm() - fall * (x - a - part * along).norm());
    }
    return size;
  };
  double sum = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Corners<2> x = mesh.corners(c);
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < 2 * (n - i) - 1; ++j) // upright triangles and those upside down
      {
        const double s = (i + (j % 2 ? 2.0 : 1.0) / 3.0) / n;
        const double t = (j / 2 + (j % 2 ? 2.0 : 1.0) / 3.0) / n;
        const double size = sizeAt(x[0] + s * (x[1] - x[0]) + t * (x[2] - x[0]));
        sum += signedVolume(x) / (n * n) / (size * size);
      }
    }
  }
  return 4.0 / std::sqrt(3.0) * sum;
}
}

TEST(SizeLimits, FixedBoundaryKeepsWhatItHas)
{
  const MeshInput<2> in = jitteredGrid<2>(4, 0.1);
  const Result<2> tiny = optimized<2>(in, NodalMetric<2>(0.02), options(0.3, 0.6), false);
  EXPECT_NEAR(static_cast<double>(tiny.cells) / trianglesBeside(in, 0.02), 1.0, 0.25);
  EXPECT_GT(tiny.report.worstAfter, tiny.report.worstBefore);
  const Result<2> huge = optimized<2>(in, NodalMetric<2>(10.0), options(0.3), false);
  // A triangle has at most two sides on the boundary, of which all stay, and the mesh gets coarser.
  EXPECT_GE(huge.cells, 4 * 4 / 2);
  EXPECT_LT(huge.cells, static_cast<long>(in.cells.size()));
}

/// Flat cells are repaired before the sizes are followed. The growth budget is for both that and
/// what follows once the sizes are given up.
TEST(SizeLimits, TheGrowthBudgetIsForTheRepairToo)
{
  int givenUp = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    MeshInput<2> in = jitteredGrid<2>(6, 0.0);
    TestRandom random(seed);
    for (int k = 0; k < 6; ++k) // nodes that go to a neighbour: the cells of both are flat
    {
      const int i = 1 + int(2.4999 * (random() + 1.0)), j = 1 + int(2.4999 * (random() + 1.0));
      in.points[i + 7 * j] = in.points[i + 1 + 7 * j];
    }
    const Tensor<2> m = (Tensor<2>() << 5.05, -4.95, -4.95, 5.05).finished();
    const Options o = options(0.0, 0.95);
    const Result<2> run = optimized<2>(in, constantMetric<2>(in, m, 0.1), o, true);
    if (run.report.sizes.isGivenUp)
    {
      const long before = run.report.history.front().cells;
      EXPECT_LE(run.cells, before + growthOf(o, before, 2)) << seed;
      ++givenUp;
    }
  }
  EXPECT_GE(givenUp, 1);
}

/// Edges of .39, and .01 is wanted: elements grow from the one to the other, and inside all is as
/// wanted.
TEST(SizeLimits, SizesFallFromAFixedCoarseBoundary)
{
  const Result<2> run = optimized<2>(disc(16), NodalMetric<2>(0.01), options(1.0), false);
  EXPECT_FALSE(run.report.sizes.isGivenUp);
  EXPECT_EQ(run.report.sizes.cellsAtBrake, 0);
  EXPECT_NEAR(run.report.sizes.longestKept, 2.0 * std::sin(Pi / 16) / 0.01, 1e-6);
  EXPECT_NE(run.report.stopReason, StopReason::TargetReached);
  EXPECT_LT(tries(run.report), 60 * run.cells); // takes 12; not without end
  EXPECT_NEAR(static_cast<double>(run.cells) / trianglesBeside(disc(16), 0.01), 1.0, 0.25);
  double worstShape = 1.0, worstInside = 1.0;
  for (Index c = 0; c < run.mesh.numberOfCellSlots(); ++c)
  {
    if (run.mesh.isAlive(c))
    {
      const auto x = run.mesh.corners(c);
      worstShape = std::min(worstShape, MeanEdgeShape<2>::value(x));
      const bool isInside = (x[0] + x[1] + x[2]).norm() / 3.0 < 0.3;
      worstInside = isInside ? std::min(worstInside, run.mesh.quality(c)) : worstInside;
    }
  }
  EXPECT_GE(worstShape, 0.5);
  EXPECT_GE(worstInside, 0.6);
}

/// A metric that turns by far more than its elements are short: what is made must not grow without
/// end.
TEST(SizeLimits, SplittingHasABrake)
{
  constexpr double ratio = 100.0, wanted = 0.3;
  const MeshInput<2> in = jitteredGrid<2>(32, 0.0);
  std::vector<Tensor<2>> tensors;
  for (const Vec<2>& x : in.points)
  {
    const double a = 8.0 * Pi * x[1];
    const Vec<2> n(std::cos(a), std::sin(a));
    tensors.push_back(Tensor<2>(Tensor<2>::Identity() + (ratio * ratio - 1.0) * n * n.transpose()));
  }
  NodalMetric<2> metric(wanted);
  EXPECT_EQ(metric.set(buildMesh(in), {}, tensors), "");
  Options o = options(1.0, 0.1);
  o.effort = Effort::Quick;
  const Result<2> run = optimized<2>(in, metric, o, true);
  const double most = 4.0 * run.predicted + 1000.0;
  // 4 / sqrt(3) of the area in units of the wanted length: sqrt(det) is the ratio, everywhere
  EXPECT_NEAR(run.predicted, 4.0 / std::sqrt(3.0) * ratio / (wanted * wanted), 1e-6);
  EXPECT_NEAR(run.report.sizes.predictedCells, run.predicted, 1e-6);
  EXPECT_GT(run.report.sizes.cellsAtBrake, most);
  EXPECT_LT(run.report.sizes.cellsAtBrake, most + 10.0);
  EXPECT_LT(run.cells, 1.1 * most);
}

// In a mesh of some ten triangles one node is a fifth of them: to correct the number to a few
// percent made the worst element bad, and then the sizes were given up.
/// A round of a large mesh takes long: what is left of it must not be done first.
TEST(SizeLimits, NoTimeEndsARoundInItsMidst)
{
  const MeshInput<2> in = jitteredGrid<2>(60, 0.3);
  const auto tried = [&](const Control& control)
  {
    long sum = 0;
    for (const PassRecord& row :
      optimized<2>(in, NodalMetric<2>(1.0 / 60), options(1.0), false, control).report.history)
    {
      sum += row.stage.rfind("sizes", 0) == 0
        ? row.tried[static_cast<std::size_t>(Operation::NodeMotion)]
        : 0;
    }
    return sum;
  };
  Control late;
  late.deadline = deadlineIn(1e-9);
  EXPECT_LT(10 * tried(late), tried({}));
  EXPECT_LT(tried(late), static_cast<long>(in.points.size()) / 3);
}

TEST(SizeLimits, SmallMeshesGetTheirSizes)
{
  for (unsigned seed : { 3, 18, 28 })
  {
    TestRandom random(seed);
    const double h = (1.0 + 0.3 * random()) / 3.0, along = 1.0 + 0.5 * random();
    Tensor<2> metric = Tensor<2>::Identity();
    metric(0, 0) = along * along;
    const MeshInput<2> in = jitteredGrid<2>(3, 0.2, seed);
    const Result<2> run = optimized<2>(in, constantMetric<2>(in, metric, h), options(2.0), false);
    EXPECT_FALSE(run.report.sizes.isGivenUp) << seed;
    EXPECT_NEAR(static_cast<double>(run.cells), run.predicted, 5.0) << seed;
  }
}
