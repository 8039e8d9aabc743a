// SPDX-License-Identifier: BSD-3-Clause
// Several nodes moved at once: known optima, and what single nodes cannot reach.
#include "Reposition/ClusterProblem.h"
#include "Paper1996/LocalAlgorithm.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
using Problem = ClusterProblem<D, MeanEdgeShape<D>>;

template <int D>
double maximize(Cluster<D>& cluster, double gain = 1e-6)
{
  Problem<D> problem;
  const double before = *std::min_element(cluster.quality.begin(), cluster.quality.end());
  const double worst = problem.maximize(
    cluster, { 0.0 }, { ElementMetric<D>{} }, { 1.0, gain, 200 });
  EXPECT_GE(worst, before);
  const ElementQuality<D, MeanEdgeShape<D>> quality{ 0.0 };
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    const Corners<D> x = cluster.corners(static_cast<int>(k));
    EXPECT_EQ(cluster.quality[k], quality.value(x, ElementMetric<D>{}));
    EXPECT_GE(cluster.quality[k], worst);
  }
  return worst;
}

template <int D>
double worstAt(const Cluster<D>& cluster, const std::vector<Vec<D>>& x)
{
  double worst = 1.0;
  for (const Simplex<D>& nodes : cluster.nodes)
  {
    Corners<D> c;
    for (int i = 0; i <= D; ++i)
    {
      c[i] = x[nodes[i]];
    }
    worst = std::min(worst, MeanEdgeShape<D>::value(c));
  }
  return worst;
}

template <int D>
void centreFromAnywhere(double optimum)
{
  forStarsOffCentre<D>(
    [&](Cluster<D>& cluster)
    {
      EXPECT_NEAR(maximize(cluster), optimum, 1e-5);
      EXPECT_LT(cluster.x[0].norm(), 1e-3);
    });
}
}

TEST(ClusterProblem, FindsTheCentreOfAHexagon) { centreFromAnywhere<2>(1.0); }

TEST(ClusterProblem, FindsTheCentreOfAnOctahedron)
{
  const double p = 3.0 + 3.0 * std::sqrt(2.0);
  centreFromAnywhere<3>(1296.0 * std::sqrt(2.0) / 6.0 / (p * p * p));
}

TEST(ClusterProblem, PutsAnOutsideNodeBack)
{
  MeshInput<3> in = star<3>();
  in.points[0] = Vec<3>(0.7, 0.6, 0.1); // outside: some cells are inverted
  SimplexMesh<3> mesh;
  ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
  Cluster<3> cluster = clusterOf(mesh, 0, 0);
  EXPECT_GT(maximize(cluster), 0.5);
}

// Where it stops no small step of all nodes, in any of many directions, gains more than rounding
// and tolerance; and it never ends below the paper's algorithm.
TEST(ClusterProblem, EndsWhereNoSmallStepGains)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(4, 0.3, seed));
    Cluster<3> cluster = clusterOf(mesh, 6 * 21, 1), same = cluster;
    ASSERT_GT(cluster.numberOfMoving, 8);
    const double worst = maximize(cluster);
    LocalAlgorithm<3, MeanEdgeShape<3>> paper({ 0.0 }, LocalParameters{});
    EXPECT_GE(worst, paper.solve(same, { ElementMetric<3>{} }).after - 1e-4);
    TestRandom random(seed);
    for (int trial = 0; trial < 2000; ++trial)
    {
      std::vector<Vec<3>> x = cluster.x;
      for (int k = 0; k < cluster.numberOfMoving; ++k)
      {
        x[k] += 1e-3 * Vec<3>(random(), random(), random());
      }
      EXPECT_LT(worstAt(cluster, x), worst + 1e-4);
    }
  }
}

// One node after the other, each to its best place, until none gains enough: then all at once.
TEST(ClusterProblem, GoesOnWhereSingleNodesStop)
{
  constexpr double Gain = 1e-3; // least gain of a move
  int further = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(4, 0.3, seed));
    Cluster<3> cluster = clusterOf(mesh, 6 * 21, 1);
    const double before = worstAt(cluster, cluster.x);
    for (bool any = true; any;)
    {
      any = false;
      for (int p = 0; p < cluster.numberOfMoving; ++p)
      {
        Cluster<3> one; // the node p and its cells
        one.numberOfMoving = 1;
        std::vector<int> cells;
        one.x = cluster.x;
        std::swap(one.x[0], one.x[p]);
        for (std::size_t k = 0; k < cluster.cells.size(); ++k)
        {
          Simplex<3> nodes = cluster.nodes[k];
          if (std::find(nodes.begin(), nodes.end(), p) == nodes.end())
          {
            continue;
          }
          for (Index& n : nodes)
          {
            n = n == p ? 0 : n == 0 ? p : n;
          }
          cells.push_back(static_cast<int>(k));
          one.cells.push_back(cluster.cells[k]);
          one.nodes.push_back(nodes);
          one.quality.push_back(cluster.quality[k]);
        }
        const double old = *std::min_element(one.quality.begin(), one.quality.end());
        if (maximize(one, Gain) > old + Gain)
        {
          any = true;
          cluster.x[p] = one.x[0];
          for (std::size_t k = 0; k < cells.size(); ++k)
          {
            cluster.quality[cells[k]] = one.quality[k];
          }
        }
      }
    }
    const double single = worstAt(cluster, cluster.x), joint = maximize(cluster);
    EXPECT_GT(single, before);
    EXPECT_GE(joint, single);
    further += joint > single + Gain;
  }
  EXPECT_GE(further, 3);
}

// Each cell in its own metric; what is enough is not gone past by much more than one step.
TEST(ClusterProblem, MetricsAndEnough)
{
  SimplexMesh<2> mesh = buildMesh(jitteredGrid<2>(6, 0.3, 3));
  Cluster<2> cluster = clusterOf(mesh, 2 * 21, 1);
  const ElementQuality<2, MeanEdgeShape<2>> quality{ 1.0 };
  std::vector<ElementMetric<2>> metrics(cluster.cells.size());
  for (std::size_t k = 0; k < metrics.size(); ++k)
  {
    metrics[k].euclidean = false;
    metrics[k].map << 1.0 + 0.02 * static_cast<double>(k), 0.1, 0.1, 1.0;
    metrics[k].desiredSize = 0.3;
    cluster.quality[k] = quality.value(cluster.corners(static_cast<int>(k)), metrics[k]);
  }
  const double before = *std::min_element(cluster.quality.begin(), cluster.quality.end());
  Cluster<2> half = cluster;
  Problem<2> problem;
  const double worst = problem.maximize(cluster, quality, metrics, { 1.0, 1e-6, 200 });
  EXPECT_GT(worst, before + 0.05);
  for (std::size_t k = 0; k < metrics.size(); ++k)
  {
    EXPECT_EQ(cluster.quality[k], quality.value(cluster.corners(static_cast<int>(k)), metrics[k]));
  }
  const double enough = 0.5 * (before + worst);
  const double reached = problem.maximize(half, quality, metrics, { enough, 1e-6, 200 });
  EXPECT_GE(reached, enough);
  EXPECT_LE(reached, worst + 1e-3);
}
