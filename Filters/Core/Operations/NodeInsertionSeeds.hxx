// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeInsertionSeeds.hxx
/// Where a new node may start: inside the cell, on its facets and edges, and in the surface.
#ifndef meshopt_Operations_NodeInsertionSeeds_hxx
#define meshopt_Operations_NodeInsertionSeeds_hxx

namespace meshopt
{
template <int D, class Shape>
void NodeInsertion<D, Shape>::findSeeds(
  const SimplexMesh<D>& mesh, Index t, std::vector<Vec<D>>& seeds)
{
  constexpr double inwards = 0.1;
  const Corners<D> c = mesh.corners(t);
  Vec<D> centre = c[0];
  for (int i = 1; i <= D; ++i)
  {
    centre += c[i];
  }
  centre /= D + 1;
  seeds.clear();
  if constexpr (D == 3)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(t, i))
      {
        const Facet<3> f = mesh.facet(t, i);
        Vec<3> apex;
        facetCap(mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]),
          std::numeric_limits<double>::infinity(), &apex);
        seeds.push_back(apex);
        seeds.push_back(0.5 * (apex + c[i]));
      }
    }
  }
  seeds.push_back(centre);
  for (int i = 0; D == 3 && i <= D; ++i)
  {
    const Vec<D> f = (Vec<D>(centre * (D + 1)) - c[i]) / D;
    seeds.push_back(f + inwards * (centre - f));
  }
  for (const auto& e : Local<D>::edges)
  {
    const Vec<D> m = 0.5 * (c[e[0]] + c[e[1]]);
    seeds.push_back(m + inwards * (centre - m));
  }
}

/// Adds the middle of an edge (the last id is None) or of a facet of the surface, if nodes may be
/// added there. `cells`: all that have it.
template <int D, class Shape>
void NodeInsertion<D, Shape>::addSurfaceSeed(const Judge<D, Shape>& judge,
  const std::array<Index, 3>& ids, const std::vector<Index>& cells, bool narrow,
  std::vector<Seed>& seeds)
{
  const SimplexMesh<D>& mesh = judge.mesh();
  Seed seed;
  seed.opening.ids = ids;
  const auto has = [&](const Facet<D>& f) {
    return std::all_of(ids.begin(), ids.end(), [&](Index p) { return p == None || hasId(f, p); });
  };
  for (Index c : cells)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(c, i) && has(mesh.facet(c, i)))
      {
        seed.opening.patches.push_back(mesh.patch(c, i));
      }
    }
  }
  // A facet between two regions comes from both sides.
  std::vector<Index>& patches = seed.opening.patches;
  sortUnique(patches);
  // What the caller locked belongs to no patch: None comes first.
  if (patches.empty() || patches[0] == None)
  {
    return;
  }
  const bool isFacet = ids[2] != None;
  if (!isFacet && !judge.surface()->mayDivide(mesh, cells, ids[0], ids[1]))
  {
    return;
  }
  // The middle in the mesh as it is, then in the surface that it stands for.
  Vec<D> now = 0.5 * (mesh.point(ids[0]) + mesh.point(ids[1]));
  if (isFacet)
  {
    now = (mesh.point(ids[0]) + mesh.point(ids[1]) + mesh.point(ids[2])) / 3.0;
  }
  // A kept edge lies on a curve; all its cells agree on that, so one is asked.
  if (!isFacet && mesh.isEdgeKept(cells[0], mesh.localEdge(cells[0], ids[0], ids[1])))
  {
    const auto span = judge.surface()->span(mesh, ids[0], ids[1]);
    seed.place = { Freedom::Curve, span->part, 0.5 * (span->from + span->to) };
    seed.x = judge.surface()->at(span->part, seed.place.parameter);
  }
  else
  {
    seed.place = { Freedom::Patch, patches[0], 0.0 };
    judge.surface()->project(seed.place, now, seed.x);
  }
  seeds.push_back(seed);
  // What changes the surface may be too far for it. The same without: the node stays where it is.
  if (narrow)
  {
    seed.opening.isNarrow = true;
    seed.place = judge.surface()->placeNear(seed.place, now, seed.x);
    seeds.push_back(seed);
  }
}

template <int D, class Shape>
void NodeInsertion<D, Shape>::findAllSeeds(
  const Judge<D, Shape>& judge, Index t, bool narrow, std::vector<Seed>& seeds)
{
  const SimplexMesh<D>& mesh = judge.mesh();
  std::vector<Vec<D>> inside;
  findSeeds(mesh, t, inside);
  for (const Vec<D>& x : inside)
  {
    seeds.push_back({ x, {}, {} });
  }
  if constexpr (D == 3)
  {
    if (!judge.slides())
    {
      return;
    }
    std::vector<Index> cells;
    for (const auto& e : Local<3>::edges)
    {
      const Index a = mesh.nodes(t)[e[0]], b = mesh.nodes(t)[e[1]];
      // The ring of an edge of the surface is open, or crosses an interface. The ends are asked
      // first: that is cheaper than to walk around.
      if (mesh.isBoundary(a) && mesh.isBoundary(b) && !mesh.ring(t, a, b, false, cells))
      {
        mesh.ring(t, a, b, true, cells);
        addSurfaceSeed(judge, { a, b, None }, cells, narrow, seeds);
      }
    }
    for (int i = 0; i < 4; ++i)
    {
      if (mesh.isKept(t, i))
      {
        addSurfaceSeed(judge, mesh.facet(t, i), { t }, narrow, seeds);
      }
    }
  }
}
}

#endif
