// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStageEdges.hxx
/// The edges of SizeStage: measured, split, contracted, swapped.
#ifndef meshopt_Sizes_SizeStageEdges_hxx
#define meshopt_Sizes_SizeStageEdges_hxx

namespace meshopt
{
namespace sizes
{
template <int D>
double SizeStage<D>::length(Index a, Index b) const
{
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  // Each end sees the edge in its own tensor; the logarithmic mean is the length if the size varies
  // geometrically in between.
  return logMeanLength(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) /
    this->scale_;
}

/// Queues the edges of the cell that are too long, or those that are too short.
template <int D>
void SizeStage<D>::push(Index c, bool isLong)
{
  for (const auto& e : Local<D>::edges)
  {
    const Index p = this->mesh().nodes(c)[e[0]], q = this->mesh().nodes(c)[e[1]];
    // Sorted ends: each of the cells at the edge must get the same length, bit for bit.
    const Index a = std::min(p, q), b = std::max(p, q);
    const double l = this->length(a, b);
    if (isLong ? l > this->longest_ : l < Shortest)
    {
      // The queue gives the largest first: the shortest edge is the one with the largest negative
      // length.
      this->queue_.push({ isLong ? l : -l, a, b, c });
    }
  }
}

template <int D>
void SizeStage<D>::collectQueue(bool isLong)
{
  this->queue_ = Queue();
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().isAlive(c))
    {
      // An edge comes once for each of its cells. After its change isThere() fails for the others.
      this->push(c, isLong);
    }
  }
}

/// After a replacement: swaps edges near the new cells as long as that helps. Cells that are left
/// alone go to push().
template <int D>
template <class Push>
void SizeStage<D>::swapAround(Push&& push)
{
  this->stack_ = this->editor_.created();
  while (!this->stack_.empty())
  {
    const Index c = this->stack_.back();
    this->stack_.pop_back();
    // A swap may have taken the cell while it was waiting.
    if (!this->mesh().isAlive(c))
    {
      continue;
    }
    if (this->options_.reconnect && this->mesh().quality(c) < SwapBelow<D> &&
      this->improver_.swap(c))
    {
      const std::vector<Index>& changed = this->judge().changed();
      this->stack_.insert(this->stack_.end(), changed.begin(), changed.end());
    }
    else
    {
      push(c);
    }
  }
}

// --- edges that are too long

template <int D>
double SizeStage<D>::longestEdge() const
{
  double longest = 0.0;
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    for (int e = 0; this->mesh().isAlive(c) && e < Local<D>::numberOfEdges; ++e)
    {
      const Simplex<D>& nodes = this->mesh().nodes(c);
      longest = std::max(
        longest, this->length(nodes[Local<D>::edges[e][0]], nodes[Local<D>::edges[e][1]]));
    }
  }
  return longest;
}

/// True if no cell has an edge that is much longer: such an edge must be split first. If it must
/// stay (on the kept surface), sizes can only become finer from layer to layer.
template <int D>
bool SizeStage<D>::isAboutLongest(const std::vector<Index>& cells, double length) const
{
  for (Index c : cells)
  {
    for (const auto& e : Local<D>::edges)
    {
      if (LongestFirst * this->length(this->mesh().nodes(c)[e[0]], this->mesh().nodes(c)[e[1]]) >
        length)
      {
        return false;
      }
    }
  }
  return true;
}

/// Whether the cell still has the edge: it may have changed since the edge was queued.
template <int D>
bool SizeStage<D>::isThere(const Edge& edge) const
{
  return this->mesh().isAlive(edge.cell) && this->mesh().localIndex(edge.cell, edge.a) >= 0 &&
    this->mesh().localIndex(edge.cell, edge.b) >= 0;
}

/// The longest edge first. What a split leaves too long joins the queue.
template <int D>
long SizeStage<D>::split()
{
  long done = 0, cells = this->mesh().countCells();
  long& cellsAtBrake = this->run_.report.sizes.cellsAtBrake;
  this->collectQueue(true);
  while (
    !this->queue_.empty() && this->options_.insertNodes && cellsAtBrake == 0 && this->triesMore())
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    if (!this->isThere(edge) || !this->splitEdge(edge))
    {
      continue;
    }
    ++done;
    cells += this->proposal_.growth();
    // The brake is for good: cellsAtBrake also ends the splitting of later rounds.
    cellsAtBrake = cells > this->mostCells_ ? cells : 0;
    this->swapAround([this](Index c) { this->push(c, true); });
  }
  return done;
}

