// SPDX-License-Identifier: BSD-3-Clause
/// @file CostModel.h
/// What the fast engine may spend where many cells are bad: it follows what earlier tries of the
/// same kind have gained. Counted in evaluations of quality, never by the clock, so that the same
/// input gives the same result on any machine.
#ifndef meshopt_WorstFirst_CostModel_h
#define meshopt_WorstFirst_CostModel_h

#include "Run/Options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace meshopt
{
namespace worstfirst
{
/// Three rules, each with a memory of the whole run:
///  - a pass that paid too much for each cell that it lifted is repeated for the worst few only;
///  - insertion and look-ahead that hardly ever helped in a pass get fewer tries in the next one;
///  - polishing ends when it has spent too much since the worst cell last rose clearly.
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

  /// A pass of this level towards this target has lifted so many cells above it.
  void notePass(int level, double target, std::int64_t evaluations, long lifted)
  {
    double& price = this->prices_[{ level, target }];
    const double paid = static_cast<double>(evaluations) /
      static_cast<double>(std::max(1L, lifted));
    // The dearest counts: cells that polishing has made worse are cheap to lift again, and would
    // make the same pass over all others seem cheap.
    price = std::max(price, paid);
  }
  bool isDear(int level, double target) const
  {
    const auto price = this->prices_.find({ level, target });
    return price != this->prices_.end() && price->second > MostPerLifted[this->effort_];
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
  /// In a pass so many tries of an operation have `helped` or not.
  void noteTries(Kind kind, long tries, bool helped)
  {
    constexpr int most = 10; // the patience is Fewest long before
    if (tries >= Fewest[kind])
    {
      int& impatience = this->impatience_[kind];
      impatience = helped ? 0 : std::min(most, impatience + Step);
    }
  }

  /// A round of polishing has spent so much and ended with this worst quality.
  void notePolish(std::int64_t evaluations, double worst)
  {
    this->spent_ += evaluations;
    if (worst > this->lastWorst_ + ClearRise * std::fabs(this->lastWorst_))
    {
      this->lastWorst_ = worst;
      this->spent_ = 0;
    }
  }
  bool mayPolish(long cells) const
  {
    return static_cast<double>(this->spent_) <=
      std::max(FewestPerRise, MostPerRise[this->effort_] * static_cast<double>(cells));
  }

private:
  // All found by trying, on Delaunay meshes of random points and surfaces of CGAL (hard.py): what
  // lowers the time most before the worst cells end lower.
  /// Evaluations for each cell lifted, by effort. Where cells are not stuck, it is a few thousand.
  static constexpr double MostPerLifted[] = { 2e4, 5e4, 5e4 };
  /// Evaluations for each cell of the mesh until the worst must have risen, by effort; and at least
  /// so many in all, since in a small mesh one look-ahead takes 1e5.
  static constexpr double MostPerRise[] = { 50.0, 150.0, 150.0 };
  static constexpr double ClearRise = 0.05; ///< relative to the worst quality
  static constexpr double FewestPerRise = 3e5;
  static constexpr long Fewest[NumberOfKinds] = { 5, 25 }; ///< tries
  static constexpr int Step = 2; ///< each pass in vain divides the tries by 2^Step
  /// At most, in the first pass of a stage: with 2 turbine has half as many cells again under .45.
  static constexpr int FirstImpatience = 1;

  int effort_;
  std::map<std::pair<int, double>, double> prices_; ///< by level and target
  std::array<int, NumberOfKinds> impatience_{};
  double target_ = 0.0; ///< of the stage
  std::int64_t spent_ = 0;
  double lastWorst_ = -1.0; ///< below all qualities
};
}
}

#endif
