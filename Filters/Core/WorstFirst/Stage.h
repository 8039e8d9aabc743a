// SPDX-License-Identifier: BSD-3-Clause
/// @file Stage.h
/// One stage of the fast engine: passes of rising effort towards one target.
#ifndef meshopt_WorstFirst_Stage_h
#define meshopt_WorstFirst_Stage_h

#include "WorstFirst/Pass.h"

namespace meshopt
{
namespace worstfirst
{
template <int D, class Shape>
class Stage
{
public:
  /// All arguments must outlive this object.
  Stage(Workpiece<D, Shape>& workpiece, Allowance<D, Shape>& allowance, Pass<D, Shape>& pass)
    : workpiece_(workpiece)
    , allowance_(allowance)
    , pass_(pass)
  {
  }

  /// Lifts cells above the target, with weighted qualities (Weights.h). False if the run has to
  /// end.
  bool lift(double target);
  /// Polishes the cells under `target`, on the way to `aim`. False if the run has to end.
  bool polish(double target, double aim, double gain)
  {
    return this->run({ Phase::Polishing, target, aim, gain });
  }

  /// Whether the many bad cells are left as they are from now on: see givesUpMany().
  bool leavesMany() const { return this->leavesMany_; }

private:
  bool run(Task task);
  int passesThatRise(const Task& task) const;
  int levelOf(const Task& task) const;
  long collect(const Task& task, std::vector<Index>& bad) const;
  bool isPolishSpent(const Task& task) const;
  bool givesUpMany(const Task& task, long badBefore) const;

  Workpiece<D, Shape>& workpiece_;
  Allowance<D, Shape>& allowance_;
  Pass<D, Shape>& pass_;
  bool leavesMany_ = false;
};

/// Without tiny caps the weights are all one.
template <int D, class Shape>
bool Stage<D, Shape>::lift(double target)
{
  this->workpiece_.weights().switchOn();
  this->allowance_.startStage(target);
  const bool more = this->run({ Phase::Lifting, target, target, this->workpiece_.usualGain() });
  this->workpiece_.weights().switchOff();
  return more;
}

/// Passes of rising effort over the cells under the target, until none is left or they gain hardly
/// anything.
template <int D, class Shape>
bool Stage<D, Shape>::run(Task task)
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  std::vector<Index> bad;
  bool raised = false;
  PassResult result;
  for (task.number = 0; task.number < MaximumPasses; ++task.number)
  {
    // When polishing the first pass is at the highest level: it includes all cheaper operations,
    // and those have just failed on these cells.
    const int last = task.polishes() ? 0 : this->passesThatRise(task);
    task.level = this->levelOf(task);
    const long belowBefore = std::exchange(task.below, this->collect(task, bad));
    // Most cells of a large mesh can be stuck. A pass that does not lift the worst and creeps, or
    // does not make them clearly fewer, then ends the stage.
    const bool idle = !task.polishes() && task.number > last && !raised &&
      task.below > workpiece.fewCells() &&
      (result.creeps || task.below > HardlyFewer * belowBefore);
    if ((bad.empty() && task.number >= last) || idle)
    {
      break;
    }
    const double before = workpiece.worst();
    if (bad.empty())
    {
      continue; // all have failed at this level: a higher one may help
    }
    result = this->pass_.run(task, bad);
    if (task.polishes())
    {
      this->allowance_.notePolish(result.evaluations, workpiece.worst());
    }
    if (!result.goesOn)
    {
      return false;
    }
    raised = workpiece.worst() > before + task.gain;
    if (task.number >= last && !raised && (result.isInVain(bad.size()) || task.gain < Gain))
    {
      break;
    }
    const bool leavesMany = result.creeps && this->givesUpMany(task, belowBefore);
    this->leavesMany_ |= leavesMany;
    if (leavesMany || this->isPolishSpent(task))
    {
      break;
    }
  }
  return true;
}

/// A quick run does not look ahead, with one exception: where the surface takes part, for the few
/// cells that keep it from its target. That costs less than to divide edges at these.
template <int D, class Shape>
int Stage<D, Shape>::passesThatRise(const Task& task) const
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const bool looksAhead = workpiece.slides() && !workpiece.run().dividesEdges &&
    task.target >= workpiece.target() && task.below <= workpiece.fewCells();
  return workpiece.effort() == Effort::Quick && !looksAhead ? 1 : 2;
}

/// It rises from pass to pass.
template <int D, class Shape>
int Stage<D, Shape>::levelOf(const Task& task) const
{
  constexpr int levels[] = { Level::Topology, Level::Insertion, Level::LookAhead };
  // Polishing is for a few cells that all cheaper levels have failed on.
  return task.polishes() ? Level::LongLookAhead
                         : levels[std::min(task.number, this->passesThatRise(task))];
}

/// Collects the cells under the target that are worth a try. Returns how many are under the target
/// and not capped, tried or not. Past the target and when polishing, without those that are left.
template <int D, class Shape>
long Stage<D, Shape>::collect(const Task& task, std::vector<Index>& bad) const
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const SimplexMesh<D>& mesh = workpiece.mesh();
  bad.clear();
  long below = 0;
  const bool leaves = task.polishes() || workpiece.isPast(task.target);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.quality(c) < task.target && mesh.isAlive(c) && !(leaves && workpiece.isLeft(c)) &&
      !workpiece.caps().isCapped(mesh, c))
    {
      ++below;
      if (workpiece.isWorthTrying(c, task.phase, task.level))
      {
        bad.push_back(c);
      }
    }
  }
  return below;
}

/// Whether nothing is left for more passes of polishing. Past the target all may be spent.
template <int D, class Shape>
bool Stage<D, Shape>::isPolishSpent(const Task& task) const
{
  return task.polishes() && !this->workpiece_.isPast(task.aim) &&
    (!this->allowance_.hasLooks() || this->allowance_.evaluations(task.phase) < 0.0 ||
      this->workpiece_.isPolished());
}

/// Whether the many bad cells are left as they are from now on, when the last pass over them crept:
/// the surface, that holds most of such cells, is kept. Only the worst get more effort.
/// `badBefore`: before that pass, 0 before the first one.
template <int D, class Shape>
bool Stage<D, Shape>::givesUpMany(const Task& task, long badBefore) const
{
  const double cells = static_cast<double>(this->workpiece_.mesh().countCells());
  const bool isQuick = this->workpiece_.effort() == Effort::Quick && task.target > Stages[0];
  return !task.polishes() && !this->workpiece_.slides() &&
    ((isQuick && task.below > ManyStuckQuick * cells) ||
      (badBefore > 0 && task.below > HopelesslyMany * badBefore && task.below > ManyStuck * cells));
}
}
}

#endif
