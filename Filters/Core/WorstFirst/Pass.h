// SPDX-License-Identifier: BSD-3-Clause
/// @file Pass.h
/// One pass of the fast engine: the bad cells are shared out among chunks, and each chunk drains
/// its queue.
#ifndef meshopt_WorstFirst_Pass_h
#define meshopt_WorstFirst_Pass_h

#include "WorstFirst/Reporter.h"
#include "WorstFirst/Tangle.h"
#include "WorstFirst/Worker.h"

namespace meshopt
{
namespace worstfirst
{
/// Makes one pass after the other. What they share stands here: the workers, the borders of the
/// chunks, and what has failed.
template <int D, class Shape>
class Pass
{
public:
  /// All arguments must outlive this object.
  Pass(Workpiece<D, Shape>& workpiece, Allowance<D, Shape>& allowance, GrowthBudget& budget,
    Reporter<D, Shape>& reporter)
    : workpiece_(workpiece)
    , allowance_(allowance)
    , budget_(budget)
    , reporter_(reporter)
    , tangle_(workpiece.mesh(), workpiece.run().report.invertedBefore > 0)
    , chunks_(workpiece.run().editor,
        [this] {
          return std::make_unique<Worker<D, Shape>>(
            this->workpiece_, this->allowance_, this->failures_);
        })
  {
  }

  /// Tries the `bad` cells and adds a row to the history.
  PassResult run(const Task& task, const std::vector<Index>& bad);
  /// Many places around the worst cell may be tried again, as if none had been tried in vain.
  void forgetInVain() { this->inVain_ = { None, 0.0 }; }

private:
  using Counts = std::array<long, NumberOfOperations>;

  void drainAll(const Task& task, const std::vector<Index>& bad);
  void drain(const Task& task, const std::vector<Index>& bad, int mostChunks);
  std::vector<Index> stillBad(double target) const;
  int numberOfChunks(Phase phase, std::size_t numberOfBadCells, int most) const;
  void instruct(const Task& task);
  void gather(const Task& task);
  void noteTries(
    CostModel::Kind kind, Operation operation, const Counts& tried, const Counts& gained);

