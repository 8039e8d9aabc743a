// SPDX-License-Identifier: BSD-3-Clause
/// @file FanCluster.h
/// All cells around a node or an edge, and the facets that bound them: the part that is emptied and
/// filled again.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.3 (nodal and edge clusters).
#ifndef meshopt_Paper1996_FanCluster_h
#define meshopt_Paper1996_FanCluster_h

#include "Mesh/MeshEditor.h"

#include <vector>

namespace meshopt
{
/// A cluster of section 2.3: all cells around a node or an edge, on one side of kept facets, with
/// the facets that bound them. Reconnection removes its interior and joins the facets to an apex.
template <int D>
struct FanCluster
{
  std::vector<Index> cells;
  /// Bounding facets in local numbers. (facet, apex) is positively oriented for an apex inside.
  std::vector<Facet<D>> facets;
  std::vector<Index> points; ///< points of the facets, by local number: ascending ids
  std::vector<Vec<D>> x;     ///< their coordinates
  bool coreInside = false;   ///< the central node is on no facet: it vanishes
  bool closed = false;       ///< no facet contains the core (node or edge): it is interior
  double worst = 0.0;        ///< least quality of the cells
  int inverted = 0;          ///< cells with quality <= 0

  bool contains(int facet, int apex) const
  {
    for (int p : this->facets[facet])
    {
      if (p == apex)
      {
        return true;
      }
    }
    return false;
  }
};

/// Gathers the cluster around a node (n = 1) or an edge (n = 2) `core` of `cell`: the cells that
/// contain the core and can be reached from `cell` over facets that contain the core and are not
/// kept. A node on the boundary of the cluster (on a kept facet) stays; see FanCluster::coreInside.
/// Returns false if the cluster lies on both sides of a kept facet: it must then not be changed.
/// Also returns false, early, if `cell` is not the worst of the cluster by (quality, id). The cells
/// keep the mark editor.lastMark().
template <int D>
bool gatherFanCluster(
  MeshEditor<D>& editor, Index cell, const Index* core, int n, FanCluster<D>& cluster);

extern template bool gatherFanCluster<2>(MeshEditor<2>&, Index, const Index*, int, FanCluster<2>&);
extern template bool gatherFanCluster<3>(MeshEditor<3>&, Index, const Index*, int, FanCluster<3>&);
}

#endif
