// SPDX-License-Identifier: BSD-3-Clause
/// @file PinchedPoints.h
/// Points where parts of a mesh meet that are not connected there.
#ifndef meshopt_Mesh_PinchedPoints_h
#define meshopt_Mesh_PinchedPoints_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Nonzero for points whose star is not connected over facets: SimplexMesh::star() then finds only
/// some of the cells. One entry per point slot; empty if there is no such point.
/// `freeOnly` leaves out points that are held anyway. Linear.
///
/// Parts of a mesh that meet in such a point may overlap although no cell is inverted. A change in
/// one of them may then create an edge at this point that the other one already has.
template <int D>
std::vector<std::uint8_t> pinchedPoints(const SimplexMesh<D>& mesh, bool freeOnly = false);

extern template std::vector<std::uint8_t> pinchedPoints<2>(const SimplexMesh<2>&, bool);
extern template std::vector<std::uint8_t> pinchedPoints<3>(const SimplexMesh<3>&, bool);
}

#endif
