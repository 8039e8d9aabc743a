// SPDX-License-Identifier: BSD-3-Clause
// The order of a whole run: untangle, follow the sizes, raise the worst cells; and what to do if
// following the sizes has made the worst cell worse.
#include "Optimize/Optimizer.h"

#include "Bound/SightBound.h"
#include "Optimize/SurfaceRounds.h"
#include "Paper1996/Paper1996.h"
#include "Quality/Evaluations.h"
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
/// Growth left once the sizes are followed and the number of elements is as predicted, as a
/// fraction. In small meshes it is CellsOfTwoNodes instead.
constexpr double GrowthAfterSizes = 0.05;
/// Inverted cells are worked on until the worst cell has this quality: cells that are only just
/// positive soon become inverted again.
constexpr double UntangledQuality = 0.1;
/// A worst quality above minus this is rounding: such a cell is flat, and the mesh need not be
/// tangled.
constexpr double FlatQuality = 1e-9;
/// Progress after untangling, and after the sizes.
constexpr double Untangled = 0.2, Sized = 0.6;
constexpr double FromRidges = 0.5; ///< the same after the first part of optimizeFromRidges()

template <int D>
class Optimizer
{
public:
  Optimizer(Run<D>& run, Surface<D>* surface)
    : run_(run)
    , surface_(surface)
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
  void optimizeOnCurves();
  void optimizeFromRidges();
  bool repairForSizes();
  void optimizeSizesToo();
  std::optional<NodalMetric<D>> attainable();
  void followAndOptimize(NodalMetric<D>& followed, double growth);
  void judgeByWantedSizes();
  void giveSizesUp(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, double worst);

  Run<D>& run_;
  Surface<D>* surface_; ///< that of the run, to be released
};

template <int D>
void Optimizer<D>::optimize()
{
  Report& report = this->run_.report;
  // A copy: stages add rows, which may move the others.
  const PassRecord input = report.history.back();
  if (input.cells == 0)
  {
    report.stopReason = StopReason::NothingToDo;
    return;
  }
  if (this->run_.options.algorithm == Algorithm::Paper1996)
  {
    // The paper knows no budget: growth is limited by nothing but the number of ids.
    this->run_.growth = roomToGrow(input.cells);
    const Options& o = this->run_.options;
    optimizePaper1996<D>(this->run_, o.targetQuality, o.lookAhead);
    return;
  }
  this->run_.mostCells = input.cells +
    std::min(growthOf(this->run_.options, input.cells, D), roomToGrow(input.cells));
  this->run_.limitGrowth();
  const bool isTangled = input.worst < -FlatQuality;
  if (isTangled && !this->untangle())
  {
    return;
  }
  this->run_.limitGrowth();
  const Clock::Section part(this->run_.clock, isTangled ? Untangled : 0.0, 1.0);
  if (this->surface_ && this->surface_->mayRelease() && !this->wantsSizes())
  {
    this->optimizeFromRidges();
  }
  else if (this->surface_ && !this->surface_->judgesChanges())
  {
    this->optimizeOnCurves();
  }
  else if (this->wantsSizes())
  {
    this->optimizeSizesToo();
  }
  else if (this->run_.surface)
  {
    optimizeSliding<D>(this->run_, *this->surface_);
  }
  else
  {
    optimizeWorstFirst<D>(this->run_);
  }
}

/// In the plane. Nothing tells at each change whether the boundary passes through another part of
/// it, across a gap: this is looked at afterwards. If it does, all is done again, and what is there
/// stays. If that does not help, the mesh stays as it was.
template <int D>
void Optimizer<D>::optimizeOnCurves()
{
  Run<D>& run = this->run_;
  const SimplexMesh<D> mesh = run.mesh();
  const NodalMetric<D> metric = run.metric;
  const auto sizes = run.report.sizes;
  for (int time = 0; time <= MostRepeats; ++time)
  {
    if (this->wantsSizes())
    {
      this->optimizeSizesToo();
    }
    else
    {
      optimizeWorstFirst<D>(run);
    }
    if (!this->surface_->refuseCrossings(mesh, run.mesh()))
    {
      return;
    }
    restore<D>(run, mesh);
    run.metric = metric;
    run.report.sizes = sizes;
    run.limitGrowth();
    run.record("crossing boundary undone");
  }
  run.report.stopReason = run.clock.hasStopped() ? run.stopped() : StopReason::NoFurtherGain;
}

