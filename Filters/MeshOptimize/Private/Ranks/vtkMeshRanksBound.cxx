// SPDX-License-Identifier: BSD-3-Clause
// The bound of the surface where that is divided among ranks: each rank certifies its own sides,
// and the least of all bounds is that of the mesh.
#include "Ranks/vtkMeshRanksBound.h"

#include "Bound/SurfaceBound.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

using meshopt::Index;

long long RegionOf(const std::vector<long long>& regions, vtkIdType c)
{
  return regions.empty() ? 0 : regions[c];
}

Side MakeSide(const Part& part, const CellFacet& facet, const std::vector<long long>& regions)
{
  // All bytes are sent: none may be without a value.
  Side side{};
  const std::array<vtkIdType, 3> nodes = OrientedNodes(part, facet.Cell, facet.Local);
  for (int i = 0; i < part.Corners - 1; ++i)
  {
    side.Ids[i] = part.PointIds[nodes[i]];
    std::copy_n(part.GetPoint(nodes[i]), 3, &side.Places[3 * i]);
  }
  side.Region = RegionOf(regions, facet.Cell);
  // Of a flat or inverted cell it is uncertain on which side the mesh is.
  side.IsOriented = part.Quality[facet.Cell] > 0.0;
  side.Cell = facet.Cell;
  return side;
}

/**
 * Points that kept facets can have: of the Skin, and of cells of several regions.
 */
std::vector<char> FindCandidates(const Part& part, const std::vector<long long>& regions)
{
  // Few facets: those inside of one region and one rank cannot be kept.
  std::vector<char> isWanted = Flagged(part, Skin);
  std::vector<vtkIdType> first(regions.empty() ? 0 : part.PointIds.size(), -1);
  for (vtkIdType c = 0; c < part.GetNumberOfCells() && !regions.empty(); ++c)
  {
    for (int i = 0; i < part.Corners; ++i)
    {
      const vtkIdType p = part.GetCell(c)[i];
      first[p] = first[p] < 0 ? c : first[p];
      isWanted[p] = isWanted[p] || regions[first[p]] != regions[c];
    }
  }
  return isWanted;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<Side> FindSides(
  const Ranks& ranks, const Part& part, const Shared& shared, const std::vector<long long>& regions)
{
  std::vector<Side> sides;
  std::vector<CellFacet> open;
  VisitFacets(part, FindCandidates(part, regions),
    [&](const CellFacet* first, const CellFacet* last)
    {
      // One cell in this part: on the surface, or at a border.
      if (last - first == 1)
      {
        open.push_back(*first);
      }
      else if (RegionOf(regions, first[0].Cell) != RegionOf(regions, first[1].Cell))
      {
        sides.push_back(MakeSide(part, first[0], regions));
        sides.push_back(MakeSide(part, first[1], regions));
      }
    });
  const auto border = FindBorder(ranks, part, shared, open, regions); // in the order of `open`
  auto next = border.begin();
  for (const CellFacet& facet : open)
  {
    const bool isBorder = next != border.end() && next->first.Cell == facet.Cell &&
      next->first.Local == facet.Local;
    // At a border it is kept if the cell beyond has another region.
    if (!isBorder || (next++)->second != RegionOf(regions, facet.Cell))
    {
      sides.push_back(MakeSide(part, facet, regions));
    }
  }
  return sides;
}

namespace
{

/**
 * Adds sides of other ranks at edges (of triangles: nodes) that this rank has, too: an angle
 * between two facets is wrong if one between them is missing.
 */
void AddSidesOfOthers(
  const Ranks& ranks, const Part& part, const Shared& shared, std::vector<Side>& sides)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (const Side& side : sides)
  {
    // How many nodes of the side each rank has.
    std::map<int, int> common;
    for (int i = 0; i < part.Corners - 1; ++i)
    {
      for (const int r : shared.RanksOf[IndexOf(part, side.Ids[i])])
      {
        ++common[r];
      }
    }
    // All nodes of an edge (D = 2: one node).
    for (const auto& [rank, nodes] : common)
    {
      if (nodes >= part.Corners - 2)
      {
        Put(out[rank], side);
      }
    }
  }
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      sides.push_back(reader.Take<Side>());
      // It belongs to no cell here: it completes the angles, and is counted where its cell is.
      sides.back().Cell = -1;
    }
  }
}

/**
 * The bound of these sides, and the points that the ids in it stand for.
 */
