// SPDX-License-Identifier: BSD-3-Clause
// Compares two counts of the cells at each point: all of them, and those that a walk over facets
// finds.
#include "Mesh/PinchedPoints.h"

#include <algorithm>

namespace meshopt
{
template <int D>
std::vector<std::uint8_t> pinchedPoints(const SimplexMesh<D>& mesh, bool freeOnly)
{
  // Counted without walking over facets, so that the walk below can be compared with it.
  std::vector<std::size_t> uses(static_cast<std::size_t>(mesh.numberOfPointSlots()), 0);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      ++uses[mesh.nodes(c)[i]];
    }
  }
  std::vector<std::uint8_t> pinched(uses.size(), 0);
  std::vector<Index> star;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (uses[p] > 0 && (!freeOnly || mesh.isFree(p)))
    {
      // A star is walked over facets: it misses cells that share only the point or an edge.
      mesh.star(p, star);
      pinched[p] = star.size() < uses[p];
    }
  }
  if (std::count(pinched.begin(), pinched.end(), 1) == 0)
  {
    // Empty means that there is none: callers then skip all that the rare case needs.
    pinched.clear();
  }
  return pinched;
}

template std::vector<std::uint8_t> pinchedPoints<2>(const SimplexMesh<2>&, bool);
template std::vector<std::uint8_t> pinchedPoints<3>(const SimplexMesh<3>&, bool);
}
