// SPDX-License-Identifier: BSD-3-Clause
/// @file PinchedPoints.h
/// Points at which parts of a mesh meet that do not hang together there.
#ifndef meshopt_Mesh_PinchedPoints_h
#define meshopt_Mesh_PinchedPoints_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Nonzero for the points of which SimplexMesh::star() finds some cells only, since the others are not
/// reached over facets. One entry per point slot, or none at all if there is no such point.
/// `freeOnly` leaves out the points that are held anyway. Linear.
///
/// Parts of a mesh that are joined in such points may lie on each other although no cell is inverted, and
/// then one can get an edge from such a point that the other has.
template <int D>
std::vector<std::uint8_t> pinchedPoints(const SimplexMesh<D>& mesh, bool freeOnly = false);

extern template std::vector<std::uint8_t> pinchedPoints<2>(const SimplexMesh<2>&, bool);
extern template std::vector<std::uint8_t> pinchedPoints<3>(const SimplexMesh<3>&, bool);
}

#endif
