// SPDX-License-Identifier: BSD-3-Clause
/**
 * The part of a mesh that may change if only cells under a threshold, and some layers around them,
 * may change.
 */
#ifndef vtkMeshOptimizeZone_h
#define vtkMeshOptimizeZone_h

#include "Grid/vtkMeshOptimizeModel.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include <vector>

namespace vtkMeshOptimizeBridge
{

/**
 * Simplices that stay as they are: what to add to a report so that it covers all simplices.
 */
struct LeftOut
{
  vtkIdType NumberOfCells = 0;
  vtkIdType NumberOfPoints = 0; ///< used by no other simplex
  vtkIdType BelowTarget = 0;
  double Worst = 0.0; ///< only valid if there are cells
  double Sum = 0.0;   ///< of the qualities
};

/**
 * Finds the cells of the model under request.OptimizeBelow, and layers of cells around them that
 * share a node with the layer before. The model's mesh and cells become those of this zone. The
 * surface of the zone then holds the other cells in place; `others` receives them. Cells that were
 * numbered in reverse count as inverted, as they were in the grid: all of them are in the zone.
 *
 * Linear in the size of the mesh, for the zone and for each layer.
 */
template <int D>
LeftOut RestrictToZone(
  const Request& request, Model<D>& model, std::vector<meshopt::Simplex<D>>& others);

/**
 * Whether the zone and the others together are a mesh. If cells overlap, a new cell of the zone can
 * have a facet that already exists among the others.
 */
template <int D>
bool FitsTogether(
  const meshopt::SimplexMesh<D>& zone, const std::vector<meshopt::Simplex<D>>& others);

/**
 * Extends an outcome of the zone to all simplices: minima, means, counts, and a bound that holds
 * while the other cells stay.
 */
void AddLeftOut(const LeftOut& rest, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
