// SPDX-License-Identifier: BSD-3-Clause
/**
 * Ranks that have optimized their pieces, each by itself: one error and one outcome for all.
 */
#ifndef vtkMeshOptimizePieces_h
#define vtkMeshOptimizePieces_h

#include "Request/vtkMeshOptimizeRequest.h"

#include <functional>
#include <string>

class vtkMultiProcessController;

namespace vtkMeshOptimizeBridge
{

/**
 * Calls work(outcome) on all ranks, for the rank's own piece. Returns the first error of any rank,
 * the rank named; `outcome` is then as it was. Otherwise that is the outcome of all pieces, the
 * same on all ranks; its history is that of the rank.
 */
std::string OptimizePieces(vtkMultiProcessController* controller,
  const std::function<std::string(Outcome&)>& work, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
