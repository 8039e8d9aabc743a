// SPDX-License-Identifier: BSD-3-Clause
/// @file Report.hxx
/// What the fast engine says of its run: the rows of the history, and why it ends.
#ifndef meshopt_WorstFirst_Report_hxx
#define meshopt_WorstFirst_Report_hxx

namespace meshopt
{
namespace worstfirst
{
/// Adds a row to the history. It shows the true qualities, not the weighted ones.
template <int D, class Shape>
void Schedule<D, Shape>::record(double target, int pass)
{
  long inverted = 0;
  const bool weighed = this->weights_.areOn();
  this->weights_.switchOff();
  PassRecord row = summarize(this->mesh(), this->options_.targetQuality, &inverted);
  this->worstInside_ = this->findWorstInside();
  if (weighed)
  {
    this->weights_.switchOn();
  }
  this->tangle_.setInverted(inverted);
  char name[32];
  std::snprintf(name, sizeof name, this->lifts() ? "towards %.2f, pass %d" : "polish towards %.2f",
    this->lifts() ? target : this->polishTarget_, pass + 1);
  row.stage = name;
  row.tried = this->tried_;
  row.done = this->done_;
  row.surfaceTried = this->surface_[0];
  row.surfaceDone = this->surface_[1];
  const double now = this->run_.clock.seconds();
  row.seconds = now - std::exchange(this->passBegin_, now);
  std::vector<PassRecord>& history = this->run_.report.history;
  if (history.back().stage == row.stage) // the many short passes of one polish become one row
  {
    row.addWork(history.back());
    history.pop_back();
  }
  row.pass = static_cast<int>(history.size());
  history.push_back(row);
}

/// Counts the nodes of the worst cell by their freedom.
template <int D, class Shape>
void Schedule<D, Shape>::noteWorst()
{
  Index worst = None;
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().isAlive(c) &&
      (worst == None || this->mesh().quality(c) < this->mesh().quality(worst)))
    {
      worst = c;
    }
  }
  this->run_.report.worstNodes.fill(0);
  for (int i = 0; worst != None && i <= D; ++i)
  {
    const Freedom freedom = this->mesh().freedom(this->mesh().nodes(worst)[i]);
    ++this->run_.report.worstNodes[static_cast<int>(freedom)];
  }
}

/// Why the run ends, by what is left under the target.
template <int D, class Shape>
StopReason Schedule<D, Shape>::reason()
{
  if (this->slides())
  {
    this->noteWorst();
  }
  long below = 0;
  long& capped = this->run_.report.cappedCells;
  capped = 0; // an earlier run may have set it
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().isAlive(c) && this->mesh().quality(c) < this->options_.targetQuality)
    {
      ++below;
      capped += this->caps_.isCapped(this->mesh(), c);
    }
  }
  if (this->run_.clock.hasStopped())
  {
    return this->run_.stopped();
  }
  return below == 0            ? StopReason::TargetReached
    : below == capped          ? StopReason::CappedBySurface
    : this->budget_.isUsedUp() ? StopReason::GrowthLimit
                               : StopReason::NoFurtherGain;
}
}
}

#endif
