// SPDX-License-Identifier: BSD-3-Clause
#include "Run/Report.h"

namespace meshopt
{
const char* toString(StopReason reason)
{
  switch (reason)
  {
    case StopReason::TargetReached:
      return "target quality reached";
    case StopReason::CappedBySurface:
      return "capped by the surface: what is under the target cannot get better while it is kept";
    case StopReason::NoFurtherGain:
      return "no operation improves the worst cells any more";
    case StopReason::IterationLimit:
      return "limit of iterations reached";
    case StopReason::TimeLimit:
      return "time limit reached";
    case StopReason::Aborted:
      return "aborted";
    case StopReason::NothingToDo:
      return "nothing to do: no triangles or tetrahedra";
    case StopReason::GrowthLimit:
      return "growth budget used up: what would help needs more cells";
    case StopReason::NotRun:
      break;
  }
  return "not run";
}
}
