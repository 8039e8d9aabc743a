// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeChange.h
/// Splitting and contracting one edge, also of the boundary where it may be remeshed: which cells go
/// and which come. Topology only; whether the result is any good is the caller's to see.
#ifndef meshopt_Operations_EdgeChange_h
#define meshopt_Operations_EdgeChange_h

#include "Surface/BoundaryCurves.h"
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

  /// Point v goes, its neighbour u takes its place. False if v must stay. A point that slides can
  /// only go along its piece, and not if that would fold the boundary, or leave the curve a tenth of the
  /// new edge's length away from it.
  bool contract(MeshEditor<D>& editor, const BoundaryCurves* curves, Index v, Index u);

private:
  void clear();
};

/// Where v, which slides, has its neighbours on the piece: their ids, and their parameters as seen from v.
/// Empty if v does not slide.
struct SlidingRange
{
  std::array<Index, 2> ends;
  double low, high; ///< of ends[0], ends[1]; low need not be the less
};
std::optional<SlidingRange> slidingRange(const BoundaryCurves& curves, const SimplexMesh<2>& mesh,
  const std::vector<Index>& star, Index v);

extern template struct EdgeChange<2>;
extern template struct EdgeChange<3>;
}

#endif
