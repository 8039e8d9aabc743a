// SPDX-License-Identifier: BSD-3-Clause
#include "Optimize/Optimizer.h"

#include "Paper1996/Paper1996.h"
#include "Run/Run.h"
#include "Sizes/SizeStage.h"
#include "Surface/KeptSizes.h"
#include "WorstFirst/WorstFirst.h"

#include <algorithm>
#include <optional>

namespace meshopt
{
namespace
{
/// Growth that is left once the number of elements is what the sizes ask for, as a part of it; in
/// small meshes CellsOfTwoNodes.
constexpr double GrowthAfterSizes = 0.05;
/// Inverted cells are worked on until the worst cell is as good as that: just positive is soon tangled
/// again.
constexpr double UntangledQuality = 0.3;
/// Less is rounding: a cell that is flat, in a mesh that need not be tangled.
constexpr double FlatQuality = 1e-9;
/// Progress when the mesh is untangled, and when it has its sizes.
constexpr double Untangled = 0.2, Sized = 0.6;

template <int D>
class Optimizer
{
public:
  explicit Optimizer(Run<D>& run)
    : run_(run)
  {
  }
  void optimize();

private:
  bool wantsSizes() const
  {
    const Options& o = this->run_.options;
    return (o.beta > 0.0 || this->run_.surface) &&
      (o.desiredSize > 0.0 || this->run_.metric.hasSizes());
  }
  bool untangle();
  bool repairForSizes();
  void optimizeSizesToo();
  std::optional<NodalMetric<D>> attainable();
  void followAndOptimize(NodalMetric<D>& followed, double growth);
  void judgeByWantedSizes();
  void giveSizesUp(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, double worst);

