// SPDX-License-Identifier: BSD-3-Clause
/**
 * One mesh on many ranks: each optimizes its piece, then bands around the borders of the pieces.
 */
#ifndef vtkMeshOptimizeRanks_h
#define vtkMeshOptimizeRanks_h

#include "vtkMeshOptimizeRequest.h"

#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;
class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Brings together which blocks of composite data have a grid on some rank, by flat index. `here`:
 * those of this rank; `places`: all leaves of this rank that have or may have a grid. Returns
 * whether each block has its place on all ranks. Collective.
 */
bool ListBlocks(vtkMultiProcessController* controller, const std::vector<int>& here,
  const std::vector<int>& places, std::vector<int>& blocks);

/**
 * Which blocks have cells of dimension three on some rank. `here` are the blocks of this rank, by
 * flat index, `volumes` tells it of each for this rank; so does the result for all. Collective.
 */
std::vector<char> FindVolumes(vtkMultiProcessController* controller, const std::vector<int>& here,
  const std::vector<char>& volumes);

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
