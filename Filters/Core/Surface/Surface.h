// SPDX-License-Identifier: BSD-3-Clause
/// @file Surface.h
/// The surface of a mesh, where it takes part: curves and patches along which nodes slide.
#ifndef meshopt_Surface_Surface_h
#define meshopt_Surface_Surface_h

#include "Mesh/SimplexMesh.h"
#include "Surface/SurfaceAngles.h"
#include "Surface/SurfaceChange.h"

#include <array>
#include <optional>
#include <vector>

namespace meshopt
{
template <int D>
class MeshEditor;

/// The neighbours of a point along its curve. The point may slide between them.
struct SlidingRange
{
  std::array<Index, 2> ends;
  double low, high; ///< parameters of ends[0] and ends[1] from the point; low may be the greater
};

/// Says what points of the surface may do. The mesh stores the place of each point on the surface
/// (SimplexMesh::place()), and its editor changes it. A surface changes only by release(): during a
/// stage any number of threads may use it at the same time. Points without a place are fixed.
template <int D>
class Surface
{
public:
  virtual ~Surface() = default;

  /// The point at a place on a curve.
  virtual Vec<D> at(Index part, double parameter) const = 0;

  /// The place nearest to x on the part of `place`, and the point there.
  virtual Place project(const Place& place, const Vec<D>& x, Vec<D>& there) const = 0;

  /// The same, but not farther from x than it must be for a point that keeps the tolerance. Corners
  /// have such places, too.
  virtual Place placeNear(const Place& place, const Vec<D>& x, Vec<D>& there) const
  {
    return this->project(place, x, there);
  }

  /// The orthonormal directions in which point v of the surface may move, in `basis`; `star`: its
  /// cells. Returns their number: one on a curve, two on a patch; of these, the surface bends less
  /// along the first.
  virtual int tangents(const SimplexMesh<D>& mesh, const std::vector<Index>& star, Index v,
    std::array<Vec<D>, D>& basis) const = 0;

  /// The span of the kept edge from a to b. Empty if the edge is on no curve.
  virtual std::optional<Span> span(const SimplexMesh<D>& mesh, Index a, Index b) const = 0;

  /// The neighbours of v along its curve; `star`: its cells. Empty if v does not slide along a
  /// curve.
  virtual std::optional<SlidingRange> range(
    const SimplexMesh<D>& mesh, const std::vector<Index>& star, Index v) const = 0;

  /// Whether the edge from a to b, itself kept or in kept facets, may be divided; `cells`: all
  /// around it.
  virtual bool mayDivide(
    const SimplexMesh<D>& mesh, const std::vector<Index>& cells, Index a, Index b) const = 0;

  /// Whether an edge that is not kept, between two facets of these patches, may be swapped (D = 3).
  virtual bool maySwap(const SimplexMesh<D>& mesh, Index patch, Index other) const = 0;

  /// Whether v may vanish into its neighbour u: the shape of the surface stays, nothing folds, and
  /// no curve or corner is lost. `star`: the cells of v.
  virtual bool mayJoin(
    const SimplexMesh<D>& mesh, const std::vector<Index>& star, Index v, Index u) const = 0;

  /// Whether allows() has to be asked before a change is made.
  virtual bool judgesChanges() const { return false; }
  /// The angles that a mesh has to fill whatever moves. None where nothing is certain.
  virtual SurfaceAngles angles() const { return {}; }
  /// The node sets that point v of the surface is in, as bits.
  virtual std::uint32_t sets(const SimplexMesh<D>&, Index /*v*/) const { return 0; }
  /// Whether the surface may change in this way.
  virtual bool allows(const SurfaceChange<D>&) const { return true; }
  /// Whether two facets of the surface may have this cosine between their normals at the edge from
  /// a to b; `isKept`: an edge on a curve.
  virtual bool allowsAngle(
    const SimplexMesh<D>&, Index /*a*/, Index /*b*/, bool /*isKept*/, double /*cosine*/) const
  {
    return true;
  }
  /// The same for two facets of the outer surface between which an interface ends.
  virtual bool allowsAngleOutside(
    const SimplexMesh<D>&, Index /*a*/, Index /*b*/, double /*cosine*/) const
  {
    return true;
  }

  /// Whether the surface of the second mesh, made from the first by allowed changes, newly passes
  /// through itself. If so, changes at these places are refused from now on. Between stages only.
  virtual bool refuseCrossings(const SimplexMesh<D>& /*before*/, const SimplexMesh<D>& /*now*/)
  {
    return false;
  }

  /// Whether there is more to keep now than in the end.
  virtual bool mayRelease() const { return false; }
  /// Gives up what was to be kept only at first, and says so in the places of the mesh. False if
  /// that cannot be. Between stages only: nobody else may use the surface meanwhile.
  virtual bool release(MeshEditor<D>&) { return false; }
};
}

#endif
