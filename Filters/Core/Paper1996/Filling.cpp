// SPDX-License-Identifier: BSD-3-Clause
// What is remembered from try to try, so that nothing is tried twice while nothing has changed.
#include "Paper1996/Filling.h"

#include <algorithm>

namespace meshopt
{
template <int D>
void ReconnectionMemory<D>::resize(const SimplexMesh<D>& mesh)
{
  // Changed at 1 and failed at 0: what was never tried is fresh.
  this->time = std::max<std::uint32_t>(this->time, 1);
  this->failed.resize(mesh.numberOfCellSlots(), 0);
  this->ahead.resize(mesh.numberOfCellSlots(), 0);
  this->changed.resize(mesh.numberOfPointSlots(), 1);
}

template <int D>
bool ReconnectionMemory<D>::hasChanged(
  const SimplexMesh<D>& mesh, Index c, std::uint32_t when) const
{
  for (Index p : mesh.nodes(c))
  {
    if (this->changed[p] > when)
    {
      return true;
    }
  }
  return false;
}

/// From a boundary point the core vanishes if it is inside; at kept facets it stays.
template <int D>
Filling ElementCluster<D>::kindFromBoundary() const
{
  if (this->isEdge())
  {
    return this->cluster.closed ? Filling::RingNode : Filling::OpenRing;
  }
  return this->cluster.coreInside ? Filling::BoundaryNode : Filling::OpenRing;
}

/// What has not changed since `when` was tried then, and failed.
template <int D>
void ElementClusters<D>::gather(
  MeshEditor<D>& editor, Index c, const ReconnectionMemory<D>& memory, std::uint32_t when)
{
  const Simplex<D> nodes = editor.mesh().nodes(c);
  const auto hasChanged = [&](Index p) { return memory.changed[p] > when; };
  for (int e = 0; e < Local<D>::numberOfEdges; ++e)
  {
    ElementCluster<D>& around = this->edges_[e];
    around.core = { nodes[Local<D>::edges[e][0]], nodes[Local<D>::edges[e][1]] };
    // A change in the cluster of an edge touches both of its ends.
    around.usable = hasChanged(around.core[0]) && hasChanged(around.core[1]) &&
      gatherFanCluster<D>(editor, c, around.core.data(), 2, around.cluster);
  }
  for (int i = 0; i <= D; ++i)
  {
    ElementCluster<D>& around = this->nodes_[i];
    around.core = { nodes[i], None };
    around.usable = hasChanged(nodes[i]) &&
      gatherFanCluster<D>(editor, c, around.core.data(), 1, around.cluster);
  }
}

template struct ReconnectionMemory<2>;
template struct ReconnectionMemory<3>;
template struct ElementCluster<2>;
template struct ElementCluster<3>;
template class ElementClusters<2>;
template class ElementClusters<3>;
}
