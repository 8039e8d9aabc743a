// SPDX-License-Identifier: BSD-3-Clause
// Division of an edge as a change of topology only: the same division of labour as in
// EdgeContraction.cpp.
#include "Operations/EdgeSplit.h"

#include "Mesh/Ids.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// Collects the cells around the edge. Returns whether the editor owns all of them. `isKept`: the
/// edge is part of a kept facet, or kept by itself.
bool cellsAround(
  const MeshEditor<2>& editor, Index t, Index a, Index b, std::vector<Index>& cells, bool& isKept)
{
  const SimplexMesh<2>& mesh = editor.mesh();
  // Local numbers are 0, 1 and 2: what is left is the node opposite to the edge, and so its facet.
  const int i = 3 - mesh.localIndex(t, a) - mesh.localIndex(t, b);
  const Index h = mesh.adjacent(t, i);
  cells.assign(1, t);
  isKept = mesh.isKept(t, i);
  if (h != None)
  {
    cells.push_back(mesh.cellOf(h));
  }
  return h == None || editor.owns(mesh.cellOf(h));
}

bool cellsAround(
  const MeshEditor<3>& editor, Index t, Index a, Index b, std::vector<Index>& cells, bool& isKept)
{
  const SimplexMesh<3>& mesh = editor.mesh();
  isKept = mesh.isEdgeKeptByItself(t, mesh.localEdge(t, a, b));
  if (!mesh.ring(t, a, b, false, cells))
  {
    // The ring ends at a kept facet: the edge lies in it. Collect the cells on all sides.
    isKept = true;
    mesh.ring(t, a, b, true, cells);
  }
  return std::all_of(cells.begin(), cells.end(), [&](Index c) { return editor.owns(c); });
}

/// Kept facets and edges that contain a and b are divided, too.
template <int D>
void divideKept(const SimplexMesh<D>& mesh, Index a, Index b, Index m, Proposal<D>& p)
{
  p.changesKept = true;
  for (Index c : p.cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> f = mesh.facet(c, i);
      // A facet between two regions comes twice, once from each side. The editor only looks facets
      // up.
      if (mesh.isKept(c, i) && hasId(f, a) && hasId(f, b))
      {
        p.kept.gone.push_back(f);
        p.kept.come.push_back(exchanged(f, a, m));
        p.kept.come.push_back(exchanged(f, b, m));
        p.kept.patches.insert(p.kept.patches.end(), 2, mesh.patch(c, i));
      }
    }
  }
  if (D == 3)
  {
    // All cells around an edge agree on whether it is kept: the first one is asked.
    p.kept.goneEdges.push_back({ a, b });
    if (mesh.isEdgeKeptByItself(p.cavity[0], mesh.localEdge(p.cavity[0], a, b)))
    {
      p.kept.comeEdges.push_back({ a, m });
      p.kept.comeEdges.push_back({ m, b });
    }
  }
}
}

template <int D>
bool proposeSplit(const MeshEditor<D>& editor, const Surface<D>* surface,
  const EdgeDivision& division, Proposal<D>& proposal)
{
  const auto& [t, a, b, m] = division;
  const SimplexMesh<D>& mesh = editor.mesh();
  proposal.clear();
  bool isKept = false;
  if (!cellsAround(editor, t, a, b, proposal.cavity, isKept) ||
    (isKept && !(surface && surface->mayDivide(mesh, proposal.cavity, a, b))))
  {
    return false;
  }
  if (isKept)
  {
    divideKept(mesh, a, b, m, proposal);
  }
  for (Index c : proposal.cavity)
  {
    // Each cell falls into two. The order of the nodes stays, and with it the orientation.
    proposal.cells.push_back(exchanged(mesh.nodes(c), a, m));
    proposal.cells.push_back(exchanged(mesh.nodes(c), b, m));
    proposal.kept.regions.insert(proposal.kept.regions.end(), 2, mesh.region(c));
  }
  proposal.oldWorst = mesh.worstQuality(proposal.cavity);
  return true;
}

template bool proposeSplit<2>(
  const MeshEditor<2>&, const Surface<2>*, const EdgeDivision&, Proposal<2>&);
template bool proposeSplit<3>(
  const MeshEditor<3>&, const Surface<3>*, const EdgeDivision&, Proposal<3>&);
}