  Run<D>& run_;
};

template <int D>
void Optimizer<D>::optimize()
{
  Report& report = this->run_.report;
  const PassRecord input = report.history.back();
  if (input.cells == 0)
  {
    report.stopReason = StopReason::NothingToDo;
    return;
  }
  if (this->run_.options.algorithm == Algorithm::Paper1996)
  {
    const Options& o = this->run_.options;
    optimizePaper1996<D>(this->run_, o.targetQuality, o.lookAhead);
    return;
  }
  const long growth = growthOf(this->run_.options, input.cells, D);
  this->run_.growth = growth;
  const bool isTangled = input.worst < -FlatQuality;
  if (isTangled && !this->untangle())
  {
    return;
  }
  this->run_.growth = std::max(0L, input.cells + growth - report.history.back().cells);
  const Clock::Part part(this->run_.clock, isTangled ? Untangled : 0.0, 1.0);
  this->wantsSizes() ? this->optimizeSizesToo() : optimizeWorstFirst<D>(this->run_);
}

/// Inverted cells are left to the clusters of 1996: moves of single nodes, which come first in the fast
/// engine, press tangled cells flat rather than part them. One row of the history; false if that was all
/// there is time for.
template <int D>
bool Optimizer<D>::untangle()
{
  Run<D>& run = this->run_;
  std::vector<PassRecord>& history = run.report.history;
  const std::size_t rows = history.size();
  {
    const Clock::Part part(run.clock, 0.0, Untangled);
    const double target = std::min(run.options.targetQuality, UntangledQuality);
    optimizePaper1996<D>(run, target, false);
  }
  PassRecord row = summarize(run.mesh(), run.options.targetQuality);
  row.stage = "untangling";
  row.pass = static_cast<int>(rows);
  for (; history.size() > rows; history.pop_back())
  {
    row.addWork(history.back());
  }
  history.push_back(row);
  return !run.clock.hasStopped();
}

// --- wanted sizes

/// In the plane, where edges that must stay are much longer than wanted: the metric with the sizes that
/// can be had beside them. In the wanted ones no quality can be high there, and to raise the worst of
/// them by a little would cost the sizes all around. Else nothing.
template <int D>
std::optional<NodalMetric<D>> Optimizer<D>::attainable()
{
  const Run<D>& run = this->run_;
  auto floor = keptSizeFloor(run.mesh(), run.metric, run.surface, run.report.sizes.longestKept);
  if (floor && run.options.beta > 0.0)
  {
    return run.metric.raised(run.mesh(), std::move(floor));
  }
  return std::nullopt;
}

/// From the attainable sizes back to the wanted ones.
template <int D>
void Optimizer<D>::judgeByWantedSizes()
{
  const Run<D>& run = this->run_;
  for (Index p = 0; p < run.mesh().numberOfPointSlots(); ++p)
  {
    if (run.mesh().isPointAlive(p))
    {
      run.metric.resample(p, run.mesh().point(p));
    }
  }
  computeQualities<D>(run.editor, run.metric, run.options.measure, run.options.beta);
  const PassRecord& row = this->run_.record("sizes as wanted");
  if (run.report.stopReason == StopReason::TargetReached && row.worst < run.options.targetQuality)
  {
    run.report.stopReason = StopReason::NoFurtherGain;
  }
}

/// Where cells overlap lengths say little: these first. False if some are left, or time is not.
template <int D>
bool Optimizer<D>::repairForSizes()
{
  long inverted = 0;
  summarize(this->run_.mesh(), this->run_.options.targetQuality, &inverted);
  if (inverted > 0)
  {
    const Clock::Part part(this->run_.clock, 0.0, Untangled);
    optimizeWorstFirst<D>(this->run_);
    summarize(this->run_.mesh(), this->run_.options.targetQuality, &inverted);
    return inverted == 0 && !this->run_.clock.hasStopped();
  }
  return true;
}

/// Gives the mesh its sizes, then raises its worst cells. `growth`: most growth after the sizes, as a
/// part of the cells then.
template <int D>
void Optimizer<D>::followAndOptimize(NodalMetric<D>& followed, double growth)
{
  const Run<D>& all = this->run_;
  Run<D> run{ all.editor, followed, all.surface, all.options, all.control, all.clock, all.report };
  const auto sized = [&]
  {
    const Clock::Part part(run.clock, Untangled, Sized);
    return followSizes<D>(run, run.report.sizes.predictedCells);
  };
  const bool more = sized();
  computeQualities<D>(run.editor, followed, run.options.measure, run.options.beta);
  if (!more)
  {
    run.report.stopReason = run.stopped();
    return;
  }
  const auto cells = static_cast<double>(run.report.history.back().cells);
  const double part = std::min(growth, std::max(GrowthAfterSizes, CellsOfTwoNodes<D> / cells));
  run.growth = std::lround(part * static_cast<double>(run.mesh().countCells()));
  const Clock::Part improving(run.clock, Sized, 1.0);
  optimizeWorstFirst<D>(run);
}

/// All is undone, and the mesh is optimized with its sizes as they were.
template <int D>
void Optimizer<D>::giveSizesUp(
  const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, double worst)
{
  const Run<D>& run = this->run_;
  run.editor.mesh() = mesh;
  run.metric = metric;
  run.editor = MeshEditor<D>(run.editor.mesh());
  this->run_.record("sizes given up");
  run.report.sizes.isGivenUp = true;
  run.report.sizes.worstWithSizes = worst;
  if (!run.clock.hasStopped())
  {
    const Clock::Part part(run.clock, 1.0, 1.0);
    optimizeWorstFirst<D>(this->run_);
  }
}

/// Sizes first, then the worst elements. Should the worst be lower in the end than it was and than is
/// wanted, the sizes are given up.
template <int D>
void Optimizer<D>::optimizeSizesToo()
{
  const Run<D>& run = this->run_;
  const double growth = static_cast<double>(run.growth) /
    static_cast<double>(run.report.history.back().cells);
  if (!this->repairForSizes())
  {
    return;
  }
  const SimplexMesh<D> meshBefore = run.mesh();
  const NodalMetric<D> metricBefore = run.metric;
  const double worstBefore = run.report.history.back().worst;
  run.report.sizes.predictedCells = run.metric.predictedNumberOfElements(run.mesh());
  std::optional<NodalMetric<D>> raised = this->attainable();
  this->followAndOptimize(raised ? *raised : run.metric, growth);
  if (raised)
  {
    this->judgeByWantedSizes();
  }
  const double worst = summarize(run.mesh(), run.options.targetQuality).worst;
  if (worst < std::min(worstBefore, run.options.targetQuality))
  {
    this->giveSizesUp(meshBefore, metricBefore, worst);
  }
}
}

template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, const Surface<D>* surface)
{
  Report report;
  Clock clock(control, options.timeLimit);
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, options.measure, options.beta);
  PassRecord input = summarize(mesh, options.targetQuality, &report.invertedBefore);
  input.stage = "input";
  report.worstBefore = input.worst;
  report.meanBefore = input.mean;
  report.history.push_back(input);

  Run<D> run{ editor, metric, surface, options, control, clock, report };
  Optimizer<D>(run).optimize();

  const PassRecord output = summarize(mesh, options.targetQuality, &report.invertedAfter);
  report.worstAfter = output.worst;
  report.meanAfter = output.mean;
  report.seconds = clock.seconds();
  return report;
}

template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, const Surface<2>*);
template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, const Surface<3>*);
}
