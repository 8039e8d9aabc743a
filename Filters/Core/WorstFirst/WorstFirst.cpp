// SPDX-License-Identifier: BSD-3-Clause
// The engine is compiled once for each measure, in several files of about equal size. Each of them
// returns false for a measure that it does not have.
#include "WorstFirst/WorstFirst.h"

#include "WorstFirst/Parts.h"

namespace meshopt
{
template <int D>
void optimizeWorstFirst(Run<D>& run)
{
  const FollowedMetric<D> follows(run.editor, run.metric);
  static_assert(NumberOfParts == 3, "a call for each");
  (void)(runPart<D, 0>(run) || runPart<D, 1>(run) || runPart<D, 2>(run));
}

template void optimizeWorstFirst<2>(Run<2>&);
template void optimizeWorstFirst<3>(Run<3>&);
}
