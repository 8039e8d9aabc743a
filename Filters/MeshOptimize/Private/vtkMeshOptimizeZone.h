// SPDX-License-Identifier: BSD-3-Clause
/**
 * The part of a mesh that may change where only cells under a threshold, and some layers around
 * them, may.
 */
#ifndef vtkMeshOptimizeZone_h
#define vtkMeshOptimizeZone_h

#include "vtkMeshOptimizeModel.h"
#include "vtkMeshOptimizeRequest.h"

#include <vector>

namespace vtkMeshOptimizeBridge
{

/**
 * Simplices that are left as they are: what a report about all simplices has to add.
 */
struct LeftOut
{
  vtkIdType NumberOfCells = 0;
  vtkIdType NumberOfPoints = 0; ///< that no other simplex uses
  vtkIdType BelowTarget = 0;
  double Worst = 0.0; ///< not to be looked at without cells
  double Sum = 0.0;   ///< of the qualities
};

/**
 * Finds the cells of the model under request.OptimizeBelow and so many layers of cells that share a
 * node with them, and makes the model's mesh and cells those of this zone. The surface of the zone
 * then holds the other cells in place; `others` gets them. Cells that were numbered the wrong way
 * round count as inverted ones, which they were in the grid: none is left out.
 *
 * Linear in the size of the mesh, and so is each layer.
 */
template <int D>
LeftOut RestrictToZone(
  const Request& request, Model<D>& model, std::vector<meshopt::Simplex<D>>& others);

/**
 * Whether the zone and the others are a mesh. Where cells overlap a new cell of the zone can have a
 * facet that is there among the others.
 */
template <int D>
bool FitsTogether(
  const meshopt::SimplexMesh<D>& zone, const std::vector<meshopt::Simplex<D>>& others);

/**
 * Makes an outcome of the zone one of all simplices: minima, means, counts, and a bound that holds
 * while the cells that are left out stay.
 */
void AddLeftOut(const LeftOut& rest, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
