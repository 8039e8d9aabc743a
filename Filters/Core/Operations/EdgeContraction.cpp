// SPDX-License-Identifier: BSD-3-Clause
// Contraction as a change of topology only. What it does to kept facets and edges is written down
// for the editor; whether it is good, the judge says.
#include "Operations/EdgeContraction.h"

#include "Mesh/Ids.h"

namespace meshopt
{
namespace
{
/// Kept facets and edges at v vanish. Those that do not contain u appear again with u in place of
/// v. False at an ear, a cell that collapses between such a facet and the one that would appear:
/// the cell behind, which is not in the cavity, has that facet already, and the surface would fold.
template <int D>
bool joinKept(const SimplexMesh<D>& mesh, Index v, Index u, Proposal<D>& p)
{
  // Facets and edges that several cells of the cavity share come several times. The editor only
  // looks them up.
  p.changesKept = true;
  for (Index c : p.cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> f = mesh.facet(c, i);
      if (!mesh.isKept(c, i) || !hasId(f, v))
      {
        continue;
      }
      p.kept.gone.push_back(f);
      if (!hasId(f, u))
      {
        if (mesh.localIndex(c, u) >= 0)
        {
          return false;
        }
        p.kept.come.push_back(exchanged(f, v, u));
        p.kept.patches.push_back(mesh.patch(c, i));
      }
    }
    for (int e = 0; D == 3 && e < Local<D>::numberOfEdges; ++e)
    {
      const std::array<Index, 2> edge{ mesh.nodes(c)[Local<D>::edges[e][0]],
        mesh.nodes(c)[Local<D>::edges[e][1]] };
      if (!mesh.isEdgeKeptByItself(c, e) || !hasId(edge, v))
      {
        continue;
      }
      p.kept.goneEdges.push_back(edge);
      if (!hasId(edge, u))
      {
        p.kept.comeEdges.push_back(exchanged(edge, v, u));
      }
    }
  }
  return true;
}
}

template <int D>
bool proposeContraction(
  MeshEditor<D>& editor, const Surface<D>* surface, Index v, Index u, Proposal<D>& proposal)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  proposal.clear();
  if (!editor.star(v, proposal.cavity))
  {
    return false;
  }
  if (!mesh.isFree(v))
  {
    if (!surface || !surface->mayJoin(mesh, proposal.cavity, v, u) ||
      !joinKept(mesh, v, u, proposal))
    {
      return false;
    }
  }
  for (Index c : proposal.cavity)
  {
    // Cells with both points collapse; all others survive with u in place of v.
    if (mesh.localIndex(c, u) < 0)
    {
      proposal.cells.push_back(exchanged(mesh.nodes(c), v, u));
      proposal.kept.regions.push_back(mesh.region(c));
    }
  }
  proposal.oldWorst = mesh.worstQuality(proposal.cavity);
  // Without cells the star as a whole would vanish.
  return !proposal.cells.empty();
}

template bool proposeContraction<2>(MeshEditor<2>&, const Surface<2>*, Index, Index, Proposal<2>&);
template bool proposeContraction<3>(MeshEditor<3>&, const Surface<3>*, Index, Index, Proposal<3>&);
}
