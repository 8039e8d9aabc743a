// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceBound.h
/// How good a mesh can be at best while its surface is kept: a certified upper bound of (2.1).
///
/// Every kept facet belongs to one cell on each side. The shape of that cell is at most that of the
/// best element with this facet: its cap. At every kept edge (3D; in 2D a kept node) the angle
/// between two kept facets has to be filled by some number of elements. The worst of them is at
/// most what edgeCap() leaves possible. Nothing else is used: the inside may be reconnected,
/// even where all nodes of a cell are fixed.
#ifndef meshopt_Bound_SurfaceBound_h
#define meshopt_Bound_SurfaceBound_h

#include "Mesh/SimplexMesh.h"
#include "Quality/Measure.h"

#include <limits>
#include <string>
#include <vector>

namespace meshopt
{
/// The fraction of its cap at which a cell counts as capped, and is left alone.
inline constexpr double CapReached = 0.998;

/// One side of a kept facet. A facet between regions has two.
template <int D>
struct KeptSide
{
  /// Ordered as in Local<D>::facets: with a node on this side appended, a positive simplex.
  Facet<D> nodes;
  Index cell = None; ///< on this side
  Index region = 0;  ///< of that cell
  /// False if it is uncertain on which side of the facet the mesh lies (the cell is inverted or
  /// flat, and nothing else tells). Its angles with other facets are then ignored.
  bool oriented = true;
  double quality = -1.0; ///< of that cell; not positive: not known, or nothing can be said from it
};

/// A kept edge (nodes a, b) or, in 2D, a kept node (a; b is None), where every filling has some
/// cell of at most `cap`. It is not known which of the cells there.
struct EdgeBound
{
  Index a = None, b = None;
  double cap = 1.0;
};

struct SurfaceBoundOptions
{
  Measure measure = Measure::Shape;
  /// Caps of facets and edges must be exact only below this. Above it, sideCaps may be any value
  /// from here to the true cap. Infinite: all sideCaps are exact.
  double enough = std::numeric_limits<double>::infinity();
  /// Lists all edges with a cap below this (0: only the edge that sets the bound).
  double listEdgesBelow = 0.0;
};

/// The result. Measure::Shape uses facets and edges, in 3D and 2D; MeanRatio and VolumeLength use
/// facets only. For other measures nothing is known, and the caps are those of the regular simplex.
///
/// A cap of the shape is also one of the quality (2.2), since the size factor is at most 1. Lengths
/// are Euclidean: for a constant metric pass points mapped by M^(1/2). For a varying metric there
/// is no bound.
template <int D>
struct SurfaceBound
{
  double bound = 1.0; ///< no mesh with this surface has a worst cell above it
  std::vector<KeptSide<D>> sides;
  std::vector<double> sideCaps; ///< cap of the cell on each side, in [0, 1]
  std::vector<EdgeBound> edges; ///< see listEdgesBelow; in no special order, but always the same
};

/// The present kept facets of a mesh (surface, regions, the caller's) from both their sides, as
/// each side has cells of its own.
template <int D>
struct KeptSurface
{
  explicit KeptSurface(const SimplexMesh<D>& mesh);

  std::vector<Vec<D>> points; ///< all of the mesh, by id
  std::vector<KeptSide<D>> sides;
};

/// The bound of a mesh with its present kept facets (surface, regions, the caller's). Linear in the
/// size of the mesh. Besides one scan of the cells, the work is proportional to the surface: some
/// 0.3 us per facet and 1 us per edge.
template <int D>
SurfaceBound<D> surfaceBound(const SimplexMesh<D>& mesh, const SurfaceBoundOptions& options = {});

/// The same from a list of sides. `points` is indexed by the ids in the sides. The points of a side
/// need not be finite.
template <int D>
SurfaceBound<D> surfaceBound(
  const Vec<D>* points, std::vector<KeptSide<D>> sides, const SurfaceBoundOptions& options = {});

extern template struct SurfaceBound<2>;
extern template struct SurfaceBound<3>;
}

#endif