  Workpiece<D, Shape>& workpiece_;
  Allowance<D, Shape>& allowance_;
  GrowthBudget& budget_;
  Reporter<D, Shape>& reporter_;
  Tangle<D> tangle_;
  FailureMemory failures_;
  ChunkedPass<D, Worker<D, Shape>> chunks_;
  Known inVain_{ None, 0.0 };
  int variant_ = 0;   ///< which of Shifts is next
  PassResult result_; ///< of this pass
};

template <int D, class Shape>
PassResult Pass<D, Shape>::run(const Task& task, const std::vector<Index>& bad)
{
  this->result_ = {};
  this->drainAll(task, bad);
  this->tangle_.setInverted(this->reporter_.record(task, this->result_));
  this->result_.goesOn = this->reporter_.goesOn(task.target);
  return this->result_;
}

/// Drains by chunks; what borders have held up, again with other borders, and what then remains in
/// one chunk.
template <int D, class Shape>
void Pass<D, Shape>::drainAll(const Task& task, const std::vector<Index>& bad)
{
  this->drain(task, bad, MaximumChunks);
  // Past the target they may wait: there are many stages. Before it the next pass would spend more
  // on them than they need. When polishing, it is the same again.
  const bool past = !task.polishes() && task.target > this->workpiece_.target();
  const bool mayWait = past || (task.polishes() && !this->result_.isInVain(bad.size()));
  if (mayWait || this->chunks_.heldUp().empty())
  {
    return;
  }
  // With other borders most of them are inside a chunk.
  std::vector<Index> rest = this->stillBad(task.target);
  for (std::size_t k = 1; k < std::size(Shifts); ++k)
  {
    if (this->numberOfChunks(task.phase, rest.size(), MaximumChunks) > 1)
    {
      this->drain(task, rest, MaximumChunks);
      rest = this->stillBad(task.target);
    }
  }
  // Cells that are long compared with a chunk lie across some border in every drain and must not
  // wait for better ones. This takes one thread only.
  if (!rest.empty())
  {
    this->drain(task, rest, 1);
  }
}

/// Those that are left of cells that borders have held up: others may have improved or removed
/// them.
template <int D, class Shape>
std::vector<Index> Pass<D, Shape>::stillBad(double target) const
{
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  const std::vector<Index>& heldUp = this->chunks_.heldUp();
  std::vector<Index> result;
  std::copy_if(heldUp.begin(), heldUp.end(), std::back_inserter(result),
    [&](Index c) { return mesh.isAlive(c) && mesh.quality(c) < target; });
  return result;
}

/// Shares out the bad cells and tries each, until no queue has a cell left.
template <int D, class Shape>
void Pass<D, Shape>::drain(const Task& task, const std::vector<Index>& bad, int mostChunks)
{
  const int n = this->numberOfChunks(task.phase, bad.size(), mostChunks);
  // Each drain with several chunks takes the next shift, so that a cell held up now is inside a
  // chunk later.
  this->chunks_.open(n, n > 1 ? Shifts[this->variant_++ % std::size(Shifts)] : 0.0, bad);
  this->instruct(task);
  this->chunks_.run(
    this->workpiece_.run().control, [](Worker<D, Shape>& w) { w.work(); },
    [&] { return this->reporter_.goesOn(task.target); });
  this->chunks_.close();
  this->gather(task);
}

/// As many chunks as there is work for. But one if cells may overlap: the checks then look at cells
/// anywhere in the mesh, which may belong to other chunks.
template <int D, class Shape>
int Pass<D, Shape>::numberOfChunks(Phase phase, std::size_t numberOfBadCells, int most) const
{
  const long each = phase == Phase::Polishing ? PolishedPerChunk : BadCellsPerChunk;
  int n = static_cast<int>(
    std::min<long>(this->workpiece_.mesh().numberOfCellSlots() / CellsPerChunk,
      static_cast<long>(numberOfBadCells) / each));
  n -= n % 2; // with an odd number, one of two threads would wait for the other
  return this->tangle_.mayOverlap() ? 1 : std::min(std::max(n, 1), most);
}

/// Tells the workers of all chunks the task, and how much of everything each may use.
template <int D, class Shape>
void Pass<D, Shape>::instruct(const Task& task)
{
  constexpr long any = std::numeric_limits<long>::max();
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const int n = this->chunks_.size();
  const bool onTheWay = !task.polishes() && !(task.target > workpiece.target());
  const bool polishesOnTheWay = task.polishes() && !workpiece.isPast(task.aim);
  // Where the surface takes part, or in a metric, it does not pay to lift one of many bad cells by
  // making others bad: all changes are then guarded at the target. Otherwise the guard only keeps
  // cells from falling below the first stage: with the other rule, kept surfaces of random points
  // end with up to two thirds more cells under .2.
  const bool many = !workpiece.isKeptAndPlain() && onTheWay && task.level > 0 &&
    task.below > workpiece.fewCells();
  const bool wide = polishesOnTheWay && !workpiece.slides() && workpiece.isFarBelowBound();
  // Nodes may vanish also where swaps have used up what may. Where the surface takes part, or in a
  // metric, only at very bad cells.
  // Counted anew for each drain of a pass: the one before may have taken all that may vanish.
  const double nodes = static_cast<double>(workpiece.mesh().countPoints()) /
    static_cast<double>(workpiece.run().report.history.front().points);
  Orders orders;
  const bool countsNodes = workpiece.isKeptAndPlain() || !(task.target > Stages[0]);
  orders.growth = this->budget_.share(task.phase, n, countsNodes ? nodes : 0.0);
  orders.guard = task.polishes() ? -1.0 : many ? task.target : Stages[0];
  orders.guardsAll = workpiece.model().weights || many;
  orders.wide = wide ? this->budget_.mostSwallowed(nodes, WideShrink) : None;
  orders.wideOfWorst = wide ? this->budget_.mostSwallowed(nodes, WideShrinkOfWorst) : None;
  orders.inVain = this->inVain_;
  orders.tries = onTheWay && task.level == Level::LookAhead ? workpiece.fewCells() / n : any;
  orders.looks = polishesOnTheWay ? this->allowance_.looks(n) : any;
  orders.evaluations = this->allowance_.evaluations(task.phase) / n;
  for (int k = 0; k < n; ++k)
  {
    Worker<D, Shape>& w = this->chunks_.worker(k);
    w.judge().setTangled(
      this->tangle_.mayOverlap(), this->tangle_.hasInverted(), this->tangle_.pinched());
    w.begin(task, orders);
  }
}

/// Collects the counts of the workers and the growth that they have left.
template <int D, class Shape>
void Pass<D, Shape>::gather(const Task& task)
{
  long left = 0;
  bool isShort = false;
  Counts tried{}, done{}, gained{}; // in this drain
  for (int k = 0; k < this->chunks_.size(); ++k)
  {
    Worker<D, Shape>& w = this->chunks_.worker(k);
    const Tally& tally = w.tally();
    this->inVain_ = tally.inVain.first != None ? tally.inVain : this->inVain_;
    Judge<D, Shape>& judge = w.judge();
    for (const Demand& demand : { w.usualDemand(), judge.demand() }) // more, if it creeps
    {
      this->failures_.note(demand, this->workpiece_.run().editor.clock());
    }
    left += judge.growth.left;
    isShort |= judge.growth.isShort;
    this->result_.accepted += tally.accepted;
    this->result_.creeps |= tally.creeps;
    for (int i : { 0, 1 })
    {
      this->result_.surface[i] += std::exchange(judge.surfaceChanges[i], 0);
    }
    this->result_.evaluations += tally.evaluations;
    this->workpiece_.run().report.evaluations += tally.evaluations;
    if (task.polishes())
    {
      this->allowance_.noteLooks(judge.tried[static_cast<int>(Operation::LookAhead)]);
    }
    else
    {
      this->allowance_.notePass(tally.evaluations, tally.lifted);
    }
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      tried[op] += std::exchange(judge.tried[op], 0);
      done[op] += std::exchange(judge.done[op], 0);
      gained[op] += std::exchange(judge.gained[op], 0);
    }
  }
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    this->result_.tried[op] += tried[op];
    this->result_.done[op] += done[op];
  }
  if (!task.polishes())
  {
    this->noteTries(CostModel::Insertion, Operation::NodeInsertion, tried, gained);
    this->noteTries(CostModel::Look, Operation::LookAhead, tried, gained);
  }
  this->budget_.takeBack(task.phase, left, isShort);
}

template <int D, class Shape>
void Pass<D, Shape>::noteTries(
  CostModel::Kind kind, Operation operation, const Counts& tried, const Counts& gained)
{
  const auto op = static_cast<int>(operation);
  this->allowance_.noteTries(kind, tried[op], gained[op] * Patience >= tried[op]);
}
}
}

#endif
