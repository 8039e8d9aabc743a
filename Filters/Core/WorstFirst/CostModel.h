// SPDX-License-Identifier: BSD-3-Clause
/// @file CostModel.h
/// What the fast engine may spend where many cells are bad: it follows what earlier tries of the
/// same kind have gained. Counted in evaluations of quality, never by the clock, so that the same
/// input gives the same result on any machine.
#ifndef meshopt_WorstFirst_CostModel_h
#define meshopt_WorstFirst_CostModel_h

#include "Base/SinceRise.h"
#include "Run/Options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

namespace meshopt
{
namespace worstfirst
{
/// Three rules, each with a memory of the whole run:
///  - a pass may spend a price for each cell that it lifts above its target. What is beyond that is
///    wasted, and there is one allowance for all that is wasted in a run. No pass gets more than a
///    share of what is left of it, so that later ones have their turn;
///  - insertion and look-ahead that hardly ever helped in a pass get fewer tries in the next one;
///  - polishing ends when it has spent too much since the worst cell last rose clearly; in a quick
///    run also when it has spent a few times as much in all.
/// Allowances grow with the cells and with the free nodes: a mesh with hardly a node inside is held
/// by its surface, and there more tries are in vain.
class CostModel
{
public:
  /// The operations that insert nodes: a try costs fifty swaps and more.
  enum Kind
  {
    Look,
    Insertion,
    NumberOfKinds
  };

  explicit CostModel(Effort effort)
    : effort_(static_cast<int>(effort))
  {
  }
  /// To be called first.
  void open(long cells, long freeNodes)
  {
    this->cells_ = static_cast<double>(cells);
    this->freeNodes_ = static_cast<double>(freeNodes);
    const double share = std::min(1.0, LeastShare + SharePerNode * this->freeNodes_ / this->cells_);
    this->waste_ = std::max(share * FewestWaste[this->effort_],
      WastePerCell[this->effort_] * this->cells_ + WastePerNode[this->effort_] * this->freeNodes_);
  }
  /// From now on anything may be spent: past the target.
  void endLimits() { this->isLimited_ = false; }

  /// Evaluations that a pass may spend. Each cell that it lifts adds pricePerLifted().
  double leftForPass() const
  {
    return this->isLimited_ ? std::max(FewestPerPass * this->cells_, WasteShare * this->waste_)
                            : Unlimited;
  }
  double pricePerLifted() const { return PricePerLifted[this->effort_]; }
  /// To be called after a pass: what it has spent, and how many cells it has lifted.
  void notePass(std::int64_t evaluations, long lifted)
  {
    this->waste_ -= std::max(
      0.0, static_cast<double>(evaluations) - this->pricePerLifted() * static_cast<double>(lifted));
  }

  /// How many tries of an operation a pass makes before it asks whether they help, if `usual` is
  /// the number without memory.
  long patience(Kind kind, long usual) const
  {
    return std::max(std::min(usual, Fewest[kind]), usual >> this->impatience_[kind]);
  }
  /// Other cells are bad at another target: what failed on those of the last one may help them.
  void startStage(double target)
  {
    if (target != std::exchange(this->target_, target))
    {
      for (int& impatience : this->impatience_)
      {
        impatience = std::min(impatience, FirstImpatience);
      }
    }
  }
  /// To be called after a pass: its tries of an operation, and whether enough of them have helped.
  void noteTries(Kind kind, long tries, bool helped)
  {
    constexpr int most = 10; // the patience is Fewest long before
    if (tries >= Fewest[kind])
    {
      int& impatience = this->impatience_[kind];
      impatience = helped ? 0 : std::min(most, impatience + Step);
    }
  }

