// SPDX-License-Identifier: BSD-3-Clause
// One cluster of a mesh is solved: nodes move if that is a gain, or the mesh is as it was.
#include "Paper1996/ClusterSolver.h"
#include "MeshSnapshot.h"
#include "Run/Run.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <class>
class ClusterSolvers : public ::testing::Test
{
};
TYPED_TEST_SUITE(ClusterSolvers, TestDimensions);

template <int D>
using Shape = MeanEdgeShape<D>;

template <int D>
struct Scene
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  double beta;
  QualityModel<D, Shape<D>> model;
  Switches switches;
  Judge<D, Shape<D>> judge;
  std::vector<std::uint8_t> movable;

  explicit Scene(const MeshInput<D>& in, double width = 0.0,
    const std::function<double(const Vec<D>&)>& size = {})
    : mesh(buildMesh(in))
    , editor(this->mesh)
    , beta(width)
    , model(this->mesh, sized(this->metric, this->mesh, size), width)
    , judge(this->editor, this->model, this->switches)
  {
    computeQualities<D>(this->editor, this->metric, Measure::Shape, width);
    for (Index p = 0; p < this->mesh.numberOfPointSlots(); ++p)
    {
      this->movable.push_back(this->mesh.isFree(p));
    }
  }

  bool solve(Index cell, int level, double leastGain = 1e-3, double epsilon = 0.02)
  {
    LocalParameters parameters;
    parameters.epsilon = epsilon;
    this->solver = std::make_unique<ClusterSolver<D, Shape<D>>>(this->judge, parameters, leastGain);
    return this->solver->solve(cell, level, this->movable);
  }
  std::unique_ptr<ClusterSolver<D, Shape<D>>> solver;

private:
  static NodalMetric<D>& sized(NodalMetric<D>& metric, const SimplexMesh<D>& mesh,
    const std::function<double(const Vec<D>&)>& size)
  {
    std::vector<double> sizes;
    for (Index p = 0; p < mesh.numberOfPointSlots() && size; ++p)
    {
      sizes.push_back(size(mesh.point(p)));
    }
    EXPECT_EQ(metric.set(mesh, sizes, {}), "");
    return metric;
  }
};

double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

/// The S of the cells of star<D>() whose node is in the middle.
template <int D>
double bestOfStar()
{
  const double sum = 3.0 + 3.0 * std::sqrt(2.0);
  return D == 2 ? 1.0 : 1296.0 * std::sqrt(2.0) / 6.0 / (sum * sum * sum);
}
}

TYPED_TEST(ClusterSolvers, PutsTheNodeOfAStarInTheMiddle)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0] = Vec<D>::Constant(0.2);
  Scene<D> s(in);
  const std::vector<double> before = sortedQualities(s.mesh);
  ASSERT_TRUE(s.solve(0, 0, 1e-3, 1e-4));
  EXPECT_LT(s.mesh.point(0).norm(), 2e-2);
  EXPECT_NEAR(sortedQualities(s.mesh).front(), bestOfStar<D>(), 2e-3);
  EXPECT_EQ(sorted(s.judge.changed()), sorted(s.solver->cluster().cells));
  std::vector<double> old = s.solver->oldQuality();
  std::sort(old.begin(), old.end());
  EXPECT_EQ(old, before);
  expectSound(s.mesh);
}

/// Of each cell of a mesh, with neighbours of order 0 and 1.
TYPED_TEST(ClusterSolvers, RaisesTheWorstOfTheClusterOrChangesNothing)
{
  constexpr int D = TypeParam::dimension;
  constexpr double gain = 1e-3;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 6 : 3, 0.2, 8));
  int solved = 0, left = 0;
  for (int level : { 0, 1 })
  {
    for (Index c = 0; c < s.mesh.numberOfCellSlots(); ++c)
    {
      const Snapshot<D> bits(s.editor);
      std::vector<double> before(s.mesh.numberOfCellSlots());
      for (Index k = 0; k < s.mesh.numberOfCellSlots(); ++k)
      {
        before[k] = s.mesh.quality(k);
      }
      const bool done = s.solve(c, level, gain);
      EXPECT_FALSE(s.editor.inTransaction());
      if (!done)
      {
        ++left;
        EXPECT_TRUE(Snapshot<D>(s.editor) == bits);
        continue;
      }
      ++solved;
      // The cells of the cluster are all those with a node near to the cell that moves.
      const Cluster<D>& cluster = s.solver->cluster();
      const std::set<Index> cells(cluster.cells.begin(), cluster.cells.end());
      for (Index k = 0; k < s.mesh.numberOfCellSlots(); ++k)
      {
        EXPECT_EQ(s.mesh.quality(k), Shape<D>::value(s.mesh.corners(k)));
        EXPECT_TRUE(cells.count(k) == 1 || s.mesh.quality(k) == before[k]);
      }
      for (std::size_t k = 0; k < cluster.cells.size(); ++k)
      {
        EXPECT_EQ(s.solver->oldQuality()[k], before[cluster.cells[k]]);
        EXPECT_EQ(cluster.quality[k], s.mesh.quality(cluster.cells[k]));
      }
      const double old = least(s.solver->oldQuality());
      EXPECT_GT(least(cluster.quality), old + gain * std::abs(old));
    }
  }
  EXPECT_GT(solved, 20);
  EXPECT_GT(left, 20);
  expectSound(s.mesh);
}

