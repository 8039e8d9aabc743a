// SPDX-License-Identifier: BSD-3-Clause
// Clusters for tests of node motion.
#ifndef meshopt_Testing_TestClusters_h
#define meshopt_Testing_TestClusters_h

#include "Mesh/Cluster.h"
#include "Quality/ElementQuality.h"
#include "TestMeshes.h"

namespace meshopt
{
// One free node, joined to the edges of a regular hexagon or to the faces of a regular octahedron.
template <int D>
MeshInput<D> star();

template <>
inline MeshInput<2> star<2>()
{
  MeshInput<2> in;
  in.points.emplace_back(0.0, 0.0);
  for (int k = 0; k < 6; ++k)
  {
    in.points.emplace_back(std::cos(k * M_PI / 3.0), std::sin(k * M_PI / 3.0));
    in.cells.push_back({ 0, 1 + k, 1 + (k + 1) % 6 });
  }
  return in;
}

template <>
inline MeshInput<3> star<3>()
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  for (int x : { 1, 2 })
  {
    for (int y : { 3, 4 })
    {
      for (int z : { 5, 6 })
      {
        const bool even = (x == 1) == ((y == 3) == (z == 5));
        in.cells.push_back(even ? Simplex<3>{ 0, x, y, z } : Simplex<3>{ 0, x, z, y });
      }
    }
  }
  return in;
}

template <int D>
Cluster<D> clusterOf(SimplexMesh<D>& mesh, Index cell, int level)
{
  MeshEditor<D> editor(mesh);
  const ElementQuality<D, MeanEdgeShape<D>> quality{ 0.0 };
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    editor.setQuality(c, quality.value(mesh.corners(c), ElementMetric<D>{}));
  }
  ClusterGatherer<D> gatherer;
  Cluster<D> cluster;
  gatherer.gather(
    editor, cell, level, [&](Index p) { return mesh.isFree(p); }, cluster);
  return cluster;
}

/// Calls check(cluster) for 50 such stars whose free node is somewhere inside; afterwards all other
/// nodes have to be where they were.
template <int D, class Check>
void forStarsOffCentre(Check&& check)
{
  TestRandom random(5);
  for (int run = 0; run < 50; ++run)
  {
    MeshInput<D> in = star<D>();
    for (int d = 0; d < D; ++d)
    {
      in.points[0][d] = 0.45 * random();
    }
    SimplexMesh<D> mesh = buildMesh(in);
    Cluster<D> cluster = clusterOf(mesh, 0, 0);
    ASSERT_EQ(cluster.numberOfMoving, 1);
    ASSERT_EQ(cluster.cells.size(), in.cells.size());
    check(cluster);
    for (std::size_t k = 1; k < cluster.points.size(); ++k)
    {
      EXPECT_EQ(cluster.x[k], mesh.point(cluster.points[k]));
    }
  }
}
}

#endif