/// With all ridges first, by single changes and with half of the budget; then without those that
/// may go. Without them from the input on, nodes would leave the ridges before the surface has a
/// form, and what they leave behind would use up the tolerance.
template <int D>
void Optimizer<D>::optimizeFromRidges()
{
  Run<D>& all = this->run_;
  {
    const Clock::Section part(all.clock, 0.0, FromRidges);
    optimizeOnSurface<D>(all, *this->surface_, Effort::Quick, 0.5, true);
  }
  const bool isDone = all.report.stopReason == StopReason::TargetReached &&
    all.effort != Effort::Best;
  if (isDone || all.clock.hasStopped())
  {
    return;
  }
  // If the ridges cannot be given up, the run goes on with them: what was asked for is still due.
  if (this->surface_->release(all.editor))
  {
    all.record("ridges given up");
  }
  const Clock::Section part(all.clock, FromRidges, 1.0);
  optimizeSliding<D>(all, *this->surface_);
}

/// Leaves inverted cells to the clusters of 1996. The fast engine moves single nodes first, and
/// these press tangled cells flat instead of separating them. Adds one row to the history. False if
/// no time is left.
template <int D>
bool Optimizer<D>::untangle()
{
  Run<D>& run = this->run_;
  std::vector<PassRecord>& history = run.report.history;
  const std::size_t rows = history.size();
  {
    const Clock::Section part(run.clock, 0.0, Untangled);
    const double target = std::min(run.options.targetQuality, UntangledQuality);
    optimizePaper1996<D>(run, target, false);
  }
  PassRecord row = summarize(run.mesh(), run.options.targetQuality);
  row.stage = "untangling";
  row.pass = static_cast<int>(rows);
  // One row for all alternations: to the caller this is a single step.
  for (; history.size() > rows; history.pop_back())
  {
    row.addWork(history.back());
  }
  history.push_back(row);
  return !run.clock.hasStopped();
}

// --- wanted sizes

/// In 2D, if edges that must stay are much longer than wanted: the metric with the sizes that can
/// be reached beside them. With the wanted sizes no quality can be high there, and to raise the
/// worst a little would spoil the sizes all around. Otherwise nothing.
template <int D>
std::optional<NodalMetric<D>> Optimizer<D>::attainable()
{
  const Run<D>& run = this->run_;
  // Asked in any case: it also reports the longest kept edge.
  auto floor = keptSizeFloor(run.mesh(), run.metric, run.surface, run.report.sizes.longestKept);
  if (floor && run.options.beta > 0.0)
  {
    return run.metric.raised(run.mesh(), std::move(floor));
  }
  return std::nullopt;
}

/// Goes back from the attainable sizes to the wanted ones, and measures all qualities again.
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
  // The stored qualities are those in the attainable sizes.
  computeQualities<D>(run.editor, run.metric, run.options.measure, run.options.beta);
  const PassRecord& row = this->run_.record("sizes as wanted");
  // The engine has reached the target with the attainable sizes, perhaps not with the wanted ones.
  if (run.report.stopReason == StopReason::TargetReached && row.worst < run.options.targetQuality)
  {
    run.report.stopReason = StopReason::NoFurtherGain;
  }
}

/// Lengths say little where cells overlap, so inverted cells are repaired first. False if some are
/// left, or if no time is left.
template <int D>
bool Optimizer<D>::repairForSizes()
{
  long inverted = 0;
  summarize(this->run_.mesh(), this->run_.options.targetQuality, &inverted);
  if (inverted > 0)
  {
    const Clock::Section part(this->run_.clock, 0.0, Untangled);
    optimizeWorstFirst<D>(this->run_);
    this->run_.limitGrowth();
    summarize(this->run_.mesh(), this->run_.options.targetQuality, &inverted);
    return inverted == 0 && !this->run_.clock.hasStopped();
  }
  return true;
}

