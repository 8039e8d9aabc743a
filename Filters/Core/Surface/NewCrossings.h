// SPDX-License-Identifier: BSD-3-Clause
/// @file NewCrossings.h
/// Where a surface, or in the plane a boundary, that has changed passes through itself.
///
/// That each facet is near the surface of before does not exclude it: in a narrow wedge, both sides
/// may move by more than the gap between them. Next to its edge ReferenceSurface sees no gap.
#ifndef meshopt_Surface_NewCrossings_h
#define meshopt_Surface_NewCrossings_h

#include "Mesh/BoxTree.h"
#include "Mesh/SimplexMesh.h"

#include <functional>
#include <vector>

namespace meshopt
{
/// Whether a pair of kept facets of a mesh that pass through each other counts.
template <int D>
using CrossingCounts = std::function<bool(const SimplexMesh<D>&, const Facet<D>&, const Facet<D>&)>;

/// Boxes around the kept facets of `now` that pass through each other, if one of the two is not in
/// `before` or has other corners there, and if the pair counts (without `counts` all do). Facets
/// with a common edge (2D: point), and those that only touch, do not. The signs are exact. The cost
/// is linear in the mesh, and n log n in the facets.
template <int D>
std::vector<BoxTree::Box> findNewCrossings(
  const SimplexMesh<D>& before, const SimplexMesh<D>& now, const CrossingCounts<D>& counts = {});

/// Adds these boxes to `refused`, where nothing may change from now on. False if there are none.
template <int D>
bool refuseNewCrossings(const SimplexMesh<D>& before, const SimplexMesh<D>& now,
  std::vector<BoxTree::Box>& refused, const CrossingCounts<D>& counts = {})
{
  const auto refuse = [&refused](const std::vector<BoxTree::Box>& boxes)
  {
    refused.insert(refused.end(), boxes.begin(), boxes.end());
    return !boxes.empty();
  };
  const bool crosses = refuse(findNewCrossings<D>(before, now, counts));
  if (crosses)
  {
    // Parts that have always passed through each other would else be found one after the other.
    refuse(findNewCrossings<D>({}, before, counts));
  }
  return crosses;
}

extern template std::vector<BoxTree::Box> findNewCrossings<2>(
  const SimplexMesh<2>&, const SimplexMesh<2>&, const CrossingCounts<2>&);
extern template std::vector<BoxTree::Box> findNewCrossings<3>(
  const SimplexMesh<3>&, const SimplexMesh<3>&, const CrossingCounts<3>&);
}

#endif
