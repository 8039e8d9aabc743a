// SPDX-License-Identifier: BSD-3-Clause
/// @file Worker.h
/// Drains the queue of one chunk: again and again its worst cell is tried.
#ifndef meshopt_WorstFirst_Worker_h
#define meshopt_WorstFirst_Worker_h

#include "Run/ChunkedPass.h"
#include "Run/Improver.h"
#include "WorstFirst/Allowance.h"

#include <utility>

namespace meshopt
{
namespace worstfirst
{
/// A cell, and its quality at some time. None: no cell.
using Known = std::pair<Index, double>;

/// What a chunk may do in a pass.
struct Orders
{
  Growth growth;
  double guard;              ///< see Judge::setGuard()
  bool guardsAll;            ///< the same
  int wide;                  ///< see Judge::setWide()
  int wideOfWorst;           ///< the same for the worst cell
  long tries;                ///< the most above the lowest level
  long looks;                ///< the most look-aheads
  double evaluations;        ///< the most, beside those that it earns
  Known inVain{ None, 0.0 }; ///< for this cell many places were tried in vain
};

/// What a chunk has done in a pass.
struct Tally
{
  std::int64_t evaluations = 0;
  long accepted = 0, tries = 0; ///< changes; cells
  long lifted = 0;              ///< cells
  bool creeps = false;          ///< see Worker::watch()
  Known inVain{ None, 0.0 };    ///< see Orders
};

/// Workers are kept from pass to pass. Several are at work at the same time: what they share, they
/// only read.
template <int D, class Shape>
class Worker : public ChunkWorker<D>
{
public:
  /// All arguments must outlive the worker. `failures`: of earlier passes.
  Worker(const Workpiece<D, Shape>& workpiece, const Allowance<D, Shape>& allowance,
    const FailureMemory& failures)
    : ChunkWorker<D>(workpiece.run().editor)
    , workpiece_(workpiece)
    , allowance_(allowance)
    , failures_(failures)
    , improver_(this->editor, workpiece.model(), workpiece.options(), workpiece.run().surface,
        &workpiece.caps())
    , usualDemand_(this->judge().demand())
  {
  }

  /// Begins a pass. The task must exist until its end.
  void begin(const Task& task, const Orders& orders);
  /// Drains the queue, up to a number of tries. What remains waits for the next round.
  void work();

  Judge<D, Shape>& judge() { return this->improver_.judge(); }
  const Judge<D, Shape>& judge() const { return this->improver_.judge(); }
  const Tally& tally() const { return this->tally_; }
  /// What changes had to bring when the pass began.
  const Demand& usualDemand() const { return this->usualDemand_; }

private:
  void demand(bool creeps);
  bool hasNext();
  bool isSpent() const;
  int patientLevel(int level);
  bool mayLookAhead();
  void watch();
  void noteSuccess(Index c);

  const Workpiece<D, Shape>& workpiece_;
  const Allowance<D, Shape>& allowance_;
  const FailureMemory& failures_;
  Improver<D, Shape> improver_;

