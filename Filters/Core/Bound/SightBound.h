// SPDX-License-Identifier: BSD-3-Clause
/// @file SightBound.h
/// How good a mesh can be at best where walls are thin: the bound of SurfaceBound.h, made lower by
/// what stands in the way.
///
/// An element on a kept facet has its fourth node where it is seen from all of that facet: no other
/// kept facet passes through an element. Seen from one place on the facet, directions are divided
/// into cones, each as far as is known to be in sight. In each cone the best fourth node is sought
/// (ApexInCone.h). The cone with the best one is looked into: if another facet stands in the way,
/// it is divided along that facet's outline, and what is behind the facet is cut off. If nothing
/// does, that is the cap. So only those directions are divided that promise most, and stopping at
/// any time leaves a bound.
///
/// This holds for surfaces that do not pass through themselves. Parts without a common node may
/// pass through each other: of those none stands in the other's way.
#ifndef meshopt_Bound_SightBound_h
#define meshopt_Bound_SightBound_h

#include "Bound/ApexInCone.h"
#include "Bound/SurfaceBound.h"
#include "Mesh/BoxTree.h"

#include <vector>

namespace meshopt
{
/// The kept facets that may stand in the way of each other.
class Sight
{
public:
  /// `points` is indexed by the ids in the sides. Both must outlive this object.
  Sight(const Vec<3>* points, const std::vector<KeptSide<3>>& sides);

  /// The greatest S of an element on a side with its fourth node in sight: an upper bound,
  /// certified but for rounding. It is not above `enough`, and not below `atLeast` > 0, which the
  /// caller knows to be reached. Each division takes one of `steps`; without any left the bound is
  /// higher.
  double cap(std::size_t side, double atLeast, double enough, long& steps) const;

  /// A guess of cap() that takes one look from the middle: the shape with the fourth node on what
  /// stands before the best place, which is hardly ever above the cap. Infinite if nothing does.
  double guess(std::size_t side) const;

private:
  struct Part;
  class Search;
  /// The nearest side in the way between from and from + way; none: the number of sides.
  std::size_t firstInTheWay(std::size_t side, const Vec<3>& from, const Vec<3>& way) const;
  std::array<Vec<3>, 3> corners(std::size_t side) const;

  const Vec<3>* points_;
  const std::vector<KeptSide<3>>& sides_;
  std::vector<Index> bodies_; ///< by side: those with common nodes, also by others, have the same
  BoxTree tree_;
};

/// The lowest cap in sight of the sides, if that is below `bound`; else `bound`. Sides need the
/// quality of their cells: only those whose cell is worse than the bound can lower it. Others, and
/// those after the worst MostSides, are not looked at; nor those with a guess above the bound. The
/// one with the lowest guess comes first.
double boundInSight(
  const Vec<3>* points, const std::vector<KeptSide<3>>& sides, double bound, long steps);

/// The number of steps that a search may take in a mesh of so many cells, 500 to 20000: some
/// hundredths of the time of a run that gets stuck, which is when it is worth while.
long stepsInSight(long cells);
}

#endif
