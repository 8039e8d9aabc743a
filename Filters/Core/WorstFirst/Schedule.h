// SPDX-License-Identifier: BSD-3-Clause
/// @file Schedule.h
/// One run of the fast engine for one shape measure: the order of its stages, and when it ends.
/// Included only by the few files that instantiate it.
#ifndef meshopt_WorstFirst_Schedule_h
#define meshopt_WorstFirst_Schedule_h

#include "WorstFirst/Parts.h"
#include "WorstFirst/Polish.h"

namespace meshopt
{
namespace worstfirst
{
/// A schedule runs stages (Stage.h), and polishes the worst cells at the end of some (Polish.h). A
/// stage makes passes (Pass.h). A pass shares out its cells among chunks, and in each chunk a
/// worker tries them (Worker.h). The other parts say what all of these may do: the growth budget,
/// the allowance of tries, and the workpiece, which knows the mesh.
template <int D, class Shape>
class Schedule
{
public:
  Schedule(Run<D>& run, const Shape& shape)
    : begin_(run.clock.seconds())
    , workpiece_(run, shape)
    , budget_(run.options, run.growth, run.mesh().countCells(), this->workpiece_.widthInEdges(),
        !this->workpiece_.model().plain)
    , allowance_(this->workpiece_)
    , reporter_(this->workpiece_, this->begin_)
    , pass_(this->workpiece_, this->allowance_, this->budget_, this->reporter_)
    , stage_(this->workpiece_, this->allowance_, this->pass_)
    , polish_(this->workpiece_, this->allowance_, this->budget_, this->pass_, this->stage_)
  {
  }

  void optimize();

private:
  std::vector<double> targets() const;
  bool runStages(const std::vector<double>& targets);

  double begin_; ///< by the clock
  Workpiece<D, Shape> workpiece_;
  GrowthBudget budget_;
  Allowance<D, Shape> allowance_;
  Reporter<D, Shape> reporter_;
  Pass<D, Shape> pass_;
  Stage<D, Shape> stage_;
  Polish<D, Shape> polish_;
};

/// The stages below the target, then the target. With the best effort also those above it, up to
/// the certified bound.
template <int D, class Shape>
std::vector<double> Schedule<D, Shape>::targets() const
{
  const double target = this->workpiece_.target();
  std::vector<double> result;
  const double first = BeatenBy * this->workpiece_.run().toBeat;
  if (first > 0.0 && first < target)
  {
    result.push_back(first);
  }
  for (double s : Stages)
  {
    // A little below the target, so that a stage equal to it is not run twice.
    if (s >= AboveBeaten * first && s < target - SameTarget)
    {
      result.push_back(s);
    }
  }
  result.push_back(target);
  const double bound = this->workpiece_.bound();
  for (double s : Stages)
  {
    if (this->workpiece_.effort() == Effort::Best && this->workpiece_.isPast(s) &&
      result.back() < bound)
    {
      result.push_back(std::min(s, bound));
    }
  }
  for (double s : StagesOfSliding)
  {
    if (this->workpiece_.effort() == Effort::Best && this->workpiece_.isPast(s) &&
      this->workpiece_.slides() && result.back() < bound)
    {
      result.push_back(std::min(s, bound));
    }
  }
  return result;
}

template <int D, class Shape>
void Schedule<D, Shape>::optimize()
{
  const std::vector<double> targets = this->targets();
  const bool more = this->runStages(targets);
  // The fine polish also makes other cells worse. Bring those that can be repaired back to the
  // target.
  if (more && this->workpiece_.effort() == Effort::Best)
  {
    this->allowance_.endLimits();
    if (this->polish_.run(targets.back(), true))
    {
      this->stage_.lift(this->workpiece_.target());
    }
  }
  this->workpiece_.run().report.stopReason = this->reporter_.reason(this->budget_);
}

/// Stage after stage up to the target, or beyond it. Polishes after the first stage, at the target,
/// and after each stage above it. False if the run has to end, or has not beaten what it should.
template <int D, class Shape>
bool Schedule<D, Shape>::runStages(const std::vector<double>& targets)
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  // The worst of a part may be held by the border nearby. It must not stop the others: other runs
  // take up what is left, and these must be few.
  const int mostIdle = workpiece.mesh().hasBorder() ? MostIdleOfPart : MostIdle;
  bool more = true;
  int idle = 0;
  for (std::size_t k = 0; k < targets.size() && more && idle < mostIdle; ++k)
  {
    const double target = targets[k];
    if (this->stage_.leavesMany() && target < workpiece.target())
    {
      continue;
    }
    const bool past = workpiece.isPast(target);
    if (past)
    {
      this->allowance_.endLimits(); // what is made bad here must be repaired at any price
    }
    this->reporter_.setDone(static_cast<double>(k) / static_cast<double>(targets.size()));
    const double before = workpiece.worst();
    more = this->stage_.lift(target);
    if (more && (k == 0 || past || target == workpiece.target()))
    {
      // Nothing comes after the last stage: it may use the reserve.
      more = this->polish_.runAndRepair(target, k + 1 == targets.size());
    }
    // What comes next is for cells that are better: it seldom helps the worst.
    if (k == 0 && workpiece.worst() < workpiece.run().toBeat)
    {
      return false;
    }
    // Past the target the run ends after some stages that did not lift the worst cell.
    const bool stuck = workpiece.worst() < before + Gain;
    idle = past && stuck ? idle + 1 : 0;
  }
  return more;
}
}

template <int D, class Shape>
void optimizeWith(Run<D>& run, const Shape& shape)
{
  worstfirst::Schedule<D, Shape>(run, shape).optimize();
}
}

#endif
