// SPDX-License-Identifier: BSD-3-Clause
#include "Operations/EdgeChange.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// How far the curve may go from a new edge of the boundary, in parts of the edge's length.
constexpr double Sagitta = 0.1;

template <int D>
Simplex<D> exchanged(Simplex<D> cell, Index from, Index to)
{
  std::replace(cell.begin(), cell.end(), from, to);
  return cell;
}

int localEdge(const SimplexMesh<3>& mesh, Index t, Index a, Index b)
{
  for (int e = 0; e < Local<3>::numberOfEdges; ++e)
  {
    const Index p = mesh.nodes(t)[Local<3>::edges[e][0]], q = mesh.nodes(t)[Local<3>::edges[e][1]];
    if ((p == a && q == b) || (p == b && q == a))
    {
      return e;
    }
  }
  return -1;
}
}

std::optional<SlidingRange> slidingRange(
  const BoundaryCurves& curves, const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v)
{
  std::vector<Index> ends; // over kept facets
  for (Index c : star)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Facet<2> f = mesh.facet(c, i);
      if (mesh.isConstrained(c, i) && (f[0] == v || f[1] == v))
      {
        ends.push_back(f[0] == v ? f[1] : f[0]);
      }
    }
  }
  std::sort(ends.begin(), ends.end()); // the order of the star must not matter
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  if (mesh.pointData(v).curve == None || ends.size() != 2)
  {
    return std::nullopt;
  }
  const auto low = curves.span(mesh, v, ends[0]), high = curves.span(mesh, v, ends[1]);
  return low && high ? std::optional<SlidingRange>({ { ends[0], ends[1] }, low->to, high->to })
                     : std::nullopt;
}

template <int D>
void EdgeChange<D>::clear()
{
  this->cavity.clear();
  this->cells.clear();
  this->changesKept = false;
  this->kept.gone.clear();
  this->kept.come.clear();
  this->kept.regions.clear();
}

template <int D>
bool EdgeChange<D>::split(
  MeshEditor<D>& editor, const BoundaryCurves* curves, Index t, Index a, Index b, Index m)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->clear();
  if constexpr (D == 2)
  {
    const int i = 3 - mesh.localIndex(t, a) - mesh.localIndex(t, b);
    const Index h = mesh.adjacent(t, i);
    if (h != None && !editor.owns(mesh.cellOf(h)))
    {
      return false;
    }
    this->cavity.assign(1, t);
    if (h != None)
    {
      this->cavity.push_back(mesh.cellOf(h));
    }
    if (mesh.isConstrained(t, i))
    {
      if (!curves || !curves->span(mesh, a, b))
      {
        return false;
      }
      this->changesKept = true;
      this->kept.gone.push_back({ a, b });
      this->kept.come.push_back({ a, m });
      this->kept.come.push_back({ m, b });
    }
  }
  else
  {
    if (mesh.isEdgeConstrained(t, localEdge(mesh, t, a, b)) ||
      !mesh.ring(t, a, b, false, this->cavity))
    {
      return false;
    }
    for (Index c : this->cavity)
    {
      if (!editor.owns(c))
      {
        return false;
      }
    }
  }
  for (Index c : this->cavity)
  {
    this->cells.push_back(exchanged<D>(mesh.nodes(c), a, m));
    this->cells.push_back(exchanged<D>(mesh.nodes(c), b, m));
    this->kept.regions.insert(this->kept.regions.end(), 2, mesh.region(c));
  }
  return true;
}

template <int D>
bool EdgeChange<D>::contract(
  MeshEditor<D>& editor, [[maybe_unused]] const BoundaryCurves* curves, Index v, Index u)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->clear();
  if (!editor.star(v, this->cavity))
  {
    return false;
  }
  if (mesh.isFixed(v))
  {
    if constexpr (D == 2)
    {
      const auto range = curves ? slidingRange(*curves, mesh, this->cavity, v) : std::nullopt;
      if (!range || (range->ends[0] != u && range->ends[1] != u))
      {
        return false;
      }
      const Index w = range->ends[0] == u ? range->ends[1] : range->ends[0];
      const bool isEar = std::any_of(this->cavity.begin(), this->cavity.end(),
        [&](Index c) { return mesh.localIndex(c, u) >= 0 && mesh.localIndex(c, w) >= 0; });
      const BoundaryCurves::Span joined{ mesh.pointData(v).curve, range->low, range->high };
      if (isEar || !curves->mayBeNeighbours(joined) ||
        curves->sagitta(joined) > Sagitta * (mesh.point(u) - mesh.point(w)).norm())
      {
        return false;
      }
      if (mesh.pointData(u).curve == None && mesh.pointData(w).curve == None)
      {
        const auto between = curves->span(mesh, u, w);
        if (!between || between->piece != joined.piece)
        {
          return false; // two corners with several pieces between them: this is not the one
        }
      }
      this->changesKept = true;
      this->kept.gone.push_back({ v, u });
      this->kept.gone.push_back({ v, w });
      this->kept.come.push_back({ u, w });
    }
    else
    {
      return false;
    }
  }
  for (Index c : this->cavity)
  {
    if (mesh.localIndex(c, u) < 0)
    {
      this->cells.push_back(exchanged<D>(mesh.nodes(c), v, u));
      this->kept.regions.push_back(mesh.region(c));
    }
  }
  return !this->cells.empty();
}

template struct EdgeChange<2>;
template struct EdgeChange<3>;
}
