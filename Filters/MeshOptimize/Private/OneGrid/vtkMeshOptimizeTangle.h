// SPDX-License-Identifier: BSD-3-Clause
/**
 * Inverted and flat cells that are left at the end: which ones, and why.
 */
#ifndef vtkMeshOptimizeTangle_h
#define vtkMeshOptimizeTangle_h

#include "Grid/vtkMeshOptimizeExport.h"

#include "Run/Report.h"

#include <string>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * A sentence for the user about the cells of the output whose quality is not positive; an empty
 * string if there are none. For each reason it has the number of cells, an example, and the first
 * few cells: by their ids in the input, or for new ones by their ids in the output and their
 * places. The reasons, of which the first that applies is given:
 * - a kept face without area: its cells have no volume;
 * - kept faces near the cell that are folded onto each other or pass through each other;
 * - the run ended early (aborted, a limit);
 * - all nodes are kept, and no other connection was found;
 * - none of these.
 *
 * `output` has its points and cells. Linear in the size of the mesh.
 */
template <int D>
std::string DescribeTangle(vtkUnstructuredGrid* output, const OutputMap& map,
  const meshopt::SimplexMesh<D>& mesh, const meshopt::Report& report);

/**
 * A sentence about cells of the input that overlap although none of them is inverted; an empty
 * string if there are none.
 */
template <int D>
std::string DescribeOverlap(const meshopt::SimplexMesh<D>& mesh);

} // namespace vtkMeshOptimizeBridge

#endif
