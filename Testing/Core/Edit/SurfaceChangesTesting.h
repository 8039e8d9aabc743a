// SPDX-License-Identifier: BSD-3-Clause
// A surface that writes down what it is asked, and a body whose facets are found by a search.
#ifndef meshopt_Testing_SurfaceChangesTesting_h
#define meshopt_Testing_SurfaceChangesTesting_h

#include "Edit/SurfaceChanges.h"

#include "Mesh/CavityFit.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeSplit.h"
#include "StillSurface.h"
#include "TestMeshes.h"

#include <functional>
#include <map>

namespace meshopt
{
/// Lets everything be done, and writes down what it is asked.
template <int D>
class Recorder final : public StillSurface<D>
{
public:
  struct Angle
  {
    std::array<Index, 2> edge;
    bool isKept;
    double cosine;
  };
  mutable std::vector<SurfaceChange<D>> changes;
  mutable std::vector<Angle> angles, anglesOutside;
  bool answer = true;
  double leastCosine = -2.0;                ///< an angle with less is refused
  std::set<std::array<Index, 2>> offCurves; ///< edges that have no span
  std::function<std::uint32_t(Index)> setsOf = [](Index) { return 0u; };

  /// The span of an edge has its ids for parameters: so a test knows it again.
  std::optional<Span> span(const SimplexMesh<D>&, Index a, Index b) const override
  {
    const auto edge = sortedIds(a, b);
    return this->offCurves.count(edge) > 0
      ? std::nullopt
      : std::optional<Span>(Span{ 0, double(edge[0]), double(edge[1]) });
  }
  bool mayDivide(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return true;
  }
  bool maySwap(const SimplexMesh<D>&, Index, Index) const override { return true; }
  bool mayJoin(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return true;
  }
  std::uint32_t sets(const SimplexMesh<D>&, Index v) const override { return this->setsOf(v); }
  bool allows(const SurfaceChange<D>& change) const override
  {
    this->changes.push_back(change);
    return this->answer;
  }
  bool allowsAngle(
    const SimplexMesh<D>&, Index a, Index b, bool isKept, double cosine) const override
  {
    this->angles.push_back({ sortedIds(a, b), isKept, cosine });
    return cosine >= this->leastCosine;
  }
  bool allowsAngleOutside(const SimplexMesh<D>&, Index a, Index b, double cosine) const override
  {
    this->anglesOutside.push_back({ sortedIds(a, b), false, cosine });
    return cosine >= this->leastCosine;
  }
};

/// A side of a facet that is on the surface.
template <int D>
struct Side
{
  Simplex<D> cell;
  Facet<D> facet; ///< as seen from the cell
  Index region;
};

/// All facets with one cell, or with cells of two regions, by sorted ids.
template <int D>
using Sides = std::map<Facet<D>, std::vector<Side<D>>>;

template <int D>
Sides<D> surfaceOf(const std::vector<Simplex<D>>& cells, const std::vector<Index>& regions)
{
  Sides<D> all, kept;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      Facet<D> f;
      for (int k = 0; k < D; ++k)
      {
        f[k] = cells[c][Local<D>::facets[i][k]];
      }
      all[sortedIds(f)].push_back({ cells[c], f, regions[c] });
    }
  }
  for (const auto& [key, sides] : all)
  {
    if (sides.size() == 1 || sides[0].region != sides[1].region)
    {
      kept[key] = sides;
    }
  }
  return kept;
}

