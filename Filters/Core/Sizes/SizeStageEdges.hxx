// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStageEdges.hxx
/// Edges of SizeStage: measured, split, contracted, swapped.
#ifndef meshopt_Sizes_SizeStageEdges_hxx
#define meshopt_Sizes_SizeStageEdges_hxx

namespace meshopt
{
namespace sizes
{

/// Takes over the metric at p; `near`: a point whose neighbourhood p is in, if p is new or has moved.
template <int D>
void SizeStage<D>::sample(Index p, Index near)
{
  if (near != None)
  {
    this->metric_.resample(p, this->mesh().point(p), near);
  }
  if (static_cast<Index>(this->units_.size()) <= p)
  {
    this->units_.resize(this->mesh().numberOfPointSlots(), Tensor<D>::Identity());
  }
  this->units_[p] = this->metric_.unitTensor(p);
}

template <int D>
double SizeStage<D>::length(Index a, Index b) const
{
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  return logMeanLength(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) /
    this->scale_;
}

/// Whether all these cells are better than `least`; their qualities go to qualities_.
template <int D>
bool SizeStage<D>::measure(const std::vector<Simplex<D>>& cells, double least)
{
  this->qualities_.clear();
  for (const Simplex<D>& c : cells)
  {
    this->qualities_.push_back(this->model_(c));
    if (!(this->qualities_.back() > least))
    {
      return false;
    }
  }
  return true;
}

template <int D>
void SizeStage<D>::push(Index c, bool isLong)
{
  for (const auto& e : Local<D>::edges)
  {
    const Index p = this->mesh().nodes(c)[e[0]], q = this->mesh().nodes(c)[e[1]];
    const Index a = std::min(p, q), b = std::max(p, q);
    const double l = this->length(a, b);
    if (isLong ? l > this->longest_ : l < Shortest)
    {
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
      this->push(c, isLong);
    }
  }
}

/// After a replacement: swaps edges near the new cells as long as that helps.
template <int D>
template <class Push>
void SizeStage<D>::swapAround(Push&& push)
{
  this->stack_ = this->editor_.created();
  while (!this->stack_.empty())
  {
    const Index c = this->stack_.back();
    this->stack_.pop_back();
    if (!this->mesh().isAlive(c))
    {
      continue;
    }
    if (this->options_.reconnect && this->mesh().quality(c) < SwapBelow<D> &&
      this->improver_.swap(c))
    {
      this->stack_.insert(
        this->stack_.end(), this->improver_.changed().begin(), this->improver_.changed().end());
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

/// No cell has an edge that is much longer: that comes first, and where it must stay (the surface is
/// kept) sizes can only grow finer from layer to layer.
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

template <int D>
long SizeStage<D>::split()
{
  long done = 0, cells = this->mesh().countCells();
  long& cellsAtBrake = this->report_.sizes.cellsAtBrake;
  this->collectQueue(true);
  while (!this->queue_.empty() && this->options_.insertNodes && cellsAtBrake == 0)
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    if (!this->mesh().isAlive(edge.cell) || this->mesh().localIndex(edge.cell, edge.a) < 0 ||
      this->mesh().localIndex(edge.cell, edge.b) < 0 || !this->splitEdge(edge))
    {
      continue;
    }
    ++done;
    cells += static_cast<long>(this->change_.cells.size() - this->change_.cavity.size());
    cellsAtBrake = cells > this->mostCells_ ? cells : 0;
    this->swapAround([this](Index c) { this->push(c, true); });
    if (done % 256 == 0 && !this->keepGoing())
    {
      break;
    }
  }
  this->splits_ += done;
  return done;
}

template <int D>
bool SizeStage<D>::splitEdge(const Edge& edge)
{
  const Index a = edge.a, b = edge.b;
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  // Exact halves would make a grid of equal triangles, half or twice the wanted size, in which
  // nothing gains.
  const double t = metricMiddle(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) +
    Jitter * noise(a, b);
  Vec<D> x = this->mesh().point(a) + t * e;
  CurvePlace<D> place;
  if constexpr (D == 2)
  {
    const int i = 3 - this->mesh().localIndex(edge.cell, a) - this->mesh().localIndex(edge.cell, b);
    const bool kept = this->mesh().isConstrained(edge.cell, i);
    const auto span = kept && this->curves_ ? this->curves_->span(this->mesh(), a, b)
                                            : std::nullopt;
    if (kept && !span)
    {
      return false;
    }
    if (span)
    {
      place.curve = span->piece;
      place.parameter = span->from + t * (span->to - span->from);
      x = this->curves_->at(place.curve, place.parameter);
    }
  }
  const Index p = this->editor_.addPoint(x);
  this->sample(p, a);
  if (this->change_.split(this->editor_, this->curves_, edge.cell, a, b, p) &&
    this->isAboutLongest(this->change_.cavity, edge.length))
  {
    const double worst = this->mesh().worstQuality(this->change_.cavity);
    if (this->measure(this->change_.cells, std::min(WorstSplit * worst, GoodEnough)))
    {
      this->editor_.setCurvePlace(p, place);
      this->editor_.replace(
        this->change_.cavity, this->change_.cells, this->qualities_, this->change_.keptChange());
      return true;
    }
  }
  this->editor_.dropPoint(p);
  return false;
}

// --- edges that are too short

template <int D>
long SizeStage<D>::contract()
{
  long done = 0;
  this->collectQueue(false);
  EdgeChange<D> best;
  while (!this->queue_.empty() && this->options_.removeNodes)
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    if (!this->mesh().isAlive(edge.cell) || this->mesh().localIndex(edge.cell, edge.a) < 0 ||
      this->mesh().localIndex(edge.cell, edge.b) < 0)
    {
      continue;
    }
    double above = -std::numeric_limits<double>::infinity();
    const bool first = this->contractEdge(edge.a, edge.b, above, best);
    const bool second = this->contractEdge(edge.b, edge.a, above, best);
    if (!first && !second)
    {
      continue;
    }
    this->editor_.replace(best.cavity, best.cells, this->bestQualities_, best.keptChange());
    ++done;
    this->swapAround([this](Index c) { this->push(c, false); });
    if (done % 256 == 0 && !this->keepGoing())
    {
      break;
    }
  }
  this->contractions_ += done;
  return done;
}

/// Whether v can go to u such that the worst cell is better than `above`, which then is that worst.
template <int D>
bool SizeStage<D>::contractEdge(Index v, Index u, double& above, EdgeChange<D>& best)
{
  if (!this->change_.contract(this->editor_, this->curves_, v, u))
  {
    return false;
  }
  const double least = std::max(
    above, std::max(0.0, std::min(this->mesh().worstQuality(this->change_.cavity), GoodEnough)));
  if (!this->measure(this->change_.cells, least) ||
    (this->overlaps_ &&
      !this->improver_.fits(this->change_.cavity, this->change_.cells, this->change_.keptChange())))
  {
    return false;
  }
  double longest = Longest;
  for (Index c : this->change_.cavity)
  {
    for (Index w : this->mesh().nodes(c))
    {
      longest = w != v ? std::max(longest, this->length(v, w)) : longest;
    }
  }
  for (const Simplex<D>& cell : this->change_.cells)
  {
    for (Index w : cell)
    {
      if (w != u && this->length(w, u) > longest)
      {
        return false;
      }
    }
  }
  above = *std::min_element(this->qualities_.begin(), this->qualities_.end());
  best = this->change_;
  this->bestQualities_ = this->qualities_;
  return true;
}
}
}

#endif
