// SPDX-License-Identifier: BSD-3-Clause
/**
 * The first division of a mesh that lies on one rank.
 */
#ifndef vtkMeshRanksDivide_h
#define vtkMeshRanksDivide_h

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

} // namespace vtkMeshRanks

#endif
