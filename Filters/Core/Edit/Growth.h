// SPDX-License-Identifier: BSD-3-Clause
/// @file Growth.h
/// How many cells may come, counted in cells.
#ifndef meshopt_Edit_Growth_h
#define meshopt_Edit_Growth_h

#include <limits>

namespace meshopt
{
/// As a number of cells that may come: no limit. Such numbers are added and subtracted.
inline constexpr long AnyGrowth = std::numeric_limits<long>::max() / 2;

/// The growth that one judge may allow: all of a run's, or the share of one chunk.
struct Growth
{
  long left = AnyGrowth; ///< net number of cells that may still come; where cells go it rises
  /// Once so many may come, since so many have gone, no more nodes are removed.
  long most = std::numeric_limits<long>::max();
  bool isShort = false; ///< something was left out for want of growth

  /// Whether so many more cells may come; notes it if not.
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
