// SPDX-License-Identifier: BSD-3-Clause
#include "Optimize/Optimizer.h"

#include "Mesh/MeshEditor.h"
#include "Surface/KeptSizes.h"
#include "Paper1996/Paper1996.h"
#include "Sizes/SizeStage.h"
#include "Run/Summary.h"
#include "WorstFirst/WorstFirst.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace meshopt
{
namespace
{
/// What may be added once the number of elements is what the sizes ask for; in small meshes CellsOfTwoNodes.
constexpr double GrowthAfterSizes = 0.05;
/// Inverted cells are worked on until the worst cell is as good as that: just positive is soon tangled again.
constexpr double UntangledQuality = 0.3;
/// Less is rounding: a cell that is flat, in a mesh that need not be tangled.
constexpr double FlatQuality = 1e-9;
/// Progress when the mesh is untangled, and when it has its sizes.
constexpr double Untangled = 0.2, Sized = 0.6;

template <int D>
bool wantsSizes(const NodalMetric<D>& metric, const Options& options, const BoundaryCurves* curves)
{
  return (options.beta > 0.0 || curves) && (options.desiredSize > 0.0 || metric.hasSizes());
}

/// A control whose progress goes from `first` to `last` of the whole.
Control partOf(const Control& control, double first, double last)
{
  Control part = control;
  if (control.progress)
  {
    part.progress = [&control, first, last](double fraction, const std::string& text)
    { return control.progress(first + fraction * (last - first), text); };
  }
  return part;
}

template <int D>
void appendRow(const char* stage, const SimplexMesh<D>& mesh, double target, Report& report)
{
  PassRecord row = summarize(mesh, target);
  row.stage = stage;
  row.pass = static_cast<int>(report.history.size());
  report.history.push_back(row);
}

/// In the plane, where edges that must stay are much longer than wanted: the metric with the sizes that
/// can be had beside them. In the wanted ones no quality can be high there, and to raise the worst of
/// them by a little would cost the sizes all around. Else nothing.
template <int D>
std::optional<NodalMetric<D>> attainable([[maybe_unused]] const SimplexMesh<D>& mesh,
  [[maybe_unused]] const NodalMetric<D>& metric, [[maybe_unused]] const Options& options,
  [[maybe_unused]] const BoundaryCurves* curves, [[maybe_unused]] Report& report)
{
  if constexpr (D == 2)
  {
    auto floor = keptSizeFloor(mesh, metric, curves, report.sizes.longestKept);
    if (floor && options.beta > 0.0)
    {
      return metric.raised(mesh, std::move(floor));
    }
  }
  return std::nullopt;
}

/// From the attainable sizes back to the wanted ones.
template <int D>
void judgeByWantedSizes(
  MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options, Report& report)
{
  for (Index p = 0; p < editor.mesh().numberOfPointSlots(); ++p)
  {
    if (editor.mesh().isPointAlive(p))
    {
      metric.resample(p, editor.mesh().point(p));
    }
  }
  computeQualities<D>(editor, metric, options.measure, options.beta);
  appendRow<D>("sizes as wanted", editor.mesh(), options.targetQuality, report);
  if (report.stopReason == StopReason::TargetReached &&
    report.history.back().worst < options.targetQuality)
  {
    report.stopReason = StopReason::NoFurtherGain;
  }
}

/// What is left of the time limit, of which so much is spent.
double timeLeft(const Options& options, std::chrono::steady_clock::time_point begin)
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  return options.timeLimit > 0.0 ? std::max(options.timeLimit - spent.count(), 1e-9) : 0.0;
}

/// Inverted cells are left to the clusters of 1996: moves of single nodes, which come first in the fast
/// engine, press tangled cells flat rather than part them. At most `growth` cells may come. One row of
/// the history; false if that was all there is time for.
template <int D>
bool untangle(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, long growth)
{
  const auto begin = std::chrono::steady_clock::now();
  bool isLate = false;
  const Control untangling = partOf(control, 0.0, Untangled);
  Control limited = control;
  limited.progress = [&](double fraction, const std::string& text)
  {
    isLate = options.timeLimit > 0.0 && timeLeft(options, begin) <= 1e-9;
    return !isLate && (!untangling.progress || untangling.progress(fraction, text));
  };
  Options first = options;
  first.targetQuality = std::min(options.targetQuality, UntangledQuality);
  first.lookAhead = false;
  const std::size_t rows = report.history.size();
  optimizePaper1996<D>(editor, metric, first, limited, report, growth);
  PassRecord row = summarize(editor.mesh(), options.targetQuality);
  row.stage = "untangling";
  row.pass = static_cast<int>(rows);
  for (; report.history.size() > rows; report.history.pop_back())
  {
    row.addWork(report.history.back());
  }
  report.history.push_back(row);
  if (report.stopReason == StopReason::Aborted && isLate)
  {
    report.stopReason = StopReason::TimeLimit;
  }
  return report.stopReason != StopReason::Aborted && report.stopReason != StopReason::TimeLimit;
}

/// Sizes first, then the worst elements. Should the worst be lower in the end than it was and than is
/// wanted, all is undone, and the mesh is optimized with its sizes as they are.
template <int D>
void optimizeSizesToo(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, const BoundaryCurves* curves)
{
  const auto begin = std::chrono::steady_clock::now();
  const auto optionsLeft = [&] // for what is still to be done
  {
    Options left = options;
    left.timeLimit = timeLeft(options, begin);
    return left;
  };
  long inverted = 0;
  summarize(editor.mesh(), options.targetQuality, &inverted);
  if (inverted > 0) // where cells overlap, lengths say little: these first
  {
    const Control untangling = partOf(control, 0.0, Untangled);
    optimizeWorstFirst<D>(editor, metric, optionsLeft(), untangling, report, curves);
    summarize(editor.mesh(), options.targetQuality, &inverted);
    if (inverted > 0 || report.stopReason == StopReason::Aborted ||
      report.stopReason == StopReason::TimeLimit)
    {
      return;
    }
  }
  const SimplexMesh<D> meshBefore = editor.mesh();
  const NodalMetric<D> metricBefore = metric;
  const double worstBefore = report.history.back().worst;
  const Control sizing = partOf(control, Untangled, Sized), improving = partOf(control, Sized, 1.0);
  report.sizes.predictedCells = metric.predictedNumberOfElements(editor.mesh());
  std::optional<NodalMetric<D>> raised = attainable<D>(
    editor.mesh(), metric, options, curves, report);
  NodalMetric<D>& followed = raised ? *raised : metric;
  const bool more = followSizes<D>(
    editor, followed, report.sizes.predictedCells, optionsLeft(), sizing, curves, report);
  computeQualities<D>(editor, followed, options.measure, options.beta);
  if (more)
  {
    Options rest = optionsLeft();
    const auto cells = static_cast<double>(report.history.back().cells);
    rest.growthBudget = std::min(
      rest.growthBudget, std::max(GrowthAfterSizes, CellsOfTwoNodes<D> / cells));
    optimizeWorstFirst<D>(editor, followed, rest, improving, report, curves);
  }
  else
  {
    const bool isLate = options.timeLimit > 0.0 && timeLeft(options, begin) <= 1e-9;
    report.stopReason = isLate ? StopReason::TimeLimit : StopReason::Aborted;
  }
  if (raised)
  {
    judgeByWantedSizes<D>(editor, metric, options, report);
  }
  const double worst = summarize(editor.mesh(), options.targetQuality).worst;
  if (worst < std::min(worstBefore, options.targetQuality))
  {
    editor.mesh() = meshBefore;
    metric = metricBefore;
    editor = MeshEditor<D>(editor.mesh());
    appendRow<D>("sizes given up", editor.mesh(), options.targetQuality, report);
    report.sizes.isGivenUp = true;
    report.sizes.worstWithSizes = worst;
    if (report.stopReason != StopReason::Aborted && report.stopReason != StopReason::TimeLimit)
    {
      optimizeWorstFirst<D>(
        editor, metric, optionsLeft(), partOf(control, 1.0, 1.0), report, curves);
    }
  }
}
}

template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, const BoundaryCurves* curves)
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
  else if (options.algorithm == Algorithm::Paper1996)
  {
    optimizePaper1996<D>(editor, metric, options, control, report);
  }
  else
  {
    const bool isTangled = input.worst < -FlatQuality;
    const long growth = growthOf(options, input.cells, D);
    const bool more = !isTangled || untangle<D>(editor, metric, options, control, report, growth);
    const Control rest = isTangled ? partOf(control, Untangled, 1.0) : control;
    Options left = options;
    left.timeLimit = timeLeft(options, begin);
    const long cells = report.history.back().cells;
    const long room = std::max(0L, input.cells + growth - cells);
    left.growthBudget = static_cast<double>(room) / static_cast<double>(cells);
    if (more && wantsSizes(metric, options, curves))
    {
      optimizeSizesToo<D>(editor, metric, left, rest, report, curves);
    }
    else if (more)
    {
      optimizeWorstFirst<D>(editor, metric, left, rest, report, curves);
    }
  }

  const PassRecord output = summarize(mesh, options.targetQuality, &report.invertedAfter);
  report.worstAfter = output.worst;
  report.meanAfter = output.mean;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, const BoundaryCurves*);
template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, const BoundaryCurves*);
}
