// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/WorstFirst.h"

#include "Quality/ElementQuality.h"

namespace meshopt
{
/// WorstFirstRun.h
template <int D, class Shape>
void runWorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, const BoundaryCurves* curves);

template <int D>
void optimizeWorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, const BoundaryCurves* curves)
{
  dispatch<D>(options.measure,
    [&](auto shape)
    {
      using Shape = decltype(shape);
      // to report only: Options::check() has refused it
      if constexpr (!std::is_same_v<Shape, MinimumAngleShape<D>>)
      {
        runWorstFirst<D, Shape>(editor, metric, options, control, report, curves);
      }
    });
}

template void optimizeWorstFirst<2>(
  MeshEditor<2>&, NodalMetric<2>&, const Options&, const Control&, Report&, const BoundaryCurves*);
template void optimizeWorstFirst<3>(
  MeshEditor<3>&, NodalMetric<3>&, const Options&, const Control&, Report&, const BoundaryCurves*);
}
