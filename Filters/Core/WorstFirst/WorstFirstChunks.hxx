// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstFirstChunks.hxx
/// One pass of the fast engine: its bad cells are shared out among chunks, each drains its queue.
#ifndef meshopt_WorstFirst_WorstFirstChunks_hxx
#define meshopt_WorstFirst_WorstFirstChunks_hxx

namespace meshopt
{
namespace worstfirst
{
/// One cell in a hundred, in small meshes more.
template <int D, class Shape>
long WorstFirst<D, Shape>::fewCells() const
{
  const long cells = this->mesh().numberOfCellSlots();
  return std::max({ FewestCells, std::min(FewCells, cells / 20), cells / 100 });
}

/// Chunks, their queues and slots: a function of the mesh and of the bad cells only.
template <int D, class Shape>
void WorstFirst<D, Shape>::distribute(
  double target, int level, const std::vector<Index>& bad, long below, int mostChunks)
{
  const Index cells = this->mesh().numberOfCellSlots();
  const long each = this->guard_ ? BadCellsPerChunk : PolishedPerChunk;
  int n = static_cast<int>(
    std::min<long>(cells / CellsPerChunk, static_cast<long>(bad.size()) / each));
  n -= n % 2; // the odd one would be left to one of two threads
  n = this->tangled_ ? 1 : std::min(std::max(n, 1), mostChunks); // tangled: checks look anywhere
  this->numberOfChunks_ = n;
  if (n > 1)
  {
    this->chunks_.assign(this->editor_, n, Shifts[this->variant_++ % 3]);
  }
  while (static_cast<int>(this->workers_.size()) < n)
  {
    this->workers_.push_back(std::make_unique<Worker>(
      this->editor_, this->model_, this->caps_, this->options_, this->curves_));
  }
  // All slots that are free go round, then the mesh grows, if several are to work at once.
  std::vector<Index>& freeCells = this->editor_.freeCells();
  std::vector<Index>& freePoints = this->editor_.freePoints();
  const Index cellRoom = n > 1 ? 256 + cells / n / 8 : 0;
  const Index pointRoom = n > 1 ? 64 + this->mesh().numberOfPointSlots() / n / 8 : 0;
  this->editor_.growCells(std::max<Index>(0, n * cellRoom - static_cast<Index>(freeCells.size())));
  this->editor_.growPoints(
    std::max<Index>(0, n * pointRoom - static_cast<Index>(freePoints.size())));
  const auto take = [](std::vector<Index>& from, std::size_t count, std::vector<Index>& to)
  {
    to.assign(from.end() - count, from.end());
    from.resize(from.size() - count);
  };
  const bool onTheWay = this->guard_ && !(target > this->options_.targetQuality);
  const long few = this->fewCells();
  const long limit = onTheWay && level == Improver<D, Shape>::LookAhead
    ? few / n
    : std::numeric_limits<long>::max();
  // While many cells are stuck it does not pay to lift one of them by making others bad.
  const bool many = onTheWay && level > 0 && below > few;
  const long reserve = this->guard_ ? this->reserve_ : 0;
  const long most = this->guard_ ? (this->mostGrowth_ - reserve) / n
                                 : std::numeric_limits<long>::max();
  const double guard = !this->guard_ ? -1.0 : many ? target : Stages[0];
  for (int k = 0; k < n; ++k)
  {
    Worker& w = *this->workers_[k];
    w.editor.setOwner(n > 1 ? k : None);
    w.editor.setClock(this->editor_.clock());
    w.editor.setLastMark(this->editor_.lastMark());
    take(freeCells, n > 1 ? cellRoom : freeCells.size(), w.editor.freeCells());
    take(freePoints, n > 1 ? pointRoom : freePoints.size(), w.editor.freePoints());
    w.improver.setGrowth((this->growth_ - reserve) / n, most);
    w.improver.setTangled(this->tangled_, this->inverted_, this->pinched_);
    w.improver.setGain(this->gain_);
    w.improver.setTarget(target, guard, this->model_.weights || many);
    w.heldUp.clear();
    w.kept = w.tries = w.bad = 0;
    w.limit = limit;
    w.isPatient = true;
  }
  if (!this->metric_.isTrivial())
  {
    this->metric_.reserve(this->mesh().numberOfPointSlots() + (n > 1 ? 0 : 1));
  }
  this->heldUp_.clear();
  for (Index c : bad)
  {
    const int k = n > 1 ? this->mesh().pointData(this->mesh().nodes(c)[0]).owner : 0;
    if (this->workers_[k]->editor.owns(c))
    {
      this->workers_[k]->queue.emplace(this->mesh().quality(c), c);
      ++this->workers_[k]->bad;
    }
    else
    {
      this->heldUp_.push_back(c);
    }
  }
}

/// Takes back what the workers hold.
template <int D, class Shape>
void WorstFirst<D, Shape>::gather()
{
  long left = 0;
  for (int k = 0; k < this->numberOfChunks_; ++k)
  {
    Worker& w = *this->workers_[k];
    const auto give = [](std::vector<Index>& from, std::vector<Index>& to)
    {
      to.insert(to.end(), from.begin(), from.end());
      from.clear();
    };
    give(w.editor.freeCells(), this->editor_.freeCells());
    give(w.editor.freePoints(), this->editor_.freePoints());
    this->editor_.setClock(std::max(this->editor_.clock(), w.editor.clock()));
    this->editor_.setLastMark(std::max(this->editor_.lastMark(), w.editor.lastMark()));
    left += w.improver.growth();
    this->isShort_ |= w.improver.isShortOfGrowth();
    this->heldUp_.insert(this->heldUp_.end(), w.heldUp.begin(), w.heldUp.end());
    this->kept_ += w.kept;
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      this->tried_[op] += std::exchange(w.improver.tried[op], 0);
      this->done_[op] += std::exchange(w.improver.done[op], 0);
    }
    w.queue = Queue();
  }
  this->growth_ = left + (this->guard_ ? this->reserve_ : 0);
}

template <int D, class Shape>
void WorstFirst<D, Shape>::pass(double target, int level, const std::vector<Index>& bad, long below)
{
  this->kept_ = 0;
  this->tried_.fill(0);
  this->done_.fill(0);
  this->drain(target, level, bad, below, MaximumChunks);
  // Long cells lie across some border each time: they must not wait for better borders. Past the target
  // there is time for that: stages are many, and one by one costs more than threads bring.
  const bool past = this->guard_ && target > this->options_.targetQuality;
  const auto heldUp = static_cast<long>(this->heldUp_.size());
  const bool many = this->guard_ && heldUp > static_cast<long>(bad.size()) / HeldUpPart;
  if (heldUp > 0 && !past && (many || this->hardlyAny(bad)))
  {
    std::vector<Index> rest;
    std::copy_if(this->heldUp_.begin(), this->heldUp_.end(), std::back_inserter(rest),
      [&](Index c) { return this->mesh().isAlive(c) && this->mesh().quality(c) < target; });
    this->drain(target, level, rest, below, 1);
  }
}

/// Shares the bad cells out and tries each until none gains.
template <int D, class Shape>
void WorstFirst<D, Shape>::drain(
  double target, int level, const std::vector<Index>& bad, long below, int mostChunks)
{
  this->distribute(target, level, bad, below, mostChunks);
  // The most work first, so that the threads end at about the same time; the result is the same.
  std::vector<int> order(this->numberOfChunks_);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return this->workers_[a]->bad > this->workers_[b]->bad; });
  const auto body = [&](int k) { this->work(*this->workers_[order[k]], target, level); };
  bool more = true;
  while (more && this->keepGoing(target))
  {
    if (this->numberOfChunks_ > 1 && this->control_.parallelFor)
    {
      this->control_.parallelFor(this->numberOfChunks_, body);
    }
    else
    {
      for (int k = 0; k < this->numberOfChunks_; ++k)
      {
        body(k);
      }
    }
    more = false;
    for (int k = 0; k < this->numberOfChunks_; ++k)
    {
      more |= !this->workers_[k]->queue.empty();
    }
  }
  this->gather();
}

