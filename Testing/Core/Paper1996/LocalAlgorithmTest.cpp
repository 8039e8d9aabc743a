// SPDX-License-Identifier: BSD-3-Clause
// The local algorithm on clusters whose optimum is known.
#include "Paper1996/LocalAlgorithm.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
LocalResult solve(Cluster<D>& cluster, double epsilon = 0.02)
{
  LocalParameters parameters;
  parameters.epsilon = epsilon;
  LocalAlgorithm<D, MeanEdgeShape<D>> local({ 0.0 }, parameters);
  return local.solve(cluster, { ElementMetric<D>{} });
}

// S is quasi-concave in one node: from every start the centre is found.
template <int D>
void centreFromAnywhere(double optimum)
{
  forStarsOffCentre<D>(
    [&](Cluster<D>& cluster)
    {
      const LocalResult result = solve(cluster, 1e-4);
      EXPECT_GE(result.after, result.before);
      EXPECT_NEAR(result.after, optimum, 2e-3);
      EXPECT_LT(cluster.x[0].norm(), 2e-2);
    });
}
}

TEST(LocalAlgorithm, FindsTheCentreOfAHexagon) { centreFromAnywhere<2>(1.0); }

TEST(LocalAlgorithm, FindsTheCentreOfAnOctahedron)
{
  const double p = 3.0 + 3.0 * std::sqrt(2.0);
  centreFromAnywhere<3>(1296.0 * std::sqrt(2.0) / 6.0 / (p * p * p));
}

TEST(LocalAlgorithm, PutsAnOutsideNodeBack)
{
  MeshInput<3> in = star<3>();
  in.points[0] = Vec<3>(0.7, 0.6, 0.1); // outside: some cells are inverted
  SimplexMesh<3> mesh;
  ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
  Cluster<3> cluster = clusterOf(mesh, 0, 0);
  const LocalResult result = solve(cluster);
  EXPECT_LT(result.before, 0.0);
  EXPECT_GT(result.after, 0.5);
}

TEST(LocalAlgorithm, NothingWorseAndQualitiesTrue)
{
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(4, 0.3, seed));
    Cluster<3> cluster = clusterOf(mesh, 6 * 21, 1);
    EXPECT_GT(cluster.numberOfMoving, 8);
    const EvaluationCount count;
    const LocalResult result = solve(cluster);
    EXPECT_GT(result.after, result.before);
    EXPECT_GE(count.get(), 2 * result.iterations) << "each step a gradient and a value";
    const ElementQuality<3, MeanEdgeShape<3>> quality{ 0.0 };
    double worst = 1.0;
    for (std::size_t k = 0; k < cluster.cells.size(); ++k)
    {
      const Corners<3> x = cluster.corners(static_cast<int>(k));
      EXPECT_EQ(cluster.quality[k], quality.value(x, ElementMetric<3>{}));
      worst = std::min(worst, cluster.quality[k]);
    }
    EXPECT_EQ(worst, result.after);
  }
}

TEST(LocalAlgorithm, StationaryAtTheOptimum)
{
  SimplexMesh<2> mesh = buildMesh(star<2>());
  Cluster<2> cluster = clusterOf(mesh, 0, 0);
  const LocalResult result = solve(cluster);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.after, result.before);
}

TEST(ClusterGatherer, NeighbourhoodsGrowByLevel)
{
  SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(6, 0.1));
  const Index cell = 6 * (3 * 36 + 3 * 6 + 3);
  const Cluster<3> zero = clusterOf(mesh, cell, 0), one = clusterOf(mesh, cell, 1);
  EXPECT_EQ(zero.numberOfMoving, 4);
  EXPECT_GT(one.numberOfMoving, 20);
  EXPECT_EQ(std::set<Index>(one.cells.begin(), one.cells.end()).size(), one.cells.size());
  for (const Simplex<3>& nodes : one.nodes) // every cell has a moving node
  {
    EXPECT_LT(*std::min_element(nodes.begin(), nodes.end()), one.numberOfMoving);
  }
}
