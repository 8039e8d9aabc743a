// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshRanksBound.h"

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
using Vector = meshopt::Vec<3>;

/**
 * One side of a kept facet, as the ranks tell each other of it.
 */
struct Side
{
  std::array<vtkIdType, 3> Ids; ///< with a node on this side appended, a positive simplex
  std::array<double, 9> Places;
  long long Region;
  bool IsOriented;
  vtkIdType Cell; ///< of the part; -1: of another rank
};

long long RegionOf(const std::vector<long long>& regions, vtkIdType c)
{
  return regions.empty() ? 0 : regions[c];
}

Side MakeSide(const Part& part, const CellFacet& facet, const std::vector<long long>& regions)
{
  Side side;
  const std::array<vtkIdType, 3> nodes = OrientedNodes(part, facet.Cell, facet.Local);
  for (int i = 0; i < 3; ++i)
  {
    side.Ids[i] = part.PointIds[nodes[i]];
    std::copy_n(part.GetPoint(nodes[i]), 3, &side.Places[3 * i]);
  }
  side.Region = RegionOf(regions, facet.Cell);
  side.IsOriented = part.Quality[facet.Cell] > 0.0;
  side.Cell = facet.Cell;
  return side;
}

/**
 * Points that kept facets can have: of the Skin, and of cells of several regions.
 */
std::vector<char> FindCandidates(const Part& part, const std::vector<long long>& regions)
{
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

std::vector<Side> FindSides(
  const Ranks& ranks, const Part& part, const Shared& shared, const std::vector<long long>& regions)
{
  std::vector<Side> sides;
  std::vector<CellFacet> open;
  VisitFacets(part, FindCandidates(part, regions),
    [&](const CellFacet* first, const CellFacet* last)
    {
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
    if (!isBorder || (next++)->second != RegionOf(regions, facet.Cell))
    {
      sides.push_back(MakeSide(part, facet, regions));
    }
  }
  return sides;
}

/**
 * Adds sides of other ranks at edges that this rank has, too: an angle between two facets is wrong
 * if one between them is missing.
 */
void AddSidesOfOthers(
  const Ranks& ranks, const Part& part, const Shared& shared, std::vector<Side>& sides)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (const Side& side : sides)
  {
    std::map<int, int> common;
    for (const vtkIdType id : side.Ids)
    {
      for (const int r : shared.RanksOf[IndexOf(part, id)])
      {
        ++common[r];
      }
    }
    for (const auto& [rank, nodes] : common)
    {
      if (nodes >= 2)
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
      sides.back().Cell = -1;
    }
  }
}

/**
 * The bound of these sides, and the points that the ids in it stand for.
 */
meshopt::SurfaceBound<3> BoundOf(const std::vector<Side>& sides, meshopt::Measure measure,
  double target, std::vector<vtkIdType>& ids)
{
  std::vector<long long> regions;
  for (const Side& side : sides)
  {
    ids.insert(ids.end(), side.Ids.begin(), side.Ids.end());
    regions.push_back(side.Region);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::vector<Vector> points(ids.size());
  std::vector<meshopt::KeptSide<3>> kept;
  for (const Side& side : sides)
  {
    meshopt::KeptSide<3> one;
    for (int i = 0; i < 3; ++i)
    {
      const auto at = std::lower_bound(ids.begin(), ids.end(), side.Ids[i]) - ids.begin();
      const double* x = &side.Places[3 * i];
      points[at] = Vector(x[0], x[1], x[2]);
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
  options.enough = options.listEdgesBelow = target;
  return meshopt::surfaceBound<3>(points.data(), std::move(kept), options);
}

/// The fraction of its cap at which a cell counts as capped: that of Bound/Caps.h.
constexpr double Reached = 0.998;

/**
 * The two lowest qualities around an edge.
 */
struct Ring
{
  double Cap;
  double Least = std::numeric_limits<double>::infinity(), Second = Least;
  vtkIdType Cell = -1;
};

void MarkCappedByEdges(const Part& part, const Shared& shared,
  const meshopt::SurfaceBound<3>& surface, const std::vector<vtkIdType>& ids,
  std::vector<char>& isCapped)
{
  std::map<std::array<vtkIdType, 2>, Ring> rings; // by indices in the part, ascending as ids do
  for (const meshopt::EdgeBound& edge : surface.edges)
  {
    const vtkIdType a = IndexOf(part, ids[edge.a]), b = IndexOf(part, ids[edge.b]);
    if (a >= 0 && b >= 0 && !(shared.Has(a) && shared.Has(b)))
    {
      Ring& ring = rings.try_emplace({ std::min(a, b), std::max(a, b) }, Ring{ 1.0 }).first->second;
      ring.Cap = std::min(ring.Cap, edge.cap);
    }
  }
  for (vtkIdType c = 0; c < part.GetNumberOfCells() && !rings.empty(); ++c)
  {
    const vtkIdType* p = part.GetCell(c);
    for (int k = 0; k < 6; ++k)
    {
      constexpr int ends[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };
      const auto found = rings.find(
        { std::min(p[ends[k][0]], p[ends[k][1]]), std::max(p[ends[k][0]], p[ends[k][1]]) });
      if (found == rings.end())
      {
        continue;
      }
      Ring& ring = found->second;
      const double q = part.Quality[c];
      ring.Second = std::min(ring.Second, std::max(q, ring.Least));
      ring.Cell = q < ring.Least ? c : ring.Cell;
      ring.Least = std::min(ring.Least, q);
    }
  }
  for (const auto& [nodes, ring] : rings)
  {
    if (ring.Cell >= 0 && ring.Least >= Reached * ring.Cap && ring.Second > ring.Cap)
    {
      isCapped[ring.Cell] = 1;
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
SurfaceFigures MeasureSurface(const Ranks& ranks, const Part& part, const Shared& shared,
  const std::vector<long long>& regions, meshopt::Measure measure, double target)
{
  std::vector<Side> sides = FindSides(ranks, part, shared, regions);
  AddSidesOfOthers(ranks, part, shared, sides);
  std::vector<vtkIdType> ids;
  const meshopt::SurfaceBound<3> surface = BoundOf(sides, measure, target, ids);
  SurfaceFigures figures;
  figures.IsCapped.assign(part.CellIds.size(), 0);
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const vtkIdType c = sides[surface.sides[k].cell].Cell;
    if (c >= 0 && surface.sideCaps[k] < target && part.Quality[c] >= Reached * surface.sideCaps[k])
    {
      figures.IsCapped[c] = 1;
    }
  }
  MarkCappedByEdges(part, shared, surface, ids, figures.IsCapped);
  for (const double bound : ranks.Gather(surface.bound))
  {
    figures.Bound = std::min(figures.Bound, bound);
  }
  return figures;
}

} // namespace vtkMeshRanks
