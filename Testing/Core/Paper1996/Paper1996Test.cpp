// SPDX-License-Identifier: BSD-3-Clause
// The paper's mode as a whole: what it must reach, keep, and give again.
#include "Paper1996/Paper1996.h"
#include "Bound/SurfaceBound.h"
#include "Optimize/Optimizer.h"
#include "Paper1996/GlobalAlgorithm.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
Report run(SimplexMesh<D>& mesh, const Options& options = {}, const Control& control = {})
{
  NodalMetric<D> metric(options.desiredSize);
  EXPECT_EQ(options.check(false), "");
  return optimize<D>(mesh, metric, options, control);
}

Options target(double quality)
{
  Options options;
  options.algorithm = Algorithm::Paper1996;
  options.targetQuality = quality;
  return options;
}

template <int D>
MeshInput<D> testMesh(double jitter = 0.3, unsigned seed = 1)
{
  return jitteredGrid<D>(D == 3 ? 5 : 10, jitter, seed);
}

template <int D>
double absoluteVolume(const SimplexMesh<D>& mesh)
{
  double sum = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    sum += mesh.isAlive(c) ? std::abs(signedVolume(mesh.corners(c))) : 0.0;
  }
  return sum;
}
}

template <class T>
class Paper : public ::testing::Test
{
};
TYPED_TEST_SUITE(Paper, TestDimensions);

TYPED_TEST(Paper, RaisesTheWorstAndKeepsTheRest)
{
  constexpr int D = TypeParam::dimension;
  for (const bool regions : { false, true })
  {
    for (unsigned seed = 1; seed <= 3; ++seed)
    {
      MeshInput<D> in = testMesh<D>(0.35, seed);
      if (regions)
      {
        splitRegions(in);
      }
      SimplexMesh<D> mesh = buildMesh(in);
      const auto kept = keptFacets(mesh);
      const long euler = eulerCharacteristic(mesh);
      NodalMetric<D> metric;
      MeshEditor<D> editor(mesh);
      computeQualities<D>(editor, metric, Measure::Shape, 0.0);
      const auto before = sortedQualities(mesh);
      const Report report = run<D>(mesh, target(1.0));
      // Kept facets between displaced nodes may cap the worst element.
      EXPECT_GE(report.worstAfter, report.worstBefore + (regions ? 0.0 : 0.2));
      EXPECT_LE(report.worstAfter, surfaceBound<D>(mesh).bound + 1e-12);
      EXPECT_TRUE(isAbove(sortedQualities(mesh), before));
      const auto stored = sortedQualities(mesh);
      computeQualities<D>(editor, metric, Measure::Shape, 0.0);
      EXPECT_EQ(sortedQualities(mesh), stored); // the bits it worked with are those of the mesh
      EXPECT_EQ(report.worstAfter, stored.front());
      EXPECT_EQ(keptFacets(mesh), kept);
      EXPECT_EQ(eulerCharacteristic(mesh), euler);
      expectSound(mesh);
      const double tolerance = 1e-13 * std::sqrt(double(mesh.countCells()));
      EXPECT_NEAR(mesh.volume(), 1.0, tolerance);
      EXPECT_NEAR(mesh.volume(), absoluteVolume(mesh), tolerance);
      for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
      {
        EXPECT_TRUE(mesh.isFree(p) || mesh.point(p) == in.points[p]);
      }
    }
  }
}

TYPED_TEST(Paper, HistoryAddsUp)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  const Report report = run<D>(mesh, target(1.0));
  ASSERT_GE(report.history.size(), 3u);
  EXPECT_EQ(report.history.front().stage, "input");
  EXPECT_EQ(report.history[1].stage, "reconnection");
  EXPECT_EQ(report.history[2].stage, "repositioning");
  for (std::size_t k = 0; k < report.history.size(); ++k)
  {
    const PassRecord& row = report.history[k];
    EXPECT_EQ(row.pass, static_cast<int>(k));
    EXPECT_TRUE(k == 0 || row.worst >= report.history[k - 1].worst);
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      EXPECT_LE(row.done[op], row.tried[op]);
    }
  }
  EXPECT_EQ(report.history.back().cells, mesh.countCells());
  EXPECT_EQ(report.history.back().worst, report.worstAfter);
}

TYPED_TEST(Paper, SwitchesTurnKindsOff)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.35);
  Options options = target(1.0);
  options.reconnect = options.insertNodes = options.removeNodes = false;
  SimplexMesh<D> moved = buildMesh(in);
  const SimplexMesh<D> original = moved;
  const Report motion = run<D>(moved, options);
  EXPECT_GT(motion.worstAfter, motion.worstBefore);
  ASSERT_EQ(moved.numberOfCellSlots(), original.numberOfCellSlots());
  for (Index c = 0; c < moved.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(moved.nodes(c), original.nodes(c));
  }
  options = target(1.0);
  options.moveNodes = options.insertNodes = options.removeNodes = false;
  SimplexMesh<D> swapped = buildMesh(in);
  const Report report = run<D>(swapped, options);
  EXPECT_GT(report.worstAfter, report.worstBefore);
  EXPECT_EQ(swapped.countPoints(), static_cast<Index>(in.points.size()));
  for (Index p = 0; p < swapped.numberOfPointSlots(); ++p)
  {
    EXPECT_EQ(swapped.point(p), in.points[p]);
  }
}

TYPED_TEST(Paper, SameBitsOnEveryRun)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> a = buildMesh(testMesh<D>(0.35)), b = a;
  run<D>(a, target(1.0));
  run<D>(b, target(1.0));
  EXPECT_EQ(bitsOf(a), bitsOf(b));
}

