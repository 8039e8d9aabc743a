// SPDX-License-Identifier: BSD-3-Clause
/**
 * One mesh on many ranks: each optimizes its piece, then bands around the borders of the pieces.
 */
#ifndef vtkMeshOptimizeRanks_h
#define vtkMeshOptimizeRanks_h

#include "vtkMeshOptimizeRequest.h"
#include "vtkMeshRanksExchange.h"

#include <string>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Why borders cannot take part for this input and request; empty if they can. Then and otherwise
 * the same on all ranks. `error` is that of this rank. Collective.
 */
std::string FindObstacle(const vtkMeshRanks::Ranks& ranks, const Request& request,
  vtkUnstructuredGrid* input, std::string& error);

/**
 * Optimizes the mesh whose piece on this rank is `input`. The outcome is that of the whole on all
 * ranks. Returns the first error of any rank. Collective; FindObstacle() was empty.
 */
std::string OptimizeOnRanks(const vtkMeshRanks::Ranks& ranks, const Request& request,
  vtkUnstructuredGrid* input, vtkUnstructuredGrid* output, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
