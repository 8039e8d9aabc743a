// SPDX-License-Identifier: BSD-3-Clause
// The rounds of the size stage: contract, split, contract, smooth, until few edges change; then h*
// is corrected if the number of cells is not the predicted one.
#include "Sizes/SizeStage.h"

#include "Sizes/SizeStageRun.h"

namespace meshopt
{
namespace sizes
{
template <int D>
SizeStage<D>::SizeStage(Run<D>& run)
  : run_(run)
  , editor_(run.editor)
  , options_(run.options)
  , model_(run.mesh(), run.metric, 0.0)
  , improver_(run.editor, this->model_, run.options, run.surface) // caps are for the engine later
  , units_(run.metric)
  , pinched_(pinchedPoints<D>(run.mesh()))
  , tangled_(!this->pinched_.empty() || run.mesh().numberOfFoldedFacets() > 0 ||
      hasLostSigns(run.mesh()) ||
      (run.report.invertedBefore > 0 && mayOverlap<D>(run.mesh(), this->pinched_)))
{
  // Inverted cells are excluded by the precondition; nodes are stamped one by one (see moveNode()).
  this->judge().setTangled(this->tangled_, false, this->pinched_);
  // A stamp on every node of a star would make each move look like a change at all neighbours.
  this->judge().setStampsStars(false);
  // The tensors follow the points only from now on: compute those of the points that are there.
  this->editor_.attach(this->units_);
  for (Index p = 0; p < this->mesh().numberOfPointSlots(); ++p)
  {
    if (this->mesh().isPointAlive(p))
    {
      this->units_.update(p);
    }
  }
}

template <int D>
bool SizeStage<D>::goesOn()
{
  this->isStopped_ = this->isStopped_ ||
    !this->run_.clock.goesOn(static_cast<double>(this->round_) / MaximumRounds,
      [] { return std::string("making edges as long as wanted"); });
  return !this->isStopped_;
}

/// To be asked before each edge or node: looks at the clock now and then.
template <int D>
bool SizeStage<D>::triesMore()
{
  return ++this->tries_ % TriesPerLook == 0 ? this->goesOn() : !this->isStopped_;
}

template <int D>
void SizeStage<D>::record()
{
  // The history shows the quality that the caller wants; the stage itself works with the shape.
  computeQualities<D>(
    this->editor_, this->run_.metric, this->options_.measure, this->options_.beta);
  this->run_.record("sizes, round " + std::to_string(this->round_ + 1), this->judge());
  computeQualities<D>(this->editor_, this->run_.metric, Measure::Shape, 0.0);
  // The next row of the history counts from here.
  this->judge().done.fill(0);
  this->judge().tried.fill(0);
}

/// Edges are halved round by round. To split one long edge to the end at once would refine its
/// neighbourhood in all directions, also where only one direction has to be fine.
template <int D>
bool SizeStage<D>::follow(double predicted)
{
  this->run_.report.sizes.predictedCells = predicted;
  const long cells = this->mesh().countCells();
  // Clamped before it becomes a whole number: a prediction may have any size.
  this->mostCells_ = BrakeSlack +
    static_cast<long>(
      BrakeFactor * std::clamp(predicted, static_cast<double>(cells), MostPredicted));
  // In any case no more than ids can number.
  this->mostCells_ = std::min(this->mostCells_, cells + roomToGrow(cells));
  // Beginning with the longest edges, the target for splitting is halved in each round. Only the
  // rounds after that count.
  this->longest_ = std::max(Longest, 0.5 * this->longestEdge());
  int corrections = 0;
  int last = MaximumRounds;
  long changesBefore = std::numeric_limits<long>::max();
  int idle = 0; // consecutive rounds in which changes did not settle
  for (this->round_ = 0; this->round_ < last; ++this->round_)
  {
    long changes = this->contract(); // first, else cells too fine one way are split the other
    changes += this->split();
    changes += this->contract();
    this->smooth();
    this->record();
    if (!this->goesOn())
    {
      return false;
    }
    if (this->longest_ > Longest)
    {
      this->longest_ = std::max(Longest, 0.5 * this->longest_);
      ++last; // does not count as a round
      continue;
    }
    const double cells = static_cast<double>(this->run_.report.history.back().cells);
    // The same edges may be split and contracted in every round: this ends the rounds, too.
    idle = static_cast<double>(changes) > Settling * static_cast<double>(changesBefore) ? idle + 1
                                                                                        : 0;
    changesBefore = changes;
    if (static_cast<double>(changes) > FewChanges * cells && idle < MaximumIdle)
    {
      continue;
    }
    idle = 0;
    const double ratio = cells / predicted;
    // plus half a cell, since the prediction is not a whole number
    // A raised metric is not corrected: fewer elements than predicted are enough for it.
    const double slack = std::max(CountTolerance * predicted, CellsOfTwoNodes<D> + 0.5);
    if (std::fabs(cells - predicted) < slack || corrections++ == MaximumCorrections ||
      this->run_.metric.isRaised())
    {
      break;
    }
    // The number of cells goes with h*^-D. The limit holds for all corrections together.
    this->scale_ = std::clamp(
      this->scale_ * std::pow(ratio, 1.0 / D), 1.0 / GreatestScale, GreatestScale);
    // With another scale all nodes are worth a try again.
    this->failedAt_.clear();
  }
  return true;
}
}

/// In the shape in the metric, without a size factor: lengths are what the stage itself looks at.
template <int D>
bool followSizes(Run<D>& run, double predicted)
{
  // As long as this lives, the metric is sampled again where points move or come.
  const FollowedMetric<D> follows(run.editor, run.metric);
  computeQualities<D>(run.editor, run.metric, Measure::Shape, 0.0);
  return sizes::SizeStage<D>(run).follow(predicted);
}

template bool followSizes<2>(Run<2>&, double);
template bool followSizes<3>(Run<3>&, double);
}
