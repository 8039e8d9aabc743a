// SPDX-License-Identifier: BSD-3-Clause
// Two passes over the edges, counting and filling, then the neighbours of each point are sorted: no
// set and no map is needed.
#include "Metric/PointGraph.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// Calls visit(p, q) for both directions of each edge of each live cell.
template <int D, class F>
void forEachEdge(const SimplexMesh<D>& mesh, F&& visit)
{
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int e = 0; e < Local<D>::numberOfEdges && mesh.isAlive(c); ++e)
    {
      const Index p = mesh.nodes(c)[Local<D>::edges[e][0]];
      const Index q = mesh.nodes(c)[Local<D>::edges[e][1]];
      visit(p, q);
      visit(q, p);
    }
  }
}
}

template <int D>
PointGraph PointGraph::of(const SimplexMesh<D>& mesh)
{
  const Index n = mesh.numberOfPointSlots();
  // First with repetitions: an edge appears once for each cell around it.
  std::vector<std::size_t> start(static_cast<std::size_t>(n) + 1, 0);
  forEachEdge(mesh, [&start](Index p, Index) { ++start[p + 1]; });
  for (Index p = 0; p < n; ++p)
  {
    start[p + 1] += start[p];
  }
  std::vector<Index> repeated(start[n]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  forEachEdge(mesh, [&](Index p, Index q) { repeated[next[p]++] = q; });

  PointGraph graph;
  graph.first.assign(static_cast<std::size_t>(n) + 1, 0);
  for (Index p = 0; p < n; ++p)
  {
    // Sorted: the order of neighbours does not depend on the order of cells.
    const auto begin = repeated.begin() + start[p], end = repeated.begin() + start[p + 1];
    std::sort(begin, end);
    graph.ids.insert(graph.ids.end(), begin, std::unique(begin, end));
    graph.first[p + 1] = static_cast<Index>(graph.ids.size());
  }
  return graph;
}

template PointGraph PointGraph::of<2>(const SimplexMesh<2>&);
template PointGraph PointGraph::of<3>(const SimplexMesh<3>&);
}
