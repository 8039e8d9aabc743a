// SPDX-License-Identifier: BSD-3-Clause
// Ranks on one computer share its cores. If each took all of them, threads would wait for each
// other; so each takes its share.
#include "Ranks/vtkMeshRanksNode.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <thread>

#ifndef _WIN32
#include <unistd.h>
#endif
#ifdef __linux__
#include <sched.h>
#endif

namespace vtkMeshRanks
{
namespace
{

constexpr int MostCores = 1024; // of a Linux cpu_set_t

/**
 * Which computer a rank runs on, and which cores it may use there: a launcher may have bound it to
 * some of them.
 */
struct Seat
{
  std::array<char, 256> Computer{};
  std::bitset<MostCores> Cores;
};

Seat FindSeat()
{
  Seat seat;
#ifndef _WIN32
  gethostname(seat.Computer.data(), seat.Computer.size() - 1);
#endif
#ifdef __linux__
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) == 0)
  {
    for (int core = 0; core < MostCores; ++core)
    {
      seat.Cores[core] = CPU_ISSET(core, &set);
    }
    return seat;
  }
#endif
  // Where cores cannot be asked for, or there are more than fit: as many as there are.
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  for (int core = 0; core < std::min(cores, MostCores); ++core)
  {
    seat.Cores.set(core);
  }
  return seat;
}

} // namespace

int GetShareOfCores(const Ranks& ranks)
{
  const Seat mine = FindSeat();
  std::bitset<MostCores> cores;
  int neighbors = 0;
  // Ranks that are bound to different cores have all of these together.
  for (const Seat& seat : ranks.Gather(mine))
  {
    if (seat.Computer == mine.Computer)
    {
      cores |= seat.Cores;
      ++neighbors;
    }
  }
  // Whole cores, and at least one: ranks may be more than cores.
  return std::max(1, static_cast<int>(cores.count()) / neighbors);
}

} // namespace vtkMeshRanks
