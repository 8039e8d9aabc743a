// SPDX-License-Identifier: BSD-3-Clause
/// @file Task.h
/// What a pass of the fast engine is to do.
#ifndef meshopt_WorstFirst_Task_h
#define meshopt_WorstFirst_Task_h

#include "Operations/Level.h"

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
}
}

#endif
