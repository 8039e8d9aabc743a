// SPDX-License-Identifier: BSD-3-Clause
// Ranks may have different blocks; a rank that has none of a block still takes part in its work.
#include "Ranks/vtkMeshRanksBlocks.h"

#include "Ranks/vtkMeshRanksExchange.h"

#include <algorithm>
#include <set>
#include <string>

namespace vtkMeshRanks
{

bool ListBlocks(vtkMultiProcessController* controller, const std::vector<int>& here,
  const std::vector<int>& places, std::vector<int>& blocks)
{
  const Ranks ranks(controller);
  bool lacksOne = false;
  const std::string error = ranks.Together(
    [&]()
    {
      Bytes mine;
      PutAll(mine, here);
      std::set<int> all;
      for (const Bytes& bytes : ranks.Gather(mine))
      {
        const std::vector<int> theirs = Reader(bytes).TakeAll<int>();
        all.insert(theirs.begin(), theirs.end());
      }
      // In the order of the blocks, the same on all ranks, since each block is optimized together.
      blocks.assign(all.begin(), all.end());
      const std::set<int> known(places.begin(), places.end());
      lacksOne = ranks.IsAny(std::any_of(
        blocks.begin(), blocks.end(), [&](int block) { return known.count(block) == 0; }));
      return std::string();
    });
  return error.empty() && !lacksOne;
}

//------------------------------------------------------------------------------
std::vector<char> FindVolumes(vtkMultiProcessController* controller, const std::vector<int>& here,
  const std::vector<char>& volumes)
{
  const Ranks ranks(controller);
  std::vector<char> all = volumes;
  // Without an answer, for want of memory, each rank is left with what it knows.
  ranks.Together(
    [&]()
    {
      std::vector<int> mine;
      for (std::size_t i = 0; i < here.size(); ++i)
      {
        if (volumes[i])
        {
          mine.push_back(here[i]);
        }
      }
      Bytes bytes;
      PutAll(bytes, mine);
      for (const Bytes& one : ranks.Gather(bytes))
      {
        const std::vector<int> theirs = Reader(one).TakeAll<int>();
        for (std::size_t i = 0; i < here.size(); ++i)
        {
          all[i] |= std::count(theirs.begin(), theirs.end(), here[i]) > 0;
        }
      }
      return std::string();
    });
  return all;
}

} // namespace vtkMeshRanks