/// A box of two regions whose surface takes part: one patch a side, and one for the interface.
template <int D>
struct Box
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  Recorder<D> surface;
  SurfaceChanges<D> changes;
  Proposal<D> proposal;

  static MeshInput<D> input()
  {
    MeshInput<D> in = jitteredGrid<D>(4, 0.2);
    splitRegions(in);
    return in;
  }

  Box()
    : mesh(buildMesh(input()))
    , editor(mesh)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        if (this->mesh.isKept(c, i))
        {
          this->editor.setPatch(c, i, this->patchOf(this->mesh.facet(c, i)));
        }
      }
    }
  }

  /// The number of the plane in which the facet lies; 2 D inside.
  Index patchOf(const Facet<D>& f) const
  {
    for (int k = 0; k < 2 * D; ++k)
    {
      const double at = k % 2;
      if (std::all_of(
            f.begin(), f.end(), [&](Index p) { return this->mesh.point(p)[k / 2] == at; }))
      {
        return k;
      }
    }
    return 2 * D;
  }

  Sides<D> sides(const std::vector<Index>& without = {}, const Proposal<D>* with = nullptr) const
  {
    std::vector<Simplex<D>> cells;
    std::vector<Index> regions;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c) && std::find(without.begin(), without.end(), c) == without.end())
      {
        cells.push_back(this->mesh.nodes(c));
        regions.push_back(this->mesh.region(c));
      }
    }
    if (with)
    {
      cells.insert(cells.end(), with->cells.begin(), with->cells.end());
      regions.insert(regions.end(), with->kept.regions.begin(), with->kept.regions.end());
    }
    return surfaceOf<D>(cells, regions);
  }

  /// Is `pieces` the list of these facets, each once, seen from one of its sides?
  void expectPieces(const std::vector<SurfacePiece<D>>& pieces, const Sides<D>& facets) const
  {
    EXPECT_EQ(pieces.size(), facets.size());
    std::set<Facet<D>> seen;
    for (const SurfacePiece<D>& piece : pieces)
    {
      bool isFound = false;
      for (const auto& [key, sides] : facets)
      {
        for (const Side<D>& side : sides)
        {
          std::array<Vec<D>, D> x;
          for (int k = 0; k < D; ++k)
          {
            x[k] = this->mesh.point(side.facet[k]);
          }
          if (x == piece.x && side.region == piece.region)
          {
            isFound = true;
            EXPECT_TRUE(seen.insert(key).second) << "twice";
            EXPECT_EQ(piece.patch, this->patchOf(side.facet));
            std::uint32_t sets = ~0u;
            for (Index p : side.facet)
            {
              sets &= this->surface.setsOf(p);
            }
            EXPECT_EQ(piece.sets, sets);
          }
        }
      }
      EXPECT_TRUE(isFound) << "no facet of the mesh, or not as seen from its region";
    }
  }

  /// Those of a that are not in b.
  static Sides<D> less(const Sides<D>& a, const Sides<D>& b)
  {
    Sides<D> rest;
    for (const auto& entry : a)
    {
      if (b.count(entry.first) == 0)
      {
        rest.insert(entry);
      }
    }
    return rest;
  }

  /// Asks about the proposal; compares what the surface is told with the mesh before and after.
  void check()
  {
    this->surface.changes.clear();
    EXPECT_TRUE(this->changes.allowsReplacement(this->surface, this->mesh, this->proposal));
    ASSERT_EQ(this->surface.changes.size(), 1u);
    const Sides<D> before = this->sides();
    const Sides<D> after = this->sides(this->proposal.cavity, &this->proposal);
    this->expectPieces(this->surface.changes[0].gone, less(before, after));
    this->expectPieces(this->surface.changes[0].come, less(after, before));
    this->surface.answer = false;
    EXPECT_FALSE(this->changes.allowsReplacement(this->surface, this->mesh, this->proposal));
    this->surface.answer = true;
  }

  /// The edges of the surface, each with a cell.
  std::map<std::array<Index, 2>, Index> surfaceEdges() const
  {
    std::map<std::array<Index, 2>, Index> edges;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Facet<D> f = this->mesh.facet(c, i);
        for (int k = 0; k < D && this->mesh.isKept(c, i); ++k)
        {
          edges[sortedIds(f[k], f[(k + 1) % D])] = c;
        }
      }
    }
    return edges;
  }
};
}

#endif
