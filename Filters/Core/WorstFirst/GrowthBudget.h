// SPDX-License-Identifier: BSD-3-Clause
/// @file GrowthBudget.h
/// How many cells the fast engine may still add, and how many it may remove.
#ifndef meshopt_WorstFirst_GrowthBudget_h
#define meshopt_WorstFirst_GrowthBudget_h

#include "Edit/Growth.h"
#include "Run/Options.h"
#include "WorstFirst/Constants.h"
#include "WorstFirst/Task.h"

#include <algorithm>
#include <limits>

namespace meshopt
{
namespace worstfirst
{
/// The growth of one run. Before each pass it is shared out among the chunks, and what they have
/// left comes back afterwards. A part is reserved for polishing.
class GrowthBudget
{
public:
  /// `growth`: net number of cells that may come. `cells`: of the mesh. `width`: of it, in its
  /// mean edges. `followsSizes`: then any number of cells may vanish.
  GrowthBudget(const Options& options, long growth, long cells, double width, bool followsSizes)
    : left_(growth)
    , allowed_(growth)
    , reserve_(growth / ReservedPart)
    , cells_(static_cast<double>(cells))
    , mostSwallowed_(std::max(
        MostSwallowed, static_cast<int>(std::min(MostSwallowedAtAll, SwallowedPerEdge * width))))
  {
    const long shrink = options.mostShrink >= 0
      ? options.mostShrink
      : static_cast<long>(ShrinkBudget * static_cast<double>(cells));
    this->lean_ = growth + ShrinkAtEnd * shrink;
    this->most_ = followsSizes ? std::numeric_limits<long>::max() : growth + shrink;
    this->countsNodes_ = options.mostShrink < 0;
  }

  /// What each of n chunks may use. The shares are fixed before the pass: a chunk must not depend
  /// on what others use up meanwhile. `nodes`: the part of the input's nodes that is left, where
  /// these count, too. Then nodes may vanish until ShrinkBudget of them is gone (after openNodes()
  /// ShrinkAtEnd times that), although swaps, which remove no node, have removed as many cells.
  Growth share(Phase phase, int n, double nodes = 0.0) const
  {
    const long reserve = this->reserveIn(phase);
    Growth share;
    share.left = (this->left_ - reserve) / n;
    share.most = phase == Phase::Polishing ? std::numeric_limits<long>::max()
                                           : (this->most_ - reserve) / n;
    if (this->countsNodes_)
    {
      const double spare = (nodes - (1.0 - this->mayVanish_)) * this->cells_;
      share.most = std::max(share.most, share.left + static_cast<long>(spare) / n);
    }
    return share;
  }
  /// To be called after the pass: what all chunks together have left, and whether a change was left
  /// out for lack of growth.
  void takeBack(Phase phase, long left, bool isShort)
  {
    this->left_ = left + this->reserveIn(phase);
    this->isShort_ |= isShort;
  }

  /// From now on passes that lift may use the reserve, too.
  void openReserve() { this->reserve_ = 0; }
  /// From now on more nodes may vanish in passes that lift.
  void openNodes() { this->mayVanish_ = ShrinkAtEnd * ShrinkBudget; }
  /// The most nodes that may vanish in one wide insertion. `nodes`: the part of the input's nodes
  /// that is left. `shrink`: WideShrink or WideShrinkOfWorst.
  int mostSwallowed(double nodes, long shrink) const
  {
    const bool many = this->countsNodes_ ? nodes > 1.0 - shrink * ShrinkBudget
                                         : this->left_ < this->lean_;
    return many ? this->mostSwallowed_ : FewestSwallowed;
  }
  /// Whether changes were left out because nothing is left. A small rest counts as nothing: hardly
  /// any change fits into it.
  bool isUsedUp() const
  {
    const double nothing = UsedUp * static_cast<double>(this->allowed_) + OneNode;
    return this->isShort_ && static_cast<double>(this->left_) <= nothing;
  }

private:
  long reserveIn(Phase phase) const { return phase == Phase::Polishing ? 0 : this->reserve_; }

  long left_, most_ = 0; ///< see Growth
  long lean_ = 0;        ///< from here on, fewer nodes vanish in wide insertions, in a part
  long allowed_;         ///< left_ at the start
  long reserve_;         ///< part of the growth reserved for polishing
  double cells_;         ///< at the start
  double mayVanish_ = ShrinkBudget; ///< part of the nodes
  int mostSwallowed_;               ///< in one wide insertion
  bool countsNodes_;                ///< not in a part of a mesh, whose caller counts cells
  bool isShort_ = false;            ///< a change was left out for lack of growth
};
}
}

#endif
