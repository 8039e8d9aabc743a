// SPDX-License-Identifier: BSD-3-Clause
/**
 * Progress, abort and threads of a vtkAlgorithm as the core's Control.
 */
#ifndef vtkMeshBridgeControl_h
#define vtkMeshBridgeControl_h

#include "Base/Control.h"

#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;

namespace vtkMeshBridge
{

/**
 * The number of threads that `wanted` (0: all) means in this process.
 */
int ResolveNumberOfThreads(int wanted);

/**
 * A sentence about the first property that is NaN, or nothing. The macros of VTK's setters bring
 * numbers into their range, but let NaN pass.
 */
std::string CheckNumbers(const std::vector<std::pair<const char*, double>>& properties);

/**
 * Reports progress of the core as the part [first, last] of the filter's progress, and stops the
 * core when the user aborts. Loops run on `numberOfThreads` threads of vtkSMPTools in a scope of
 * their own. The application's choice of backend (Debian's is Sequential) is not changed.
 * `deadline`: that of the whole run, of which this is a part.
 */
meshopt::Control MakeControl(vtkAlgorithm* filter, int numberOfThreads, double first, double last,
  meshopt::Deadline deadline = meshopt::NoDeadline);

} // namespace vtkMeshBridge

#endif
