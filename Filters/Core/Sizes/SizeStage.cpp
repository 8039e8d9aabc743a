// SPDX-License-Identifier: BSD-3-Clause
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
  , improver_(run.editor, this->model_, run.options, run.surface) // what is capped matters later
  , units_(run.metric)
  , pinched_(pinchedPoints<D>(run.mesh()))
  , overlaps_(!this->pinched_.empty() ||
      (run.report.invertedBefore > 0 && mayOverlap<D>(run.mesh(), this->pinched_)))
{
  this->judge().setTangled(this->overlaps_, false, this->pinched_);
  this->judge().setStampsStars(false);
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
  return this->run_.clock.goesOn(static_cast<double>(this->round_) / MaximumRounds,
    [] { return std::string("making edges as long as wanted"); });
}

template <int D>
void SizeStage<D>::record()
{
  // The history is about the quality that the caller wants.
  computeQualities<D>(
    this->editor_, this->run_.metric, this->options_.measure, this->options_.beta);
  PassRecord& row = this->run_.record("sizes, round " + std::to_string(this->round_ + 1));
  computeQualities<D>(this->editor_, this->run_.metric, Measure::Shape, 0.0);
  row.done = this->judge().done;
  row.tried = this->judge().tried;
  for (const auto& [op, count] : { std::pair{ Operation::NodeInsertion, this->splits_ },
         std::pair{ Operation::EdgeContraction, this->contractions_ },
         std::pair{ Operation::NodeMotion, this->motions_ } })
  {
    row.done[static_cast<int>(op)] += count;
    row.tried[static_cast<int>(op)] += count;
  }
  this->judge().done.fill(0);
  this->judge().tried.fill(0);
  this->splits_ = this->contractions_ = this->motions_ = 0;
}

/// Edges are halved round by round: to split a long edge to the end at once would make its
/// neighbourhood fine in all directions, also where it is to be so in one only.
template <int D>
bool SizeStage<D>::follow(double predicted)
{
  this->run_.report.sizes.predictedCells = predicted;
  this->mostCells_ = BrakeSlack +
    static_cast<long>(BrakeFactor *
      std::clamp(predicted, static_cast<double>(this->mesh().countCells()), MostPredicted));
  this->longest_ = std::max(Longest, 0.5 * this->longestEdge());
  int corrections = 0;
  int last = MaximumRounds;
  long changesBefore = std::numeric_limits<long>::max();
  int idle = 0; // rounds in a row that did not bring changes to an end
  for (this->round_ = 0; this->round_ < last; ++this->round_)
  {
    long changes = this->contract(); // first: what is too fine in one direction is split in another
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
      ++last; // these rounds do not count
      continue;
    }
    const double cells = static_cast<double>(this->run_.report.history.back().cells);
    // The same edges may be split and contracted again round by round: that is an end, too.
    idle = static_cast<double>(changes) > Settling * static_cast<double>(changesBefore) ? idle + 1
                                                                                        : 0;
    changesBefore = changes;
    if (static_cast<double>(changes) > FewChanges * cells && idle < MaximumIdle)
    {
      continue;
    }
    idle = 0;
    const double ratio = cells / predicted;
    // half a cell, as the prediction is no whole number
    const double slack = std::max(CountTolerance * predicted, CellsOfTwoNodes<D> + 0.5);
    if (std::fabs(cells - predicted) < slack || corrections++ == MaximumCorrections ||
      this->run_.metric.isRaised())
    {
      break;
    }
    this->scale_ = std::clamp(
      this->scale_ * std::pow(ratio, 1.0 / D), 1.0 / GreatestScale, GreatestScale);
    this->failedAt_.clear();
  }
  return true;
}
}

template <int D>
bool followSizes(Run<D>& run, double predicted)
{
  const FollowedMetric<D> follows(run.editor, run.metric);
  computeQualities<D>(run.editor, run.metric, Measure::Shape, 0.0);
  return sizes::SizeStage<D>(run).follow(predicted);
}

template bool followSizes<2>(Run<2>&, double);
template bool followSizes<3>(Run<3>&, double);
}
