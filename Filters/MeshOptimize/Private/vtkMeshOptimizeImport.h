/**
 * grid -> core: the simplices of a grid as the core's MeshInput, with what must be kept.
 */
#ifndef vtkMeshOptimizeImport_h
#define vtkMeshOptimizeImport_h

#include "vtkMeshOptimizeArrays.h"
#include "vtkMeshOptimizeCells.h"
#include "vtkMeshOptimizeFrame.h"

#include "Mesh/SimplexMesh.h"

namespace vtkMeshOptimizeBridge
{

/**
 * Point ids of the core are those of the grid (points that no simplex uses are there as well and stay as they are); its
 * cell k is cells.Simplices[k].
 */
template <int D>
meshopt::MeshInput<D> ImportMesh(
  vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays, const Frame<D>& frame);

/**
 * Imports and builds. Returns the sentence of SimplexMesh::build(), with the cell ids of the grid, or an empty string.
 */
template <int D>
std::string BuildMesh(vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays,
  const Frame<D>& frame, meshopt::SimplexMesh<D>& mesh);

} // namespace vtkMeshOptimizeBridge

#endif
