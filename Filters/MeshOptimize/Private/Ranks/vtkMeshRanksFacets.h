// SPDX-License-Identifier: BSD-3-Clause
/**
 * Facets of a part, and what of them other ranks have: points on several ranks, the borders of
 * pieces, and the true surface.
 */
#ifndef vtkMeshRanksFacets_h
#define vtkMeshRanksFacets_h

#include "Ranks/vtkMeshRanksPart.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vtkMeshRanks
{

/**
 * Facet `Local` of a cell, opposite to that corner. `Nodes`: indices of points, ascending; the
 * third is -1 for triangles.
 */
struct CellFacet
{
  std::array<vtkIdType, 3> Nodes;
  vtkIdType Cell;
  int Local;
};

/**
 * Nodes of a facet in the order of the core: with the corner opposite appended, a simplex that is
 * oriented like the cell.
 */
std::array<vtkIdType, 3> OrientedNodes(const Part& part, vtkIdType cell, int local);

/**
 * Calls `visit` for each facet with all cells that have it, in ascending order of nodes.
 * `isWanted`, one value for each point: only facets with all nodes wanted. Linear.
 */
void VisitFacets(const Part& part, const std::vector<char>& isWanted,
  const std::function<void(const CellFacet* first, const CellFacet* last)>& visit);

/**
 * The facets that have one cell in this part.
 */
std::vector<CellFacet> FindOpenFacets(const Part& part);

/**
 * One value for each point: whether it has this flag.
 */
std::vector<char> Flagged(const Part& part, PointFlag flag);

/**
 * The points that several ranks have. Lists are in the order of the ids, so that both ranks have
 * the same list.
 */
struct Shared
{
  std::vector<int> Neighbors;                 ///< ranks, ascending
  std::vector<std::vector<vtkIdType>> Points; ///< of each neighbour: indices of points
  std::vector<std::vector<int>> RanksOf;      ///< of each point: the other ranks that have it

  bool Has(vtkIdType point) const { return !this->RanksOf[point].empty(); }
};

/**
 * Finds them among the points of the Skin. Fails if a point is at two places: the ids are then no
 * ids. Collective.
 */
Shared FindShared(const Ranks& ranks, const Part& part);

/**
 * One value for each point: whether any rank that has it has a mark there. Collective.
 */
std::vector<char> AnyOf(const Ranks& ranks, const Shared& shared, std::vector<char> marks);

/**
 * The facets of this part on borders between ranks: those that a cell of another rank has, too,
 * with the value that the other rank gave to that cell. `open` are all that may be. Collective.
 */
std::vector<std::pair<CellFacet, long long>> FindBorder(const Ranks& ranks, const Part& part,
  const Shared& shared, const std::vector<CellFacet>& open, const std::vector<long long>& values);

/**
 * The place of the point with this id in part.PointIds, or -1.
 */
vtkIdType IndexOf(const Part& part, vtkIdType id);

} // namespace vtkMeshRanks

#endif
