// SPDX-License-Identifier: BSD-3-Clause
/// @file Surface.h
/// What the surface of a mesh is where it takes part: curves and patches that nodes slide along.
#ifndef meshopt_Surface_Surface_h
#define meshopt_Surface_Surface_h

#include "Mesh/SimplexMesh.h"

#include <array>
#include <optional>
#include <vector>

namespace meshopt
{
/// The part of a curve between two points that are neighbours on it.
struct Span
{
  Index part;      ///< number of the curve
  double from, to; ///< parameters; those of a closed curve may be out of its range
};

/// The neighbours of a point along its curve: between them it may slide.
struct SlidingRange
{
  std::array<Index, 2> ends;
  double low, high; ///< parameters of ends[0] and ends[1] as seen from the point; low need not be the less
};

/// Says what points of the surface may do. Where on the surface each point lies (SimplexMesh::place())
/// is kept by the mesh, and changed by its editor; a surface itself never changes during a run, and
/// any number of threads may ask it at the same time. Points without a place are fixed.
template <int D>
class Surface
{
public:
  virtual ~Surface() = default;

  /// The point at a place on a curve.
  virtual Vec<D> at(Index part, double parameter) const = 0;

  /// The place nearest to x on the part that `place` is on, and the point there.
  virtual Place project(const Place& place, const Vec<D>& x, Vec<D>& there) const = 0;

  /// Orthonormal directions in which a point at a place may move, in `basis`; returns how many: one
  /// on a curve, two on a patch.
  virtual int tangents(const Place& place, const Vec<D>& x, std::array<Vec<D>, D>& basis) const = 0;

  /// The span of the kept edge from a to b. Empty if the edge is on no curve.
  virtual std::optional<Span> span(const SimplexMesh<D>& mesh, Index a, Index b) const = 0;

  /// The neighbours of v along its curve; `star`: its cells. Empty if v does not slide along one.
  virtual std::optional<SlidingRange> range(
    const SimplexMesh<D>& mesh, const std::vector<Index>& star, Index v) const = 0;

  /// Whether the kept edge from a to b may be divided, or swapped for another.
  virtual bool mayDivide(const SimplexMesh<D>& mesh, Index a, Index b) const = 0;

  /// Whether v may vanish into its neighbour u: the surface stays what it is, nothing folds, and no
  /// curve or corner is lost. `star`: the cells of v.
  virtual bool mayJoin(
    const SimplexMesh<D>& mesh, const std::vector<Index>& star, Index v, Index u) const = 0;
};
}

#endif