TYPED_TEST(ClusterSolvers, AGainThatIsTooSmallIsNotTaken)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0] = Vec<D>::Constant(0.2);
  Scene<D> s(in);
  const double before = sortedQualities(s.mesh).front();
  const double possible = bestOfStar<D>() / before - 1.0;
  const MeshBits<D> bits = bitsOf(s.mesh);
  EXPECT_FALSE(s.solve(0, 0, possible * 1.01, 1e-4));
  EXPECT_EQ(bitsOf(s.mesh), bits);
  EXPECT_TRUE(s.judge.changed().empty());
  EXPECT_TRUE(s.solve(0, 0, possible * 0.95, 1e-4));
}

TYPED_TEST(ClusterSolvers, OnlyNodesThatMayMoveDo)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 6 : 4, 0.25, 3));
  std::vector<Vec<D>> before;
  for (Index p = 0; p < s.mesh.numberOfPointSlots(); ++p)
  {
    before.push_back(s.mesh.point(p));
    s.movable[p] = s.movable[p] && p % 2 == 0;
  }
  int moved = 0;
  for (Index c = 0; c < s.mesh.numberOfCellSlots(); ++c)
  {
    s.solve(c, 1);
  }
  for (Index p = 0; p < s.mesh.numberOfPointSlots(); ++p)
  {
    EXPECT_TRUE(s.movable[p] || s.mesh.point(p) == before[p]);
    moved += s.mesh.point(p) != before[p];
  }
  EXPECT_GT(moved, 2);
  std::fill(s.movable.begin(), s.movable.end(), 0);
  EXPECT_FALSE(s.solve(0, 1));
  EXPECT_TRUE(s.solver->cluster().cells.empty());
}

/// In a field of sizes that varies it is asked at the new places: qualities are those of the mesh
/// as it is, not of the metric that was frozen.
TYPED_TEST(ClusterSolvers, SizesAreSampledWhereNodesHaveGone)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 6 : 3, 0.25, 8), 0.5,
    [](const Vec<D>& x) { return 0.1 + 0.3 * x[0] * x[0]; });
  const FollowedMetric<D> follows(s.editor, s.metric);
  int solved = 0;
  for (Index c = 0; c < s.mesh.numberOfCellSlots(); ++c)
  {
    const double worst = sortedQualities(s.mesh).front();
    if (!s.solve(c, 1))
    {
      continue;
    }
    ++solved;
    EXPECT_GE(sortedQualities(s.mesh).front(), worst);
    NodalMetric<D> again = s.metric;
    SimplexMesh<D> copy = s.mesh;
    MeshEditor<D> editor(copy);
    for (Index p = 0; p < copy.numberOfPointSlots(); ++p)
    {
      again.resample(p, copy.point(p));
    }
    computeQualities<D>(editor, again, Measure::Shape, s.beta);
    for (Index k = 0; k < copy.numberOfCellSlots(); ++k)
    {
      EXPECT_NEAR(copy.quality(k), s.mesh.quality(k), 1e-12);
    }
  }
  EXPECT_GT(solved, 3);
}

TEST(ClusterSolver, AnInvertedStarIsUntangled)
{
  MeshInput<3> in = star<3>();
  in.points[0] = Vec<3>(0.7, 0.6, 0.1);
  Scene<3> s(in);
  EXPECT_LT(sortedQualities(s.mesh).front(), 0.0);
  EXPECT_TRUE(s.solve(0, 0));
  expectSound(s.mesh);
  EXPECT_GT(sortedQualities(s.mesh).front(), 0.5);
}
