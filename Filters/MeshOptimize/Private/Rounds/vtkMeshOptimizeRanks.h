// SPDX-License-Identifier: BSD-3-Clause
/**
 * One mesh on many ranks: each optimizes its piece, then bands around the borders of the pieces.
 */
#ifndef vtkMeshOptimizeRanks_h
#define vtkMeshOptimizeRanks_h

#include "Request/vtkMeshOptimizeRequest.h"

#include <functional>
#include <string>

class vtkMultiProcessController;
class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Optimizes the mesh whose piece on this rank is `input`. First
 * `check` looks at what is on this rank, and returns an error or an empty string.
 *
 * The outcome is that of the whole on all ranks. Returns the first error of any rank, the rank
 * named. If borders cannot take part, `obstacle` says why on all ranks, and nothing is done.
 * Collective.
 */
std::string OptimizeOnRanks(vtkMultiProcessController* controller, Request& request,
  const std::function<std::string()>& check, vtkUnstructuredGrid* input,
  vtkUnstructuredGrid* output, Outcome& outcome, std::string& obstacle);

} // namespace vtkMeshOptimizeBridge

#endif
