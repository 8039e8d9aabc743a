// SPDX-License-Identifier: BSD-3-Clause
// What every run promises, whatever the algorithm, the effort and the measure; and the order of its
// stages.
#include "Optimize/Optimizer.h"

#include "Run/Summary.h"
#include "TestMeshes.h"

#include <numeric>

using namespace meshopt;

template <class T>
class OptimizerOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(OptimizerOf, TestDimensions);

namespace
{
/// Each algorithm; of the engine each effort.
std::vector<Options> allWays(double target)
{
  std::vector<Options> all(4);
  all[0].algorithm = Algorithm::Paper1996;
  for (int effort = 0; effort < 3; ++effort)
  {
    all[1 + effort].effort = static_cast<Effort>(effort);
  }
  for (Options& options : all)
  {
    options.targetQuality = target;
  }
  return all;
}

/// Two regions, and some free nodes that must stay.
template <int D>
MeshInput<D> restricted(double jitter, unsigned seed)
{
  MeshInput<D> in = jitteredGrid<D>(D == 3 ? 3 : 6, jitter, seed);
  splitRegions(in);
  in.fixedPoints.assign(in.points.size(), 0);
  for (std::size_t p = seed; p < in.points.size(); p += 7)
  {
    in.fixedPoints[p] = 1;
  }
  return in;
}

template <int D>
std::vector<double> qualitiesOf(SimplexMesh<D> mesh, Measure measure)
{
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, NodalMetric<D>(), measure, 0.0);
  return sortedQualities(mesh);
}

/// Does the row say how the cells of the mesh are?
template <int D>
void expectRow(const PassRecord& row, const SimplexMesh<D>& mesh, const std::vector<double>& sorted,
  double target)
{
  EXPECT_EQ(row.cells, static_cast<long>(sorted.size()));
  EXPECT_EQ(row.points, mesh.countPoints());
  EXPECT_NEAR(row.worst, sorted.front(), 1e-12);
  double sum = 0.0;
  long below = 0;
  for (double q : sorted)
  {
    sum += q;
    below += q < target;
  }
  EXPECT_NEAR(row.mean, sum / static_cast<double>(sorted.size()), 1e-12);
  EXPECT_EQ(row.belowTarget, below);
}

template <int D>
long countOf(const Report& report, const std::string& stage)
{
  return std::count_if(report.history.begin(), report.history.end(),
    [&](const PassRecord& row) { return row.stage == stage; });
}
}

/// The worst never falls, no cell is inverted, what is kept stays to the bit; and the report tells
/// of the mesh before and after.
TYPED_TEST(OptimizerOf, KeepsItsPromises)
{
  constexpr int D = TypeParam::dimension;
  for (int measure = 0; measure < numberOfMeasures(); ++measure)
  {
    if (!infoOf(static_cast<Measure>(measure)).isOptimizable)
    {
      continue;
    }
    for (const double jitter : { 0.3, 0.7 }) // the latter is tangled
    {
      const MeshInput<D> in = restricted<D>(jitter, static_cast<unsigned>(measure));
      for (Options options : allWays(0.3))
      {
        options.measure = static_cast<Measure>(measure);
        if (options.effort == Effort::Best && options.measure != Measure::Shape)
        {
          continue; // takes long
        }
        SCOPED_TRACE(std::string(infoOf(options.measure).name) + ", jitter " +
          std::to_string(jitter) + ", algorithm " + std::to_string(int(options.algorithm)) +
          ", effort " + std::to_string(int(options.effort)));
        ASSERT_EQ(options.check(false), "");
        SimplexMesh<D> mesh = buildMesh(in);
        const std::vector<double> before = qualitiesOf(mesh, options.measure);
        const auto kept = keptFacets(mesh);
        const SimplexMesh<D> input = mesh;
        NodalMetric<D> metric;
        const Report report = optimize<D>(mesh, metric, options, {});
        const std::vector<double> after = qualitiesOf(mesh, options.measure);

        EXPECT_GE(after.front(), before.front());
        const auto inverted = [](const std::vector<double>& sorted)
        { return std::upper_bound(sorted.begin(), sorted.end(), 0.0) - sorted.begin(); };
        EXPECT_LE(inverted(after), inverted(before));
        EXPECT_TRUE(keptFacets(mesh) == kept);
        for (std::size_t p = 0; p < in.points.size(); ++p)
        {
          EXPECT_TRUE(!in.fixedPoints[p] ||
            (mesh.isPointAlive(static_cast<Index>(p)) &&
              mesh.point(static_cast<Index>(p)) == in.points[p]))
            << "point " << p;
        }

        EXPECT_EQ(report.worstBefore, before.front());
        EXPECT_NEAR(report.worstAfter, after.front(), 1e-12);
        EXPECT_EQ(report.invertedBefore, inverted(before));
        EXPECT_EQ(report.invertedAfter, inverted(after));
        EXPECT_EQ(report.history.front().stage, "input");
        expectRow(report.history.front(), input, before, options.targetQuality);
        expectRow(report.history.back(), mesh, after, options.targetQuality);
        for (std::size_t k = 1; k < report.history.size(); ++k)
        {
          EXPECT_EQ(report.history[k].pass, static_cast<int>(k));
          EXPECT_GE(report.history[k].worst, report.history[k - 1].worst);
        }
        EXPECT_LE(report.worstAfter, report.bound + 1e-12);
        EXPECT_EQ(report.meanBefore, report.history.front().mean);
        EXPECT_EQ(report.meanAfter, report.history.back().mean);
        EXPECT_EQ(report.sizes.predictedCells, 0.0);

        EXPECT_NE(report.stopReason, StopReason::NotRun);
        EXPECT_NE(report.stopReason, StopReason::NothingToDo);
        // No limits of iterations and time: there is none to be named.
        EXPECT_NE(report.stopReason, StopReason::TimeLimit);
        EXPECT_NE(report.stopReason, StopReason::Aborted);
        EXPECT_TRUE(
          report.stopReason != StopReason::TargetReached || after.front() >= options.targetQuality);
        EXPECT_TRUE(options.effort == Effort::Best || after.front() < options.targetQuality ||
          report.stopReason == StopReason::TargetReached);
        EXPECT_TRUE(report.stopReason != StopReason::CappedBySurface || report.cappedCells > 0);
      }
    }
  }
}

