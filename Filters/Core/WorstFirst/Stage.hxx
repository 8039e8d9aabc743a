// SPDX-License-Identifier: BSD-3-Clause
/// @file Stage.hxx
/// One stage of the fast engine: passes of rising effort towards one target.
#ifndef meshopt_WorstFirst_Stage_hxx
#define meshopt_WorstFirst_Stage_hxx

namespace meshopt
{
namespace worstfirst
{
/// A stage with weighted qualities (Weights.h). Without tiny caps it is a plain stage.
template <int D, class Shape>
bool Schedule<D, Shape>::weighedStage(double target)
{
  this->weights_.switchOn();
  const bool more = this->stage(target);
  this->weights_.switchOff();
  return more;
}

/// Passes of rising effort over the cells under the target, until none is left or they gain hardly
/// anything. False if the run has to end.
template <int D, class Shape>
bool Schedule<D, Shape>::stage(double target)
{
  std::vector<Index> bad;
  // Without guard (polishing) the first pass is at the highest level: it includes all cheaper
  // operations, and those have just failed on these cells.
  const int last = this->lifts() ? this->passesThatRise() : 0;
  long below = 0;
  bool raised = false;
  if (this->lifts())
  {
    this->costs_.startStage(target);
  }
  for (int pass = 0; pass < MaximumPasses; ++pass)
  {
    const int level = this->levelOf(pass);
    const long belowBefore = std::exchange(below, this->collect(target, level, bad));
    // Most cells of a large mesh can be stuck. A pass that does not lift the worst and creeps, or
    // does not make them clearly fewer, then ends the stage.
    const bool idle = this->lifts() && pass > last && !raised && below > this->fewCells() &&
      (this->creeps_ || below > HardlyFewer * belowBefore);
    if ((bad.empty() && pass >= last) || idle)
    {
      break;
    }
    const double before = this->worst();
    if (bad.empty())
    {
      continue; // all have failed at this level: a higher one may help
    }
    this->pass({ target, level, below }, bad);
    this->record(target, pass);
    if (!this->lifts())
    {
      this->costs_.notePolish(this->spent_, this->worst());
    }
    if (!this->goesOn(target))
    {
      return false;
    }
    raised = this->worst() > before + this->gain_;
    if (pass >= last && !raised && (this->hardlyAny(bad) || this->gain_ < Gain))
    {
      break;
    }
    const bool isSpent = !this->lifts() && !this->isPast(this->polishTarget_) &&
      (this->looks_ >= this->mostLooks() || this->mostEvaluations() < 0.0);
    const bool leavesMany = this->givesUpMany(target, below, belowBefore);
    this->leavesMany_ |= leavesMany;
    if (isSpent || leavesMany)
    {
      break;
    }
  }
  return true;
}

/// A failed cell is tried again only with more effort, or after something has changed around it.
template <int D, class Shape>
bool Schedule<D, Shape>::worthTrying(Index c, int level) const
{
  const auto& data = this->mesh().cellData(c);
  const auto& nodes = this->mesh().nodes(c);
  return data.stamp == 0 || data.level < rankOf(this->phase_, level) ||
    std::any_of(nodes.begin(), nodes.end(),
      [&](Index p) { return this->mesh().pointData(p).stamp > data.stamp; });
}

/// Collects the cells under the target that are worth a try. Returns how many are under the target
/// and not capped, tried or not. Past the target and when polishing, without those that are left.
template <int D, class Shape>
long Schedule<D, Shape>::collect(double target, int level, std::vector<Index>& bad) const
{
  bad.clear();
  long below = 0;
  const bool leaves = !this->lifts() || this->isPast(target);
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().quality(c) < target && this->mesh().isAlive(c) &&
      !(leaves && this->isLeft(c)) && !this->caps_.isCapped(this->mesh(), c))
    {
      ++below;
      if (this->worthTrying(c, level))
      {
        bad.push_back(c);
      }
    }
  }
  return below;
}

/// The worst quality of the cells that are not left to other runs; 1 if there are none.
template <int D, class Shape>
double Schedule<D, Shape>::findWorstInside() const
{
  double worst = 1.0;
  for (Index c = 0; this->mesh().hasBorder() && c < this->mesh().numberOfCellSlots(); ++c)
  {
    // The quality first: hardly any cell is worse than all before.
    const double q = this->mesh().quality(c);
    worst = q < worst && this->mesh().isAlive(c) && !this->isLeft(c) ? q : worst;
  }
  return worst;
}
}
}

#endif
