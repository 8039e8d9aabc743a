// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core: the simplices of a grid as the core's MeshInput, with what must be kept.
 */
#ifndef vtkMeshBridgeImport_h
#define vtkMeshBridgeImport_h

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"

#include "Mesh/SimplexMesh.h"

namespace vtkMeshOptimizeBridge
{

/**
 * Points and simplices only. Point ids of the core are those of the grid (points that no simplex
 * uses are there as well and stay as they are); its cell k is simplices[k].
 */
template <int D>
meshopt::MeshInput<D> ImportGeometry(
  vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, const Frame<D>& frame);

/**
 * Points and simplices with what must be kept: regions, fixed points, and what other cells touch.
 */
template <int D>
meshopt::MeshInput<D> ImportMesh(
  vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays, const Frame<D>& frame);

/**
 * Imports and builds. Returns the sentence of SimplexMesh::build(), with the cell ids of the grid,
 * or an empty string.
 */
template <int D>
std::string BuildMesh(vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays,
  const Frame<D>& frame, meshopt::SimplexMesh<D>& mesh);

} // namespace vtkMeshOptimizeBridge

#endif
