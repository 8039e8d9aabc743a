// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStageNodes.hxx
/// The nodes of SizeStage: moved to where their edges have the wanted length.
#ifndef meshopt_Sizes_SizeStageNodes_hxx
#define meshopt_Sizes_SizeStageNodes_hxx

namespace meshopt
{
namespace sizes
{
/// Sum of ln(l)^2 over the edges at v, whose neighbours are neighbours_. It is 0 if all edges have
/// length 1, and counts an edge twice as long like one half as long.
template <int D>
double SizeStage<D>::energyAround(Index v)
{
  double sum = 0.0;
  for (Index w : this->neighbours_)
  {
    const double l = std::log(this->length(v, w));
    sum += l * l;
  }
  return sum;
}

/// Puts v at x if its edges come closer to the wanted length and no cell becomes bad.
template <int D>
bool SizeStage<D>::tryPlace(
  Index v, const Vec<D>& x, const Place& place, double worst, double energy)
{
  Proposal<D>& p = this->proposal_;
  p.clear();
  p.cavity = this->star_;
  p.moves.push_back({ v, x, place });
  p.oldWorst = worst;
  // As good as the worst was, or good enough; and positive. (nextafter(): equal is allowed.)
  p.least = std::max(0.0, std::nextafter(std::min(worst, 2.0 * GoodEnough), -1.0));
  this->judge().start();
  return this->judge().acceptIf(p, [&] { return this->energyAround(v) < WorthMoving * energy; });
}

/// Moves v, unless nothing has changed at its edges since that last failed.
template <int D>
void SizeStage<D>::moveNode(Index v)
{
  const auto& point = this->mesh().pointData(v);
  this->editor_.star(v, this->star_);
  this->neighbours_.clear();
  for (Index c : this->star_)
  {
    for (Index w : this->mesh().nodes(c))
    {
      if (w != v)
      {
        this->neighbours_.push_back(w);
      }
    }
  }
  // A neighbour comes once for each cell that it shares with v, but has one edge.
  sortUnique(this->neighbours_);
  if (static_cast<Index>(this->failedAt_.size()) <= v)
  {
    // Nodes have come by splits since the last call.
    this->failedAt_.resize(this->mesh().numberOfPointSlots(), 0);
  }
  // Its edges also change when a neighbour moves: look at the stamps of the neighbours, too.
  std::uint32_t latest = point.stamp;
  for (Index w : this->neighbours_)
  {
    latest = std::max(latest, this->mesh().pointData(w).stamp);
  }
  if (latest <= this->failedAt_[v])
  {
    return; // nothing has changed since the last try
  }
  // Noted before the try: if the node moves, its new stamp is later, and it is tried again.
  this->failedAt_[v] = this->editor_.clock();
  const double worst = this->mesh().worstQuality(this->star_), energy = this->energyAround(v);
  this->judge().count(Operation::NodeMotion,
    this->mesh().isFree(v) ? this->moveFreeNode(v, worst, energy)
                           : this->moveSlidingNode(v, worst, energy));
}

/// Moves v on its curve, towards the neighbour that is farther away.
template <int D>
bool SizeStage<D>::moveSlidingNode(Index v, double worst, double energy)
{
  const auto range = this->run_.surface->range(this->mesh(), this->star_, v);
  if (!range)
  {
    return false;
  }
  const double l0 = this->length(v, range->ends[0]), l1 = this->length(v, range->ends[1]);
  const double to = l0 > l1 ? range->low : range->high;
  Place place = this->mesh().place(v);
  const double s = place.parameter;
  for (double part : { 0.5, 0.25 })
  {
    // Half of the difference makes both edges equally long, if the parameter goes with the length.
    place.parameter = s + part * std::fabs(l0 - l1) / std::max(l0, l1) * (to - s);
    const Vec<D> x = this->run_.surface->at(place.part, place.parameter);
    if (this->tryPlace(v, x, place, worst, energy))
    {
      return true;
    }
  }
  return false;
}

/// Moves v to the mean of the places where each edge would have the wanted length, or part of the
/// way.
template <int D>
bool SizeStage<D>::moveFreeNode(Index v, double worst, double energy)
{
  const Vec<D> x = this->mesh().point(v);
  Vec<D> target = Vec<D>::Zero();
  for (Index w : this->neighbours_)
  {
    const Vec<D>& y = this->mesh().point(w);
    // Along the same line from y, at the wanted length.
    target += y + (x - y) / this->length(v, w);
  }
  target /= static_cast<double>(this->neighbours_.size());
  for (double part : { 1.0, 0.5, 0.25 })
  {
    if (this->tryPlace(v, Vec<D>(x + part * (target - x)), Place(), worst, energy))
    {
      return true;
    }
  }
  return false;
}

/// Each node at most once in a sweep, in the order of ids. Then edges are swapped where nodes have
/// moved.
template <int D>
void SizeStage<D>::smooth()
{
  for (int sweep = 0; sweep < Sweeps && this->options_.moveNodes; ++sweep)
  {
    for (Index v = 0; v < this->mesh().numberOfPointSlots() && this->triesMore(); ++v)
    {
      if (!this->mesh().isPointAlive(v))
      {
        continue;
      }
      const Freedom freedom = this->mesh().freedom(v);
      const bool mayMove = freedom == Freedom::Free ||
        (freedom == Freedom::Curve && this->run_.surface);
      if (mayMove)
      {
        this->moveNode(v);
      }
    }
    this->swapWhatChanged();
  }
}

/// Swaps edges of the cells around which something has changed since the last call.
template <int D>
void SizeStage<D>::swapWhatChanged()
{
  const std::uint32_t since = std::exchange(this->swappedAt_, this->editor_.clock());
  for (Index c = 0;
       c < this->mesh().numberOfCellSlots() && this->options_.reconnect && this->triesMore(); ++c)
  {
    const auto isNew = [&](Index p) { return this->mesh().pointData(p).stamp > since; };
    // A swap may put a new cell into this slot: look at it again.
    while (this->mesh().isAlive(c) && this->mesh().quality(c) < SwapBelow<D> &&
      std::any_of(this->mesh().nodes(c).begin(), this->mesh().nodes(c).end(), isNew) &&
      this->improver_.swap(c))
    {
    }
  }
}
}
}

#endif
