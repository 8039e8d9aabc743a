// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core: the mesh of a model, with all that must be kept.
 */
#ifndef vtkMeshOptimizeImport_h
#define vtkMeshOptimizeImport_h

#include "Grid/vtkMeshOptimizeModel.h"

#include <string>

namespace vtkMeshOptimizeBridge
{

/**
 * Points and simplices with all that must be kept: regions, fixed points, and what other cells
 * touch. Points of the core have the ids of the grid; its cell k is model.Cells.Simplices[k].
 */
template <int D>
meshopt::MeshInput<D> ImportMesh(const Model<D>& model);

/**
 * Makes model.Mesh from the rest of the model. Returns an empty string, or the sentence of
 * SimplexMesh::build() with the cell ids of the grid.
 */
template <int D>
std::string BuildMesh(Model<D>& model);

} // namespace vtkMeshOptimizeBridge

#endif
