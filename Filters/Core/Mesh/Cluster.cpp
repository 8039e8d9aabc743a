// SPDX-License-Identifier: BSD-3-Clause
// Gathers the cells around a few nodes, with numbers of their own, so that a local problem can be
// solved without the mesh.
#include "Mesh/Cluster.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
/// An edge counts once for each of its cells, so edges inside weigh more than those at the rim. The
/// result is only a scale of length, so this does not matter.
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

/// The number of the point in the cluster; a new point gets the next one. Numbers come in the order
/// of asking, so whoever asks for the moving nodes first gets 0 to numberOfMoving - 1.
template <int D>
int ClusterGatherer<D>::localNumber(const SimplexMesh<D>& mesh, Index p, Cluster<D>& cluster)
{
  const int k = this->numbers_.add(p);
  if (k == static_cast<int>(cluster.points.size()))
  {
    cluster.points.push_back(p);
    cluster.x.push_back(mesh.point(p));
  }
  return k;
}

/// Puts the neighbours of the cell into front_, order by order.
template <int D>
void ClusterGatherer<D>::findNeighbours(MeshEditor<D>& editor, Index cell, int level)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->numbers_.clear();
  this->front_.assign(mesh.nodes(cell).begin(), mesh.nodes(cell).end());
  for (Index p : this->front_)
  {
    this->numbers_.add(p);
  }
  // Each round looks only at the points that the last one has added.
  for (std::size_t begin = 0; level > 0; --level)
  {
    const std::size_t end = this->front_.size();
    for (; begin < end; ++begin)
    {
      editor.star(this->front_[begin], this->star_);
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

/// Numbers the moving nodes (those of front_) first; then collects their cells with all other
/// nodes.
template <int D>
void ClusterGatherer<D>::collect(MeshEditor<D>& editor, Cluster<D>& cluster)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  cluster.points.clear();
  cluster.x.clear();
  cluster.cells.clear();
  cluster.nodes.clear();
  cluster.quality.clear();
  this->numbers_.clear();
  for (Index p : this->front_)
  {
    this->localNumber(mesh, p, cluster);
  }
  cluster.numberOfMoving = static_cast<int>(cluster.points.size());
  // star() overwrites marks, so these cannot tell which cells are taken: a cell is taken at its
  // first moving node in local order.
  for (int k = 0; k < cluster.numberOfMoving; ++k)
  {
    editor.star(cluster.points[k], this->star_);
    for (Index c : this->star_)
    {
      Simplex<D> local;
      int first = cluster.numberOfMoving;
      for (int i = 0; i <= D; ++i)
      {
        local[i] = this->localNumber(mesh, mesh.nodes(c)[i], cluster);
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

template struct Cluster<2>;
template struct Cluster<3>;
template class ClusterGatherer<2>;
template class ClusterGatherer<3>;
}
