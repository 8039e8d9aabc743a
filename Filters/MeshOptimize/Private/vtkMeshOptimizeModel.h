// SPDX-License-Identifier: BSD-3-Clause
/**
 * A grid on its way through the core.
 */
#ifndef vtkMeshOptimizeModel_h
#define vtkMeshOptimizeModel_h

#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"
#include "vtkMeshOptimizeArrays.h"

#include "Mesh/SimplexMesh.h"
#include "Metric/NodalMetric.h"

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

template <int D>
struct Model
{
  vtkUnstructuredGrid* Grid = nullptr; ///< the input; never changed
  InputArrays Arrays;                  ///< of the grid
  vtkMeshBridge::Cells Cells;          ///< of the grid; the simplices are those of Mesh
  vtkMeshBridge::Frame<D> Frame;
  meshopt::SimplexMesh<D> Mesh;
  meshopt::NodalMetric<D> Metric;
};

} // namespace vtkMeshOptimizeBridge

#endif
