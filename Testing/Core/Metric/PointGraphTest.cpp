// SPDX-License-Identifier: BSD-3-Clause
// Which points share an edge, against a set of all pairs.
#include "Metric/PointGraph.h"
#include "Mesh/MeshEditor.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class PointGraphOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(PointGraphOf, TestDimensions);

template <int D>
void expectAllPairs(const SimplexMesh<D>& mesh)
{
  std::vector<std::set<Index>> wanted(mesh.numberOfPointSlots());
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (Index p : mesh.nodes(c))
    {
      for (Index q : mesh.nodes(c))
      {
        if (mesh.isAlive(c) && p != q)
        {
          wanted[p].insert(q);
        }
      }
    }
  }
  const PointGraph graph = PointGraph::of<D>(mesh);
  ASSERT_EQ(graph.numberOfPoints(), mesh.numberOfPointSlots());
  ASSERT_EQ(graph.first.back(), static_cast<Index>(graph.ids.size()));
  for (Index p = 0; p < graph.numberOfPoints(); ++p)
  {
    const std::vector<Index> found(
      graph.ids.begin() + graph.first[p], graph.ids.begin() + graph.first[p + 1]);
    EXPECT_EQ(found, std::vector<Index>(wanted[p].begin(), wanted[p].end())) << p; // ascending
  }
}
}

TYPED_TEST(PointGraphOf, NeighboursAreThoseOfAllPairs)
{
  constexpr int D = TypeParam::dimension;
  expectAllPairs<D>(buildMesh(oneCell<D>()));
  expectAllPairs<D>(buildMesh(jitteredGrid<D>(4, 0.2)));
}

TYPED_TEST(PointGraphOf, PointsWithoutCellsHaveNone)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(2, 0.1);
  in.points.insert(in.points.begin(), Vec<D>(Vec<D>::Constant(7.0))); // point 0, and the last one
  in.points.push_back(Vec<D>(Vec<D>::Constant(8.0)));
  for (Simplex<D>& c : in.cells)
  {
    for (Index& p : c)
    {
      ++p;
    }
  }
  const SimplexMesh<D> mesh = buildMesh(in);
  expectAllPairs<D>(mesh);
  const PointGraph graph = PointGraph::of<D>(mesh);
  EXPECT_EQ(graph.first[1], 0);
  EXPECT_EQ(graph.first[mesh.numberOfPointSlots() - 1], graph.first.back());
}

/// Cells that have gone have no edges: four tetrahedra around one edge become four around another.
TEST(PointGraph, OfLiveCellsOnly)
{
  SimplexMesh<3> mesh = buildMesh(ringOf(4));
  MeshEditor<3> editor(mesh);
  expectAllPairs<3>(mesh);
  const std::vector<Simplex<3>> cells{ { 2, 3, 4, 1 }, { 2, 4, 5, 1 }, { 3, 2, 4, 0 },
    { 4, 2, 5, 0 } };
  ASSERT_TRUE(editor.replace({ 0, 1, 2, 3 }, cells, { 1, 1, 1, 1 }));
  expectSound(mesh);
  expectAllPairs<3>(mesh);
  const PointGraph graph = PointGraph::of<3>(mesh);
  EXPECT_EQ(graph.first[1] - graph.first[0], 4); // not 1 any more
  EXPECT_EQ(graph.first[3] - graph.first[2], 5);
}
