// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceFaults.h
/// Faults of a kept surface: places where no mesh of positive cells exists. They explain why a cell
/// cannot be repaired.
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
    NoArea,  ///< nodes of a kept facet collinear (2D: coincident): its cells are flat
    Folded,  ///< two kept facets with D - 1 common nodes lie on each other
    Crossing ///< two kept facets without such a common side pass through each other
  };
  Kind kind = NoArea;
  std::array<Facet<D>, 2> facets; ///< sorted ids; for NoArea both are the same
};

/// The faults among the kept facets that are at most two cells away from `cells` (live ones).
/// Facets that only touch, like those of a closed crack, are no fault. Signs are exact, except for
/// NoArea: an area below 1e-14 of the square of the longest edge counts as none. In order of kind,
/// then of ids. Linear in the mesh, and n log n in the facets as long as they do not overlap much.
template <int D>
std::vector<SurfaceFault<D>> findSurfaceFaults(
  const SimplexMesh<D>& mesh, const std::vector<Index>& cells);

/// Whether two facets, whose nodes are given, pass through each other. Those that only touch, or
/// lie in one plane (2D: on one line), do not. Exact.
bool facetsCross(const SimplexMesh<2>& mesh, const Facet<2>& f, const Facet<2>& g);
bool facetsCross(const SimplexMesh<3>& mesh, const Facet<3>& f, const Facet<3>& g);

/// Whether edges are so short that the volumes of their cells, or what exact signs are made of, are
/// below the smallest numbers: signs say nothing there. Nodes at the same place do no harm. Hardly
/// more than a look at the coordinates.
template <int D>
bool hasLostSigns(const SimplexMesh<D>& mesh);

/// Whether cells may overlap although none is inverted: if they fill more than all directions at
/// some point, if points are `pinched` (PinchedPoints.h: one part may lie in another), or, in 3D,
/// if the surface has a fault. The cost is the same as above.
template <int D>
bool mayOverlap(const SimplexMesh<D>& mesh, const std::vector<std::uint8_t>& pinched);

extern template bool hasLostSigns<2>(const SimplexMesh<2>&);
extern template bool hasLostSigns<3>(const SimplexMesh<3>&);
extern template bool mayOverlap<2>(const SimplexMesh<2>&, const std::vector<std::uint8_t>&);
extern template bool mayOverlap<3>(const SimplexMesh<3>&, const std::vector<std::uint8_t>&);
extern template std::vector<SurfaceFault<2>> findSurfaceFaults<2>(
  const SimplexMesh<2>&, const std::vector<Index>&);
extern template std::vector<SurfaceFault<3>> findSurfaceFaults<3>(
  const SimplexMesh<3>&, const std::vector<Index>&);
}

#endif
