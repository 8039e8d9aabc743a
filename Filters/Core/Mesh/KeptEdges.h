// SPDX-License-Identifier: BSD-3-Clause
/// @file KeptEdges.h
/// Kept edges and sets of cells that grow, such as cavities.
#ifndef meshopt_Mesh_KeptEdges_h
#define meshopt_Mesh_KeptEdges_h

#include "Mesh/SimplexMesh.h"

namespace meshopt
{
/// True if all cells around a kept edge of cell c are in a set that c joins: inside the set the
/// edge would vanish. `contains(cell)` is asked about the others. Always false in the plane, where
/// edges are facets.
template <int D, class Contains>
bool enclosesKeptEdge(const SimplexMesh<D>& mesh, Index c, const Contains& contains)
{
  for (int e = 0; D == 3 && mesh.hasKeptEdges() && e < Local<D>::numberOfEdges; ++e)
  {
    if (!mesh.isEdgeKeptByItself(c, e))
    {
      continue;
    }
    const Index a = mesh.nodes(c)[Local<D>::edges[e][0]], b = mesh.nodes(c)[Local<D>::edges[e][1]];
    // from cell to cell around the edge; `entry` is the facet by which `current` was entered
    Index current = c;
    int entry = -1;
    do
    {
      const int exit = mesh.otherFacet(current, entry, a, b);
      const Index h = mesh.isKept(current, exit) ? None : mesh.adjacent(current, exit);
      current = h == None ? None : mesh.cellOf(h);
      entry = h == None ? -1 : mesh.facetOf(h);
    } while (current != None && current != c && contains(current));
    if (current == c)
    {
      return true;
    }
  }
  return false;
}
}

#endif
