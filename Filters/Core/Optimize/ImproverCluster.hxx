// SPDX-License-Identifier: BSD-3-Clause
/// @file ImproverCluster.hxx
/// Several nodes moved at once.
#ifndef meshopt_Optimize_ImproverCluster_hxx
#define meshopt_Optimize_ImproverCluster_hxx

namespace meshopt
{
/// The cluster of cell t with neighbours of order 1 (section 2.2), less the nodes of cells that are
/// worse than t: those, held by a cap perhaps, would stop everything. False if nothing may move.
template <int D, class Shape>
bool Improver<D, Shape>::gatherCluster(Index t)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  Cluster<D>& cluster = this->moving_;
  cluster = Cluster<D>();
  std::vector<Index> front(mesh.nodes(t).begin(), mesh.nodes(t).end());
  LocalNumbers& seen = this->numbers_;
  seen.clear();
  for (Index p : front)
  {
    seen.add(p);
  }
  for (int k = 0; k <= D; ++k)
  {
    mesh.star(front[k], this->star_);
    for (Index c : this->star_)
    {
      for (Index p : mesh.nodes(c))
      {
        if (seen.get(p) < 0)
        {
          seen.add(p);
          front.push_back(p);
        }
      }
    }
  }
  std::vector<Index> cells;
  for (Index p : front)
  {
    if (!mesh.isFixed(p) && this->editor_->star(p, this->star_) &&
      !(mesh.worstQuality(this->star_) < mesh.quality(t)))
    {
      cluster.points.push_back(p);
      cells.insert(cells.end(), this->star_.begin(), this->star_.end());
    }
  }
  cluster.numberOfMoving = static_cast<int>(cluster.points.size());
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  seen.clear();
  for (Index p : cluster.points)
  {
    seen.add(p);
    cluster.x.push_back(mesh.point(p));
  }
  for (Index c : cells)
  {
    Simplex<D> local;
    for (int i = 0; i <= D; ++i)
    {
      local[i] = seen.add(mesh.nodes(c)[i]);
      if (local[i] == static_cast<int>(cluster.points.size()))
      {
        cluster.points.push_back(mesh.nodes(c)[i]);
        cluster.x.push_back(mesh.point(mesh.nodes(c)[i]));
      }
    }
    cluster.nodes.push_back(local);
    cluster.quality.push_back(mesh.quality(c));
  }
  cluster.cells.swap(cells);
  return std::find(cluster.cells.begin(), cluster.cells.end(), t) != cluster.cells.end();
}

template <int D, class Shape>
bool Improver<D, Shape>::moveCluster(Index t)
{
  if (!this->options_->moveNodes || !this->gatherCluster(t))
  {
    return false;
  }
  const double old = this->editor_->mesh().quality(t);
  std::vector<ElementMetric<D>> metrics;
  for (std::size_t k = 0; k < (this->model_->plain ? 0 : this->moving_.cells.size()); ++k)
  {
    metrics.push_back(
      this->model_->metric->element(this->editor_->mesh().nodes(this->moving_.cells[k])));
  }
  if (this->model_->plain)
  {
    metrics.emplace_back();
  }
  const double now = this->clusterProblem_.maximize(this->moving_, this->model_->quality, metrics,
    std::max(this->enough(), old + 2 * gain(old)), 0.5 * gain(old));
  bool better = now > old + gain(old);
  if (better)
  {
    const Place start = this->begin();
    for (int k = 0; k < this->moving_.numberOfMoving; ++k)
    {
      this->place(this->moving_.points[k], this->moving_.x[k], this->moving_.points[k]);
    }
    this->star_ = this->moving_.cells;
    better = this->settleStar(old);
    better ? this->commit(start) : this->rollback(start);
  }
  this->count(Operation::NodeMotion, better);
  return better;
}
}

#endif
