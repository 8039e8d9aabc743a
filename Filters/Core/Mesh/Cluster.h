// SPDX-License-Identifier: BSD-3-Clause
/// @file Cluster.h
/// The few cells that are worked on, numbered locally: the part of a mesh that node motion sees.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2 (steps 3 and 4 of the global
/// algorithm: neighbours of order NL, moving nodes, optimization cluster).
#ifndef meshopt_Mesh_Cluster_h
#define meshopt_Mesh_Cluster_h

#include "Mesh/LocalNumbers.h"
#include "Mesh/MeshEditor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace meshopt
{
/// The optimization cluster of section 2.2: the cells that contain a moving node. Local point
/// numbers 0 .. numberOfMoving - 1 are the moving nodes, the others follow.
template <int D>
struct Cluster
{
  std::vector<Index> points;     ///< local number -> point of the mesh
  std::vector<Vec<D>> x;         ///< coordinates, by local number
  std::vector<Index> cells;      ///< cells of the mesh
  std::vector<Simplex<D>> nodes; ///< local point numbers of each cell
  std::vector<double> quality;   ///< of each cell, as stored in the mesh
  int numberOfMoving = 0;

  Corners<D> corners(int k) const
  {
    Corners<D> c;
    for (int i = 0; i <= D; ++i)
    {
      c[i] = this->x[this->nodes[k][i]];
    }
    return c;
  }
  /// Whether the moving nodes lie in the bounding box of the others. This holds if no cell is
  /// inverted.
  bool isAmidPoints() const
  {
    Eigen::AlignedBox<double, D> box;
    std::for_each(this->x.begin() + this->numberOfMoving, this->x.end(),
      [&](const Vec<D>& p) { box.extend(p); });
    return std::all_of(this->x.begin(), this->x.begin() + this->numberOfMoving,
      [&](const Vec<D>& p) { return box.contains(p); });
  }
  /// Mean length of the edges of all cells (an edge counts once for each cell): the L of (2.5).
  double meanEdge() const;
};

/// Gathers optimization clusters; keeps its scratch memory between calls. The cost of a call is
/// proportional to the cells around the neighbourhood, not to the mesh.
template <int D>
class ClusterGatherer
{
public:
  /// The cluster of `cell`. Its neighbourhood of order `level` are its own nodes (0), also those
  /// joined to them by an edge (1), and so on. Nodes of the neighbourhood for which movable(p) is
  /// true become moving nodes, in the order of distance. The cells are those that contain a moving
  /// node. What the editor does not own is ignored.
  template <class Movable>
  void gather(MeshEditor<D>& editor, Index cell, int level, Movable&& movable, Cluster<D>& cluster)
  {
    this->findNeighbours(editor, cell, level);
    this->front_.erase(std::remove_if(this->front_.begin(), this->front_.end(),
                         [&](Index p) { return !movable(p); }),
      this->front_.end());
    this->collect(editor, cluster);
  }

private:
  void findNeighbours(MeshEditor<D>& editor, Index cell, int level);
  void collect(MeshEditor<D>& editor, Cluster<D>& cluster);
  int localNumber(const SimplexMesh<D>& mesh, Index p, Cluster<D>& cluster);

  LocalNumbers numbers_;
  std::vector<Index> front_, star_;
};

extern template struct Cluster<2>;
extern template struct Cluster<3>;
extern template class ClusterGatherer<2>;
extern template class ClusterGatherer<3>;
}

#endif
