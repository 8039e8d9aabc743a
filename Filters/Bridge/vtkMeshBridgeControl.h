// SPDX-License-Identifier: BSD-3-Clause
/**
 * Progress, abort and threads of a vtkAlgorithm as the core's Control.
 */
#ifndef vtkMeshBridgeControl_h
#define vtkMeshBridgeControl_h

#include "Base/Control.h"

#include <chrono>

class vtkAlgorithm;

namespace vtkMeshBridge
{

/**
 * How many threads `wanted` (0: all) means in this process.
 */
int ResolveNumberOfThreads(int wanted);

/**
 * The time at which a run must end.
 */
class Deadline
{
public:
  /// So many seconds from now; 0: never.
  explicit Deadline(double seconds);
  /// True from the first call on that comes after the time.
  bool HasPassed();
  /// Did a call of HasPassed() say so?
  bool WasSeen() const { return this->Seen; }

private:
  std::chrono::steady_clock::time_point Start;
  double Seconds;
  bool Seen = false;
};

/**
 * Reports progress of the core as the part [first, last] of the filter's progress, and stops the
 * core when the user aborts or the deadline has passed. Loops run on so many threads of
 * vtkSMPTools, in a scope of their own: the backend that the application has chosen is not touched
 * (Debian's is Sequential).
 */
meshopt::Control MakeControl(
  vtkAlgorithm* filter, int numberOfThreads, double first, double last, Deadline& deadline);

} // namespace vtkMeshBridge

#endif