/// Gives the mesh its sizes, then improves its worst cells. `growth`: most growth after the sizes,
/// as a fraction of the cells then.
template <int D>
void Optimizer<D>::followAndOptimize(NodalMetric<D>& followed, double growth)
{
  const Run<D>& all = this->run_;
  // A run of its own, without a growth budget: the sizes decide the number of cells.
  Run<D> run{ all.editor, followed, all.surface, all.options, all.control, all.clock, all.report };
  const auto sized = [&]
  {
    const Clock::Section part(run.clock, Untangled, Sized);
    return followSizes<D>(run, run.report.sizes.predictedCells);
  };
  const bool more = sized();
  // Lengths were followed in the shape in the metric; from here on the caller's measure counts.
  computeQualities<D>(run.editor, followed, run.options.measure, run.options.beta);
  if (!more)
  {
    run.report.stopReason = run.stopped();
    return;
  }
  const auto cells = static_cast<double>(run.report.history.back().cells);
  const double part = std::min(growth, std::max(GrowthAfterSizes, CellsOfTwoNodes<D> / cells));
  const long after = run.mesh().countCells();
  run.growth = std::min(std::lround(part * static_cast<double>(after)), roomToGrow(after));
  const Clock::Section improving(run.clock, Sized, 1.0);
  optimizeWorstFirst<D>(run);
}

/// Undoes everything, and optimizes the mesh with its sizes as they were.
template <int D>
void Optimizer<D>::giveSizesUp(
  const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, double worst)
{
  const Run<D>& run = this->run_;
  restore<D>(this->run_, mesh);
  run.metric = metric;
  this->run_.record("sizes given up");
  run.report.sizes.isGivenUp = true;
  run.report.sizes.worstWithSizes = worst;
  if (!run.clock.hasStopped())
  {
    // Progress was at its end before: it must not go back.
    const Clock::Section part(run.clock, 1.0, 1.0);
    optimizeWorstFirst<D>(this->run_);
  }
}

/// Sizes first, then the worst elements. Gives the sizes up if the worst quality ends up lower than
/// before and lower than the target.
template <int D>
void Optimizer<D>::optimizeSizesToo()
{
  const Run<D>& run = this->run_;
  if (!this->repairForSizes())
  {
    return;
  }
  // As a fraction, since the sizes change the number of cells.
  const double growth = static_cast<double>(run.growth) /
    static_cast<double>(run.report.history.back().cells);
  // Kept in case the sizes have to be given up.
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

/// Looks for what stands in the way of the worst cells, if they have remained worse than the bound
/// and the target. Only of the shape in space, with a surface that stays, more is known than the
/// bound says.
void lowerBoundInSight(const Run<2>&) {}
void lowerBoundInSight(const Run<3>& run)
{
  Report& report = run.report;
  const double worst = report.worstAfter;
  const bool isKnown = infoOf(run.options.measure).bound == FacetBound::BestApex &&
    run.metric.isTrivial() && !run.surface && !run.mesh().hasBorder();
  const bool isWanted = 0.0 < worst && worst < run.options.targetQuality &&
    worst < CapReached * report.bound && !run.clock.hasStopped();
  if (isKnown && isWanted)
  {
    const KeptSurface<3> surface(run.mesh());
    report.bound = boundInSight(surface.points.data(), surface.sides, report.bound,
      stepsInSight(report.history.back().cells));
  }
}
}

/// Qualities are computed first: all later steps trust those that are stored.
template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, Surface<D>* surface)
{
  Report report;
  Clock clock(control);
  MeshEditor<D> editor(mesh);
  if (surface)
  {
    editor.makeRoomForPlaces(); // before editors of chunks may set some
  }
  computeQualities<D>(editor, metric, options.measure, options.beta);
  PassRecord input = summarize(mesh, options.targetQuality, &report.invertedBefore);
  input.stage = "input";
  report.worstBefore = input.worst;
  report.meanBefore = input.mean;
  report.history.push_back(input);

  Run<D> run{ editor, metric, surface, options, control, clock, report };
  const EvaluationCount count;
  Optimizer<D>(run, surface).optimize();
  report.evaluations += count.get(); // of this thread, without those of chunks

  const PassRecord output = summarize(mesh, options.targetQuality, &report.invertedAfter);
  report.worstAfter = output.worst;
  report.meanAfter = output.mean;
  lowerBoundInSight(run);
  if (surface) // two bounds, both certified: the lesser holds
  {
    report.bound = std::min(report.bound, boundOfAngles<D>(*surface, options.measure));
  }
  report.seconds = clock.seconds();
  return report;
}

template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, Surface<2>*);
template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, Surface<3>*);
}
