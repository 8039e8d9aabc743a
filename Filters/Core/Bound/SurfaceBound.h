// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceBound.h
/// How good a mesh can be at best while its surface is kept: a certified upper bound of (2.1).
///
/// Every kept facet belongs to one cell on each side, whose shape is at most that of the best
/// element with this facet: its cap. At every kept edge (3D; a kept node in 2D) the angle between
/// two kept facets has to be filled by some number of elements; the worst of them is at most what
/// edgeForbids() leaves possible. Nothing else is used: what lies inside may be reconnected, also
/// where all nodes of a cell are fixed.
#ifndef meshopt_Bound_SurfaceBound_h
#define meshopt_Bound_SurfaceBound_h

#include "Mesh/SimplexMesh.h"
#include "Quality/Measure.h"

#include <limits>
#include <string>
#include <vector>

namespace meshopt
{
/// One side of a kept facet. A facet between regions has two.
template <int D>
struct KeptSide
{
  /// Ordered as in Local<D>::facets: with a node on this side appended, a positive simplex.
  Facet<D> nodes;
  Index cell = None; ///< on this side
  Index region = 0;  ///< of that cell
  /// False where it is not sure on which side of the facet the mesh lies (the cell is inverted or
  /// flat and nothing else tells): its angles with other facets are then left out.
  bool oriented = true;
};

/// A kept edge (nodes a, b) or, in 2D, a kept node (a; b is None) where some cell of every filling
/// is at most `cap`. Which one of the cells there it is, is not said.
struct EdgeBound
{
  Index a = None, b = None;
  double cap = 1.0;
};

struct SurfaceBoundOptions
{
  Measure measure = Measure::Shape;
  /// Caps of facets and edges are needed exactly only where they are below this; above, sideCaps
  /// may be anything from here to the true cap. Infinite: all sideCaps are exact.
  double enough = std::numeric_limits<double>::infinity();
  /// List all edges that cap something under this (0: only the edge that sets the bound).
  double listEdgesBelow = 0.0;
};

/// The result. For Measure::Shape, in 3D and 2D; for MeanRatio and VolumeLength facets only; for
/// the others nothing is known and the caps are those of the regular simplex.
///
/// A cap of the shape is one of the quality (2.2) as well, since the size factor is at most 1.
/// Lengths are Euclidean: for a constant metric pass points mapped by M^(1/2); for a varying one
/// there is no bound.
template <int D>
struct SurfaceBound
{
  double bound = 1.0; ///< no mesh with this surface has a worst cell above it
  std::vector<KeptSide<D>> sides;
  std::vector<double> sideCaps; ///< cap of the cell on each side, in [0, 1]
  std::vector<EdgeBound> edges; ///< see listEdgesBelow; in no special order, but always the same
};

/// Bound of a mesh: its kept facets (surface, regions, the caller's) as they are now. Linear in its
/// size; besides one scan of the cells the work is on the surface only: some .3 us a facet, 1 us an
/// edge.
template <int D>
SurfaceBound<D> surfaceBound(const SimplexMesh<D>& mesh, const SurfaceBoundOptions& options = {});

/// The same from a list of sides. `points` is indexed by the ids in it. A side's points need not be
/// finite.
template <int D>
SurfaceBound<D> surfaceBound(
  const Vec<D>* points, std::vector<KeptSide<D>> sides, const SurfaceBoundOptions& options = {});

extern template struct SurfaceBound<2>;
extern template struct SurfaceBound<3>;
}

#endif
