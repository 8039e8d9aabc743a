// SPDX-License-Identifier: BSD-3-Clause
/**
 * The input arrays of the filter: region, fixed points, size, metric, corners. Found, checked, and read as
 * the core wants them.
 */
#ifndef vtkMeshBridgeArrays_h
#define vtkMeshBridgeArrays_h

#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Indices of vtkAlgorithm::SetInputArrayToProcess().
 */
enum ArrayIndex
{
  RegionArray = 0,
  FixedPointArray = 1,
  SizeArray = 2,
  MetricArray = 3,
  CornerArray = 4,
  NumberOfInputArrays = 5
};

/**
 * The arrays of one grid; nullptr for those that are not wanted or not there.
 */
struct InputArrays
{
  vtkDataArray* Region = nullptr;
  vtkDataArray* FixedPoints = nullptr;
  vtkDataArray* Size = nullptr;
  vtkDataArray* Metric = nullptr;
  vtkDataArray* Corners = nullptr;
};

/**
 * Did the caller of `filter` ask for this array? ParaView's "None" counts as no.
 */
bool IsWanted(vtkAlgorithm* filter, int index);

/**
 * Finds the arrays that the caller of `filter` wants in `grid`, and checks types and numbers of
 * components. Returns a sentence about the first that cannot be used. One that is not there is no
 * error here: another block may have it.
 */
std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays);

/**
 * Returns a sentence about the first array that the caller of `filter` wants and none of `grids`
 * has; an empty string if there is none, or if no grid has cells (a process without a piece). The
 * array of index `elsewhere` has been found in another place.
 */
std::string CheckArraysAreThere(
  vtkAlgorithm* filter, const std::vector<vtkUnstructuredGrid*>& grids, int elsewhere = -1);

/**
 * Region of each simplex. Numbers that do not fit into the core's 32 bits are replaced by their
 * ranks.
 */
std::vector<meshopt::Index> ReadRegions(vtkDataArray* array, const Cells& cells);

/**
 * Sizes at all points of the grid; 1 at points that no simplex uses, whatever the array has there.
 */
std::vector<double> ReadSizes(vtkDataArray* array, const Cells& cells);

/**
 * Tensors at all points of the grid, in the frame; the identity at points that no simplex uses.
 */
template <int D>
std::vector<meshopt::Tensor<D>> ReadMetric(
  vtkDataArray* array, const Cells& cells, const Frame<D>& frame);

} // namespace vtkMeshOptimizeBridge

#endif