  const Task* task_ = nullptr;
  Orders orders_{};
  Tally tally_;
  Demand usualDemand_;
  bool isPatient_ = true; ///< insertion and look-ahead are still tried
  // of a pass that creeps
  long liftedBefore_ = 0; ///< when watch() looked last
  int round_ = 0;
  std::vector<Index> changed_; ///< cells for the next round
};

template <int D, class Shape>
void Worker<D, Shape>::begin(const Task& task, const Orders& orders)
{
  this->task_ = &task;
  this->orders_ = orders;
  this->tally_ = {};
  this->isPatient_ = true;
  this->liftedBefore_ = 0;
  this->round_ = 0;
  this->changed_.clear();
  Judge<D, Shape>& judge = this->judge();
  judge.growth = orders.growth;
  judge.setTarget(task.target);
  judge.setThorough(!this->workpiece_.model().plain ||
    (!task.polishes() && task.below <= this->workpiece_.fewCells()));
  judge.setWide(orders.wide);
  judge.setGuard(orders.guard, orders.guardsAll);
  this->demand(false);
  this->usualDemand_ = judge.demand();
}

/// What a change must gain at least. Where many cells are bad, small gains cost more than they
/// help: other changes around the same node follow, and undo them.
template <int D, class Shape>
void Worker<D, Shape>::demand(bool creeps)
{
  const bool isThrifty = this->allowance_.isThrifty(*this->task_);
  const double least = std::max(isThrifty ? ThriftyGain : 0.0, creeps ? CoarseGain : 0.0);
  Judge<D, Shape>& judge = this->judge();
  judge.setGain(std::max(this->task_->gain, least), isThrifty ? ThriftySteps : StarSteps);
  judge.setFailuresSince(this->failures_.since(judge.demand()));
}

template <int D, class Shape>
void Worker<D, Shape>::work()
{
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  const Phase phase = this->task_->phase;
  int level = this->task_->level; // once patience has ended it stays low
  EvaluationCount count;
  for (long tries = Tries[level];
       tries > 0 && this->hasNext() && !this->workpiece_.run().clock.isOutOfTime();)
  {
    this->tally_.evaluations += count.take();
    if (this->isSpent())
    {
      this->queue = {};
      break;
    }
    const auto [q, c] = this->queue.top();
    this->queue.pop();
    level = this->patientLevel(level);
    this->judge().setLooksAhead(this->mayLookAhead());
    const bool isWorst = !(q > this->workpiece_.worst());
    const bool isPatient = isWorst && this->orders_.wideOfWorst != None &&
      this->orders_.inVain != Known(c, q);
    this->judge().setWide(isWorst ? this->orders_.wideOfWorst : this->orders_.wide, isPatient);
    // The queue is not updated when a quality changes: an entry with another quality is out of
    // date. Cells without hope are skipped before they count as a try.
    if (!mesh.isAlive(c) || mesh.quality(c) != q ||
      !this->workpiece_.isWorthTrying(c, phase, level) || this->workpiece_.caps().isCapped(mesh, c))
    {
      continue;
    }
    --tries;
    this->watch();
    this->editor.resetHeldUp();
    if (this->improver_.improve(c, level))
    {
      this->noteSuccess(c);
    }
    else if (!this->editor.isHeldUp())
    {
      // A failure is remembered only if no border played a part in it: another pass may succeed.
      this->editor.setFailed(c, this->editor.clock(), rankOf(phase, level));
      this->tally_.inVain = isPatient ? Known(c, q) : this->tally_.inVain;
    }
    else
    {
      this->heldUp.push_back(c);
    }
  }
  this->tally_.evaluations += count.take();
}

/// Counts a change that has helped cell c. What it has made and is still bad is tried again in this
/// pass.
template <int D, class Shape>
void Worker<D, Shape>::noteSuccess(Index c)
{
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  const auto isBad = [&](Index o)
  { return mesh.isAlive(o) && mesh.quality(o) < this->task_->target; };
  const std::vector<Index>& changed = this->judge().changed();
  ++this->tally_.accepted;
  this->tally_.lifted += mesh.isAlive(c) ? !isBad(c)
                                         : std::none_of(changed.begin(), changed.end(), isBad);
  for (Index o : changed)
  {
    if (isBad(o) && this->tally_.creeps)
    {
      this->changed_.push_back(o);
    }
    else if (isBad(o))
    {
      this->queue.emplace(mesh.quality(o), o);
    }
  }
}

/// Whether the queue has a cell left. If not, the next round of a pass that creeps begins with the
/// cells that the last one has changed.
template <int D, class Shape>
bool Worker<D, Shape>::hasNext()
{
  const int rounds = CreepingRounds[static_cast<int>(this->workpiece_.effort())];
  if (this->queue.empty() && this->round_ < rounds)
  {
    ++this->round_;
    for (Index c : this->changed_)
    {
      if (this->workpiece_.mesh().isAlive(c))
      {
        this->queue.emplace(this->workpiece_.mesh().quality(c), c);
      }
    }
    this->changed_.clear();
  }
  return !this->queue.empty();
}

template <int D, class Shape>
bool Worker<D, Shape>::isSpent() const
{
  const double earned = this->allowance_.earned(this->task_->phase, this->tally_.lifted);
  return static_cast<double>(this->tally_.evaluations) > this->orders_.evaluations + earned;
}

/// The level of the next try. Insertion and look-ahead are given up for a pass if they hardly ever
/// help. The remaining cells are still tried at a cheap level: a border may have kept them from it
/// until now.
template <int D, class Shape>
int Worker<D, Shape>::patientLevel(int level)
{
  const Task& task = *this->task_;
  const bool inserts = level == Level::Insertion;
  const Judge<D, Shape>& judge = this->judge();
  const bool isPlain = this->workpiece_.model().plain;
  const long looks = judge.tried[static_cast<int>(Operation::LookAhead)];
  const auto op = static_cast<int>(inserts ? Operation::NodeInsertion : Operation::LookAhead);
  const long tries = judge.tried[op] * (isPlain ? 1 : Hurry);
  // Where the surface takes part, or in a metric, others of the same level help more often.
  const bool others = !this->workpiece_.isKeptAndPlain();
  const long helped = others ? this->tally_.accepted : judge.gained[op];
  const bool isFirst = !(task.target > Stages[0]) && !this->tally_.creeps;
  const bool patiently = others || task.below <= this->workpiece_.fewCells();
  const long usual = inserts ? std::max(PatientTries, this->given / (isFirst ? 1 : PatientPart))
    : patiently              ? PatientTries
                             : PatientLooks;
  const long patient = this->allowance_.patience(
    task, inserts ? CostModel::Insertion : CostModel::Look, usual);
  this->isPatient_ = this->isPatient_ && this->tally_.tries < this->orders_.tries &&
    looks < this->orders_.looks && (tries < patient || helped * Patience >= tries);
  return this->isPatient_ ? level : std::min<int>(level, Level::Removal);
}

/// Whether look-ahead is still tried. Where the surface takes part, other operations of its level
/// help more often, so that it alone is given up.
template <int D, class Shape>
bool Worker<D, Shape>::mayLookAhead()
{
  const auto op = static_cast<int>(Operation::LookAhead);
  const Judge<D, Shape>& judge = this->judge();
  const bool isLifting = this->workpiece_.slides() && !this->task_->polishes();
  return !isLifting ||
    judge.tried[op] < this->allowance_.patienceOfSliding(PatientLooksOfSliding) ||
    judge.gained[op] * Patience >= judge.tried[op];
}

/// Counts a try, and looks whether more of them pay. Polishing ends after MostPolishTries tries for
/// each of its cells: then its changes make ever more other cells bad.
/// A pass creeps if many tries lift few cells above the target: the same nodes move a little, again
/// and again. From then on a change must gain more. Where many cells are bad, each cell gets one
/// try in a round.
template <int D, class Shape>
void Worker<D, Shape>::watch()
{
  Tally& tally = this->tally_;
  const bool isPlain = this->workpiece_.model().plain;
  ++tally.tries;
  if (this->task_->polishes())
  {
    if (tally.tries >= MostPolishTries * this->given && !this->workpiece_.slides() && isPlain)
    {
      this->queue = {};
    }
    return;
  }
  const long window = std::max(CreepingTries, this->given / CreepingPart);
  if (tally.tries % window == 0 && this->task_->below > this->workpiece_.fewCells() && isPlain)
  {
    const bool isQuick = this->workpiece_.effort() == Effort::Quick && !this->workpiece_.slides();
    const long lift = isQuick ? CreepingLiftOfQuick : CreepingLift;
    tally.creeps = tally.creeps || (tally.lifted - this->liftedBefore_) * lift < window;
    this->liftedBefore_ = tally.lifted;
  }
  if (tally.creeps || tally.tries > Creeping * this->given)
  {
    this->demand(true);
  }
}
}
}

#endif
