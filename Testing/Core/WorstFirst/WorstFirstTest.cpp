// SPDX-License-Identifier: BSD-3-Clause
// The fast engine as a whole: what it must reach and keep.
#include "WorstFirstRuns.h"

using namespace meshopt;

template <class T>
class WorstFirst : public ::testing::Test
{
};
TYPED_TEST_SUITE(WorstFirst, TestDimensions);

// ---- what it reaches ----------------------------------------------------------------------------

TYPED_TEST(WorstFirst, ReachesTheTarget)
{
  constexpr int D = TypeParam::dimension;
  for (const MeshInput<D>& in : { testMesh<D>(), withSlivers<D>() })
  {
    SimplexMesh<D> mesh = buildMesh(in);
    const Report report = run<D>(mesh, target(D == 3 ? 0.5 : 0.7));
    EXPECT_LT(report.worstBefore, 0.25);
    EXPECT_GE(report.worstAfter, D == 3 ? 0.5 : 0.7);
    EXPECT_EQ(report.stopReason, StopReason::TargetReached);
    EXPECT_EQ(report.history.back().belowTarget, 0);
    EXPECT_GT(report.meanAfter, report.meanBefore);
    EXPECT_EQ(report.history.front().stage, "input");
  }
}

/// Where the target is out of reach, the best effort begins with all that the usual one does.
TYPED_TEST(WorstFirst, BestBeginsAsDefaultWhereTheTargetIsOutOfReach)
{
  constexpr int D = TypeParam::dimension;
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    MeshInput<D> in = testMesh<D>(0.3, seed);
    for (Vec<D>& x : in.points)
    {
      x[0] *= 0.1; // the surface now has needles: they cap the cells there
    }
    std::vector<PassRecord> histories[2];
    double worst[2];
    for (int k : { 0, 1 })
    {
      SimplexMesh<D> mesh = buildMesh(in);
      Options options = target(0.6);
      options.effort = k == 0 ? Effort::Default : Effort::Best;
      const Report report = run<D>(mesh, options);
      histories[k] = report.history;
      worst[k] = report.worstAfter;
    }
    EXPECT_LT(worst[0], 0.6) << "the target is not out of reach: nothing is tested";
    EXPECT_GE(worst[1], worst[0]) << "seed " << seed;
    ASSERT_GE(histories[1].size(), histories[0].size()) << "seed " << seed;
    // The last row: what comes next in the best effort may be added to it.
    for (std::size_t row = 0; row + 1 < histories[0].size(); ++row)
    {
      EXPECT_EQ(histories[1][row].stage, histories[0][row].stage) << "seed " << seed;
      EXPECT_EQ(histories[1][row].worst, histories[0][row].worst) << "seed " << seed;
      EXPECT_EQ(histories[1][row].cells, histories[0][row].cells) << "seed " << seed;
    }
  }
}

TYPED_TEST(WorstFirst, GoodMeshIsLeftAlone)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.02));
  const MeshBits<D> before = bitsOf(mesh);
  const Report report = run<D>(mesh, target(0.4));
  EXPECT_EQ(report.stopReason, StopReason::TargetReached);
  EXPECT_EQ(bitsOf(mesh), before);
}

TYPED_TEST(WorstFirst, Untangles)
{
  constexpr int D = TypeParam::dimension;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SimplexMesh<D> mesh = buildMesh(testMesh<D>(0.5, seed));
    const Report report = run<D>(mesh, target(0.3));
    EXPECT_GE(report.invertedBefore, 3);
    EXPECT_EQ(report.invertedAfter, 0);
    EXPECT_GT(report.worstAfter, 0.0);
    expectSound(mesh, true);
  }
}

TYPED_TEST(WorstFirst, EveryMeasureRaisesItsWorst)
{
  constexpr int D = TypeParam::dimension;
  for (Measure measure : { Measure::Shape, Measure::RadiusRatio, Measure::MeanRatio,
         Measure::MinimumSine, Measure::WarpedSine, Measure::VolumeLength })
  {
    SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 4 : 10, 0.3, 3));
    Options options = target(D == 3 ? 0.35 : 0.5);
    options.measure = measure;
    const Report report = run<D>(mesh, options);
    EXPECT_GT(report.worstAfter, std::min(0.3, report.worstBefore + 0.1)) << int(measure);
  }
}

