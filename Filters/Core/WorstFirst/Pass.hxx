// SPDX-License-Identifier: BSD-3-Clause
/// @file Pass.hxx
/// One pass of the fast engine: the bad cells are shared out among chunks, and each chunk drains
/// its queue.
#ifndef meshopt_WorstFirst_Pass_hxx
#define meshopt_WorstFirst_Pass_hxx

namespace meshopt
{
namespace worstfirst
{
/// How many cells count as few: see FewCells.
template <int D, class Shape>
long Schedule<D, Shape>::fewCells() const
{
  const long cells = this->mesh().numberOfCellSlots();
  return std::max({ FewestCells, std::min(FewCells, cells / FewCellsPart), cells / FewOfMany });
}

/// Drains by chunks, and one without borders for what these have held up.
template <int D, class Shape>
void Schedule<D, Shape>::pass(const Task& task, const std::vector<Index>& bad)
{
  this->kept_ = 0;
  this->spent_ = 0;
  this->creeps_ = false;
  this->tried_.fill(0);
  this->done_.fill(0);
  this->surface_.fill(0);
  this->drain(task, bad, MaximumChunks);
  // Past the target they may wait: there are many stages. Before it the next pass would spend more
  // on them than they need. When polishing, it is the same again.
  const bool past = this->lifts() && task.target > this->options_.targetQuality;
  const bool mayWait = past || (!this->lifts() && !this->hardlyAny(bad));
  if (mayWait || this->chunks_.heldUp().empty())
  {
    return;
  }
  // With other borders most of them are inside a chunk.
  std::vector<Index> rest = this->stillBad(task.target);
  for (std::size_t k = 1; k < std::size(Shifts); ++k)
  {
    if (this->numberOfChunks(rest.size(), MaximumChunks) > 1)
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
std::vector<Index> Schedule<D, Shape>::stillBad(double target) const
{
  const std::vector<Index>& heldUp = this->chunks_.heldUp();
  std::vector<Index> result;
  std::copy_if(heldUp.begin(), heldUp.end(), std::back_inserter(result),
    [&](Index c) { return this->mesh().isAlive(c) && this->mesh().quality(c) < target; });
  return result;
}

/// Shares out the bad cells and tries each, until no queue has a cell left.
template <int D, class Shape>
void Schedule<D, Shape>::drain(const Task& task, const std::vector<Index>& bad, int mostChunks)
{
  const int n = this->numberOfChunks(bad.size(), mostChunks);
  // Each drain with several chunks takes the next shift, so that a cell held up now is inside a
  // chunk later.
  this->chunks_.open(n, n > 1 ? Shifts[this->variant_++ % std::size(Shifts)] : 0.0, bad);
  this->instruct(task);
  this->chunks_.run(
    this->run_.control, [&](Worker& w) { this->work(w, task); },
    [&] { return this->goesOn(task.target); });
  this->chunks_.close();
  this->gather();
}

/// As many chunks as there is work for. But one if cells may overlap: the checks then look at cells
/// anywhere in the mesh, which may belong to other chunks.
template <int D, class Shape>
int Schedule<D, Shape>::numberOfChunks(std::size_t numberOfBadCells, int most) const
{
  const long each = this->lifts() ? BadCellsPerChunk : PolishedPerChunk;
  int n = static_cast<int>(std::min<long>(
    this->mesh().numberOfCellSlots() / CellsPerChunk, static_cast<long>(numberOfBadCells) / each));
  n -= n % 2; // with an odd number, one of two threads would wait for the other
  return this->tangle_.mayOverlap() ? 1 : std::min(std::max(n, 1), most);
}

/// Tells the judges of all chunks the task, and how many cells each may add.
template <int D, class Shape>
void Schedule<D, Shape>::instruct(const Task& task)
{
  const int n = this->chunks_.size();
  const bool onTheWay = this->lifts() && !(task.target > this->options_.targetQuality);
  const long few = this->fewCells();
  const long limit = onTheWay && task.level == Level::LookAhead ? few / n
                                                                : std::numeric_limits<long>::max();
  const bool polishes = !this->lifts() && !this->isPast(this->polishTarget_);
  const long looks = polishes ? std::max<long>(1, (this->mostLooks() - this->looks_) / n)
                              : std::numeric_limits<long>::max();
  const double most = this->mostEvaluations() / n;
  // Where many cells are stuck, it does not pay to lift one of them by making others bad: all
  // changes are then guarded at the target. Otherwise the guard only keeps cells from falling below
  // the first stage.
  const bool many = onTheWay && task.level > 0 && task.below > few;
  const double guard = !this->lifts() ? -1.0 : many ? task.target : Stages[0];
  const bool wide = polishes && !this->slides() && this->isFarBelowBound();
  const Growth share = this->budget_.share(this->phase_, n);
  for (int k = 0; k < n; ++k)
  {
    Worker& w = this->chunks_.worker(k);
    Judge<D, Shape>& judge = w.improver.judge();
    judge.growth = share;
    judge.setTangled(
      this->tangle_.mayOverlap(), this->tangle_.hasInverted(), this->tangle_.pinched());
    judge.setTarget(task.target);
    judge.setThorough(!this->model_.plain || (this->lifts() && task.below <= few));
    judge.setWide(wide ? this->budget_.mostSwallowed() : None);
    judge.setGuard(guard, this->model_.weights || many);
    this->demand(judge, task, false);
    w.demand = judge.demand();
    w.kept = w.tries = w.lifted = w.liftedBefore = 0;
    w.creeps = false;
    w.round = 0;
    w.changed.clear();
    w.limit = limit;
    w.looks = looks;
    w.most = most;
    w.isPatient = true;
  }
}

/// What a change of the pass must gain at least. Where many cells are bad, small gains cost more
/// than they help: other changes around the same node follow, and undo them.
template <int D, class Shape>
void Schedule<D, Shape>::demand(Judge<D, Shape>& judge, const Task& task, bool creeps) const
{
  const bool isThrifty = this->isThrifty(task.target, task.below);
  const double least = std::max(isThrifty ? ThriftyGain : 0.0, creeps ? CoarseGain : 0.0);
  judge.setGain(std::max(this->gain_, least), isThrifty ? ThriftySteps : StarSteps);
  judge.setFailuresSince(this->failures_.since(judge.demand()));
}

/// How many evaluations a pass may spend, beside what it earns by lifting cells: see CostModel. Any
/// number in a metric, and where the surface takes part.
template <int D, class Shape>
double Schedule<D, Shape>::mostEvaluations() const
{
  if (!this->model_.plain || this->slides())
  {
    return std::numeric_limits<double>::infinity();
  }
  return this->lifts() ? this->costs_.leftForPass() : this->costs_.leftForPolish();
}

template <int D, class Shape>
bool Schedule<D, Shape>::isSpent(const Worker& w) const
{
  const double earned = this->lifts()
    ? this->costs_.pricePerLifted() * static_cast<double>(w.lifted)
    : 0.0;
  return static_cast<double>(w.evaluations) > w.most + earned;
}

/// Collects the counts of the workers and the growth that they have left.
template <int D, class Shape>
void Schedule<D, Shape>::gather()
{
  long left = 0;
  bool isShort = false;
  std::array<long, NumberOfOperations> tried{}, done{}, gained{}; // in this drain
  for (int k = 0; k < this->chunks_.size(); ++k)
  {
    Worker& w = this->chunks_.worker(k);
    Judge<D, Shape>& judge = w.improver.judge();
    for (const Demand& demand : { w.demand, judge.demand() }) // more, if it creeps
    {
      this->failures_.note(demand, this->run_.editor.clock());
    }
    left += judge.growth.left;
    isShort |= judge.growth.isShort;
    this->kept_ += w.kept;
    this->creeps_ |= w.creeps;
    for (int i : { 0, 1 })
    {
      this->surface_[i] += std::exchange(judge.surfaceChanges[i], 0);
    }
    this->spent_ += w.evaluations;
    if (this->lifts())
    {
      this->costs_.notePass(w.evaluations, w.lifted);
    }
    this->run_.report.evaluations += std::exchange(w.evaluations, 0);
    this->looks_ += this->lifts() ? 0 : judge.tried[static_cast<int>(Operation::LookAhead)];
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      tried[op] += std::exchange(judge.tried[op], 0);
      done[op] += std::exchange(judge.done[op], 0);
      gained[op] += std::exchange(judge.gained[op], 0);
    }
  }
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    this->tried_[op] += tried[op];
    this->done_[op] += done[op];
  }
  const auto note = [&](CostModel::Kind kind, Operation operation)
  {
    const auto op = static_cast<int>(operation);
    this->costs_.noteTries(kind, tried[op], gained[op] * Patience >= tried[op]);
  };
  if (this->lifts())
  {
    note(CostModel::Insertion, Operation::NodeInsertion);
    note(CostModel::Look, Operation::LookAhead);
  }
  this->budget_.takeBack(this->phase_, left, isShort);
}

/// The level of a worker's next try. Insertion and look-ahead are given up for a pass if they
/// hardly ever help. The remaining cells are still tried at a cheap level: a border may have kept
/// them from it until now.
template <int D, class Shape>
int Schedule<D, Shape>::patientLevel(Worker& w, const Task& task, int level) const
{
  const bool inserts = level == Level::Insertion;
  const Judge<D, Shape>& judge = w.improver.judge();
  const long looks = judge.tried[static_cast<int>(Operation::LookAhead)];
  const auto op = static_cast<int>(inserts ? Operation::NodeInsertion : Operation::LookAhead);
  const long tries = judge.tried[op] * (this->model_.plain ? 1 : Hurry);
  // Where the surface takes part, or in a metric, others of the same level help more often.
  const bool others = this->slides() || !this->model_.plain;
  const long helped = others ? w.kept : judge.gained[op];
  const bool isFirst = !(task.target > Stages[0]) && !w.creeps;
  const bool patiently = others || task.below <= this->fewCells();
  const long usual = inserts ? std::max(PatientTries, w.given / (isFirst ? 1 : PatientPart))
    : patiently              ? PatientTries
                             : PatientLooks;
  const long patient = this->isThrifty(task.target, task.below)
    ? this->costs_.patience(inserts ? CostModel::Insertion : CostModel::Look, usual)
    : usual;
  w.isPatient = w.isPatient && w.tries < w.limit && looks < w.looks &&
    (tries < patient || helped * Patience >= tries);
  return w.isPatient ? level : std::min<int>(level, Level::Removal);
}

/// Counts a try, and looks whether more of them pay. Polishing ends after MostPolishTries tries for
/// each of its cells: then its changes make ever more other cells bad.
/// A pass creeps if many tries lift few cells above the target: the same nodes move a little, again
/// and again. From then on a change must gain more. Where many cells are bad, each cell gets one
/// try in a round.
template <int D, class Shape>
void Schedule<D, Shape>::watch(Worker& w, const Task& task)
{
  ++w.tries;
  if (!this->lifts())
  {
    if (w.tries >= MostPolishTries * w.given && !this->slides() && this->model_.plain)
    {
      w.queue = {};
    }
    return;
  }
  const long window = std::max(CreepingTries, w.given / CreepingPart);
  if (w.tries % window == 0 && task.below > this->fewCells() && this->model_.plain)
  {
    const long lift = this->slides() ? CreepingLiftOfSliding : CreepingLift;
    w.creeps = w.creeps || (w.lifted - w.liftedBefore) * lift < window;
    w.liftedBefore = w.lifted;
  }
  if (w.creeps || w.tries > Creeping * w.given)
  {
    this->demand(w.improver.judge(), task, true);
  }
}

/// Whether the queue has a cell left. If not, the next round of a pass that creeps begins with the
/// cells that the last one has changed.
template <int D, class Shape>
bool Schedule<D, Shape>::hasNext(Worker& w) const
{
  if (w.queue.empty() && w.round < CreepingRounds[static_cast<int>(this->options_.effort)])
  {
    ++w.round;
    for (Index c : w.changed)
    {
      if (this->mesh().isAlive(c))
      {
        w.queue.emplace(this->mesh().quality(c), c);
      }
    }
    w.changed.clear();
  }
  return !w.queue.empty();
}

/// Drains the queue of one chunk, up to a number of tries. What remains waits for the next round.
template <int D, class Shape>
void Schedule<D, Shape>::work(Worker& w, const Task& task)
{
  const SimplexMesh<D>& mesh = this->mesh();
  int level = task.level; // once patience has ended it stays low
  EvaluationCount count;
  for (long tries = Tries[level]; tries > 0 && this->hasNext(w) && !this->run_.clock.isOutOfTime();)
  {
    w.evaluations += count.take();
    if (this->isSpent(w))
    {
      w.queue = {};
      break;
    }
    const auto [q, c] = w.queue.top();
    w.queue.pop();
    level = this->patientLevel(w, task, level);
    // The queue is not updated when a quality changes: an entry with another quality is out of
    // date. Cells without hope are skipped before they count as a try.
    if (!mesh.isAlive(c) || mesh.quality(c) != q || !this->worthTrying(c, level) ||
      this->caps_.isCapped(mesh, c))
    {
      continue;
    }
    --tries;
    this->watch(w, task);
    w.editor.resetBlocked();
    if (w.improver.improve(c, level))
    {
      const auto isBad = [&](Index o) { return mesh.isAlive(o) && mesh.quality(o) < task.target; };
      const std::vector<Index>& changed = w.improver.judge().changed();
      ++w.kept;
      w.lifted += mesh.isAlive(c) ? !isBad(c) : std::none_of(changed.begin(), changed.end(), isBad);
      // What the change has made and is still bad is tried again in this pass.
      for (Index o : changed)
      {
        if (isBad(o) && w.creeps)
        {
          w.changed.push_back(o);
        }
        else if (isBad(o))
        {
          w.queue.emplace(mesh.quality(o), o);
        }
      }
    }
    else if (!w.editor.blocked())
    {
      // A failure is remembered only if no border played a part in it: another pass may succeed.
      w.editor.setFailed(c, w.editor.clock(), rankOf(this->phase_, level));
    }
    else
    {
      w.heldUp.push_back(c);
    }
  }
  w.evaluations += count.take();
}
}
}

#endif
