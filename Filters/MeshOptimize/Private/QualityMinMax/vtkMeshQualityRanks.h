// SPDX-License-Identifier: BSD-3-Clause
/**
 * What cells of a mesh on many ranks must know of each other to be measured as on one rank: the
 * plane of triangles, and which facets of a piece are borders, not surface.
 */
#ifndef vtkMeshQualityRanks_h
#define vtkMeshQualityRanks_h

#include "QualityMinMax/vtkMeshQualityMeasure.h"
#include "QualityMinMax/vtkMeshQualityReport.h"
#include "Ranks/vtkMeshRanksExchange.h"

#include <map>
#include <vector>

namespace vtkMeshQualityBridge
{

/**
 * Whether the triangles of the whole mesh lie in a plane, and in which one.
 */
struct Planarity
{
  bool IsFlat = false;
  vtkMeshBridge::Frame<2> Frame;
};

/**
 * The planes of blocks (by their flat index) that have triangles and, on all ranks, no tetrahedra.
 * Blocks that are not in the result are no plane meshes. Collective.
 */
std::map<unsigned int, Planarity> FindPlanes(
  const vtkMeshRanks::Ranks& ranks, const std::vector<Block>& blocks);

/**
 * Takes out of the surfaces what is border: facets whose other cell is on another rank, in the same
 * block and region. Facets are the same if their corners have the same global ids, if all pieces
 * have any, and the same coordinates otherwise. Sides of other ranks are added at edges where
 * borders end, so that angles there are right. `surfaces[i]` is that of blocks[i]. Collective.
 *
 * Where nothing tells which facets belong together, as at a crack along a border without ids, they
 * are taken for border: then the bound is higher than it need be, but still a bound.
 */
void RemoveBorders(const vtkMeshRanks::Ranks& ranks, const std::vector<Block>& blocks,
  std::vector<Surface>& surfaces);

} // namespace vtkMeshQualityBridge

#endif
