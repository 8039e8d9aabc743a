// SPDX-License-Identifier: BSD-3-Clause
/**
 * How good the whole mesh can be at best while its surface is kept: as Bound/SurfaceBound.h in the
 * core, but the surface lies on several ranks, and borders of pieces are none of it.
 */
#ifndef vtkMeshRanksBound_h
#define vtkMeshRanksBound_h

#include "Ranks/vtkMeshRanksFacets.h"
#include "vtkMeshBridgeFrame.h"

#include "Quality/Measure.h"

#include <array>
#include <vector>

namespace vtkMeshRanks
{

/**
 * One side of a facet of the surface, or between two regions.
 */
struct Side
{
  std::array<vtkIdType, 3>
    Ids; ///< D of them; with a node on this side appended, a positive simplex
  std::array<double, 9> Places;
  long long Region;
  bool IsOriented; ///< known: the cell is not flat or inverted
  vtkIdType Cell;  ///< of the part; -1: of another rank
};

/**
 * The sides that are those of this part's cells; `regions` as in MeasureSurface(). Collective.
 */
std::vector<Side> FindSides(const Ranks& ranks, const Part& part, const Shared& shared,
  const std::vector<long long>& regions);

struct SurfaceFigures
{
  double Bound = 1.0;         ///< the same on all ranks
  std::vector<char> IsCapped; ///< of each cell: has reached its cap, which is under the target
};

/**
 * Looks at the surface and, if `regions` has a value for each cell, at facets between regions.
 * Edges of facets on several ranks are looked at with all their facets. Of edges whose cells lie on
 * several ranks no cell is known to be capped. `plane`: of triangles. Collective.
 */
SurfaceFigures MeasureSurface(const Ranks& ranks, const Part& part, const Shared& shared,
  const std::vector<long long>& regions, meshopt::Measure measure, double target,
  const vtkMeshBridge::Frame<2>& plane);

} // namespace vtkMeshRanks

#endif
