// SPDX-License-Identifier: BSD-3-Clause
#include "Paper1996/Fan.h"

#include <algorithm>

namespace meshopt
{
namespace
{
// True if facet f contains the points others[i] for every bit i of `subset`.
template <int D>
bool containsAll(const Facet<D>& f, const std::array<int, D>& others, int subset)
{
  for (int i = 0; i < D; ++i)
  {
    if (((subset >> i) & 1) && std::find(f.begin(), f.end(), others[i]) == f.end())
    {
      return false;
    }
  }
  return true;
}
}

template <int D>
bool isFanSafe(const FanCluster<D>& cluster, const Apex<D>& apex,
  const std::vector<Simplex<D>>& outside)
{
  for (const Simplex<D>& cell : outside)
  {
    std::array<int, D> others; // points of the cell, but the apex, that bound the cluster
    int n = 0;
    for (Index p : cell)
    {
      const auto at = std::lower_bound(cluster.points.begin(), cluster.points.end(), p);
      if (p != apex.id && at != cluster.points.end() && *at == p)
      {
        others[n++] = static_cast<int>(at - cluster.points.begin());
      }
    }
    for (int subset = 1; subset < (1 << n); ++subset)
    {
      // The simplex (apex, subset) belongs to the cell; does it to the fan, and to the boundary?
      bool inFan = false, onBoundary = false;
      for (std::size_t f = 0; f < cluster.facets.size(); ++f)
      {
        if (containsAll<D>(cluster.facets[f], others, subset))
        {
          const bool hasApex = cluster.contains(static_cast<int>(f), apex.local);
          onBoundary = onBoundary || hasApex;
          inFan = inFan || !hasApex;
        }
      }
      if (inFan && !onBoundary)
      {
        return false;
      }
    }
  }
  return true;
}

template <int D>
bool fanHasEdges(const Fan<D>& fan, const std::vector<std::array<Index, 2>>& edges)
{
  for (const auto& e : edges)
  {
    bool found = false;
    for (const Simplex<D>& cell : fan.cells)
    {
      found = found ||
        (std::find(cell.begin(), cell.end(), e[0]) != cell.end() &&
          std::find(cell.begin(), cell.end(), e[1]) != cell.end());
    }
    if (!found)
    {
      return false;
    }
  }
  return true;
}

template bool isFanSafe<2>(const FanCluster<2>&, const Apex<2>&, const std::vector<Simplex<2>>&);
template bool isFanSafe<3>(const FanCluster<3>&, const Apex<3>&, const std::vector<Simplex<3>>&);
template bool fanHasEdges<2>(const Fan<2>&, const std::vector<std::array<Index, 2>>&);
template bool fanHasEdges<3>(const Fan<3>&, const std::vector<std::array<Index, 2>>&);
}