/// The span of the edge on a curve of the surface, if it is kept and on a curve.
template <int D>
std::optional<Span> SizeStage<D>::spanOf(const Edge& edge, bool& isKept) const
{
  const int e = this->mesh().localEdge(edge.cell, edge.a, edge.b);
  isKept = e >= 0 && this->mesh().isEdgeKept(edge.cell, e);
  return isKept && this->run_.surface ? this->run_.surface->span(this->mesh(), edge.a, edge.b)
                                      : std::nullopt;
}

/// Splits the edge near its middle in the metric, if the judge agrees.
template <int D>
bool SizeStage<D>::splitEdge(const Edge& edge)
{
  const Index a = edge.a, b = edge.b;
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  // Exact halves would make a grid of equal triangles of half or twice the wanted size, in which no
  // change gains.
  const double t = metricMiddle(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) +
    Jitter * noise(a, b);
  bool isKept = false;
  const std::optional<Span> span = this->spanOf(edge, isKept);
  // A kept edge that lies on no curve has no place for a new node.
  if (isKept && !span)
  {
    return false;
  }
  Vec<D> x = this->mesh().point(a) + t * e;
  Place place;
  if (span)
  {
    place = { Freedom::Curve, span->part, span->from + t * (span->to - span->from) };
    x = this->run_.surface->at(span->part, place.parameter);
  }
  // The new node must be there before cells with it can be measured: a refusal takes it back.
  const auto mark = this->judge().begin();
  const Index p = this->editor_.addPoint(x, a, place);
  Proposal<D>& proposal = this->proposal_;
  bool done = p != None &&
    proposeSplit(this->editor_, this->run_.surface, { edge.cell, a, b, p }, proposal) &&
    this->isAboutLongest(proposal.cavity, edge.length);
  if (done)
  {
    // The halves of a cell are worse at first: a split may lower the worst quality to this part.
    proposal.least = std::min(WorstSplit * proposal.oldWorst, GoodEnough);
    this->judge().start();
    done = this->judge().measure(proposal) && this->judge().accept(proposal);
  }
  this->judge().end(mark, done);
  this->judge().count(Operation::NodeInsertion, done);
  return done;
}

// --- edges that are too short

/// The shortest edge first.
template <int D>
long SizeStage<D>::contract()
{
  long done = 0;
  this->collectQueue(false);
  Proposal<D> best;
  while (!this->queue_.empty() && this->options_.removeNodes && this->triesMore())
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    best.clear();
    best.newWorst = Proposal<D>::Never;
    if (!this->isThere(edge))
    {
      continue;
    }
    // Either end may vanish; the better of both is taken.
    const bool first = this->contractEdge(edge.a, edge.b, best);
    const bool second = this->contractEdge(edge.b, edge.a, best);
    this->judge().start();
    const bool contracted = (first || second) && this->judge().accept(best);
    this->judge().count(Operation::EdgeContraction, contracted);
    if (!contracted)
    {
      continue;
    }
    ++done;
    this->swapAround([this](Index c) { this->push(c, false); });
  }
  return done;
}

/// Whether v can join u such that the worst cell is better than with `best`. If so, `best` is this.
template <int D>
bool SizeStage<D>::contractEdge(Index v, Index u, Proposal<D>& best)
{
  Proposal<D>& p = this->proposal_;
  if (!proposeContraction(this->editor_, this->run_.surface, v, u, p))
  {
    return false;
  }
  // Never worse than before, unless good enough; and always positive.
  p.least = std::max(best.newWorst, std::max(0.0, std::min(p.oldWorst, GoodEnough)));
  if (!this->judge().measure(p) || !this->judge().fits(p) || !this->makesNoneLonger(p, v, u))
  {
    return false;
  }
  std::swap(best, p);
  return true;
}

/// Whether the edges that u gets from v are no longer than the longest edge of v, or short enough.
template <int D>
bool SizeStage<D>::makesNoneLonger(const Proposal<D>& p, Index v, Index u) const
{
  double longest = Longest;
  for (Index c : p.cavity)
  {
    for (Index w : this->mesh().nodes(c))
    {
      longest = w != v ? std::max(longest, this->length(v, w)) : longest;
    }
  }
  for (const Simplex<D>& cell : p.cells)
  {
    for (Index w : cell)
    {
      if (w != u && this->length(w, u) > longest)
      {
        return false;
      }
    }
  }
  return true;
}
}
}

#endif