TYPED_TEST(Paper, ScalingByAPowerOfTwoScalesTheBits)
{
  constexpr int D = TypeParam::dimension;
  for (const double factor : { 1024.0, 1.0 / 65536.0 })
  {
    MeshInput<D> in = testMesh<D>(0.35);
    SimplexMesh<D> a = buildMesh(in);
    for (auto& x : in.points)
    {
      x *= factor;
    }
    SimplexMesh<D> b = buildMesh(in);
    run<D>(a, target(1.0));
    run<D>(b, target(1.0));
    MeshBits<D> scaled = bitsOf(a);
    for (double& x : scaled.coordinates)
    {
      x *= factor;
    }
    EXPECT_EQ(scaled, bitsOf(b));
  }
}

TYPED_TEST(Paper, RotationTranslationRenumbering)
{
  constexpr int D = TypeParam::dimension;
  const double goal = D == 3 ? 0.45 : 0.7;
  MeshInput<D> in = testMesh<D>(0.3);
  SimplexMesh<D> plain = buildMesh(in);
  const double reference = run<D>(plain, target(goal)).worstAfter;

  MeshInput<D> turned = in;
  for (auto& x : turned.points)
  {
    const double a = x[0], b = x[1];
    x[0] = 0.8 * a - 0.6 * b + 3.0;
    x[1] = 0.6 * a + 0.8 * b - 1.0;
  }
  SimplexMesh<D> second = buildMesh(turned);
  EXPECT_NEAR(run<D>(second, target(goal)).worstAfter, reference, 0.02);

  MeshInput<D> renumbered = in;
  const Index n = static_cast<Index>(in.points.size());
  for (Index p = 0; p < n; ++p)
  {
    renumbered.points[n - 1 - p] = in.points[p];
  }
  for (Simplex<D>& cell : renumbered.cells)
  {
    for (Index& p : cell)
    {
      p = n - 1 - p;
    }
  }
  std::reverse(renumbered.cells.begin(), renumbered.cells.end());
  SimplexMesh<D> third = buildMesh(renumbered);
  EXPECT_NEAR(run<D>(third, target(goal)).worstAfter, reference, 0.02);
}

TYPED_TEST(Paper, UntanglesInvertedCells)
{
  constexpr int D = TypeParam::dimension;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SimplexMesh<D> mesh = buildMesh(testMesh<D>(0.6, seed));
    const Report report = run<D>(mesh, target(0.4));
    EXPECT_GT(report.invertedBefore, 0);
    EXPECT_EQ(report.invertedAfter, 0);
    EXPECT_GT(report.worstAfter, 0.3);
    expectSound(mesh);
    EXPECT_NEAR(absoluteVolume(mesh), 1.0, 1e-11);
  }
}

TYPED_TEST(Paper, GrowthIsLimitedOnRequest)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.32, 2);
  std::vector<MeshBits<D>> bits;
  for (const long growth : { AnyGrowth, 1000000L, 0L, 20L })
  {
    SimplexMesh<D> mesh = buildMesh(in);
    const long cells = mesh.countCells();
    MeshEditor<D> editor(mesh);
    NodalMetric<D> metric;
    const Options options = target(0.9);
    computeQualities<D>(editor, metric, options.measure, options.beta);
    Report report;
    report.history.push_back(summarize(mesh, options.targetQuality));
    const Control control;
    Clock clock(control);
    meshopt::Run<D> run{ editor, metric, nullptr, options, control, clock, report, growth };
    // without look-ahead, which takes no notice of the limit
    optimizePaper1996<D>(run, options.targetQuality, false);
    EXPECT_LE(mesh.countCells() - cells, growth);
    bits.push_back(bitsOf(mesh));
  }
  EXPECT_TRUE(bits[0] == bits[1]); // no limit is no limit, also after cells have gone
  EXPECT_TRUE(D == 2 || !(bits[0] == bits[2]));
}

TYPED_TEST(Paper, EveryMeasureImprovesInItsOwnTerms)
{
  constexpr int D = TypeParam::dimension;
  for (int m = 0; m <= static_cast<int>(Measure::VolumeLength); ++m)
  {
    Options options = target(1.0);
    options.measure = static_cast<Measure>(m);
    options.maximumNumberOfAlternations = 3;
    SimplexMesh<D> mesh = buildMesh(testMesh<D>(0.3));
    const Report report = run<D>(mesh, options);
    EXPECT_GT(report.worstAfter, report.worstBefore) << m;
    expectSound(mesh);
  }
}

TYPED_TEST(Paper, SizeFieldAndMetricAreSampledAgain)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>(0.3));
  std::vector<double> sizes;
  std::vector<Tensor<D>> tensors;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    sizes.push_back(0.2 + 0.1 * mesh.point(p)[0]);
    tensors.push_back((1.0 + mesh.point(p)[1]) * Tensor<D>::Identity());
  }
  NodalMetric<D> metric;
  ASSERT_EQ(metric.set(mesh, sizes, tensors), "");
  Options options = target(1.0);
  options.beta = 0.5;
  options.maximumNumberOfAlternations = 3;
  ASSERT_EQ(options.check(true), "");
  const Report report = optimize<D>(mesh, metric, options, {});
  EXPECT_GT(report.worstAfter, report.worstBefore);
  const auto stored = sortedQualities(mesh);
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, Measure::Shape, 0.5);
  EXPECT_EQ(sortedQualities(mesh), stored); // the qualities it worked with are the real ones
  expectSound(mesh);
}
