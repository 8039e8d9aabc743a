// SPDX-License-Identifier: BSD-3-Clause
/// @file CavityFit.h
/// Whether cells fill a cavity, decided from their points alone.
#ifndef meshopt_Mesh_CavityFit_h
#define meshopt_Mesh_CavityFit_h

#include "Mesh/FewCells.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
/// Use: load(), then one question or both.
template <int D>
class CavityFit
{
public:
  /// Takes a cavity, and the cells that are to replace it. The mesh must not change before the
  /// questions. The cost of all three functions is about linear in the number of cells, beside the
  /// stars that meetsOthers() looks at; memory is kept for the next cavity.
  void load(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
    const std::vector<Simplex<D>>& cells);

  /// Whether the cells may replace those of the cavity. For meshes whose cells overlap: geometry
  /// then does not tell. True if
  /// - every facet of the cavity's boundary is a facet of one of the cells, and all other facets of
  ///   the cells come in pairs: this is what MeshEditor::replace() requires. Kept facets that
  ///   `change` adds or removes are excepted;
  /// - the cells are connected. Otherwise, a new node joined to the outside of a cavity and to an
  ///   inverted cell inside it would close a bubble around that cell;
  /// - at every point (D = 3: and edge) of the boundary, cells stay connected that were so before.
  ///   Otherwise the mesh could be pinched there, and a star would be found only in part;
  /// - their Euler characteristic is that of the cavity: a node joined to all of a ring of cells
  ///   does not make a ring.
  /// False with two million points or more.
  bool fills(const KeptChange<D>* change = nullptr);

  /// Whether one of the cells has an edge or a facet that already exists outside of the cavity.
  /// This is the link condition of an edge contraction, and its analogue for other changes. Without
  /// inverted cells geometry rules it out. `pinched`: see PinchedPoints.h. True with two million
  /// points or more.
  bool meetsOthers(const std::vector<std::uint8_t>& pinched);

private:
  bool matchesBoundary(const KeptChange<D>* change);
  bool agrees(Index p, Index q);
  bool staysTogether();
  void keysOf(const std::vector<Facet<D>>& facets, std::vector<std::uint64_t>& keys);
  bool isTaken(const std::vector<std::uint8_t>& pinched, const Index* face, int n);

  const SimplexMesh<D>* mesh_ = nullptr;
  bool isTooLarge_ = false;
  LocalNumbers numbers_, cavity_;
  std::vector<Index> points_; ///< by local number
  std::vector<Simplex<D>> nodes_;
  FewCells<D> old_, new_;
  std::vector<Facet<D>> outer_;           ///< facets of the boundary of the cavity
  std::vector<std::array<int, 2>> sides_; ///< of each of them: the old cell and the new one
  Incidence outerAt_;
  std::vector<Index> seen_;
  std::vector<int> link_; ///< for each tree of old cells, the tree of new ones; None between calls
  std::vector<std::uint64_t> gone_, come_;
  std::vector<Index> star_;
  Index centre_ = None; ///< of the star
};

extern template class CavityFit<2>;
extern template class CavityFit<3>;

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
