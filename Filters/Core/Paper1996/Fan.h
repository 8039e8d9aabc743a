// SPDX-License-Identifier: BSD-3-Clause
/// @file Fan.h
/// Fills a cluster by joining the facets of its boundary to an apex. Pure functions of a cluster.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.3: "removing its interior, and either
/// connecting all the faces (edges in 2D) in the cluster boundary to one of the boundary nodes or
/// connecting them to a node at the center of the cluster".
#ifndef meshopt_Paper1996_Fan_h
#define meshopt_Paper1996_Fan_h

#include "Edit/Proposal.h"
#include "Paper1996/FanCluster.h"

#include <algorithm>
#include <limits>

namespace meshopt
{
/// The apex of a fan: a boundary point of the cluster (`local` >= 0), or a point elsewhere.
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

/// Fills the cluster from the apex: a cell for every facet that does not contain the apex, put into
/// the proposal with its quality. Returns false as soon as a cell is not better than
/// proposal.least, or if there are more cells of quality <= 0 than the cluster had.
/// `qualityOf(nodes, corners)` is the quality of a cell.
template <int D, class QualityOf>
bool fillFromApex(const FanCluster<D>& cluster, const Apex<D>& apex, const QualityOf& qualityOf,
  Proposal<D>& proposal)
{
  proposal.cells.clear();
  proposal.qualities.clear();
  proposal.newWorst = std::numeric_limits<double>::infinity();
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
    if (!(q > proposal.least) || inverted > cluster.inverted)
    {
      return false;
    }
    proposal.cells.push_back(cell);
    proposal.qualities.push_back(q);
    proposal.newWorst = std::min(proposal.newWorst, q);
  }
  return !proposal.cells.empty();
}
}

#endif
