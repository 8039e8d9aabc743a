// SPDX-License-Identifier: BSD-3-Clause
#include "Optimize/Optimizer.h"

#include "Mesh/MeshEditor.h"
#include "Optimize/Paper1996.h"
#include "Optimize/Statistics.h"
#include "Optimize/WorstFirst.h"

#include <chrono>

namespace meshopt
{
template <int D>
Report optimize(
  SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options, const Control& control)
{
  const auto begin = std::chrono::steady_clock::now();
  Report report;
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, options.measure, options.beta);
  PassRecord input = summarize(mesh, options.targetQuality, &report.invertedBefore);
  input.stage = "input";
  report.worstBefore = input.worst;
  report.meanBefore = input.mean;
  report.history.push_back(input);

  if (input.cells == 0)
  {
    report.stopReason = StopReason::NothingToDo;
  }
  else if (options.algorithm == Algorithm::WorstFirst)
  {
    optimizeWorstFirst<D>(editor, metric, options, control, report);
  }
  else
  {
    optimizePaper1996<D>(editor, metric, options, control, report);
  }

  const PassRecord output = summarize(mesh, options.targetQuality, &report.invertedAfter);
  report.worstAfter = output.worst;
  report.meanAfter = output.mean;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

template Report optimize<2>(SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&);
template Report optimize<3>(SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&);
}
