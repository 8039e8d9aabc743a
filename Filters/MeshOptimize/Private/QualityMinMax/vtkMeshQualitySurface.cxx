// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finds the kept facets of a grid (its surface, and facets between regions, on both sides) without
 * building the adjacency of all cells; and has their bound computed.
 *
 * Each facet gets a pseudo-random 64-bit key, the same from both of its cells. Each cell combines
 * it by exclusive or with a number at the facet's lowest point: facets with two cells cancel out.
 * Points whose number is not 0 have some kept facet; only the facets at those few points are
 * compared one by one. A number is 0 by chance once in 2^64. The order of combination does not
 * matter, so several threads may do it.
 */
#include "QualityMinMax/vtkMeshQualityMeasure.h"

#include "Base/Scramble.h"
#include "Bound/SightBound.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace vtkMeshQualityBridge
{
namespace
{

using meshopt::Index;
using meshopt::KeptSide;
using meshopt::Vec;

using Key = std::uint64_t;
// Cells of one step of the threads: enough to cost nothing, few enough to be shared out evenly.
constexpr vtkIdType Length = 16384;

/**
 * A facet at a point of the surface.
 */
struct Candidate
{
  Key Id = 0;
  vtkIdType Cell = -1;
  int Facet = 0;
  bool Kept = true;
};

/**
 * The simplices of one dimension.
 */
template <int D>
class SurfaceFinder
{
public:
  explicit SurfaceFinder(const Grid& grid)
    : Mesh(grid)
    , Numbers(grid.GetNumberOfPoints())
  {
  }

  /// Two passes: all facets are combined; then the facets at points with a remainder are collected.
  std::vector<Candidate> Find()
  {
    const vtkIdType n = this->Mesh.GetNumberOfCells();
    const vtkIdType chunks = (n + Length - 1) / Length;
    // See Add().
    const bool alone = vtkSMPTools::GetEstimatedNumberOfThreads() == 1;
    vtkSMPTools::For(0, chunks, 1,
      [&](vtkIdType first, vtkIdType last)
      {
        for (vtkIdType c = first * Length; c < std::min(n, last * Length); ++c)
        {
          this->Combine(c, alone);
        }
      });
    std::vector<std::vector<Candidate>> parts(chunks);
    vtkSMPTools::For(0, chunks, 1,
      [&](vtkIdType first, vtkIdType last)
      {
        for (vtkIdType k = first; k < last; ++k)
        {
          for (vtkIdType c = k * Length; c < std::min(n, (k + 1) * Length); ++c)
          {
            this->Collect(c, parts[k]);
          }
        }
      });
    // In the order of the cells, whichever thread has found them.
    std::vector<Candidate> all;
    for (const auto& part : parts)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    return KeepSingle(std::move(all));
  }

private:
  struct Facets
  {
    std::array<Key, D + 1> Keys;
    vtkIdType Lowest,
      Next;       ///< the two lowest points; the facet opposite to the lowest begins at the next
    int Opposite; ///< local number of the lowest point, which its facet does not contain
  };

  bool GetFacets(vtkIdType cell, Facets& f) const
  {
    vtkIdType ids[D + 1];
    if (this->Mesh.GetKind(cell) != (D == 3 ? Kind::Tetrahedron : Kind::Triangle) ||
      !this->Mesh.GetCorners(cell, D + 1, ids))
    {
      return false;
    }
    // The region is part of the key: a facet between two regions has two keys, and does not cancel.
    Key sum = this->Mesh.HasRegions()
      ? meshopt::scramble(~static_cast<Key>(this->Mesh.GetRegion(cell)))
      : 0;
    Key keys[D + 1];
    f.Opposite = 0;
    for (int i = 0; i <= D; ++i)
    {
      keys[i] = meshopt::scramble(static_cast<Key>(ids[i]));
      sum += keys[i];
      f.Opposite = ids[i] < ids[f.Opposite] ? i : f.Opposite;
    }
    f.Lowest = ids[f.Opposite];
    f.Next = -1;
    for (int i = 0; i <= D; ++i)
    {
      // A sum does not depend on the order in which a cell lists its points.
      f.Keys[i] = meshopt::scramble(sum - keys[i]);
      f.Next = i != f.Opposite && (f.Next < 0 || ids[i] < f.Next) ? ids[i] : f.Next;
    }
    return true;
  }

  void Combine(vtkIdType cell, bool alone)
  {
    Facets f;
    if (!this->GetFacets(cell, f))
    {
      return;
    }
    // All facets but one contain the lowest point; that one begins at the next.
    Key atLowest = 0;
    for (int i = 0; i <= D; ++i)
    {
      atLowest ^= i != f.Opposite ? f.Keys[i] : 0;
    }
    this->Add(f.Lowest, atLowest, alone);
    this->Add(f.Next, f.Keys[f.Opposite], alone);
  }

  void Add(vtkIdType point, Key key, bool alone)
  {
    std::atomic<Key>& number = this->Numbers[point];
    // One thread needs no atomic exchange, which is slower.
    if (alone)
    {
      number.store(number.load(std::memory_order_relaxed) ^ key, std::memory_order_relaxed);
    }
    else
    {
      number.fetch_xor(key, std::memory_order_relaxed);
    }
  }

  /// Also facets with two cells, if they lie at such a point: KeepSingle() sorts these out.
  void Collect(vtkIdType cell, std::vector<Candidate>& out) const
  {
    Facets f;
    if (!this->GetFacets(cell, f))
    {
      return;
    }
    const bool lowest = this->Numbers[f.Lowest].load(std::memory_order_relaxed) != 0;
    const bool next = this->Numbers[f.Next].load(std::memory_order_relaxed) != 0;
    for (int i = 0; i <= D; ++i)
    {
      if (i == f.Opposite ? next : lowest)
      {
        // The facet opposite to the lowest point was combined at the next lowest.
        out.push_back({ f.Keys[i], cell, i, true });
      }
    }
  }

  /**
   * Removes what occurs twice or more, by a hash table with open addressing.
   */
  static std::vector<Candidate> KeepSingle(std::vector<Candidate> all)
  {
    // At most half full, and a power of two.
    std::size_t size = 16;
    while (size < 2 * all.size())
    {
      size *= 2;
    }
    std::vector<std::size_t> table(size, all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      std::size_t slot = all[i].Id & (size - 1);
      while (table[slot] != all.size() && all[table[slot]].Id != all[i].Id)
      {
        slot = (slot + 1) & (size - 1);
      }
      if (table[slot] == all.size())
      {
        table[slot] = i;
      }
      // The first of them stays in the table, so that a third one is found out, too.
      else
      {
        all[table[slot]].Kept = all[i].Kept = false;
      }
    }
    all.erase(std::remove_if(all.begin(), all.end(), [](const Candidate& c) { return !c.Kept; }),
      all.end());
    return all;
  }

  const Grid& Mesh;
  std::vector<std::atomic<Key>> Numbers;
};

/**
 * The sides of a grid, with their points renumbered.
 */
template <int D>
class SideCollector
{
public:
  SideCollector(const Grid& grid, const Surface& surface, SurfaceOf<D>& result)
    : Mesh(grid)
    , Whole(surface)
    , Result(result)
    , Numbers(grid.GetNumberOfPoints(), meshopt::None)
  {
  }

  void Collect(const double* quality)
  {
    for (const Candidate& facet : SurfaceFinder<D>(this->Mesh).Find())
    {
      // Ghosts were combined like all others, so that facets beside them are no surface. Sides of
      // their own do not count.
      if (this->Mesh.IsGhost(facet.Cell))
      {
        continue;
      }
      vtkIdType ids[D + 1];
      this->Mesh.GetCorners(facet.Cell, D + 1, ids);
      KeptSide<D> side;
      for (int k = 0; k < D; ++k)
      {
        side.nodes[k] = this->Number(ids[meshopt::Local<D>::facets[facet.Facet][k]]);
      }
      side.cell = static_cast<Index>(facet.Cell);
      side.region = static_cast<Index>(this->Mesh.GetRegion(facet.Cell));
      // On which side of a flat or inverted cell the mesh lies is not known.
      side.oriented = quality[facet.Cell] > 0.0;
      side.quality = quality[facet.Cell];
      this->Result.Sides.push_back(side);
      this->Result.Opposite.push_back(ids[facet.Facet]);
    }
  }

private:
  Index Number(vtkIdType p)
  {
    // In the order of first use: the core wants points of the surface only.
    if (this->Numbers[p] == meshopt::None)
    {
      this->Numbers[p] = static_cast<Index>(this->Result.Places.size());
      this->Result.Points.push_back(p);
      this->Result.Places.push_back(this->Whole.template PlaceOf<D>(this->Mesh.GetPoint(p).data()));
    }
    return this->Numbers[p];
  }

  const Grid& Mesh;
  const Surface& Whole;
  SurfaceOf<D>& Result;
  std::vector<Index> Numbers;
};

template <int D>
void Collect(const Grid& grid, const double* quality, Surface& surface)
{
  SideCollector<D>(grid, surface, std::get<SurfaceOf<D>>(surface.Parts)).Collect(quality);
}

/**
 * Looks for what stands in the way of the worst cells, if they are under the target: as the
 * optimizer does.
 */
double BoundInSight(const std::vector<meshopt::Vec<3>>& places,
  const meshopt::SurfaceBound<3>& surface, const Options& options, std::int64_t cells)
{
  const bool known = meshopt::infoOf(options.Measure).bound == meshopt::FacetBound::BestApex &&
    std::any_of(surface.sides.begin(), surface.sides.end(),
      [&](const KeptSide<3>& side) { return side.quality < options.TargetQuality; });
  return known ? meshopt::boundInSight(places.data(), surface.sides, surface.bound,
                   meshopt::stepsInSight(static_cast<long>(cells)))
               : surface.bound;
}

double BoundInSight(const std::vector<meshopt::Vec<2>>&, const meshopt::SurfaceBound<2>& surface,
  const Options&, std::int64_t)
{
  return surface.bound;
}

/**
 * Region by region, since each has a bound of its own.
 */
template <int D>
void MeasurePart(const SurfaceOf<D>& part, const std::vector<long long>& regions,
  const Options& options, Figures& figures)
{
  std::vector<std::vector<KeptSide<D>>> sides(std::max<std::size_t>(1, regions.size()));
  for (const KeptSide<D>& side : part.Sides)
  {
    sides[side.region].push_back(side);
  }
  meshopt::SurfaceBoundOptions boundOptions;
  boundOptions.measure = options.Measure;
  boundOptions.enough = options.TargetQuality;
  for (std::size_t r = 0; r < sides.size(); ++r)
  {
    const auto result = meshopt::surfaceBound<D>(
      part.Places.data(), std::move(sides[r]), boundOptions);
    Index lastCapped = meshopt::None; // the sides of one cell are consecutive
    std::int64_t capped = 0;
    for (std::size_t s = 0; s < result.sides.size(); ++s)
    {
      const Index cell = result.sides[s].cell;
      if (result.sideCaps[s] < options.TargetQuality && cell != lastCapped && cell != meshopt::None)
      {
        lastCapped = cell;
        ++capped;
      }
    }
    Sums sums;
    sums.Bound = BoundInSight(part.Places, result, options, figures.Total.Quality.count);
    sums.CappedCells = capped;
    figures.Total.Merge(sums);
    if (!regions.empty())
    {
      figures.Regions[regions[r]].Merge(sums);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
template <>
meshopt::Vec<3> Surface::PlaceOf<3>(const double* x) const
{
  return { x[0], x[1], x[2] };
}

template <>
meshopt::Vec<2> Surface::PlaceOf<2>(const double* x) const
{
  return this->Frame.ToCore(x);
}

Surface FindSurface(const Grid& grid, const Options& options, const double* quality)
{
  Surface surface;
  surface.Frame = grid.GetFrame();
  if (grid.HasRegions())
  {
    surface.Regions = grid.GetRegions();
  }
  // With a varying metric nothing is certain, and neither is it for triangles that are not in a
  // plane.
  // Numbers of points and cells must fit into the core's.
  const bool known = !grid.HasMetric() && (grid.HasTetrahedra() || grid.IsFlat()) &&
    grid.GetNumberOfPoints() < std::numeric_limits<Index>::max() &&
    grid.GetNumberOfCells() < std::numeric_limits<Index>::max();
  if (!options.ComputeBound || !known)
  {
    return surface;
  }
  if (grid.HasTetrahedra())
  {
    Collect<3>(grid, quality, surface);
  }
  else
  {
    Collect<2>(grid, quality, surface);
  }
  return surface;
}

void MeasureSurface(const Surface& surface, const Options& options, Figures& figures)
{
  const auto& [plane, solid] = surface.Parts;
  if (!plane.Sides.empty())
  {
    MeasurePart<2>(plane, surface.Regions, options, figures);
  }
  if (!solid.Sides.empty())
  {
    MeasurePart<3>(solid, surface.Regions, options, figures);
  }
}

} // namespace vtkMeshQualityBridge
