// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceFaults.h
/// Places where a kept surface admits no mesh of positive cells: why a cell cannot be repaired.
#ifndef meshopt_Surface_SurfaceFaults_h
#define meshopt_Surface_SurfaceFaults_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// One such place.
template <int D>
struct SurfaceFault
{
  enum Kind
  {
    NoArea,  ///< the nodes of a kept facet are on one line (2D: at one place): its cells are flat
    Folded,  ///< two kept facets with D - 1 common nodes lie on each other
    Crossing ///< two kept facets without such a common side pass through each other
  };
  Kind kind = NoArea;
  std::array<Facet<D>, 2> facets; ///< sorted ids; of NoArea both are the same
};

/// The faults among the kept facets that are no more than two cells away from `cells` (live ones).
/// Facets that only touch, as those of a closed crack do, are no fault. Signs are exact but for
/// NoArea: 1e-14 of the square of the longest edge counts as none. In order of kind, then of ids.
/// Linear in the mesh, n log n in the facets looked at while these do not overlap much.
template <int D>
std::vector<SurfaceFault<D>> findSurfaceFaults(
  const SimplexMesh<D>& mesh, const std::vector<Index>& cells);

/// Whether cells may lie on each other although none is inverted: if they fill more than all directions
/// at some point, if points are `pinched` (PinchedPoints.h; one part can then lie in another), in space
/// also if the surface has a fault. Cost as above.
template <int D>
bool mayOverlap(const SimplexMesh<D>& mesh, const std::vector<std::uint8_t>& pinched);

extern template bool mayOverlap<2>(const SimplexMesh<2>&, const std::vector<std::uint8_t>&);
extern template bool mayOverlap<3>(const SimplexMesh<3>&, const std::vector<std::uint8_t>&);
extern template std::vector<SurfaceFault<2>> findSurfaceFaults<2>(
  const SimplexMesh<2>&, const std::vector<Index>&);
extern template std::vector<SurfaceFault<3>> findSurfaceFaults<3>(
  const SimplexMesh<3>&, const std::vector<Index>&);
}

#endif
