// SPDX-License-Identifier: BSD-3-Clause
/**
 * A grid on its way through the core.
 */
#ifndef vtkMeshOptimizeModel_h
#define vtkMeshOptimizeModel_h

#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"

#include "Mesh/SimplexMesh.h"
#include "Metric/NodalMetric.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * A point array of the grid that may be a node set (vtkMeshOptimizeSets.h), and its sets as bits.
 */
struct NodeSetArray
{
  int Array = -1; ///< index in the point data
  std::uint32_t Bits = 0;
};

template <int D>
struct Model
{
  vtkUnstructuredGrid* Grid = nullptr; ///< the input; never changed
  InputArrays Arrays;                  ///< of the grid
  vtkMeshBridge::Cells Cells;          ///< of the grid; the simplices are those of Mesh
  vtkMeshBridge::Frame<D> Frame;
  meshopt::SimplexMesh<D> Mesh;
  meshopt::NodalMetric<D> Metric;
  /// Triangles that ride on a surface that slides (D = 3): sorted points, and cell of the grid; in
  /// ascending order.
  std::vector<std::pair<meshopt::Facet<3>, vtkIdType>> Riding;
  /// Lines that ride on it: the same with two points.
  std::vector<std::pair<std::array<meshopt::Index, 2>, vtkIdType>> RidingLines;
  std::vector<NodeSetArray> NodeSets; ///< the same
  std::vector<int> Conditions; ///< indices of point arrays: vtkMeshOptimizeConditions.h
};

} // namespace vtkMeshOptimizeBridge

#endif
