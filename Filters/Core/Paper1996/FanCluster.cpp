// SPDX-License-Identifier: BSD-3-Clause
// The cells around a node or an edge, walked over facets that contain it. The walk stops early if
// the cell that asks is not the worst of them: another cell will ask.
#include "Paper1996/FanCluster.h"

#include "Base/SortUnique.h"

#include <algorithm>

namespace meshopt
{
namespace
{
// Gives the points of the facets local numbers, in ascending order of their ids. The facets are
// given by ids and are returned with local numbers.
template <int D>
void numberPoints(const SimplexMesh<D>& mesh, FanCluster<D>& cluster)
{
  cluster.points.clear();
  for (const Facet<D>& f : cluster.facets)
  {
    cluster.points.insert(cluster.points.end(), f.begin(), f.end());
  }
  // Sorted: the numbers do not depend on the order of the facets.
  sortUnique(cluster.points);
  cluster.x.clear();
  for (Index p : cluster.points)
  {
    cluster.x.push_back(mesh.point(p));
  }
  for (Facet<D>& f : cluster.facets)
  {
    for (Index& p : f)
    {
      const auto at = std::lower_bound(cluster.points.begin(), cluster.points.end(), p);
      p = static_cast<Index>(at - cluster.points.begin());
    }
  }
}
}

/// First the cells, over facets that contain the core. Then the facets: those with cells of the
/// cluster on both sides are inside.
template <int D>
bool gatherFanCluster(
  MeshEditor<D>& editor, Index cell, const Index* core, int n, FanCluster<D>& cluster)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  const auto inCore = [&](Index p) { return p == core[0] || (n == 2 && p == core[1]); };
  // By (quality, id): exactly one cell of each cluster is its worst.
  const auto isWorse = [&](Index c)
  {
    const double q = mesh.quality(c), limit = mesh.quality(cell);
    return q < limit || (q == limit && c < cell);
  };
  const std::uint32_t mark = editor.newMark();
  cluster.cells.assign(1, cell);
  cluster.facets.clear();
  editor.setMark(cell, mark);
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    const Index c = cluster.cells[k];
    for (int i = 0; i <= D; ++i)
    {
      // The cell behind facet i has all nodes but node i: the core must be among them. What is not
      // kept has a cell on its other side.
      if (!inCore(mesh.nodes(c)[i]) && !mesh.isKept(c, i))
      {
        const Index next = SimplexMesh<D>::cellOf(mesh.adjacent(c, i));
        if (!editor.isMarked(next, mark))
        {
          if (isWorse(next))
          {
            return false; // early, since most cells of a mesh are not the worst of their clusters
          }
          editor.setMark(next, mark);
          cluster.cells.push_back(next);
        }
      }
    }
  }

  cluster.worst = mesh.quality(cell);
  cluster.inverted = 0;
  cluster.closed = true;
  for (Index c : cluster.cells)
  {
    cluster.inverted += mesh.quality(c) <= 0.0 ? 1 : 0;
    for (int i = 0; i <= D; ++i)
    {
      const Index across = mesh.adjacent(c, i);
      const bool inside = across != None && editor.isMarked(SimplexMesh<D>::cellOf(across), mark);
      const bool kept = mesh.isKept(c, i);
      // The cluster lies on both sides of a kept facet, which a filling would remove.
      if (kept && inside)
      {
        return false;
      }
      if (kept || !inside)
      {
        cluster.facets.push_back(mesh.facet(c, i));
        // A facet contains the core, unless it is opposite to one of its nodes.
        cluster.closed = cluster.closed && inCore(mesh.nodes(c)[i]);
      }
    }
  }
  numberPoints<D>(mesh, cluster);
  cluster.coreInside = n == 1 &&
    !std::binary_search(cluster.points.begin(), cluster.points.end(), core[0]);
  return true;
}

template bool gatherFanCluster<2>(MeshEditor<2>&, Index, const Index*, int, FanCluster<2>&);
template bool gatherFanCluster<3>(MeshEditor<3>&, Index, const Index*, int, FanCluster<3>&);
}