TYPED_TEST(OptimizerOf, WithoutCellsThereIsNothingToDo)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in;
  in.points.push_back(Vec<D>::Zero()); // points alone are no mesh
  const SimplexMesh<D> none, points = buildMesh(in);
  for (const SimplexMesh<D>& input : { none, points, buildMesh(MeshInput<D>()) })
  {
    for (const Options& options : allWays(0.6))
    {
      SimplexMesh<D> mesh = input;
      NodalMetric<D> metric;
      const Report report = optimize<D>(mesh, metric, options, {});
      EXPECT_EQ(report.stopReason, StopReason::NothingToDo);
      EXPECT_EQ(report.history.size(), 1u);
      EXPECT_EQ(report.worstBefore, 0.0); // numbers that can be shown
      EXPECT_EQ(report.worstAfter, 0.0);
      EXPECT_EQ(report.meanAfter, 0.0);
    }
  }
}

/// Inverted cells are untangled before all else, in one row. A cell that is only flat is left to
/// the engine.
TYPED_TEST(OptimizerOf, UntanglesFirst)
{
  constexpr int D = TypeParam::dimension;
  Options options;
  options.targetQuality = 0.3;
  const auto reportOf = [&](const MeshInput<D>& in)
  {
    SimplexMesh<D> mesh = buildMesh(in);
    NodalMetric<D> metric;
    return optimize<D>(mesh, metric, options, {});
  };
  const Report tangled = reportOf(jitteredGrid<D>(D == 3 ? 4 : 8, 0.7));
  ASSERT_LT(tangled.worstBefore, 0.0);
  EXPECT_EQ(tangled.history[1].stage, "untangling");
  EXPECT_EQ(countOf<D>(tangled, "untangling"), 1);
  EXPECT_GT(tangled.history[1].worst, 0.0);
  const auto& done = tangled.history[1].done;
  EXPECT_GT(std::accumulate(done.begin(), done.end(), 0L), 0); // the work of all its passes
  EXPECT_EQ(countOf<D>(reportOf(jitteredGrid<D>(4, 0.2)), "untangling"), 0);

  // A node in the middle of the facet opposite to it. The cells around a node of the grid fill a
  // convex body, so no other one is inverted.
  MeshInput<D> flat = jitteredGrid<D>(4, 0.0);
  const SimplexMesh<D> grid = buildMesh(flat);
  for (Index c = 0; c < grid.numberOfCellSlots(); ++c)
  {
    const Index p = grid.nodes(c)[0];
    if (grid.isFree(p))
    {
      Vec<D> middle = Vec<D>::Zero();
      for (Index q : grid.facet(c, 0))
      {
        middle += grid.point(q) / D;
      }
      flat.points[p] = middle;
      break;
    }
  }
  const Report report = reportOf(flat);
  EXPECT_NEAR(report.worstBefore, 0.0, 1e-12);
  EXPECT_EQ(countOf<D>(report, "untangling"), 0);
  EXPECT_GE(report.worstAfter, options.targetQuality);
}

/// If time is over in the midst of untangling, nothing comes after it.
TYPED_TEST(OptimizerOf, EndsWithUntanglingIfItIsStoppedThere)
{
  constexpr int D = TypeParam::dimension;
  Control control;
  control.progress = [](double, const std::string&) { return false; };
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 4 : 8, 0.7));
  const MeshBits<D> before = bitsOf(mesh);
  NodalMetric<D> metric;
  const Report report = optimize<D>(mesh, metric, Options(), control);
  EXPECT_EQ(report.stopReason, StopReason::Aborted);
  EXPECT_EQ(report.history.back().stage, "untangling");
  EXPECT_EQ(report.history.size(), 2u);
  EXPECT_EQ(bitsOf(mesh), before);
}

/// The budget is the engine's: the paper has none.
TYPED_TEST(OptimizerOf, ThePaperKnowsNoBudget)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 3 ? 4 : 8, 0.35);
  std::vector<MeshBits<D>> bits;
  for (const double budget : { 0.0, 10.0 })
  {
    Options options;
    options.algorithm = Algorithm::Paper1996;
    options.growthBudget = budget;
    options.targetQuality = D == 3 ? 0.4 : 0.7;
    SimplexMesh<D> mesh = buildMesh(in);
    NodalMetric<D> metric;
    optimize<D>(mesh, metric, options, {});
    bits.push_back(bitsOf(mesh));
  }
  EXPECT_EQ(bits[0], bits[1]);
}
