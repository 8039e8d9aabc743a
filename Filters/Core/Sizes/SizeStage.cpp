// SPDX-License-Identifier: BSD-3-Clause
#include "Sizes/SizeStage.h"

#include "Sizes/SizeStageRun.h"

namespace meshopt
{
namespace sizes
{
template <int D>
SizeStage<D>::SizeStage(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, const BoundaryCurves* curves, Report& report)
  : editor_(editor)
  , metric_(metric)
  , options_(options)
  , curves_(curves)
  , report_(report)
  , progress_(control)
  , model_(editor.mesh(), metric, 0.0)
  , improver_(editor, this->model_, this->caps_, options)
  , pinched_(pinchedPoints<D>(editor.mesh()))
  , overlaps_(!this->pinched_.empty() ||
      (report.invertedBefore > 0 && mayOverlap<D>(editor.mesh(), this->pinched_)))
{
  this->improver_.setTangled(this->overlaps_, false, this->pinched_);
  this->improver_.setGrowth(std::numeric_limits<long>::max() / 2);
  for (Index p = 0; p < this->mesh().numberOfPointSlots(); ++p)
  {
    if (this->mesh().isPointAlive(p))
    {
      this->sample(p, None);
    }
  }
}

template <int D>
bool SizeStage<D>::keepGoing()
{
  const bool inTime = this->options_.timeLimit <= 0.0 ||
    std::chrono::duration<double>(std::chrono::steady_clock::now() - this->begin_).count() <
      this->options_.timeLimit;
  return inTime &&
    this->progress_.report(static_cast<double>(this->round_) / MaximumRounds,
      [] { return std::string("making edges as long as wanted"); });
}

template <int D>
void SizeStage<D>::record()
{
  // The history is about the quality that the caller wants.
  computeQualities<D>(this->editor_, this->metric_, this->options_.measure, this->options_.beta);
  PassRecord row = summarize(this->mesh(), this->options_.targetQuality);
  computeQualities<D>(this->editor_, this->metric_, Measure::Shape, 0.0);
  row.stage = "sizes, round " + std::to_string(this->round_ + 1);
  row.done = this->improver_.done;
  row.tried = this->improver_.tried;
  for (const auto& [op, count] : { std::pair{ Operation::NodeInsertion, this->splits_ },
         std::pair{ Operation::EdgeContraction, this->contractions_ },
         std::pair{ Operation::NodeMotion, this->motions_ } })
  {
    row.done[static_cast<int>(op)] += count;
    row.tried[static_cast<int>(op)] += count;
  }
  this->improver_.done.fill(0);
  this->improver_.tried.fill(0);
  this->splits_ = this->contractions_ = this->motions_ = 0;
  row.pass = static_cast<int>(this->report_.history.size());
  this->report_.history.push_back(row);
}

/// Edges are halved round by round: to split a long edge to the end at once would make its
/// neighbourhood fine in all directions, also where it is to be so in one only.
template <int D>
bool SizeStage<D>::run(double predicted)
{
  this->report_.sizes.predictedCells = predicted;
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
    if (!this->keepGoing())
    {
      return false;
    }
    if (this->longest_ > Longest)
    {
      this->longest_ = std::max(Longest, 0.5 * this->longest_);
      ++last; // these rounds do not count
      continue;
    }
    const double cells = static_cast<double>(this->report_.history.back().cells);
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
      this->metric_.isRaised())
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
bool followSizes(MeshEditor<D>& editor, NodalMetric<D>& metric, double predicted,
  const Options& options, const Control& control, const BoundaryCurves* curves, Report& report)
{
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  return sizes::SizeStage<D>(editor, metric, options, control, curves, report).run(predicted);
}

template bool followSizes<2>(MeshEditor<2>&, NodalMetric<2>&, double, const Options&,
  const Control&, const BoundaryCurves*, Report&);
template bool followSizes<3>(MeshEditor<3>&, NodalMetric<3>&, double, const Options&,
  const Control&, const BoundaryCurves*, Report&);
}
