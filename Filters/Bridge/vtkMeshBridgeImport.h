// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core: points and simplices of a grid as the core's MeshInput.
 */
#ifndef vtkMeshBridgeImport_h
#define vtkMeshBridgeImport_h

#include "vtkMeshBridgeFrame.h"

#include "Mesh/SimplexMesh.h"

#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshBridge
{

/**
 * Points of the core have the ids of the grid (including points that no simplex uses). Cell k of
 * the core is simplices[k].
 */
template <int D>
meshopt::MeshInput<D> ImportGeometry(
  vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, const Frame<D>& frame);

} // namespace vtkMeshBridge

#endif
