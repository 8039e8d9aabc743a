// SPDX-License-Identifier: BSD-3-Clause
// Optimization clusters against a search of the whole mesh.
#include "Mesh/Cluster.h"
#include "TestMeshes.h"

#include <map>

using namespace meshopt;

namespace
{
template <class>
class Clusters : public ::testing::Test
{
};
TYPED_TEST_SUITE(Clusters, TestDimensions);

/// How many edges each point is away from the nodes of the cell.
template <int D>
std::vector<int> distances(const SimplexMesh<D>& mesh, Index cell)
{
  constexpr int far = 1000000;
  std::vector<int> distance(mesh.numberOfPointSlots(), far);
  for (Index p : mesh.nodes(cell))
  {
    distance[p] = 0;
  }
  for (bool changes = true; changes;)
  {
    changes = false;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      int least = far;
      for (Index p : mesh.nodes(c))
      {
        least = std::min(least, distance[p]);
      }
      for (Index p : mesh.nodes(c))
      {
        changes = changes || distance[p] > least + 1;
        distance[p] = std::min(distance[p], least + 1);
      }
    }
  }
  return distance;
}

template <int D>
void expectCluster(MeshEditor<D>& editor, ClusterGatherer<D>& gatherer, Index cell, int level,
  const std::vector<std::uint8_t>& movable)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  Cluster<D> cluster;
  gatherer.gather(
    editor, cell, level, [&](Index p) { return movable[p] != 0; }, cluster);
  const std::vector<int> distance = distances<D>(mesh, cell);
  std::set<Index> moving, cells, points;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (distance[p] <= level && movable[p])
    {
      moving.insert(p);
    }
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<D>& n = mesh.nodes(c);
    if (std::any_of(n.begin(), n.end(), [&](Index p) { return moving.count(p) == 1; }))
    {
      cells.insert(c);
      points.insert(n.begin(), n.end());
    }
  }
  ASSERT_EQ(cluster.numberOfMoving, static_cast<int>(moving.size()));
  const auto begin = cluster.points.begin();
  EXPECT_EQ(std::set<Index>(begin, begin + cluster.numberOfMoving), moving);
  EXPECT_EQ(std::set<Index>(begin, cluster.points.end()), points);
  EXPECT_EQ(std::set<Index>(cluster.cells.begin(), cluster.cells.end()), cells);
  EXPECT_EQ(cluster.points.size(), points.size()) << "each point once";
  ASSERT_EQ(cluster.cells.size(), cells.size()) << "each cell once";
  for (int k = 1; k < cluster.numberOfMoving; ++k)
  {
    EXPECT_LE(distance[cluster.points[k - 1]], distance[cluster.points[k]]);
  }
  ASSERT_EQ(cluster.x.size(), cluster.points.size());
  for (std::size_t k = 0; k < cluster.points.size(); ++k)
  {
    EXPECT_EQ(cluster.x[k], mesh.point(cluster.points[k]));
  }
  ASSERT_EQ(cluster.nodes.size(), cells.size());
  ASSERT_EQ(cluster.quality.size(), cells.size());
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    const Index c = cluster.cells[k];
    EXPECT_EQ(cluster.quality[k], mesh.quality(c));
    EXPECT_EQ(cluster.corners(static_cast<int>(k)), mesh.corners(c));
    for (int i = 0; i <= D; ++i)
    {
      EXPECT_EQ(cluster.points[cluster.nodes[k][i]], mesh.nodes(c)[i]);
    }
  }
}
}

TYPED_TEST(Clusters, EqualASearchOfTheWholeMesh)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 2 ? 8 : 4, 0.2));
  MeshEditor<D> editor(mesh);
  TestRandom random(1);
  std::vector<std::uint8_t> free, some;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    free.push_back(mesh.isFree(p));
    some.push_back(random() > 0.3);
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    editor.setQuality(c, random());
  }
  ClusterGatherer<D> gatherer; // its scratch is used again and again
  for (int level = 0; level <= 3; ++level)
  {
    for (Index c = 0; c < mesh.numberOfCellSlots(); c += 5)
    {
      expectCluster<D>(editor, gatherer, c, level, free);
      expectCluster<D>(editor, gatherer, c, level, some);
    }
  }
}

TYPED_TEST(Clusters, NothingMovesNothingIsThere)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  MeshEditor<D> editor(mesh);
  ClusterGatherer<D> gatherer;
  Cluster<D> cluster;
  gatherer.gather(
    editor, 0, 1, [](Index) { return true; }, cluster);
  EXPECT_FALSE(cluster.cells.empty());
  gatherer.gather(
    editor, 0, 1, [](Index) { return false; }, cluster);
  EXPECT_EQ(cluster.numberOfMoving, 0);
  EXPECT_TRUE(cluster.cells.empty());
  EXPECT_TRUE(cluster.points.empty());
  EXPECT_EQ(cluster.meanEdge(), 0.0);
}

TYPED_TEST(Clusters, MeanEdgeCountsAnEdgeOncePerCell)
{
  constexpr int D = TypeParam::dimension;
  Cluster<D> cluster;
  double wanted = 0.0;
  for (const Simplex<D>& cell : jitteredGrid<D>(2, 0.3).cells)
  {
    cluster.nodes.push_back(cell);
  }
  cluster.x = jitteredGrid<D>(2, 0.3).points;
  int count = 0;
  for (const Simplex<D>& cell : cluster.nodes)
  {
    for (int i = 0; i <= D; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        wanted += (cluster.x[cell[i]] - cluster.x[cell[j]]).norm();
        ++count;
      }
    }
  }
  EXPECT_NEAR(cluster.meanEdge(), wanted / count, 1e-14);
}

TYPED_TEST(Clusters, AmidPointsIsInTheBoxOfTheOthers)
{
  constexpr int D = TypeParam::dimension;
  Cluster<D> cluster;
  cluster.numberOfMoving = 2;
  cluster.x = { Vec<D>::Constant(0.5), Vec<D>::Constant(0.9), Vec<D>::Zero(), Vec<D>::Ones() };
  EXPECT_TRUE(cluster.isAmidPoints());
  for (int moving : { 0, 1 })
  {
    for (int d = 0; d < D; ++d)
    {
      for (double out : { -0.01, 1.01 })
      {
        Cluster<D> other = cluster;
        other.x[moving][d] = out;
        EXPECT_FALSE(other.isAmidPoints());
      }
    }
  }
}
