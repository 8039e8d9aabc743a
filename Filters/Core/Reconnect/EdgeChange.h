// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeChange.h
/// Splitting and contracting one edge, also of the boundary where it may be remeshed: which cells go
/// and which come. Topology only; whether the result is any good is the caller's to see.
#ifndef meshopt_Reconnect_EdgeChange_h
#define meshopt_Reconnect_EdgeChange_h

#include "Boundary/BoundaryCurves.h"
#include "Mesh/MeshEditor.h"

namespace meshopt
{
template <int D>
struct EdgeChange
{
  std::vector<Index> cavity;
  std::vector<Simplex<D>> cells; ///< in place of the cavity
  bool changesKept = false;
  KeptChange<D> kept; ///< regions always, the rest if changesKept

  const KeptChange<D>* keptChange() const { return this->changesKept ? &this->kept : nullptr; }

  /// The new point m in the middle of edge (a, b) of cell t. False if the edge must stay: kept (in
  /// the plane: and on no piece of `curves`), at the surface, or of a cell that the editor does not own.
  bool split(
    MeshEditor<D>& editor, const BoundaryCurves* curves, Index t, Index a, Index b, Index m);

  /// Point v goes, its neighbour u takes its place. False if v must stay, or if that would fold the
  /// boundary. A point that slides can only go along its piece.
  bool contract(MeshEditor<D>& editor, const BoundaryCurves* curves, Index v, Index u);

private:
  void clear();
};

/// The neighbours of v over kept facets: two for a point that slides.
std::vector<Index> neighboursOnPiece(
  const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v);

/// Whether the boundary stays near its curve if v goes from between its neighbours u and w: the
/// curve goes from the new edge by a tenth of its length at most.
bool keepsShape(
  const BoundaryCurves& curves, const SimplexMesh<2>& mesh, Index v, Index u, Index w);

extern template struct EdgeChange<2>;
extern template struct EdgeChange<3>;
}

#endif
