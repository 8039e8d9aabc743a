// SPDX-License-Identifier: BSD-3-Clause
// The fast engine as a whole: what it must reach, keep, and give again.
#include "Optimize/Optimizer.h"
#include "Optimize/Statistics.h"
#include "TestMeshes.h"
#include "TestThreads.h"

using namespace meshopt;

namespace
{
Options target(double quality)
{
  Options options;
  options.algorithm = Algorithm::WorstFirst;
  options.targetQuality = quality;
  return options;
}

/// Runs the engine; checks what holds for every run.
template <int D>
Report run(
  SimplexMesh<D>& mesh, const Options& options, NodalMetric<D> metric, const Control& control = {})
{
  EXPECT_EQ(options.check(metric.hasSizes()), "");
  const auto kept = keptFacets(mesh);
  const double volume = mesh.volume();
  const long euler = mesh.eulerCharacteristic();
  const Report report = optimize<D>(mesh, metric, options, control);
  expectSound(mesh, report.invertedAfter == 0);
  EXPECT_EQ(keptFacets(mesh), kept);
  EXPECT_NEAR(mesh.volume(), volume, 1e-11 * std::max(1.0, std::abs(volume)));
  EXPECT_EQ(mesh.eulerCharacteristic(), euler);
  for (std::size_t k = 1; k < report.history.size(); ++k)
  {
    if (report.history[k].stage.rfind("sizes", 0) != 0) // those may lower it
    {
      EXPECT_GE(report.history[k].worst, report.history[k - 1].worst) << report.history[k].stage;
    }
  }
  EXPECT_GE(report.worstAfter, std::min(report.worstBefore, options.targetQuality));
  EXPECT_LE(report.invertedAfter, report.invertedBefore);
  EXPECT_LE(report.worstAfter, report.bound + 1e-12);

  // the qualities that are stored are those of the cells
  const std::vector<double> stored = sortedQualities(mesh);
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, options.measure, options.beta);
  const std::vector<double> computed = sortedQualities(mesh);
  EXPECT_EQ(stored.size(), computed.size());
  for (std::size_t k = 0; k < std::min(stored.size(), computed.size()); ++k)
  {
    EXPECT_NEAR(stored[k], computed[k], 1e-9 * (1.0 + std::abs(computed[k])));
  }
  EXPECT_EQ(report.worstAfter, stored.front());
  return report;
}

template <int D>
Report run(SimplexMesh<D>& mesh, const Options& options, const Control& control = {})
{
  return run<D>(mesh, options, NodalMetric<D>(options.desiredSize), control);
}

template <int D>
MeshInput<D> testMesh(double jitter = 0.3, unsigned seed = 1)
{
  return jitteredGrid<D>(D == 3 ? 6 : 14, jitter, seed);
}

/// Some interior cells are pressed nearly flat: one node close to the facet opposite to it.
template <int D>
MeshInput<D> withSlivers()
{
  MeshInput<D> in = testMesh<D>(0.1);
  const SimplexMesh<D> mesh = buildMesh(in);
  std::vector<Index> star;
  std::vector<bool> used(in.points.size(), false);
  for (Index p = 0; p < mesh.numberOfPointSlots(); p += 5)
  {
    if (mesh.isFixed(p))
    {
      continue;
    }
    mesh.star(p, star);
    const Index c = star[0];
    const Facet<D> f = mesh.facet(c, mesh.localIndex(c, p));
    Vec<D> foot = Vec<D>::Zero();
    bool free = true;
    for (Index q : f)
    {
      foot += in.points[q] / D;
      free = free && !used[q];
    }
    if (free)
    {
      in.points[p] += 0.93 * (foot - in.points[p]);
      used[p] = true;
    }
  }
  return in;
}

long count(const Report& report, Operation op)
{
  long n = 0;
  for (const PassRecord& row : report.history)
  {
    n += row.done[static_cast<int>(op)];
  }
  return n;
}

struct Two
{
  static constexpr int dimension = 2;
};
struct Three
{
  static constexpr int dimension = 3;
};
}

template <class T>
class WorstFirst : public ::testing::Test
{
};
using Dimensions = ::testing::Types<Two, Three>;
TYPED_TEST_SUITE(WorstFirst, Dimensions);

// ---- what it reaches -----------------------------------------------------------------------------

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

TYPED_TEST(WorstFirst, GoodMeshIsLeftAlone)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.02));
  const MeshBits<D> before = bitsOf(mesh);
  const Report report = run<D>(mesh, target(0.4));
  EXPECT_EQ(report.stopReason, StopReason::TargetReached);
  EXPECT_EQ(bitsOf(mesh), before);
  SimplexMesh<D> empty = buildMesh(MeshInput<D>());
  NodalMetric<D> metric;
  EXPECT_EQ(optimize<D>(empty, metric, target(0.5), {}).stopReason, StopReason::NothingToDo);
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

