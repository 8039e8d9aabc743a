// SPDX-License-Identifier: BSD-3-Clause
/// @file Task.h
/// What a pass of the fast engine is to do, and what it has done.
#ifndef meshopt_WorstFirst_Task_h
#define meshopt_WorstFirst_Task_h

#include "Edit/Operation.h"
#include "Operations/Level.h"
#include "WorstFirst/Constants.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace meshopt
{
namespace worstfirst
{
/// The two ways to work on cells.
enum class Phase
{
  Lifting,  ///< as many as possible above the target; guarded: others must not become bad for it
  Polishing ///< the few worst, with the hardest tries and without guard: others may become bad
};

/// How hard a try is, to compare with an earlier failure. Tries without guard are the hardest.
inline int rankOf(Phase phase, int level)
{
  return level + (phase == Phase::Polishing ? Level::Count : 0);
}

struct Task
{
  Phase phase;
  double target;  ///< cells under it are tried
  double aim;     ///< target of the stage, where polishing has a lower one from round to round
  double gain;    ///< least gain of a change
  int level = 0;  ///< see Level
  int number = 0; ///< of the pass in its stage
  long below = 0; ///< cells under the target, including those not tried

  bool polishes() const { return this->phase == Phase::Polishing; }
};

/// What a pass has done.
struct PassResult
{
  long accepted = 0;            ///< changes
  std::int64_t evaluations = 0; ///< of quality
  bool creeps = false;          ///< see Worker::watch()
  std::array<long, NumberOfOperations> tried{}, done{};
  std::array<long, 2> surface{}; ///< the same for changes of the surface
  bool goesOn = true;            ///< false: the run has to end

  /// Whether hardly any of the cells that it was given gained.
  bool isInVain(std::size_t given) const
  {
    return this->accepted < std::max<long>(1, static_cast<long>(given) / HardlyAny);
  }
};
}
}

#endif
