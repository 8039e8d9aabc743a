// SPDX-License-Identifier: BSD-3-Clause
/// @file Fan.h
/// Filling a cluster by joining the facets of its boundary to an apex: pure functions of a cluster.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.3: "removing its interior, and either
/// connecting all the faces (edges in 2D) in the cluster boundary to one of the boundary nodes or
/// connecting them to a node at the center of the cluster".
#ifndef meshopt_Paper1996_Fan_h
#define meshopt_Paper1996_Fan_h

#include "Paper1996/FanCluster.h"

#include <vector>

namespace meshopt
{
/// The cells of a filling, with ids of mesh points, and their qualities.
template <int D>
struct Fan
{
  std::vector<Simplex<D>> cells;
  std::vector<double> quality;
};

/// Where the apex of a fan is: a boundary point of the cluster (`local` >= 0), or elsewhere.
template <int D>
struct Apex
{
  int local = -1;
  Index id = None;
  Vec<D> x;
};

/// The mean of the points that bound the cluster.
template <int D>
Vec<D> clusterCentre(const FanCluster<D>& cluster)
{
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& x : cluster.x)
  {
    sum += x;
  }
  return sum / static_cast<double>(cluster.x.size());
}

/// Fills the cluster from the apex: a cell for every facet that does not contain it. Gives up, and
/// returns false, as soon as a cell's quality is not above `required`, or there are more cells of
/// quality <= 0 than the cluster had. `qualityOf(nodes, corners)` is the quality of a cell.
template <int D, class QualityOf>
bool fillFromApex(const FanCluster<D>& cluster, const Apex<D>& apex, double required,
  const QualityOf& qualityOf, Fan<D>& fan)
{
  fan.cells.clear();
  fan.quality.clear();
  int inverted = 0;
  for (std::size_t f = 0; f < cluster.facets.size(); ++f)
  {
    if (apex.local >= 0 && cluster.contains(static_cast<int>(f), apex.local))
    {
      continue;
    }
    Simplex<D> cell;
    Corners<D> x;
    for (int k = 0; k < D; ++k)
    {
      const Index local = cluster.facets[f][k];
      cell[k] = cluster.points[local];
      x[k] = cluster.x[local];
    }
    cell[D] = apex.id;
    x[D] = apex.x;
    const double q = qualityOf(cell, x);
    inverted += q <= 0.0 ? 1 : 0;
    if (!(q > required) || inverted > cluster.inverted)
    {
      return false;
    }
    fan.cells.push_back(cell);
    fan.quality.push_back(q);
  }
  return !fan.cells.empty();
}

/// True if the fan from boundary point `apex` has no edge, facet or cell in common with the cells
/// `outside`, which are those around the apex that are not in the cluster, but what lies on the
/// cluster's boundary. Where no element is inverted this holds by geometry; it is the link
/// condition of an edge contraction, and its like for other fans.
template <int D>
bool isFanSafe(const FanCluster<D>& cluster, const Apex<D>& apex,
  const std::vector<Simplex<D>>& outside);

/// True if each of the `edges` (pairs of point ids) is an edge of a cell of the fan.
template <int D>
bool fanHasEdges(const Fan<D>& fan, const std::vector<std::array<Index, 2>>& edges);

extern template bool isFanSafe<2>(
  const FanCluster<2>&, const Apex<2>&, const std::vector<Simplex<2>>&);
extern template bool isFanSafe<3>(
  const FanCluster<3>&, const Apex<3>&, const std::vector<Simplex<3>>&);
extern template bool fanHasEdges<2>(const Fan<2>&, const std::vector<std::array<Index, 2>>&);
extern template bool fanHasEdges<3>(const Fan<3>&, const std::vector<std::array<Index, 2>>&);
}

#endif
