// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core -> arrays of the grid: the work of vtkSolutionMetricFilter.
 */
#ifndef vtkSolutionMetricRun_h
#define vtkSolutionMetricRun_h

#include "vtkMeshBridgeCells.h"

#include "Metric/ErrorIndicator.h"
#include "Metric/SolutionMetric.h"

#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace vtkSolutionMetricBridge
{

/**
 * The request. A wanted number of elements of 0 means that of the grid.
 */
struct Request
{
  bool UseErrors = false;                ///< use errors of cells; otherwise the solution at points
  meshopt::SolutionMetricOptions Metric; ///< if not UseErrors
  meshopt::ErrorIndicatorOptions Errors; ///< if UseErrors
  bool ComputeSizeTensor = false;
  vtkDataArray* Values = nullptr; ///< the solution or the errors, from FindArray()
};

struct Outcome
{
  double DesiredSize = 0.0;
  double PredictedCount = 0.0;
  double TotalError = 0.0;
  bool IsCountReached = true;
  bool IsEven = false; ///< nothing to adapt to
};

/**
 * Finds the array that the caller of `filter` chose: index 0 on points, or index 1 on cells if
 * request.UseErrors. Returns a sentence if it does not exist or cannot be used.
 */
std::string FindArray(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, Request& request);

/**
 * Classifies the cells of `grid`. Returns a sentence about the first cell that is no simplex but
 * should be one, or the first value that cannot be used. A grid without cells is fine.
 */
std::string CheckInput(
  vtkUnstructuredGrid* grid, const Request& request, vtkMeshBridge::Cells& cells);

/**
 * Adds the arrays to `grid`. Returns an empty string, or one sentence about what makes the grid or
 * the options unusable; `grid` is then unchanged. A grid without cells stays as it is.
 */
std::string AddArrays(vtkUnstructuredGrid* grid, const Request& request, Outcome& outcome);

} // namespace vtkSolutionMetricBridge

#endif
