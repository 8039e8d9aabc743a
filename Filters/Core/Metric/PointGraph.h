// SPDX-License-Identifier: BSD-3-Clause
/// @file PointGraph.h
/// The graph of points that share an edge.
#ifndef meshopt_Metric_PointGraph_h
#define meshopt_Metric_PointGraph_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Neighbours of all points in one array. Those of point p are ids[first[p]] ... ids[first[p + 1] -
/// 1], ascending. Points that no cell uses have none.
struct PointGraph
{
  std::vector<Index> first; ///< one per point slot, plus one
  std::vector<Index> ids;

  Index numberOfPoints() const { return static_cast<Index>(this->first.size()) - 1; }

  /// Edges of the live cells; O(n log of the greatest degree).
  template <int D>
  static PointGraph of(const SimplexMesh<D>& mesh);
};

extern template PointGraph PointGraph::of<2>(const SimplexMesh<2>&);
extern template PointGraph PointGraph::of<3>(const SimplexMesh<3>&);
}

#endif
