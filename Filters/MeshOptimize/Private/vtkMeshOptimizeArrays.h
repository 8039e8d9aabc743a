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
 * Chooses an array of this index by its name: vtkAlgorithm::SetInputArrayToProcess() with what the
 * array is on. nullptr or "": none.
 */
void ChooseArray(vtkAlgorithm* filter, ArrayIndex index, const char* name);

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

} // namespace vtkMeshOptimizeBridge

#endif
