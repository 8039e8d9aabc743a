// SPDX-License-Identifier: BSD-3-Clause
// Several threads for the optimizer, as tests want them.
#ifndef meshopt_Testing_TestThreads_h
#define meshopt_Testing_TestThreads_h

#include "Base/Control.h"

#include <atomic>
#include <random>
#include <thread>
#include <vector>

namespace meshopt
{
/// Runs bodies on n threads, in an order shuffled by `seed`.
inline Control threads(int n, unsigned seed = 0)
{
  Control control;
  control.parallelFor = [n, seed](int bodies, const std::function<void(int)>& body)
  {
    std::vector<int> order(bodies);
    for (int k = 0; k < bodies; ++k)
    {
      order[k] = k;
    }
    std::mt19937 engine(seed);
    for (int k = bodies; seed != 0 && k > 1; --k)
    {
      std::swap(order[k - 1], order[engine() % k]);
    }
    std::atomic<int> next{ 0 };
    std::vector<std::thread> team;
    for (int t = 0; t < n; ++t)
    {
      team.emplace_back(
        [&]
        {
          for (int k = next++; k < bodies; k = next++)
          {
            body(order[k]);
          }
        });
    }
    for (std::thread& t : team)
    {
      t.join();
    }
  };
  return control;
}
}

#endif
