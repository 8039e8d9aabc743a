// SPDX-License-Identifier: BSD-3-Clause
// Which nodes of a sliding surface may vanish into a neighbour.
#include "Mesh/Ids.h"
#include "Surface/SlidingSurface.h"

#include <algorithm>
#include <set>

namespace meshopt
{
/// Along the short curve between them, which vanishes. The curves that led to v lead to u: they say
/// whether it is near enough to where v was, now and whenever u moves. No two curves may become
/// one, and no node set may change.
bool SlidingSurface::mayJoinCorners(
  const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v, Index u) const
{
  if (mesh.freedom(u) != Freedom::Corner || !this->pieces_.mayBecomeOne(v, u) ||
    this->sets(mesh, v) != this->sets(mesh, u))
  {
    return false;
  }
  std::set<Index> ofV, ofU; // neighbours over kept edges
  for (Index c : star)
  {
    for (int e = 0; e < 6; ++e)
    {
      const Index a = mesh.nodes(c)[Local<3>::edges[e][0]];
      const Index b = mesh.nodes(c)[Local<3>::edges[e][1]];
      if (mesh.isEdgeKeptByItself(c, e) && (a == v || b == v))
      {
        ofV.insert(a == v ? b : a);
      }
      if (mesh.isEdgeKeptByItself(c, e) && (a == u || b == u))
      {
        ofU.insert(a == u ? b : a);
      }
    }
  }
  return ofV.count(u) > 0 &&
    std::none_of(ofV.begin(), ofV.end(), [&](Index p) { return ofU.count(p) > 0; });
}

/// Only along the surface; on a curve only if the chord that comes stays near it.
bool SlidingSurface::mayJoin(
  const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v, Index u) const
{
  const Place place = mesh.place(v);
  if (place.freedom == Freedom::Patch)
  {
    // Along an edge of the surface: one that is in a facet of the patch.
    return std::any_of(star.begin(), star.end(),
      [&](Index c)
      {
        for (int i = 0; i < 4; ++i)
        {
          const Facet<3> f = mesh.facet(c, i);
          if (mesh.isKept(c, i) && hasId(f, v) && hasId(f, u))
          {
            return true;
          }
        }
        return false;
      });
  }
  if (place.freedom == Freedom::Corner)
  {
    return this->mayJoinCorners(mesh, star, v, u);
  }
  const auto range = this->range(mesh, star, v);
  if (!range || (range->ends[0] != u && range->ends[1] != u))
  {
    return false;
  }
  // When v vanishes, the edge from its other neighbour to u takes the place of two.
  const Index w = range->ends[0] == u ? range->ends[1] : range->ends[0];
  const Span joined{ place.part, range->low, range->high };
  if (u == w ||
    !this->follows(this->measured(joined, mesh.point(range->ends[0]), mesh.point(range->ends[1]))))
  {
    return false;
  }
  if (mesh.freedom(u) != Freedom::Curve && mesh.freedom(w) != Freedom::Curve)
  {
    const auto between = this->span(mesh, u, w);
    return between && between->part == place.part; // several curves may join two corners
  }
  return true;
}
}
