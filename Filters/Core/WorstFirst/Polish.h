// SPDX-License-Identifier: BSD-3-Clause
/// @file Polish.h
/// The end of a stage of the fast engine: the few worst cells get the most expensive tries.
#ifndef meshopt_WorstFirst_Polish_h
#define meshopt_WorstFirst_Polish_h

#include "Base/Raised.h"
#include "WorstFirst/Stage.h"

namespace meshopt
{
namespace worstfirst
{
template <int D, class Shape>
class Polish
{
public:
  /// All arguments must outlive this object.
  Polish(Workpiece<D, Shape>& workpiece, Allowance<D, Shape>& allowance, GrowthBudget& budget,
    Pass<D, Shape>& pass, Stage<D, Shape>& stage)
    : workpiece_(workpiece)
    , allowance_(allowance)
    , budget_(budget)
    , pass_(pass)
    , stage_(stage)
  {
  }

  /// Polishes the worst cells. That makes other cells worse, up to the target: repairs these. As
  /// long as the worst one is far below the certified bound and gains, both are repeated. `isLast`:
  /// there is no further stage. False if the run has to end.
  bool runAndRepair(double target, bool isLast);
  /// Tries the few worst cells again, now even if other cells become bad. Repeats this as long as
  /// the worst cell gets better. When it does not, more of the worst cells are taken, and then the
  /// cells around them are lifted first, in ever wider neighbourhoods. `finely`: for smaller gains,
  /// and closer to the caps. False if the run has to end.
  bool run(double target, bool finely);

private:
  using Entry = std::pair<double, Index>; ///< a cell by its quality

  double findWorst(double target, std::size_t wanted, std::vector<Entry>& worst) const;
  bool isNearCap(Index c, double reached);
  std::vector<Index> cellsAround(const std::vector<Entry>& cells, int layers) const;
  bool liftAround(const std::vector<Entry>& cells, int layers, double aim);

  Workpiece<D, Shape>& workpiece_;
  Allowance<D, Shape>& allowance_;
  GrowthBudget& budget_;
  Pass<D, Shape>& pass_;
  Stage<D, Shape>& stage_;
};

template <int D, class Shape>
bool Polish<D, Shape>::runAndRepair(double target, bool isLast)
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  bool more = true, again = true;
  int idle = 0; // cycles in a row without gain: the repair in between may help the next one
  for (int cycle = 0; more && again; ++cycle)
  {
    const double before = workpiece.worst();
    more = this->run(target, false);
    if (!more || workpiece.isPast(target))
    {
      return more;
    }
    const double now = workpiece.worst();
    idle = now > before * (1.0 + WideGain) ? 0 : idle + 1;
    again = cycle + 1 < PolishCycles && !(target < workpiece.target()) &&
      idle <= (workpiece.slides() ? 0 : MostIdleCycles) && workpiece.isFarBelowBound() &&
      this->allowance_.evaluations(Phase::Polishing) >= 0.0;
    // Where the target is out of reach, the best effort does first what the usual one does: it then
    // ends no lower. (Only caps of edges may differ, by their rounding: they are listed up to
    // another limit.)
    const bool isFinal = isLast || (!(target < workpiece.target()) && now < target);
    if (isFinal && !again)
    {
      this->budget_.openReserve();
      if (workpiece.isKeptAndPlain())
      {
        this->budget_.openNodes(); // the worst cells have had their share
      }
    }
    const bool many = !workpiece.slides() &&
      workpiece.run().report.history.back().belowTarget > workpiece.fewCells();
    const bool finely = many && isFinal;
    if (more && !again && finely && workpiece.isFarBelowBound())
    {
      more = this->run(target, true);
    }
    // Where many are bad, the worst of the cells that were made worse come first.
    if (more && (many || again))
    {
      more = this->stage_.lift(std::min(Stages[0], target));
    }
    if (more && !again && !(many && this->stage_.leavesMany()))
    {
      more = this->stage_.lift(target);
    }
  }
  return more;
}

template <int D, class Shape>
bool Polish<D, Shape>::run(double target, bool finely)
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const double leastGain = finely ? FineGain : workpiece.usualGain();
  const double reached = finely ? CapReachedFinely : CapReached;
  this->workpiece_.caps().setReached(reached);
  // One such search takes as long as all else in a round. The rounds of one polish change little
  // that it would see, the stages in between much.
  this->pass_.forgetInVain();
  const bool past = finely || workpiece.isPast(target);
  bool more = true;
  std::vector<Entry> worst;
  // With tiny caps on facets the next worst cells and their surroundings are spared on purpose:
  // there the search does not widen without need.
  const bool widens = past && !workpiece.sparesTiny();
  const auto times = static_cast<std::size_t>(workpiece.effort() == Effort::Best
      ? std::max<Index>(1, workpiece.mesh().numberOfCellSlots() / CellsPerPolish)
      : 1);
  const std::size_t least = times * PolishedCells;
  const std::size_t most = times *
    (!workpiece.run().polishesWidely ? PolishedCells
        : widens                     ? MostPolishedCells
                                     : MostBelowBound);
  std::size_t wanted = least;
  for (int round = 0, layers = 0; round < PolishRounds && more; ++round)
  {
    const double worstOfAll = this->findWorst(target, wanted, worst);
    // If a cap holds the worst cell, the next ones are tried only if they are bad (under the second
    // stage), and have to gain more.
    if (workpiece.isPolished() || worst.empty() || worst[0].first > std::max(worstOfAll, Stages[1]))
    {
      break;
    }
    const double before = workpiece.worst();
    const bool isHopeful = !past && !(target < workpiece.target()) && this->allowance_.hasLooks() &&
      workpiece.isFarBelowBound();
    const double gain = worst[0].first > worstOfAll ? CoarseGain : leastGain;
    const bool nearCap = this->isNearCap(worst[0].second, reached);
    // The target lies just above the last of these cells, so that the stage takes them and no
    // others.
    const bool isWide = !past && wanted > least;
    more = this->stage_.polish(std::nextafter(worst.back().first, 1.0), target, gain);
    if (this->allowance_.evaluations(Phase::Polishing) < 0.0)
    {
      break;
    }
    // The worst cell gained enough: start again with the smallest neighbourhood.
    const double leastGained = isWide ? WideGain : RoundGain * gain;
    // Few cells cost little: where the surface takes part, these go on while they gain at all.
    const double now = workpiece.worst();
    const bool areFew = workpiece.slides() && worst.size() < wanted && now > before;
    if (now > raised(before, leastGained) || areFew)
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
      more = worst.empty() || this->liftAround(worst, layers, target);
    }
    else
    {
      break;
    }
  }
  this->workpiece_.caps().setReached(CapReached);
  return more;
}

