// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshRanksNode.h"

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
  for (const Seat& seat : ranks.Gather(mine))
  {
    if (seat.Computer == mine.Computer)
    {
      cores |= seat.Cores;
      ++neighbors;
    }
  }
  return std::max(1, static_cast<int>(cores.count()) / neighbors);
}

} // namespace vtkMeshRanks
