// SPDX-License-Identifier: BSD-3-Clause
/**
 * The first division of a mesh that lies on one rank, or in very uneven pieces.
 */
#ifndef vtkMeshRanksDivide_h
#define vtkMeshRanksDivide_h

#include "vtkMeshRanksExchange.h"
#include "vtkMeshRanksPart.h"

#include <vector>

namespace vtkMeshRanks
{

/**
 * A number below `count` for each cell, so that all have about as many: the centres of the cells
 * are cut across the longest side of their box, again and again. Any count will do. Equal centres
 * go by id. O(n log n).
 */
std::vector<int> Divide(const Part& part, int count);

/**
 * The same for a mesh that is in pieces already, a number for each cell of this rank. The cuts go
 * through samples of all ranks' cells, so that the parts differ by a few percent. Collective.
 */
std::vector<int> DivideAnew(const Ranks& ranks, const Part& part);

} // namespace vtkMeshRanks

#endif