  /// To be called after a pass of polishing: what it has spent, and the worst quality at its end.
  void notePolish(std::int64_t evaluations, double worst)
  {
    this->sinceRise_.note(static_cast<double>(evaluations), worst);
    this->spentInAll_ += static_cast<double>(evaluations);
  }
  /// What polishing may spend where the surface takes part, in times of what it may elsewhere: the
  /// `factor` of leftForPolish(). There a change costs more, and polishing widely helps longer:
  /// with 2, needles of CGAL end 2 % lower; without any limit random solids take twice as long.
  static constexpr double PolishFactorOfSliding = 4.0;
  /// The same between divisions of edges, for the few worst cells alone, by effort. There another
  /// division helps more: without a limit surfaces of CGAL take a tenth longer and random solids
  /// twice as long, and end no higher. With each effort these are about as many evaluations.
  static constexpr double PolishFactorOfFew[] = { 0.4, 0.15, 0.15 };
  static_assert(std::size(PolishFactorOfFew) == NumberOfEfforts);
  /// What the next pass may spend; nothing if less than 0.
  double leftForPolish(double factor = 1.0) const
  {
    const double fewest = std::clamp(
      FewestPerCell * this->cells_, FewestPerRise[this->effort_], FewestPerRiseAtMost);
    const double perRise = factor *
      std::max(fewest,
        PolishPerCell[this->effort_] * this->cells_ +
          PolishPerNode[this->effort_] * this->freeNodes_);
    return this->isLimited_ ? std::min(perRise - this->sinceRise_.spent(),
                                MostRises[this->effort_] * perRise - this->spentInAll_)
                            : Unlimited;
  }

private:
  static constexpr double Unlimited = std::numeric_limits<double>::infinity();
  // All found by trying, on Delaunay meshes of random points and surfaces of CGAL (hard.py): what
  // lowers the time most before the worst cells end lower. In evaluations, by effort.
  static constexpr double PricePerLifted[] = { 1500.0, 3000.0, 3000.0 };
  static constexpr double WastePerCell[] = { 40.0, 100.0, 100.0 };
  static constexpr double WastePerNode[] = { 800.0, 2500.0, 2500.0 };
  /// A small mesh is quick. Where few nodes are inside, only a share of it: more would be in vain.
  static constexpr double FewestWaste[] = { 2e5, 6e5, 6e5 };
  static constexpr double LeastShare = 1.0 / 3.0, SharePerNode = 5.0; ///< nodes by cells
  static constexpr double WasteShare = 0.3;    ///< of what is left, for one pass
  static constexpr double FewestPerPass = 3.0; ///< for each cell
  /// What polishing may spend until the worst quality has risen clearly (SinceRise); then it
  /// may spend the same again. At least FewestPerRise, since in a small mesh one look-ahead takes
  /// 1e5; or FewestPerCell, if that is more, up to FewestPerRiseAtMost: with 1e5 in all quick runs,
  /// some surfaces of CGAL with 2000 to 4000 cells end 2 to 5 % lower.
  static constexpr double PolishPerCell[] = { 8.0, 34.0, 34.0 };
  static constexpr double PolishPerNode[] = { 450.0, 1250.0, 1250.0 };
  static constexpr double FewestPerRise[] = { 1e5, 2e5, 2e5 }, FewestPerRiseAtMost = 2e5;
  static constexpr double FewestPerCell = 80.0;
  /// What polishing may spend in all, as a multiple of what it may until one rise. On thin slabs of
  /// random points the worst cell rises again and again: with 6, most slabs of 30 000 points end
  /// at a tenth to a half of the bound; without limit a quick run takes too long.
  static constexpr double MostRises[] = { 16.0, Unlimited, Unlimited };
  static_assert(std::size(PricePerLifted) == NumberOfEfforts &&
    std::size(WastePerCell) == NumberOfEfforts && std::size(WastePerNode) == NumberOfEfforts &&
    std::size(FewestWaste) == NumberOfEfforts && std::size(PolishPerCell) == NumberOfEfforts &&
    std::size(PolishPerNode) == NumberOfEfforts && std::size(FewestPerRise) == NumberOfEfforts &&
    std::size(MostRises) == NumberOfEfforts);
  static constexpr long Fewest[NumberOfKinds] = { 5, 25 }; ///< tries
  static constexpr int Step = 2; ///< each pass in vain divides the tries by 2^Step
  /// The most impatience at the start of a stage. With 2, turbine has 1.5 times as many cells under
  /// .45.
  static constexpr int FirstImpatience = 1;

  int effort_;
  bool isLimited_ = true;
  double cells_ = 0.0, freeNodes_ = 0.0;
  double waste_ = 0.0; ///< that is still allowed; less than 0 if there was more
  std::array<int, NumberOfKinds> impatience_{};
  double target_ = 0.0;     ///< of the stage
  SinceRise sinceRise_;     ///< of polishing
  double spentInAll_ = 0.0; ///< on polishing
};
}
}

#endif
