// SPDX-License-Identifier: BSD-3-Clause
/// @file Growth.h
/// The growth budget: how many cells may still be added.
#ifndef meshopt_Edit_Growth_h
#define meshopt_Edit_Growth_h

#include <limits>

namespace meshopt
{
/// No limit, as a number of cells. It leaves room for sums and differences of such numbers.
inline constexpr long AnyGrowth = std::numeric_limits<long>::max() / 2;

/// The growth that one judge may allow: that of the whole run, or the share of one chunk.
struct Growth
{
  long left = AnyGrowth; ///< net number of cells that may still be added; rises when cells vanish
  /// No more nodes are removed once `left` has risen to this.
  long most = std::numeric_limits<long>::max();
  bool isShort = false; ///< a change was refused for lack of growth

  /// Whether this many cells may be added. Notes it in isShort if not.
  bool allows(long cells)
  {
    const bool enough = cells <= 0 || cells <= this->left;
    this->isShort |= !enough;
    return enough;
  }
  bool mayShrink() const { return this->left < this->most; }
};
}

#endif