/// The `wanted` worst cells under target that no cap holds, in order. Returns the worst quality of
/// all cells, capped ones included.
template <int D, class Shape>
double Polish<D, Shape>::findWorst(
  double target, std::size_t wanted, std::vector<Entry>& worst) const
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const SimplexMesh<D>& mesh = workpiece.mesh();
  double worstOfAll = 1.0;
  worst.clear();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const double q = mesh.quality(c);
    if (mesh.isAlive(c) && q < target && !workpiece.isLeft(c))
    {
      worstOfAll = std::min(worstOfAll, q);
      if (!workpiece.caps().isCapped(mesh, c))
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

/// By the usual fraction, although cells now count as capped at the fraction `reached`: what is
/// near its cap is not worth the work around it, also when polishing finely.
template <int D, class Shape>
bool Polish<D, Shape>::isNearCap(Index c, double reached)
{
  Caps<D>& caps = this->workpiece_.caps();
  caps.setReached(CapReached);
  const bool isNear = caps.isCapped(this->workpiece_.mesh(), c);
  caps.setReached(reached);
  return isNear;
}

/// The given cells and `layers` layers around them; a layer shares a node with the one before.
template <int D, class Shape>
std::vector<Index> Polish<D, Shape>::cellsAround(const std::vector<Entry>& cells, int layers) const
{
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  std::vector<Index> zone, front, star;
  std::vector<char> seen(mesh.numberOfCellSlots(), 0);
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
      for (Index p : mesh.nodes(c))
      {
        mesh.star(p, star);
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
bool Polish<D, Shape>::liftAround(const std::vector<Entry>& cells, int layers, double aim)
{
  const Workpiece<D, Shape>& workpiece = this->workpiece_;
  const SimplexMesh<D>& mesh = workpiece.mesh();
  const std::vector<Index> zone = this->cellsAround(cells, layers);
  Task task{ Phase::Polishing, cells[0].first + layers * LiftStep, aim, Gain };
  // Both levels up to insertion, since these cells are not stuck yet: the cheap changes come first.
  for (int level : { Level::Topology, Level::Insertion })
  {
    task.level = level;
    std::vector<Index> bad;
    std::copy_if(zone.begin(), zone.end(), std::back_inserter(bad),
      [&](Index c)
      {
        return mesh.isAlive(c) && mesh.quality(c) < task.target &&
          workpiece.isWorthTrying(c, task.phase, level) && !workpiece.caps().isCapped(mesh, c);
      });
    task.below = static_cast<long>(bad.size());
    if (!this->pass_.run(task, bad).goesOn)
    {
      return false;
    }
  }
  return true;
}
}
}

#endif