/// Drains the queue of one chunk, up to a number of tries.
template <int D, class Shape>
void WorstFirst<D, Shape>::work(Worker& w, double target, int level)
{
  const SimplexMesh<D>& mesh = this->mesh();
  for (long tries = Tries[level]; tries > 0 && !w.queue.empty() && !this->outOfTime();)
  {
    const auto [q, c] = w.queue.top();
    w.queue.pop();
    // Without patience cells are still tried cheaply: a border may have kept them from it before.
    const long more = this->model_.plain ? 1 : Hurry;
    const long patient = level == Improver<D, Shape>::Insertion
      ? std::max(PatientTries, w.bad / PatientPart)
      : PatientTries;
    w.isPatient = w.isPatient && w.tries < w.limit &&
      (w.tries * more < patient || w.kept * Patience[level] >= w.tries * more);
    level = w.isPatient ? level : Improver<D, Shape>::Topology;
    if (!mesh.isAlive(c) || mesh.quality(c) != q || !this->worthTrying(c, level) ||
      this->caps_.isCapped(mesh, c))
    {
      continue;
    }
    --tries;
    if (++w.tries > Creeping * w.bad && this->guard_)
    {
      w.improver.setGain(std::max(this->gain_, CoarseGain));
    }
    w.editor.resetBlocked();
    if (w.improver.improve(c, level))
    {
      ++w.kept;
      for (Index changed : w.improver.changed())
      {
        if (mesh.isAlive(changed) && mesh.quality(changed) < target)
        {
          w.queue.emplace(mesh.quality(changed), changed);
        }
      }
    }
    else if (!w.editor.blocked())
    {
      w.editor.setFailed(c, w.editor.clock(), this->rank(level));
    }
    else
    {
      w.heldUp.push_back(c);
    }
  }
}
}
}

#endif
