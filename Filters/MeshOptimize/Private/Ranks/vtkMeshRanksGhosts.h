// SPDX-License-Identifier: BSD-3-Clause
/**
 * Layers of ghost cells around the pieces of a divided mesh: copies of other ranks' cells, found by
 * the ids of points and not by coordinates, so that the lips of a crack stay apart.
 */
#ifndef vtkMeshRanksGhosts_h
#define vtkMeshRanksGhosts_h

#include "Ranks/vtkMeshRanksFacets.h"

#include <vector>

namespace vtkMeshRanks
{

/**
 * The flags of vtkGhostType: 0, or DUPLICATECELL, DUPLICATEPOINT.
 */
struct GhostFlags
{
  std::vector<unsigned char> Points, Cells;
};

/**
 * Adds to the part the cells of other ranks that share a point with it; with more layers those that
 * share a point with these, and so on. Of a point that several ranks have, all but the lowest have
 * a ghost. `points`, `cells`: the schemas of the part. Collective.
 */
GhostFlags AddGhosts(
  const Ranks& ranks, int layers, const Schema& points, const Schema& cells, Part& part);

} // namespace vtkMeshRanks

#endif