// ---- what it keeps -------------------------------------------------------------------------------

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
    if (!plain.isFixed(p) && p % 4 == 0)
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
  in.constrainedEdges = edges;
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

// ---- options -------------------------------------------------------------------------------------

TYPED_TEST(WorstFirst, KindsOfOperationsCanBeSwitchedOff)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.32, 2);
  for (int off = 0; off < 5; ++off) // 4: nothing is off
  {
    Options options = target(0.9); // beyond reach: all is tried
    options.timeLimit = 0.0;
    options.effort = off == 4 ? Effort::Quick : Effort::Default;
    options.moveNodes = off != 0;
    options.reconnect = off != 1;
    options.insertNodes = off != 2;
    options.removeNodes = off != 3;
    SimplexMesh<D> mesh = buildMesh(in);
    const Report report = run<D>(mesh, options);
    EXPECT_EQ(count(report, Operation::NodeMotion) == 0, off == 0) << off;
    EXPECT_EQ(count(report, Operation::EdgeRemoval) == 0, off == 1) << off;
    EXPECT_TRUE(off != 1 || count(report, Operation::FaceRemoval) == 0);
    EXPECT_EQ(count(report, Operation::NodeInsertion) == 0, off == 2) << off;
    EXPECT_TRUE(off != 2 || count(report, Operation::LookAhead) == 0);
    EXPECT_TRUE(off != 3 || count(report, Operation::EdgeContraction) == 0);
    Index moved = 0, gone = 0;
    for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
    {
      gone += !mesh.isPointAlive(p);
      moved += mesh.isPointAlive(p) && mesh.point(p) != in.points[p];
    }
    EXPECT_EQ(moved == 0, off == 0) << off;
    EXPECT_TRUE(off != 2 || mesh.countPoints() <= mesh.numberOfInputPoints());
    EXPECT_TRUE(off != 3 || gone == 0) << gone << " points are gone";
  }
}

TYPED_TEST(WorstFirst, GrowthBudgetIsHonoured)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.32, 2);
  for (double budget : { 0.0, 0.02, 0.1 })
  {
    Options options = target(0.9);
    options.growthBudget = budget;
    options.effort = Effort::Quick;
    SimplexMesh<D> mesh = buildMesh(in);
    run<D>(mesh, options);
    EXPECT_LE(mesh.countCells(), (1.0 + budget) * in.cells.size()) << budget;
  }
}

// ---- why it stops --------------------------------------------------------------------------------

TEST(WorstFirst3D, StopsWhereTheSurfaceCaps)
{
  // a cube with one flat corner facet: a point of the surface close to an edge of it
  MeshInput<3> in = jitteredGrid<3>(4, 0.2);
  for (Vec<3>& x : in.points)
  {
    if (x == Vec<3>(0.25, 0.5, 0.0))
    {
      x = Vec<3>(0.02, 0.5, 0.0);
    }
  }
  SimplexMesh<3> mesh = buildMesh(in);
  const Report report = run<3>(mesh, target(0.45));
  EXPECT_LT(report.bound, 0.45);
  EXPECT_LT(report.worstAfter, 0.45);
  if (report.stopReason == StopReason::CappedBySurface)
  {
    EXPECT_GT(report.cappedCells, 0);
    EXPECT_EQ(report.cappedCells, report.history.back().belowTarget);
  }
  EXPECT_NE(report.stopReason, StopReason::TargetReached);
  EXPECT_GT(report.worstAfter, 0.9 * report.bound);
}

TYPED_TEST(WorstFirst, StopsWithoutFurtherGain)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(3, 0.2);
  in.fixedPoints.assign(in.points.size(), 1);
  Options options = target(0.99);
  options.reconnect = options.insertNodes = options.removeNodes = false;
  SimplexMesh<D> mesh = buildMesh(in);
  const MeshBits<D> before = bitsOf(mesh);
  const Report report = run<D>(mesh, options);
  EXPECT_EQ(bitsOf(mesh), before);
  EXPECT_TRUE(report.stopReason == StopReason::NoFurtherGain ||
    report.stopReason == StopReason::CappedBySurface);
}

TYPED_TEST(WorstFirst, CanBeAborted)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  int calls = 0;
  double last = 0.0;
  Control control;
  control.progress = [&](double fraction, const std::string& text)
  {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(text.empty());
    last = fraction;
    return ++calls < 1;
  };
  const Report report = run<D>(mesh, target(0.9), control);
  EXPECT_EQ(report.stopReason, StopReason::Aborted);
  EXPECT_EQ(calls, 1); // not asked again
}

TEST(WorstFirst3D, KeepsItsTimeLimit)
{
  SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(12, 0.25));
  Options options = target(0.95);
  options.timeLimit = 0.2;
  const Report report = run<3>(mesh, options);
  EXPECT_EQ(report.stopReason, StopReason::TimeLimit);
  EXPECT_LT(report.seconds, 10.0); // the machine may be busy
}

