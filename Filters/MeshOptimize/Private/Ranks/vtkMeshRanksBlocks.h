// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which blocks of composite data the ranks have, and what is in them.
 */
#ifndef vtkMeshRanksBlocks_h
#define vtkMeshRanksBlocks_h

#include <vector>

class vtkMultiProcessController;

namespace vtkMeshRanks
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

} // namespace vtkMeshRanks

#endif
