// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core -> arrays of the grid: what vtkSolutionMetricFilter does.
 */
#ifndef vtkSolutionMetricRun_h
#define vtkSolutionMetricRun_h

#include "Metric/ErrorIndicator.h"
#include "Metric/SolutionMetric.h"

#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace vtkSolutionMetricBridge
{

/**
 * What is wanted. A wanted number of elements of 0 stands for that of the grid.
 */
struct Request
{
  bool UseErrors = false;                ///< the error of cells; else the solution at points
  meshopt::SolutionMetricOptions Metric; ///< without UseErrors
  meshopt::ErrorIndicatorOptions Errors; ///< with it
  bool ComputeSizeTensor = false;
  vtkDataArray* Values = nullptr; ///< the solution or the errors: FindArray()
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
 * Finds the array that the caller of `filter` wants: index 0 among the points, or index 1 among the
 * cells if request.UseErrors. Returns a sentence if it is not there or cannot be used.
 */
std::string FindArray(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, Request& request);

/**
 * Adds the arrays to `grid`. Returns an empty string, or one sentence about what makes the grid or
 * the options unusable; `grid` is then unchanged. A grid without cells is left as it is.
 */
std::string AddArrays(vtkUnstructuredGrid* grid, const Request& request, Outcome& outcome);

} // namespace vtkSolutionMetricBridge

#endif
