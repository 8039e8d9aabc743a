// SPDX-License-Identifier: BSD-3-Clause
/// @file ClusterSolver.h
/// Steps 3 and 4 of the global algorithm on a mesh: gather the cluster of an element, solve it,
/// and move the nodes if that is a gain.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2. For the departures see
/// GlobalAlgorithm.h.
#ifndef meshopt_Paper1996_ClusterSolver_h
#define meshopt_Paper1996_ClusterSolver_h

#include "Metric/NodalMetric.h"
#include "Paper1996/LocalAlgorithm.h"

#include <cmath>
#include <limits>

namespace meshopt
{
template <int D, class Shape>
class ClusterSolver
{
public:
  ClusterSolver(MeshEditor<D>& editor, NodalMetric<D>& metric,
    const ElementQuality<D, Shape>& quality, const LocalParameters& parameters, double leastGain)
    : editor_(editor)
    , metric_(metric)
    , quality_(quality)
    , gatherer_(editor)
    , local_(quality, parameters)
    , leastGain_(leastGain)
  {
  }

  /// Optimizes the cluster of `cell` with neighbours of order `level`; `movable`: nonzero per point
  /// slot. Returns true if the worst quality of the cluster has risen by more than a fraction
  /// leastGain; otherwise the mesh is as it was, to the bit.
  bool solve(Index cell, int level, const std::vector<std::uint8_t>& movable);

  /// The cluster solved last, as it is now, and the qualities of its cells before.
  const Cluster<D>& cluster() const { return this->cluster_; }
  const std::vector<double>& oldQuality() const { return this->oldQuality_; }
  /// The metric at its moving nodes before, if the metric is not trivial.
  const std::vector<typename NodalMetric<D>::Sample>& oldSamples() const
  {
    return this->oldSamples_;
  }

private:
  void setMetrics();
  bool accept();
  bool isGain(double before, double after) const
  {
    return after > before + this->leastGain_ * std::abs(before);
  }

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  ElementQuality<D, Shape> quality_;
  ClusterGatherer<D> gatherer_;
  LocalAlgorithm<D, Shape> local_;
  double leastGain_;
  Cluster<D> cluster_;
  std::vector<double> oldQuality_;
  std::vector<typename NodalMetric<D>::Sample> oldSamples_;
  std::vector<ElementMetric<D>> metrics_;
};

// The metric of each element, frozen while the cluster is solved; a single one where it is the same
// everywhere.
template <int D, class Shape>
void ClusterSolver<D, Shape>::setMetrics()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->metrics_.clear();
  const std::size_t count = this->metric_.isTrivial() ? 1 : this->cluster_.cells.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    this->metrics_.push_back(this->metric_.element(mesh.nodes(this->cluster_.cells[k])));
  }
}

template <int D, class Shape>
bool ClusterSolver<D, Shape>::solve(Index cell, int level, const std::vector<std::uint8_t>& movable)
{
  this->gatherer_.gather(
    cell, level, [&](Index p) { return movable[p] != 0; }, this->cluster_);
  this->oldQuality_ = this->cluster_.quality;
  if (this->cluster_.cells.empty())
  {
    return false;
  }
  this->setMetrics();
  const LocalResult result = this->local_.solve(this->cluster_, this->metrics_);
  if (!this->isGain(result.before, result.after) ||
    !(result.after > 0.0 || this->cluster_.isAmidPoints()))
  {
    return false;
  }
  const std::size_t place = this->editor_.begin();
  this->oldSamples_.clear();
  for (int k = 0; k < this->cluster_.numberOfMoving && !this->metric_.isTrivial(); ++k)
  {
    this->oldSamples_.push_back(this->metric_.sample(this->cluster_.points[k]));
  }
  for (int k = 0; k < this->cluster_.numberOfMoving; ++k)
  {
    const Index p = this->cluster_.points[k];
    if (this->cluster_.x[k] != this->editor_.mesh().point(p))
    {
      this->editor_.movePoint(p, this->cluster_.x[k]);
    }
  }
  if (!this->accept())
  {
    this->editor_.rollback(place);
    for (std::size_t k = 0; k < this->oldSamples_.size(); ++k)
    {
      this->metric_.setSample(this->cluster_.points[k], this->oldSamples_[k]);
    }
    return false;
  }
  this->editor_.commit(place);
  return true;
}

// Sets the qualities of the cluster; with a metric that varies, those in the metric as it is now.
template <int D, class Shape>
bool ClusterSolver<D, Shape>::accept()
{
  Cluster<D>& cluster = this->cluster_;
  if (!this->metric_.isTrivial())
  {
    for (int k = 0; k < cluster.numberOfMoving; ++k)
    {
      this->metric_.resample(cluster.points[k], cluster.x[k]);
    }
    double before = std::numeric_limits<double>::infinity(), after = before;
    bool inverts = false;
    for (std::size_t k = 0; k < cluster.cells.size(); ++k)
    {
      const Index c = cluster.cells[k];
      const double q = this->quality_.value(
        cluster.corners(static_cast<int>(k)), this->metric_.element(this->editor_.mesh().nodes(c)));
      cluster.quality[k] = q;
      before = std::min(before, this->oldQuality_[k]);
      after = q < after || q != q ? q : after;
      inverts = inverts || (!(q > 0.0) && this->oldQuality_[k] > 0.0);
    }
    if (inverts || !this->isGain(before, after))
    {
      return false;
    }
  }
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    if (cluster.quality[k] != this->oldQuality_[k])
    {
      this->editor_.setQuality(cluster.cells[k], cluster.quality[k]);
    }
  }
  return true;
}

}

#endif
