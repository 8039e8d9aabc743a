// SPDX-License-Identifier: BSD-3-Clause
/**
 * The input arrays of vtkMeshOptimizeFilter and vtkMeshQualityMinMax.
 */
#ifndef vtkMeshOptimizeArrays_h
#define vtkMeshOptimizeArrays_h

#include <string>
#include <vector>

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
  PatchArray = 5,
  NumberOfInputArrays = 6
};

/**
 * The arrays of one grid; nullptr for those that were not chosen or do not exist.
 */
struct InputArrays
{
  vtkDataArray* Region = nullptr;
  vtkDataArray* FixedPoints = nullptr;
  vtkDataArray* Size = nullptr;
  vtkDataArray* Metric = nullptr;
  vtkDataArray* Corners = nullptr;
  vtkDataArray* Patch = nullptr;
  bool PatchIsAtPoints = false;
  /// Of a part of a mesh on many ranks: see MeshInput::borderPoints. Nobody chooses it.
  vtkDataArray* BorderPoints = nullptr;
};

/**
 * Chooses the array of this index by name, with vtkAlgorithm::SetInputArrayToProcess() for points
 * or cells. nullptr or "": none.
 */
void ChooseArray(vtkAlgorithm* filter, ArrayIndex index, const char* name);

/**
 * Finds the arrays in `grid` that the caller of `filter` chose, and checks their types and numbers
 * of components. Returns a sentence about the first one that cannot be used. A missing array is no
 * error here: another block may have it.
 */
std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays);

/**
 * Returns a sentence about the first chosen array that none of `grids` has. An empty string if
 * there is none, or if no grid has cells (a process without a piece). The array of index
 * `elsewhere` was found in another place.
 */
std::string CheckArraysAreThere(
  vtkAlgorithm* filter, const std::vector<vtkUnstructuredGrid*>& grids, int elsewhere = -1);

} // namespace vtkMeshOptimizeBridge

#endif