// ---- the same again ------------------------------------------------------------------------------

TEST(WorstFirst3D, SameBitsForAnyNumberOfThreads)
{
  const SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(24, 0.25)); // 83 k cells: four chunks
  ASSERT_GE(mesh.countCells(), 80000);
  Options options = target(0.45);
  options.effort = Effort::Quick;
  const auto result = [&](const Control& control, int& parallel)
  {
    SimplexMesh<3> copy = mesh;
    Control counted = control;
    if (control.parallelFor)
    {
      counted.parallelFor = [&](int n, const std::function<void(int)>& body)
      {
        parallel = std::max(parallel, n);
        control.parallelFor(n, body);
      };
    }
    NodalMetric<3> metric;
    const Report report = optimize<3>(copy, metric, options, counted);
    EXPECT_GT(report.worstAfter, 0.3);
    EXPECT_TRUE(copy.audit(true).empty());
    MeshBits<3> bits = bitsOf(copy);
    for (const PassRecord& row : report.history)
    {
      bits.coordinates.push_back(row.worst);
      bits.coordinates.push_back(row.mean);
      bits.ids.push_back(Index(row.cells));
      for (int op = 0; op < NumberOfOperations; ++op)
      {
        bits.ids.push_back(Index(row.tried[op]));
        bits.ids.push_back(Index(row.done[op]));
      }
    }
    return bits;
  };
  int parallel = 0;
  const MeshBits<3> alone = result({}, parallel);
  for (int n : { 1, 2, 3, 4, 8 })
  {
    EXPECT_TRUE(result(threads(n, n > 2 ? n : 0), parallel) == alone) << n << " threads";
  }
  EXPECT_GE(parallel, 4);
}

TYPED_TEST(WorstFirst, SameBitsInTenRuns)
{
  constexpr int D = TypeParam::dimension;
  MeshBits<D> first;
  for (int k = 0; k < 10; ++k)
  {
    SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.35, 7));
    NodalMetric<D> metric;
    optimize<D>(mesh, metric, target(0.5), {});
    if (k == 0)
    {
      first = bitsOf(mesh);
    }
    EXPECT_EQ(bitsOf(mesh), first);
  }
}

TYPED_TEST(WorstFirst, PowersOfTwoScaleBitwise)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(5, 0.3, 3);
  SimplexMesh<D> mesh = buildMesh(in);
  run<D>(mesh, target(0.5));
  for (int exponent : { -20, 7 })
  {
    MeshInput<D> scaled = in;
    for (Vec<D>& x : scaled.points)
    {
      x *= std::ldexp(1.0, exponent);
    }
    SimplexMesh<D> other = buildMesh(scaled);
    NodalMetric<D> metric;
    optimize<D>(other, metric, target(0.5), {});
    MeshBits<D> bits = bitsOf(other);
    for (double& x : bits.coordinates)
    {
      x = std::ldexp(x, -exponent);
    }
    EXPECT_EQ(bits, bitsOf(mesh)) << "2^" << exponent;
  }
}

TYPED_TEST(WorstFirst, RotationRenumberingAndMirroringChangeLittle)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.3, 5);
  const double goal = D == 3 ? 0.5 : 0.7;
  for (int kind = 0; kind < 4; ++kind)
  {
    MeshInput<D> other = in;
    if (kind == 1) // about an axis, by .5
    {
      for (Vec<D>& x : other.points)
      {
        const double a = x[0], b = x[1];
        x[0] = std::cos(0.5) * a - std::sin(0.5) * b;
        x[1] = std::sin(0.5) * a + std::cos(0.5) * b;
      }
    }
    else if (kind == 2)
    {
      const Index n = Index(in.points.size());
      for (Index p = 0; p < n; ++p)
      {
        other.points[n - 1 - p] = in.points[p];
      }
      for (Simplex<D>& cell : other.cells)
      {
        for (Index& p : cell)
        {
          p = n - 1 - p;
        }
      }
      std::reverse(other.cells.begin(), other.cells.end());
    }
    else if (kind == 3)
    {
      for (Vec<D>& x : other.points)
      {
        x[0] = -x[0];
      }
    }
    SimplexMesh<D> mesh = buildMesh(other);
    EXPECT_EQ(mesh.numberOfReorientedCells(), kind == 3 ? Index(in.cells.size()) : 0);
    const Report report = run<D>(mesh, target(goal));
    EXPECT_GE(report.worstAfter, goal - 0.02) << kind;
    EXPECT_LE(report.worstAfter, goal + 0.05) << kind;
  }
}

// ---- sizes and metrics ---------------------------------------------------------------------------

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
      EXPECT_EQ(metric.setConstant(stretch), "");
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
