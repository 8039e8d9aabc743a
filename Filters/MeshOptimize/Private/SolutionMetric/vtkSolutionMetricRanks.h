// SPDX-License-Identifier: BSD-3-Clause
/**
 * The metric of a mesh whose pieces are on many ranks.
 */
#ifndef vtkSolutionMetricRanks_h
#define vtkSolutionMetricRanks_h

#include "SolutionMetric/vtkSolutionMetricRun.h"

class vtkMultiProcessController;

namespace vtkSolutionMetricBridge
{

/**
 * AddArrays() for the whole mesh: the same values at a point on all ranks that have it, and the
 * same outcome on all ranks. Finds the array, too. Returns the first error of any rank, the rank
 * named. Collective.
 */
std::string AddArraysOnRanks(vtkMultiProcessController* controller, vtkAlgorithm* filter,
  vtkUnstructuredGrid* grid, Request& request, Outcome& outcome);

} // namespace vtkSolutionMetricBridge

#endif
