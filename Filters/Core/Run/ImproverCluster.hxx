// SPDX-License-Identifier: BSD-3-Clause
/// @file ImproverCluster.hxx
/// Several nodes moved at once.
#ifndef meshopt_Run_ImproverCluster_hxx
#define meshopt_Run_ImproverCluster_hxx

namespace meshopt
{
/// Moves the nodes of the cluster of cell t with neighbours of order 1 (section 2.2), less those of
/// cells that are worse than t: those, held by a cap perhaps, would stop everything.
template <int D, class Shape>
bool Improver<D, Shape>::moveCluster(Index t)
{
  if (!this->options_->moveNodes)
  {
    return false;
  }
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  const double old = mesh.quality(t);
  const auto mayMove = [&](Index p)
  {
    return !mesh.isFixed(p) && this->editor_->star(p, this->star_) &&
      !(mesh.worstQuality(this->star_) < old);
  };
  this->gatherer_.gather(t, 1, mayMove, this->moving_);
  const std::vector<Index>& cells = this->moving_.cells;
  if (std::find(cells.begin(), cells.end(), t) == cells.end())
  {
    return false;
  }
  std::vector<ElementMetric<D>> metrics;
  if (this->model_->plain)
  {
    metrics.emplace_back(); // one for all
  }
  else
  {
    for (Index c : cells)
    {
      metrics.push_back(this->model_->metric->element(mesh.nodes(c)));
    }
  }
  const double now = this->clusterProblem_.maximize(this->moving_, this->model_->quality, metrics,
    std::max(this->enough(), old + 2 * gain(old)), 0.5 * gain(old));
  bool better = now > old + gain(old) && (now > 0.0 || this->moving_.isAmidPoints());
  if (better)
  {
    const Place start = this->begin();
    for (int k = 0; k < this->moving_.numberOfMoving; ++k)
    {
      this->place(this->moving_.points[k], this->moving_.x[k], this->moving_.points[k]);
    }
    this->star_ = cells;
    better = this->settleStar(old);
    better ? this->commit(start) : this->rollback(start);
  }
  this->count(Operation::NodeMotion, better);
  return better;
}
}

#endif