TEST(WorstFirst3D, TriesCellsAcrossEveryBorder)
{
  // Enough cells for several chunks; and octahedra as wide as all of them, which every border cuts.
  MeshInput<3> in = jitteredGrid<3>(20, 0.1);
  const double r = std::sqrt(0.5);
  const Vec<3> axes[] = { Vec<3>(r, r, 0.0), Vec<3>(r, -r, 0.0), Vec<3>(0.0, 0.0, 1.0) };
  const Vec<3> centre = Vec<3>::Constant(0.5);
  for (int octahedron = 0; octahedron < 100; ++octahedron)
  {
    const Index first = static_cast<Index>(in.points.size());
    const double radius = 0.8 + 0.001 * octahedron;
    for (int k = 0; k < 6; ++k)
    {
      in.points.push_back(centre + (k % 2 ? radius : -radius) * axes[k / 2]);
    }
    // its middle, close to a face that reaches to both sides
    in.points.push_back(centre + 0.3 * radius * (axes[0] - axes[1] + axes[2]));
    for (int octant = 0; octant < 8; ++octant)
    {
      const Index x = first + (octant & 1), y = first + 2 + ((octant >> 1) & 1);
      const Index z = first + 4 + ((octant >> 2) & 1);
      const bool odd = ((octant ^ (octant >> 1) ^ (octant >> 2)) & 1) != 0;
      in.cells.push_back({ x, odd ? y : z, odd ? z : y, first + 6 });
    }
  }
  ASSERT_GE(in.cells.size(), 48000u);
  SimplexMesh<3> mesh = buildMesh(in);
  const Report report = run<3>(mesh, target(0.3));
  EXPECT_LT(report.worstBefore, 0.15);
  EXPECT_EQ(report.stopReason, StopReason::TargetReached) << report.worstAfter;
}

// ---- what it keeps ------------------------------------------------------------------------------

TYPED_TEST(WorstFirst, KeepsWhatMustStay)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = testMesh<D>();
  splitRegions(in);
  const SimplexMesh<D> plain = buildMesh(in);
  in.fixedPoints.assign(in.points.size(), 0);
  std::vector<Index> fixed;
  for (Index p = 0; p < plain.numberOfPointSlots(); ++p)
  {
    if (plain.isFree(p) && p % 4 == 0)
    {
      in.fixedPoints[p] = 1;
      fixed.push_back(p);
    }
  }
  ASSERT_GT(fixed.size(), 5u);
  std::vector<std::array<Index, 2>> edges;
  for (Index c = 40; c < plain.numberOfCellSlots() && D == 3; c += 97)
  {
    edges.push_back({ plain.nodes(c)[0], plain.nodes(c)[3] });
  }
  in.keptEdges = edges;
  SimplexMesh<D> mesh = buildMesh(in);
  double regionVolume = 0.0;
  run<D>(mesh, target(0.6));
  for (Index p : fixed)
  {
    EXPECT_TRUE(mesh.isPointAlive(p));
    EXPECT_EQ(mesh.point(p), in.points[p]);
  }
  for (const auto& e : edges)
  {
    bool found = false;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      found = found ||
        (mesh.isAlive(c) && mesh.localIndex(c, e[0]) >= 0 && mesh.localIndex(c, e[1]) >= 0);
    }
    EXPECT_TRUE(found) << e[0] << " " << e[1];
    EXPECT_EQ(mesh.point(e[0]), in.points[e[0]]);
    EXPECT_EQ(mesh.point(e[1]), in.points[e[1]]);
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      regionVolume += mesh.region(c) == 0 ? signedVolume(mesh.corners(c)) : 0.0;
      ASSERT_LT(mesh.parent(c), mesh.numberOfInputCells());
      EXPECT_EQ(mesh.region(c), in.regions[mesh.parent(c)]);
    }
  }
  double expected = 0.0;
  for (Index c = 0; c < plain.numberOfCellSlots(); ++c)
  {
    expected += plain.region(c) == 0 ? signedVolume(plain.corners(c)) : 0.0;
  }
  EXPECT_NEAR(regionVolume, expected, 1e-12);
}
// ---- sizes and metrics --------------------------------------------------------------------------

TYPED_TEST(WorstFirst, SizesAndMetrics)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 3 ? 4 : 8, 0.25, 4);
  const double h = D == 3 ? 0.4 : 0.17;
  const SimplexMesh<D> input = buildMesh(in);
  Tensor<D> stretch = Tensor<D>::Identity();
  stretch(0, 0) = 4.0;
  std::vector<double> sizes;
  std::vector<Tensor<D>> tensors;
  for (const Vec<D>& x : in.points)
  {
    sizes.push_back(h * (0.7 + 0.6 * x[0]));
    Tensor<D> t = Tensor<D>::Identity();
    t(D - 1, D - 1) = 1.0 + 2.0 * x[0];
    tensors.push_back(t);
  }
  for (int kind = 0; kind < 5; ++kind)
  {
    Options options = target(D == 3 ? 0.4 : 0.6);
    options.effort = Effort::Quick;
    options.beta = kind == 4 ? 0.0 : 0.4;
    options.desiredSize = h;
    NodalMetric<D> metric(h);
    if (kind == 1)
    {
      EXPECT_EQ(metric.set(input, sizes, {}), "");
    }
    else if (kind == 2)
    {
      EXPECT_EQ(metric.set(input, {}, std::vector<Tensor<D>>(in.points.size(), stretch)), "");
    }
    else if (kind >= 3)
    {
      EXPECT_EQ(metric.set(input, {}, tensors), "");
    }
    SimplexMesh<D> mesh = buildMesh(in);
    const Report report = run<D>(mesh, options, metric); // copies share the background only
    EXPECT_GT(report.worstAfter, std::min(report.worstBefore + 0.02, options.targetQuality))
      << kind;
  }
}
