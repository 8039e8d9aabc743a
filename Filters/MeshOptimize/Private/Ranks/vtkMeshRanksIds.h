// SPDX-License-Identifier: BSD-3-Clause
/**
 * Global ids for the points and cells of a mesh that comes in pieces, one on each rank.
 */
#ifndef vtkMeshRanksIds_h
#define vtkMeshRanksIds_h

#include "Ranks/vtkMeshRanksFacets.h"

#include <string>
#include <vector>

namespace vtkMeshRanks
{

/**
 * How the ids of a divided mesh came about, and which ones are still free.
 */
struct Numbering
{
  bool HasPointIds = false, HasCellIds = false;         ///< those of the input are used
  vtkIdType NextPoint = 0, NextCell = 0;                ///< above all that exist
  const char* Else = ", or switch OptimizeBorders off"; ///< ends errors: what else would help
};

/**
 * Replaces the numbers of ReadPiece() by ids that are unique over all ranks. Collective.
 *
 * The input's global ids are used where all ranks have them (`gridIds`, of the points and cells of
 * the part; empty: there are none). Without them, points of different ranks are one if facets of
 * their pieces' surfaces have the same three corners, bit for bit; points of one rank never become
 * one. So a crack of doubled nodes stays open, unless it lies on the border of a piece all along.
 * `open`: all facets that have one cell in the part.
 *
 * Fails for: ids that are not unique; facets of more than two cells;
 * points of one rank that would become one.
 */
void Number(const Ranks& ranks, std::vector<vtkIdType> gridPointIds,
  std::vector<vtkIdType> gridCellIds, const std::vector<CellFacet>& open, Numbering& numbering,
  Part& part);

} // namespace vtkMeshRanks

#endif
