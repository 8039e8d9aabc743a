// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/WorstFirst.h"

#include "Quality/Measures.h"
#include "WorstFirst/Parts.h"

namespace meshopt
{
template <int D>
void optimizeWorstFirst(Run<D>& run)
{
  const FollowedMetric<D> follows(run.editor, run.metric);
  dispatchOptimizable<D>(
    run.options.measure, [&run](const auto& shape) { optimizeWith(run, shape); });
}

template void optimizeWorstFirst<2>(Run<2>&);
template void optimizeWorstFirst<3>(Run<3>&);
}
