// SPDX-License-Identifier: BSD-3-Clause
/// @file Polish.hxx
/// The end of a stage of the fast engine: the few worst cells get the most expensive tries.
#ifndef meshopt_WorstFirst_Polish_hxx
#define meshopt_WorstFirst_Polish_hxx

namespace meshopt
{
namespace worstfirst
{
/// Polishes the worst cells. That makes other cells worse, up to the target: repairs these. As long
/// as the worst one is far below the certified bound and gains, both are repeated. `isLast`: there
/// is no further stage.
template <int D, class Shape>
bool Schedule<D, Shape>::polishAndRepair(double target, bool isLast)
{
  const int most = PolishCycles[static_cast<int>(this->options_.effort)];
  bool more = true, again = true;
  int idle = 0; // cycles in a row without gain: the repair in between may help the next one
  for (int cycle = 0; more && again; ++cycle)
  {
    const double before = this->worst();
    more = this->polish(target, false);
    if (!more || this->isPast(target))
    {
      return more;
    }
    const double now = this->worst();
    idle = now > before * (1.0 + WideGain) ? 0 : idle + 1;
    again = cycle + 1 < most && !(target < this->options_.targetQuality) &&
      idle <= (this->slides() ? 0 : MostIdleCycles) && this->isFarBelowBound();
    // Where the target is out of reach, the best effort does first what the usual one does: it then
    // ends no lower. (Only caps of edges may differ, by their rounding: they are listed up to
    // another limit.)
    const bool isFinal = isLast || (!(target < this->options_.targetQuality) && now < target);
    if (isFinal && !again)
    {
      this->budget_.openReserve();
    }
    const bool many = !this->slides() &&
      this->run_.report.history.back().belowTarget > this->fewCells();
    const bool finely = many && isFinal;
    if (more && !again && finely && this->isFarBelowBound())
    {
      more = this->polish(target, true);
    }
    // Where many are bad, the worst of the cells that were made worse come first.
    if (more && (many || again))
    {
      more = this->weighedStage(std::min(Stages[0], target));
    }
    if (more && !again && !(many && this->leavesMany_))
    {
      more = this->weighedStage(target);
    }
  }
  return more;
}

/// Tries the few worst cells again, now even if other cells become bad. Repeats this as long as the
/// worst cell gets better. When it does not, more of the worst cells are taken, and then the cells
/// around them are lifted first, in ever wider neighbourhoods. `finely`: for smaller gains, and
/// closer to the caps. False if the run has to end.
template <int D, class Shape>
bool Schedule<D, Shape>::polish(double target, bool finely)
{
  this->phase_ = Phase::Polishing;
  this->polishTarget_ = target;
  const double leastGain = finely ? FineGain : this->usualGain_;
  const double reached = finely ? CapReachedFinely : CapReached;
  this->caps_.setReached(reached);
  const bool past = finely || this->isPast(target);
  bool more = true;
  std::vector<Entry> worst;
  // With tiny caps on facets the next worst cells and their surroundings are spared on purpose:
  // there the search does not widen without need.
  const bool widens = past && !this->sparesTiny();
  const auto times = static_cast<std::size_t>(this->options_.effort == Effort::Best
      ? std::max<Index>(1, this->mesh().numberOfCellSlots() / CellsPerPolish)
      : 1);
  const std::size_t least = times * PolishedCells;
  const std::size_t most = times * (widens ? MostPolishedCells : MostBelowBound);
  std::size_t wanted = least;
  for (int round = 0, layers = 0; round < PolishRounds && more; ++round)
  {
    const double worstOfAll = this->findWorst(target, wanted, worst);
    // If a cap holds the worst cell, the next ones are tried only if they are bad (under the second
    // stage), and have to gain more.
    if (worst.empty() || worst[0].first > std::max(worstOfAll, Stages[1]))
    {
      break;
    }
    const double before = this->worst();
    const bool isHopeful = !past && !(target < this->options_.targetQuality) &&
      this->looks_ < this->mostLooks() && this->isFarBelowBound();
    this->gain_ = worst[0].first > worstOfAll ? CoarseGain : leastGain;
    // Whether the worst cell is near its cap, by the usual fraction also when polishing finely:
    // such a cell is not worth the work around it.
    this->caps_.setReached(CapReached);
    const bool nearCap = this->caps_.isCapped(this->mesh(), worst[0].second);
    this->caps_.setReached(reached);
    // The target lies just above the last of these cells, so that the stage takes them and no
    // others.
    const bool isWide = !past && wanted > least;
    more = this->stage(std::nextafter(worst.back().first, 1.0));
    if (this->mostEvaluations() < 0.0)
    {
      break;
    }
    // The worst cell gained enough: start again with the smallest neighbourhood.
    const double leastGained = isWide ? WideGain : RoundGain * this->gain_;
    // Few cells cost little: where the surface takes part, these go on while they gain at all.
    const double now = this->worst();
    const bool areFew = this->slides() && worst.size() < wanted && now > before;
    if (now > before + leastGained * std::fabs(before) || areFew)
    {
      layers = 0;
      wanted = isWide ? wanted : least;
    }
    else if ((widens || isHopeful) && !nearCap && worst.size() == wanted && wanted < most)
    {
      // First more cells; only then wider surroundings.
      wanted *= 2;
    }
    else if (widens && !nearCap && more && ++layers <= LiftedLayers)
    {
      // The worst cells may be others by now.
      wanted = least;
      this->findWorst(target, wanted, worst);
      more = worst.empty() || this->liftAround(worst, layers);
    }
    else
    {
      break;
    }
  }
  this->phase_ = Phase::Lifting;
  this->gain_ = this->usualGain_;
  this->caps_.setReached(CapReached);
  return more;
}

/// The `wanted` worst cells under target that no cap holds, in order. Returns the worst quality of
/// all cells, capped ones included.
template <int D, class Shape>
double Schedule<D, Shape>::findWorst(
  double target, std::size_t wanted, std::vector<Entry>& worst) const
{
  double worstOfAll = 1.0;
  worst.clear();
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    const double q = this->mesh().quality(c);
    if (this->mesh().isAlive(c) && q < target && !this->isLeft(c))
    {
      worstOfAll = std::min(worstOfAll, q);
      if (!this->caps_.isCapped(this->mesh(), c))
      {
        worst.emplace_back(q, c);
      }
    }
  }
  const std::size_t k = std::min(wanted, worst.size());
  std::partial_sort(worst.begin(), worst.begin() + k, worst.end());
  worst.resize(k);
  return worstOfAll;
}

/// The given cells and `layers` layers around them; a layer shares a node with the one before.
template <int D, class Shape>
std::vector<Index> Schedule<D, Shape>::cellsAround(
  const std::vector<Entry>& cells, int layers) const
{
  std::vector<Index> zone, front, star;
  std::vector<char> seen(this->mesh().numberOfCellSlots(), 0);
  for (const Entry& e : cells)
  {
    seen[e.second] = 1;
    front.push_back(e.second);
  }
  for (int layer = 0; layer <= layers; ++layer)
  {
    zone.insert(zone.end(), front.begin(), front.end());
    std::vector<Index> next;
    for (Index c : front)
    {
      for (Index p : this->mesh().nodes(c))
      {
        this->mesh().star(p, star);
        std::copy_if(star.begin(), star.end(), std::back_inserter(next),
          [&](Index o) { return !std::exchange(seen[o], 1); });
      }
    }
    front.swap(next);
  }
  return zone;
}

/// Improves the cells of `layers` layers around the given ones. Their target lies above the quality
/// of the worst given cell: LiftStep for each layer.
template <int D, class Shape>
bool Schedule<D, Shape>::liftAround(const std::vector<Entry>& cells, int layers)
{
  const std::vector<Index> zone = this->cellsAround(cells, layers);
  const double gain = std::exchange(this->gain_, Gain);
  const double target = cells[0].first + layers * LiftStep;
  bool more = true;
  // Both levels up to insertion, since these cells are not stuck yet: the cheap changes come first.
  for (int pass = 0; pass < 2 && more; ++pass)
  {
    const int level = pass == 0 ? Level::Topology : Level::Insertion;
    std::vector<Index> bad;
    std::copy_if(zone.begin(), zone.end(), std::back_inserter(bad),
      [&](Index c)
      {
        return this->mesh().isAlive(c) && this->mesh().quality(c) < target &&
          this->worthTrying(c, level) && !this->caps_.isCapped(this->mesh(), c);
      });
    this->pass({ target, level, static_cast<long>(bad.size()) }, bad);
    this->record(target, 0);
    more = this->goesOn(target);
  }
  this->gain_ = gain;
  return more;
}
}
}

#endif