template <int D>
meshopt::SurfaceBound<D> BoundOf(const std::vector<Side>& sides, meshopt::Measure measure,
  double target, const vtkMeshBridge::Frame<D>& frame, std::vector<vtkIdType>& ids)
{
  // Ids and regions become small numbers: the core indexes by them.
  std::vector<long long> regions;
  for (const Side& side : sides)
  {
    ids.insert(ids.end(), side.Ids.begin(), side.Ids.begin() + D);
    regions.push_back(side.Region);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::vector<meshopt::Vec<D>> points(ids.size());
  std::vector<meshopt::KeptSide<D>> kept;
  for (const Side& side : sides)
  {
    meshopt::KeptSide<D> one;
    for (int i = 0; i < D; ++i)
    {
      const auto at = std::lower_bound(ids.begin(), ids.end(), side.Ids[i]) - ids.begin();
      points[at] = frame.ToCore(&side.Places[3 * i]);
      one.nodes[i] = static_cast<Index>(at);
    }
    one.region = static_cast<Index>(
      std::lower_bound(regions.begin(), regions.end(), side.Region) - regions.begin());
    one.oriented = side.IsOriented;
    one.cell = static_cast<Index>(kept.size()); // which of the sides
    kept.push_back(one);
  }
  meshopt::SurfaceBoundOptions options;
  options.measure = measure;
  // Caps above the target do not matter: cells need not be better.
  options.enough = options.listEdgesBelow = target;
  return meshopt::surfaceBound<D>(points.data(), std::move(kept), options);
}

/**
 * The two lowest qualities around an edge, or around a node of triangles.
 */
struct Ring
{
  double Cap;
  double Least = std::numeric_limits<double>::infinity(), Second = Least;
  vtkIdType Cell = -1;
};

/**
 * Calls `visit` with the ends of each edge of a tetrahedron; for a triangle with each node twice.
 */
template <class Visit>
void VisitRims(const Part& part, vtkIdType c, const Visit& visit)
{
  const meshopt::Index* p = part.GetCell(c);
  for (int i = 0; i < part.Corners; ++i)
  {
    for (int k = part.Corners == 4 ? i + 1 : i; k < (part.Corners == 4 ? 4 : i + 1); ++k)
    {
      visit(std::min(p[i], p[k]), std::max(p[i], p[k]));
    }
  }
}

template <int D>
void MarkCappedByEdges(const Part& part, const Shared& shared,
  const meshopt::SurfaceBound<D>& surface, const std::vector<vtkIdType>& ids,
  std::vector<char>& isCapped)
{
  std::map<std::array<vtkIdType, 2>, Ring> rings; // by indices in the part, ascending as ids do
  for (const meshopt::EdgeBound& edge : surface.edges)
  {
    const vtkIdType a = IndexOf(part, ids[edge.a]);
    const vtkIdType b = D == 3 ? IndexOf(part, ids[edge.b]) : a;
    // Around an edge that two ranks have, a rank sees a part of the cells only: whether the worst
    // is capped cannot be said.
    if (a >= 0 && b >= 0 && !(shared.Has(a) && shared.Has(b)))
    {
      Ring& ring = rings.try_emplace({ std::min(a, b), std::max(a, b) }, Ring{ 1.0 }).first->second;
      ring.Cap = std::min(ring.Cap, edge.cap);
    }
  }
  for (vtkIdType c = 0; c < part.GetNumberOfCells() && !rings.empty(); ++c)
  {
    VisitRims(part, c,
      [&](vtkIdType a, vtkIdType b)
      {
        const auto found = rings.find({ a, b });
        if (found != rings.end())
        {
          Ring& ring = found->second;
          const double q = part.Quality[c];
          // The second lowest: the old lowest, if this is lower, or this one, if it lies between.
          ring.Second = std::min(ring.Second, std::max(q, ring.Least));
          ring.Cell = q < ring.Least ? c : ring.Cell;
          ring.Least = std::min(ring.Least, q);
        }
      });
  }
  for (const auto& [nodes, ring] : rings)
  {
    // An edge caps one cell, whichever: the worst counts as capped if it has reached the cap and
    // the next is beyond it.
    if (ring.Cell >= 0 && ring.Least >= meshopt::CapReached * ring.Cap && ring.Second > ring.Cap)
    {
      isCapped[ring.Cell] = 1;
    }
  }
}

template <int D>
SurfaceFigures MeasureSides(const Ranks& ranks, const Part& part, const Shared& shared,
  const std::vector<Side>& sides, meshopt::Measure measure, double target,
  const vtkMeshBridge::Frame<D>& frame)
{
  std::vector<vtkIdType> ids;
  const meshopt::SurfaceBound<D> surface = BoundOf<D>(sides, measure, target, frame, ids);
  SurfaceFigures figures;
  figures.IsCapped.assign(part.CellIds.size(), 0);
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const vtkIdType c = sides[surface.sides[k].cell].Cell;
    if (c >= 0 && surface.sideCaps[k] < target &&
      part.Quality[c] >= meshopt::CapReached * surface.sideCaps[k])
    {
      figures.IsCapped[c] = 1;
    }
  }
  MarkCappedByEdges<D>(part, shared, surface, ids, figures.IsCapped);
  // Least of all: a certified bound of a part is one of the whole.
  for (const double bound : ranks.Gather(surface.bound))
  {
    figures.Bound = std::min(figures.Bound, bound);
  }
  return figures;
}

} // namespace

//------------------------------------------------------------------------------
SurfaceFigures MeasureSurface(const Ranks& ranks, const Part& part, const Shared& shared,
  const std::vector<long long>& regions, meshopt::Measure measure, double target,
  const vtkMeshBridge::Frame<2>& plane)
{
  std::vector<Side> sides = FindSides(ranks, part, shared, regions);
  AddSidesOfOthers(ranks, part, shared, sides);
  return part.Corners == 4
    ? MeasureSides<3>(ranks, part, shared, sides, measure, target, vtkMeshBridge::Frame<3>())
    : MeasureSides<2>(ranks, part, shared, sides, measure, target, plane);
}

} // namespace vtkMeshRanks
