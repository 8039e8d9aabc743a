// SPDX-License-Identifier: BSD-3-Clause
/**
 * The bands around the borders of pieces: which cells they have, and which rank takes them.
 */
#ifndef vtkMeshRanksBand_h
#define vtkMeshRanksBand_h

#include "Ranks/vtkMeshRanksFacets.h"

#include <string>
#include <vector>

namespace vtkMeshRanks
{

/**
 * The rank that takes each cell, or -1 for cells that are in no band. A band has the cells within
 * `layers` layers of the waiting points; a layer shares points with the one before. Around a
 * waiting point the rank takes over that has the fewest cells of those that have the point (the
 * lower rank if equal; one that is inside of a piece stays there); a cell goes to the point that is
 * fewest layers away. So two ranks have the whole band between them on one of them, and where three
 * or more meet the ball around goes to one. Depends only on the division, not on the order of
 * messages. Collective.
 */
std::vector<int> FindBands(const Ranks& ranks, const Part& part, const Shared& shared, int layers);

/**
 * Sends each cell of `from` to target[c] (-1: it stays) with its points and data. `part` then has
 * those that are here; isMoved tells of each cell whether it had a target. Collective.
 */
void Move(const Ranks& ranks, const std::vector<int>& target, const Schema& points,
  const Schema& cells, const Part& from, Part& part, std::vector<char>& isMoved);

} // namespace vtkMeshRanks

#endif
