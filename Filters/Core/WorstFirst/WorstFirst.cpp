// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/WorstFirst.h"

#include "Quality/ElementQuality.h"
#include "WorstFirst/RunWorstFirst.h"

namespace meshopt
{
template <int D>
void optimizeWorstFirst(Run<D>& run)
{
  const FollowedMetric<D> follows(run.editor, run.metric);
  dispatch<D>(run.options.measure,
    [&](auto shape)
    {
      using Shape = decltype(shape);
      // to report only: Options::check() has refused it
      if constexpr (!std::is_same_v<Shape, MinimumAngleShape<D>>)
      {
        runWorstFirst<D, Shape>(run);
      }
    });
}

template void optimizeWorstFirst<2>(Run<2>&);
template void optimizeWorstFirst<3>(Run<3>&);
}
