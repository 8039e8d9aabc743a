// SPDX-License-Identifier: BSD-3-Clause
/// @file Filling.h
/// What can be tried around one element: its clusters, and the apexes from which they can be
/// filled.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.3 and figure 1.
#ifndef meshopt_Paper1996_Filling_h
#define meshopt_Paper1996_Filling_h

#include "Paper1996/Fan.h"
#include "Paper1996/FanCluster.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meshopt
{
/// The operations of figure 1 and, in 3D, their analogues at the surface.
enum class Filling
{
  RingNode = 0, ///< interior edge cluster, a ring node: the edge vanishes
  OpenRing,     ///< cluster at kept facets, one of its points: points and kept facets stay
  BoundaryNode, ///< node cluster, a boundary node: the node vanishes
  Centre,       ///< node cluster, its centre: the node moves there
  NewCentre,    ///< node cluster at kept facets, its centre: a node is added
  Midpoint,     ///< edge cluster, midpoint: a node is added
  Count
};
inline constexpr int NumberOfFillings = static_cast<int>(Filling::Count);

/// Which elements have failed since their surroundings last changed. Kept from pass to pass, so
/// that only what has changed in between is tried again.
template <int D>
struct ReconnectionMemory
{
  std::uint32_t time = 0;
  std::vector<std::uint32_t> failed;  ///< per cell slot: time of the last failure; 0: never
  std::vector<std::uint32_t> ahead;   ///< the same for the look-ahead
  std::vector<std::uint32_t> changed; ///< per point slot: last change in its star

  /// Adapts the sizes to the mesh.
  void resize(const SimplexMesh<D>& mesh);
  /// Must be called for every point whose star has changed.
  void touch(Index p) { this->changed[p] = this->time; }
  /// True if something around a node of c has changed since `when`.
  bool hasChanged(const SimplexMesh<D>& mesh, Index c, std::uint32_t when) const;
};

/// A cluster, and the node or edge (second id not None) that it surrounds.
template <int D>
struct ElementCluster
{
  FanCluster<D> cluster;
  std::array<Index, 2> core{ None, None };
  bool usable = false;

  bool isEdge() const { return this->core[1] != None; }
  /// The kind of its fillings from a boundary point.
  Filling kindFromBoundary() const;
};

/// The clusters of one element.
template <int D>
class ElementClusters
{
public:
  /// Gathers the clusters whose worst cell is c, if they have changed since `when`. A change in the
  /// cells around a node is noted at the node; a change around an edge is noted at both its nodes.
  /// Precondition: memory.resize() has been called since points were added.
  void gather(
    MeshEditor<D>& editor, Index c, const ReconnectionMemory<D>& memory, std::uint32_t when);

  /// Calls f(around, kind, apex) for every filling to be tried, in the order of the paper's figure:
  /// edge clusters from ring nodes, node clusters from the centre, node clusters from boundary
  /// nodes, edge clusters from the midpoint. So nodes are added only where nothing else helps.
  /// Apexes come in ascending order of ids; a new point has no id. Stops and returns true once f
  /// returns true.
  template <class F>
  bool forEach(const SimplexMesh<D>& mesh, F&& f) const;

private:
  template <class F>
  static bool fromBoundary(const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f);
  template <class F>
  static bool fromCentre(const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f);
  template <class F>
  static bool fromMidpoint(const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f);

  std::array<ElementCluster<D>, Local<D>::numberOfEdges> edges_;
  std::array<ElementCluster<D>, D + 1> nodes_;
};

template <int D>
template <class F>
bool ElementClusters<D>::fromBoundary(
  const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f)
{
  const FanCluster<D>& cluster = around.cluster;
  const Filling kind = around.kindFromBoundary();
  if (!around.usable || (kind == Filling::BoundaryNode && !mesh.isFree(around.core[0])))
  {
    return false;
  }
  for (std::size_t k = 0; k < cluster.points.size(); ++k)
  {
    const Apex<D> apex{ static_cast<int>(k), cluster.points[k], cluster.x[k] };
    // A fan from the core itself would be the cluster as it is.
    if (apex.id != around.core[0] && apex.id != around.core[1] && f(around, kind, apex))
    {
      return true;
    }
  }
  return false;
}

template <int D>
template <class F>
bool ElementClusters<D>::fromCentre(
  const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f)
{
  const bool moves = around.cluster.coreInside;
  if (!around.usable || (moves && !mesh.isFree(around.core[0])))
  {
    return false;
  }
  const Apex<D> apex{ -1, moves ? around.core[0] : None, clusterCentre<D>(around.cluster) };
  return f(around, moves ? Filling::Centre : Filling::NewCentre, apex);
}

template <int D>
template <class F>
bool ElementClusters<D>::fromMidpoint(
  const SimplexMesh<D>& mesh, const ElementCluster<D>& around, F&& f)
{
  if (!around.usable || !around.cluster.closed)
  {
    return false;
  }
  const Vec<D> middle = 0.5 * (mesh.point(around.core[0]) + mesh.point(around.core[1]));
  return f(around, Filling::Midpoint, Apex<D>{ -1, None, middle });
}

template <int D>
template <class F>
bool ElementClusters<D>::forEach(const SimplexMesh<D>& mesh, F&& f) const
{
  bool stop = false;
  for (std::size_t k = 0; k < this->edges_.size() && !stop; ++k)
  {
    stop = fromBoundary(mesh, this->edges_[k], f);
  }
  for (std::size_t k = 0; k < this->nodes_.size() && !stop; ++k)
  {
    stop = fromCentre(mesh, this->nodes_[k], f);
  }
  for (std::size_t k = 0; k < this->nodes_.size() && !stop; ++k)
  {
    stop = fromBoundary(mesh, this->nodes_[k], f);
  }
  for (std::size_t k = 0; k < this->edges_.size() && !stop; ++k)
  {
    stop = fromMidpoint(mesh, this->edges_[k], f);
  }
  return stop;
}

extern template struct ReconnectionMemory<2>;
extern template struct ReconnectionMemory<3>;
extern template struct ElementCluster<2>;
extern template struct ElementCluster<3>;
extern template class ElementClusters<2>;
extern template class ElementClusters<3>;
}

#endif
