// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Cluster.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
template <int D>
double Cluster<D>::meanEdge() const
{
  double sum = 0.0;
  for (const Simplex<D>& cell : this->nodes)
  {
    for (const auto& e : Local<D>::edges)
    {
      sum += (this->x[cell[e[1]]] - this->x[cell[e[0]]]).norm();
    }
  }
  const double count = static_cast<double>(this->nodes.size()) * Local<D>::numberOfEdges;
  return count > 0.0 ? sum / count : 0.0;
}

template <int D>
int ClusterGatherer<D>::localNumber(Index p, Cluster<D>& cluster)
{
  const int k = this->numbers_.add(p);
  if (k == static_cast<int>(cluster.points.size()))
  {
    cluster.points.push_back(p);
    cluster.x.push_back(this->editor_->mesh().point(p));
  }
  return k;
}

/// Neighbours of the cell, order by order, in front_.
template <int D>
void ClusterGatherer<D>::findNeighbours(Index cell, int level)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  this->numbers_.clear();
  this->front_.assign(mesh.nodes(cell).begin(), mesh.nodes(cell).end());
  for (Index p : this->front_)
  {
    this->numbers_.add(p);
  }
  for (std::size_t begin = 0; level > 0; --level)
  {
    const std::size_t end = this->front_.size();
    for (; begin < end; ++begin)
    {
      this->editor_->star(this->front_[begin], this->star_);
      for (Index c : this->star_)
      {
        for (Index p : mesh.nodes(c))
        {
          if (this->numbers_.get(p) < 0)
          {
            this->numbers_.add(p);
            this->front_.push_back(p);
          }
        }
      }
    }
  }
}

/// Moving nodes, those of front_, first; then their cells with whatever other nodes these have.
template <int D>
void ClusterGatherer<D>::collect(Cluster<D>& cluster)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  cluster.points.clear();
  cluster.x.clear();
  cluster.cells.clear();
  cluster.nodes.clear();
  cluster.quality.clear();
  this->numbers_.clear();
  for (Index p : this->front_)
  {
    this->localNumber(p, cluster);
  }
  cluster.numberOfMoving = static_cast<int>(cluster.points.size());
  // star() uses marks of its own: a cell is taken at its first moving node in local order.
  for (int k = 0; k < cluster.numberOfMoving; ++k)
  {
    this->editor_->star(cluster.points[k], this->star_);
    for (Index c : this->star_)
    {
      Simplex<D> local;
      int first = cluster.numberOfMoving;
      for (int i = 0; i <= D; ++i)
      {
        local[i] = this->localNumber(mesh.nodes(c)[i], cluster);
        first = std::min<int>(first, local[i]);
      }
      if (first == k)
      {
        cluster.cells.push_back(c);
        cluster.nodes.push_back(local);
        cluster.quality.push_back(mesh.quality(c));
      }
    }
  }
}

namespace
{
// Local numbers of the facets' points, ascending by id; facets come with ids and leave with
// numbers.
template <int D>
void numberPoints(const SimplexMesh<D>& mesh, FanCluster<D>& cluster)
{
  cluster.points.clear();
  for (const Facet<D>& f : cluster.facets)
  {
    cluster.points.insert(cluster.points.end(), f.begin(), f.end());
  }
  std::sort(cluster.points.begin(), cluster.points.end());
  cluster.points.erase(
    std::unique(cluster.points.begin(), cluster.points.end()), cluster.points.end());
  cluster.x.clear();
  for (Index p : cluster.points)
  {
    cluster.x.push_back(mesh.point(p));
  }
  for (Facet<D>& f : cluster.facets)
  {
    for (Index& p : f)
    {
      const auto at = std::lower_bound(cluster.points.begin(), cluster.points.end(), p);
      p = static_cast<Index>(at - cluster.points.begin());
    }
  }
}
}

template <int D>
bool gatherFanCluster(
  MeshEditor<D>& editor, Index cell, const Index* core, int n, FanCluster<D>& cluster)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  const auto inCore = [&](Index p) { return p == core[0] || (n == 2 && p == core[1]); };
  const auto isWorse = [&](Index c)
  {
    const double q = mesh.quality(c), limit = mesh.quality(cell);
    return q < limit || (q == limit && c < cell);
  };
  const std::uint32_t mark = editor.newMark();
  cluster.cells.assign(1, cell);
  cluster.facets.clear();
  editor.setMark(cell, mark);
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    const Index c = cluster.cells[k];
    for (int i = 0; i <= D; ++i)
    {
      if (!inCore(mesh.nodes(c)[i]) && !mesh.isConstrained(c, i))
      {
        const Index next = SimplexMesh<D>::cellOf(mesh.adjacent(c, i));
        if (!editor.isMarked(next, mark))
        {
          if (isWorse(next))
          {
            return false;
          }
          editor.setMark(next, mark);
          cluster.cells.push_back(next);
        }
      }
    }
  }

  cluster.worst = mesh.quality(cell);
  cluster.inverted = 0;
  cluster.closed = true;
  for (Index c : cluster.cells)
  {
    cluster.inverted += mesh.quality(c) <= 0.0 ? 1 : 0;
    for (int i = 0; i <= D; ++i)
    {
      const Index across = mesh.adjacent(c, i);
      const bool inside = across != None && editor.isMarked(SimplexMesh<D>::cellOf(across), mark);
      const bool kept = mesh.isConstrained(c, i);
      if (kept && inside)
      {
        return false;
      }
      if (kept || !inside)
      {
        cluster.facets.push_back(mesh.facet(c, i));
        cluster.closed = cluster.closed && inCore(mesh.nodes(c)[i]);
      }
    }
  }
  numberPoints<D>(mesh, cluster);
  cluster.coreInside = n == 1 &&
    !std::binary_search(cluster.points.begin(), cluster.points.end(), core[0]);
  return true;
}

template struct Cluster<2>;
template struct Cluster<3>;
template class ClusterGatherer<2>;
template class ClusterGatherer<3>;
template bool gatherFanCluster<2>(MeshEditor<2>&, Index, const Index*, int, FanCluster<2>&);
template bool gatherFanCluster<3>(MeshEditor<3>&, Index, const Index*, int, FanCluster<3>&);
}
