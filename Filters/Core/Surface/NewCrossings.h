// SPDX-License-Identifier: BSD-3-Clause
/// @file NewCrossings.h
/// Where a surface that has changed passes through itself.
///
/// That each facet is near the surface of before does not exclude it: in a narrow wedge, both sides
/// may move by more than the gap between them. Next to its edge ReferenceSurface sees no gap.
#ifndef meshopt_Surface_NewCrossings_h
#define meshopt_Surface_NewCrossings_h

#include "Mesh/BoxTree.h"
#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Boxes around the kept facets of `now` that pass through each other, if one of the two is not in
/// `before` or has other corners there. Facets with a common edge, and those that only touch, do
/// not. The signs are exact. The cost is linear in the mesh, and n log n in the facets.
std::vector<BoxTree::Box> findNewCrossings(const SimplexMesh<3>& before, const SimplexMesh<3>& now);
}

#endif
