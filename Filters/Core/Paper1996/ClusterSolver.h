// SPDX-License-Identifier: BSD-3-Clause
/// @file ClusterSolver.h
/// Steps 3 and 4 of the global algorithm on a mesh: gather the cluster of an element, solve it, and
/// move the nodes if that gains.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2. For the departures see
/// GlobalAlgorithm.h.
#ifndef meshopt_Paper1996_ClusterSolver_h
#define meshopt_Paper1996_ClusterSolver_h

#include "Base/Raised.h"
#include "Edit/Judge.h"
#include "Paper1996/LocalAlgorithm.h"

namespace meshopt
{
template <int D, class Shape>
class ClusterSolver
{
public:
  ClusterSolver(Judge<D, Shape>& judge, const LocalParameters& parameters, double leastGain)
    : judge_(judge)
    , local_(judge.model().quality, parameters)
    , leastGain_(leastGain)
  {
  }

  /// Optimizes the cluster of `cell` with neighbours of order `level`; `movable`: nonzero per point
  /// slot. Returns true if the worst quality of the cluster has risen by more than a fraction
  /// leastGain. Otherwise the mesh is unchanged, bit for bit.
  bool solve(Index cell, int level, const std::vector<std::uint8_t>& movable);

  /// The last cluster solved, as it is now, and the qualities of its cells before.
  const Cluster<D>& cluster() const { return this->cluster_; }
  const std::vector<double>& oldQuality() const { return this->oldQuality_; }

private:
  void setMetrics();
  bool offer(double required);

  Judge<D, Shape>& judge_;
  ClusterGatherer<D> gatherer_;
  LocalAlgorithm<D, Shape> local_;
  double leastGain_;
  Cluster<D> cluster_;
  std::vector<double> oldQuality_;
  std::vector<ElementMetric<D>> metrics_;
  Proposal<D> proposal_;
};

// The metric of each element, frozen while the cluster is solved; a single one if it is the same
// everywhere.
template <int D, class Shape>
void ClusterSolver<D, Shape>::setMetrics()
{
  const NodalMetric<D>& metric = *this->judge_.model().metric;
  this->metrics_.clear();
  const std::size_t count = metric.isTrivial() ? 1 : this->cluster_.cells.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    this->metrics_.push_back(metric.element(this->judge_.mesh().nodes(this->cluster_.cells[k])));
  }
}

template <int D, class Shape>
bool ClusterSolver<D, Shape>::solve(Index cell, int level, const std::vector<std::uint8_t>& movable)
{
  this->gatherer_.gather(
    this->judge_.editor(), cell, level, [&](Index p) { return movable[p] != 0; }, this->cluster_);
  this->oldQuality_ = this->cluster_.quality;
  if (this->cluster_.cells.empty())
  {
    return false;
  }
  this->setMetrics();
  const LocalResult result = this->local_.solve(this->cluster_, this->metrics_);
  const double required = raised(result.before, this->leastGain_);
  // Cells may be inverted before: a quality that is not positive proves nothing, so the moving
  // nodes must also lie among the others.
  return result.after > required && (result.after > 0.0 || this->cluster_.isAmidPoints()) &&
    this->offer(required);
}

/// Without a varying metric, the qualities found by the algorithm are those of the mesh. With one,
/// they are computed again with the metric at the new places.
template <int D, class Shape>
bool ClusterSolver<D, Shape>::offer(double required)
{
  Cluster<D>& cluster = this->cluster_;
  const bool varies = !this->judge_.model().metric->isTrivial();
  Proposal<D>& p = this->proposal_;
  p.clear();
  p.cavity = cluster.cells;
  p.least = required;
  p.keepsPositive = varies;
  for (int k = 0; k < cluster.numberOfMoving; ++k)
  {
    // With a varying metric all moving nodes are placed, so that the metric is sampled at each.
    if (varies || cluster.x[k] != this->judge_.mesh().point(cluster.points[k]))
    {
      p.moves.push_back({ cluster.points[k], cluster.x[k], {} });
    }
  }
  if (!varies)
  {
    p.qualities = cluster.quality;
  }
  this->judge_.start();
  if (!this->judge_.accept(p))
  {
    return false;
  }
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    cluster.quality[k] = this->judge_.mesh().quality(cluster.cells[k]);
  }
  return true;
}
}

#endif
