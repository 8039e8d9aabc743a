// SPDX-License-Identifier: BSD-3-Clause
/// @file CavityFit.h
/// Whether cells fill a cavity, decided from their points alone.
#ifndef meshopt_Mesh_CavityFit_h
#define meshopt_Mesh_CavityFit_h

#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
/// Whether `cells` may replace those of the cavity. For meshes whose cells overlap: geometry then
/// does not tell. O(n^2) in the number of cells, which are few. True if
/// - every facet of the cavity's boundary is a facet of one of `cells`, and all other facets of
///   `cells` come in pairs: this is what MeshEditor::replace() requires. Kept facets that `change`
///   adds or removes are excepted;
/// - the cells are connected. Otherwise, a new node joined to the outside of a cavity and to an
///   inverted cell inside it would close a bubble around that cell;
/// - at every point (D = 3: and edge) of the boundary, cells stay connected that were so before.
///   Otherwise the mesh could be pinched there, and a star would be found only in part;
/// - their Euler characteristic is that of the cavity: a node joined to all of a ring of cells does
///   not make a ring.
template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const KeptChange<D>* change = nullptr);

/// Whether one of `cells` has an edge or a facet that already exists outside of the cavity. This is
/// the link condition of an edge contraction, and its analogue for other changes. Without inverted
/// cells geometry rules it out. `pinched`: see PinchedPoints.h. The cost is proportional to the
/// stars of the points.
template <int D>
bool meetsOthers(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const std::vector<std::uint8_t>& pinched);

/// Whether every kept edge of the cavity is an edge of one of `cells`, or is removed by the change.
template <int D>
bool keepsEdges(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const KeptChange<D>* change = nullptr)
{
  if (!mesh.hasKeptEdges())
  {
    return true;
  }
  for (Index c : cavity)
  {
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      if (!mesh.isEdgeKeptByItself(c, e))
      {
        continue;
      }
      const Index a = mesh.nodes(c)[Local<D>::edges[e][0]];
      const Index b = mesh.nodes(c)[Local<D>::edges[e][1]];
      const auto isSame = [&](const std::array<Index, 2>& gone)
      { return (gone[0] == a && gone[1] == b) || (gone[0] == b && gone[1] == a); };
      const auto has = [&](const Simplex<D>& cell)
      {
        return std::find(cell.begin(), cell.end(), a) != cell.end() &&
          std::find(cell.begin(), cell.end(), b) != cell.end();
      };
      if (std::none_of(cells.begin(), cells.end(), has) &&
        !(change && std::any_of(change->goneEdges.begin(), change->goneEdges.end(), isSame)))
      {
        return false;
      }
    }
  }
  return true;
}
}

#endif
