// SPDX-License-Identifier: BSD-3-Clause
// Builds a SimplexMesh: checks, adjacency by a bucket sort, orientation, kept facets and edges.
#include "Mesh/Ids.h"
#include "Mesh/PinchedPoints.h"
#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meshopt
{
namespace
{
/// Ids as in a sentence, such as "3, 7 and 12", for messages.
template <std::size_t N>
std::string list(const std::array<Index, N>& ids)
{
  std::string text;
  for (std::size_t i = 0; i < N; ++i)
  {
    text += (i == 0 ? "" : i + 1 == N ? " and " : ", ") + std::to_string(ids[i]);
  }
  return text;
}

/// Sorts the D ids of a facet; returns whether the permutation was odd.
template <int D>
bool sortFacet(Facet<D>& f)
{
  bool odd = false;
  const auto order = [&](int i, int j)
  {
    if (f[i] > f[j])
    {
      std::swap(f[i], f[j]);
      odd = !odd;
    }
  };
  // A sorting network: each exchange of two ids changes the parity.
  order(0, 1);
  if constexpr (D == 3)
  {
    order(1, 2);
    order(0, 1);
  }
  return odd;
}

/// A facet without its lowest point id.
struct FacetEntry
{
  std::uint64_t rest;    // the other ids, sorted
  std::uint32_t handle2; // 2 * handle + parity
  bool operator<(const FacetEntry& o) const
  {
    // Equal facets come in the order of their cells: std::sort() alone may exchange them.
    return this->rest != o.rest ? this->rest < o.rest : this->handle2 < o.handle2;
  }
};
}

template <int D>
struct MeshBuilder
{
  using Mesh = SimplexMesh<D>;
  const MeshInput<D>& input;
  Mesh& mesh;
  bool consistent = true;

  /// Empties the mesh, so that no caller goes on with one that is half built.
  MeshError error(std::string message, Index cell = None, Index point = None)
  {
    this->mesh = Mesh();
    return { std::move(message), cell, point };
  }

  /// Lengths of arrays, and whether all numbers of cells fit into their types.
  std::optional<MeshError> checkLengths()
  {
    if (this->input.cells.size() > static_cast<std::size_t>(MaximumNumberOfCells))
    {
      // Handles are then under 2^31: with a bit for parity they fit into 32 bits.
      return this->error("More than 2^29 cells.");
    }
    const std::size_t cells = this->input.cells.size(), points = this->input.points.size();
    using List = std::tuple<const char*, std::size_t, std::size_t, const char*>;
    for (const auto& [what, have, want, of] :
      { List("The region array", this->input.regions.size(), cells, "cells"),
        List("The mask of fixed points", this->input.fixedPoints.size(), points, "points"),
        List("The mask of points at a border", this->input.borderPoints.size(), points, "points") })
    {
      if (have != 0 && have != want)
      {
        return this->error(std::string(what) + " has " + std::to_string(have) + " values for " +
          std::to_string(want) + " " + of + ".");
      }
    }
    return std::nullopt;
  }

  /// Malformed cells are refused here, so that no later step has to doubt an id. Flat and inverted
  /// cells pass: mending them is what the optimizer is for.
  std::optional<MeshError> checkCells()
  {
    const Index n = static_cast<Index>(this->input.points.size());
    for (std::size_t c = 0; c < this->input.cells.size(); ++c)
    {
      const Simplex<D>& t = this->input.cells[c];
      for (int i = 0; i <= D; ++i)
      {
        if (t[i] < 0 || t[i] >= n)
        {
          return this->error("Cell " + std::to_string(c) + " uses point " + std::to_string(t[i]) +
              ", but there are " + std::to_string(n) + " points.",
            Index(c), t[i]);
        }
        for (int j = 0; j < i; ++j)
        {
          if (t[i] == t[j])
          {
            return this->error(
              "Cell " + std::to_string(c) + " uses point " + std::to_string(t[i]) + " twice.",
              Index(c), t[i]);
          }
        }
        // Only points that cells use: others are never read.
        if (!this->input.points[t[i]].allFinite())
        {
          return this->error("Point " + std::to_string(t[i]) + " of cell " + std::to_string(c) +
              " has a coordinate that is not finite.",
            Index(c), t[i]);
        }
      }
    }
    return std::nullopt;
  }

  /// Slot c is cell c of the input and slot p is point p. SimplexMesh promises this for points, and
  /// whoever takes results back relies on it.
  void fill()
  {
    const std::size_t n = this->input.cells.size();
    this->mesh.cells_.resize(n);
    this->mesh.cellData_.resize(n);
    this->mesh.points_.resize(this->input.points.size());
    this->mesh.inputCells_ = static_cast<Index>(n);
    this->mesh.inputPoints_ = static_cast<Index>(this->input.points.size());
    for (std::size_t p = 0; p < this->input.points.size(); ++p)
    {
      this->mesh.points_[p].x = this->input.points[p];
      if (!this->input.fixedPoints.empty() && this->input.fixedPoints[p])
      {
        this->mesh.points_[p].flags = Mesh::PointHeld | Mesh::PointFixedByUser;
      }
      if (!this->input.borderPoints.empty() && this->input.borderPoints[p])
      {
        this->mesh.points_[p].flags |= Mesh::PointAtBorder;
        this->mesh.hasBorder_ = true;
      }
    }
    for (std::size_t c = 0; c < n; ++c)
    {
      this->mesh.cells_[c].nodes = this->input.cells[c];
      this->mesh.cells_[c].adjacent.fill(None);
      typename Mesh::CellData& data = this->mesh.cellData_[c];
      data.parent = static_cast<Index>(c);
      data.region = this->input.regions.empty() ? 0 : this->input.regions[c];
      data.flags = Mesh::CellAlive;
      for (Index p : this->input.cells[c])
      {
        // Any of its cells will do: stars are walked from it.
        this->mesh.points_[p].cell = static_cast<Index>(c);
        this->mesh.points_[p].flags |= Mesh::PointAlive;
      }
    }
  }

  /// Puts facets into buckets by their lowest point id (counting sort), then sorts the few facets
  /// of each bucket: equal facets become neighbours.
  std::optional<MeshError> link()
  {
    const Index n = this->mesh.numberOfCellSlots();
    std::vector<std::uint32_t> start(this->input.points.size() + 1, 0);
    for (Index c = 0; c < n; ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Facet<D> f = this->mesh.facet(c, i);
        // Counted one place further on: after the sums below, start[p] is where the bucket of p
        // begins.
        ++start[*std::min_element(f.begin(), f.end()) + 1];
      }
    }
    for (std::size_t p = 0; p + 1 < start.size(); ++p)
    {
      start[p + 1] += start[p];
    }
    std::vector<FacetEntry> entries(std::size_t(n) * (D + 1));
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (Index c = 0; c < n; ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        Facet<D> f = this->mesh.facet(c, i);
        const bool odd = sortFacet<D>(f);
        // The lowest id is the number of the bucket, so that the others fit into 64 bits.
        std::uint64_t rest = static_cast<std::uint32_t>(f[1]);
        if constexpr (D == 3)
        {
          rest = (rest << 32) | static_cast<std::uint32_t>(f[2]);
        }
        entries[next[f[0]]++] = { rest,
          (static_cast<std::uint32_t>(Mesh::handle(c, i)) << 1) | odd };
      }
    }
    for (std::size_t p = 0; p + 1 < start.size(); ++p)
    {
      std::sort(entries.begin() + start[p], entries.begin() + start[p + 1]);
      for (std::uint32_t k = start[p]; k + 1 < start[p + 1]; ++k)
      {
        if (entries[k].rest != entries[k + 1].rest)
        {
          continue;
        }
        if (auto wrong = this->pair(entries, k, start[p + 1]))
        {
          return wrong;
        }
        // Both have found each other: go on behind the second one.
        ++k;
      }
    }
    return std::nullopt;
  }

  /// Links entries k and k + 1, which are the same facet. `end` is the end of their bucket: a third
  /// equal entry can only stand before it.
  std::optional<MeshError> pair(
    const std::vector<FacetEntry>& entries, std::uint32_t k, std::uint32_t end)
  {
    const Index a = static_cast<Index>(entries[k].handle2 >> 1);
    const Index b = static_cast<Index>(entries[k + 1].handle2 >> 1);
    const Index ca = Mesh::cellOf(a), cb = Mesh::cellOf(b);
    if (k + 2 < end && entries[k + 2].rest == entries[k].rest)
    {
      // A third equal facet: the mesh is not conforming.
      const Index cc = Mesh::cellOf(static_cast<Index>(entries[k + 2].handle2 >> 1));
      return this->error("The " + std::string(D == 3 ? "face" : "edge") + " of points " +
          list(this->mesh.facet(ca, Mesh::facetOf(a))) +
          " belongs to more than two cells: " + list(std::array<Index, 3>{ ca, cb, cc }) + ".",
        cc);
    }
    // Two cells with the same points would share all facets.
    Simplex<D> na = this->mesh.nodes(ca), nb = this->mesh.nodes(cb);
    std::sort(na.begin(), na.end());
    std::sort(nb.begin(), nb.end());
    if (na == nb)
    {
      return this->error(
        "Cells " + list(std::array<Index, 2>{ ca, cb }) + " have the same points.", cb);
    }
    this->mesh.cells_[ca].adjacent[Mesh::facetOf(a)] = b;
    this->mesh.cells_[cb].adjacent[Mesh::facetOf(b)] = a;
    // Neighbours that are numbered alike see their facet with opposite parity.
    this->consistent &= ((entries[k].handle2 ^ entries[k + 1].handle2) & 1) != 0;
    return std::nullopt;
  }

  /// True if the two cells see the shared facet from opposite sides, as they must.
  bool agree(Index c, int i) const
  {
    const Index h = this->mesh.adjacent(c, i);
    Facet<D> f = this->mesh.facet(c, i), g = this->mesh.facet(Mesh::cellOf(h), Mesh::facetOf(h));
    return sortFacet<D>(f) != sortFacet<D>(g);
  }

  /// Makes the numbering of each connected component consistent, and its total volume positive. A
  /// cell that is negative after that is geometrically inverted, not just numbered in reverse. A
  /// component without a negative cell stays as it is: where its numbering is not consistent cells
  /// overlap, and reversing one would make it inverted.
  void orient()
  {
    const Index n = this->mesh.numberOfCellSlots();
    bool negative = false;
    for (Index c = 0; c < n && !negative; ++c)
    {
      negative = signedVolume(this->mesh.corners(c)) < 0.0;
    }
    // The usual case: nothing to walk over.
    if (this->consistent && !negative)
    {
      return;
    }
    std::vector<std::int8_t> sign(n, 0);
    std::vector<Index> component;
    for (Index seed = 0; seed < n; ++seed)
    {
      if (sign[seed] != 0)
      {
        continue;
      }
      const double volume = this->propagate(seed, sign, component);
      const bool isPositive = std::none_of(component.begin(), component.end(),
        [&](Index c) { return signedVolume(this->mesh.corners(c)) < 0.0; });
      for (Index c : component)
      {
        // The sign is relative to the seed. A negative volume says that the seed itself is in
        // reverse.
        if (!isPositive && (sign[c] < 0) != (volume < 0.0))
        {
          this->reverse(c);
          ++this->mesh.reoriented_;
        }
      }
      // Here no cell is negative, yet two may be numbered against each other: they overlap.
      if (isPositive)
      {
        this->findFolds(component);
      }
    }
  }

  /// Counts facets that have both their cells on the same side.
  void findFolds(const std::vector<Index>& cells)
  {
    for (Index c : cells)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Index h = this->mesh.adjacent(c, i);
        // Each pair once: from the side with the lower handle.
        if (h > Mesh::handle(c, i) && !this->agree(c, i) && this->mesh.foldedFacets_++ == 0)
        {
          this->mesh.firstFoldedFacet_ = this->mesh.facet(c, i);
        }
      }
    }
  }

  double propagate(Index seed, std::vector<std::int8_t>& sign, std::vector<Index>& component)
  {
    // Walks over the component; sign is the numbering of each cell relative to the seed's.
    component.assign(1, seed);
    sign[seed] = 1;
    double volume = 0.0;
    for (std::size_t k = 0; k < component.size(); ++k)
    {
      const Index c = component[k];
      volume += sign[c] * signedVolume(this->mesh.corners(c));
      for (int i = 0; i <= D; ++i)
      {
        const Index h = this->mesh.adjacent(c, i);
        if (h != None && sign[Mesh::cellOf(h)] == 0)
        {
          sign[Mesh::cellOf(h)] = this->agree(c, i) ? sign[c] : -sign[c];
          component.push_back(Mesh::cellOf(h));
        }
      }
    }
    return volume;
  }

  void reverse(Index c)
  {
    auto& cell = this->mesh.cells_[c];
    // The last two nodes, and with them the facets opposite to them.
    std::swap(cell.nodes[D - 1], cell.nodes[D]);
    std::swap(cell.adjacent[D - 1], cell.adjacent[D]);
    for (int i = D - 1; i <= D; ++i)
    {
      const Index h = cell.adjacent[i];
      if (h != None)
      {
        this->mesh.cells_[Mesh::cellOf(h)].adjacent[Mesh::facetOf(h)] = Mesh::handle(c, i);
      }
    }
  }

  /// Marks one side. Callers go over all cells, and so come to the other side by themselves.
  void keepFacet(Index c, int i)
  {
    this->mesh.cellData_[c].flags |= std::uint16_t(1u << i);
    for (Index p : this->mesh.facet(c, i))
    {
      this->mesh.points_[p].flags |= Mesh::PointHeld | Mesh::PointBoundary;
    }
  }

  /// Facets of the surface and between regions are kept in any case, those of the caller besides.
  void keepAll()
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Index h = this->mesh.adjacent(c, i);
        if (h == None || this->mesh.region(Mesh::cellOf(h)) != this->mesh.region(c))
        {
          this->keepFacet(c, i);
        }
      }
    }
    // Pinched points come last: points on kept facets are held already, and need no star.
    this->keepListed();
    this->fixPinchedPoints();
  }

  /// Marks the caller's facets and edges in every cell that has them. Scans all cells, since a star
  /// may be incomplete where bodies touch in a point. Ignores what no cell has.
  void keepListed()
  {
    std::vector<Facet<D>> facets = this->input.keptFacets;
    std::vector<std::array<Index, 2>> edges = this->input.keptEdges;
    sortAll(facets);
    sortAll(edges);
    if (facets.empty() && edges.empty())
    {
      return;
    }
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        if (std::binary_search(facets.begin(), facets.end(), sortedIds(this->mesh.facet(c, i))))
        {
          this->keepFacet(c, i);
        }
      }
      for (int k = 0; k < Local<D>::numberOfEdges; ++k)
      {
        const Index a = this->mesh.nodes(c)[Local<D>::edges[k][0]];
        const Index b = this->mesh.nodes(c)[Local<D>::edges[k][1]];
        if (std::binary_search(edges.begin(), edges.end(), sortedIds(a, b)))
        {
          // An edge stays where it is only if both its ends do.
          this->mesh.cellData_[c].flags |= std::uint16_t(1u << (Mesh::FirstEdgeBit + k));
          this->mesh.points_[a].flags |= Mesh::PointHeld;
          this->mesh.points_[b].flags |= Mesh::PointHeld;
          this->mesh.hasKeptEdges_ = true;
        }
      }
    }
  }

  template <class List>
  static void sortAll(List& list)
  {
    for (auto& ids : list)
    {
      ids = sortedIds(ids);
    }
    std::sort(list.begin(), list.end());
  }

  /// Holds free points whose cells are not all connected over facets (two bodies that touch in an
  /// inner point). They must not move, because their star would be found only in part.
  void fixPinchedPoints()
  {
    const std::vector<std::uint8_t> pinched = pinchedPoints(this->mesh, true);
    for (std::size_t p = 0; p < pinched.size(); ++p)
    {
      this->mesh.points_[p].flags |= pinched[p] ? Mesh::PointHeld : 0;
    }
  }
};

/// The order matters. Orientation needs the adjacency. Kept facets are marked after it, since
/// reverse() exchanges facets, but not their marks.
template <int D>
std::optional<MeshError> SimplexMesh<D>::build(const MeshInput<D>& input, SimplexMesh<D>& mesh)
{
  mesh = SimplexMesh<D>();
  MeshBuilder<D> builder{ input, mesh };
  if (auto wrong = builder.checkLengths())
  {
    return wrong;
  }
  if (auto wrong = builder.checkCells())
  {
    return wrong;
  }
  builder.fill();
  if (auto wrong = builder.link())
  {
    return wrong;
  }
  if (!input.isOriented)
  {
    builder.orient();
  }
  builder.keepAll();
  return std::nullopt;
}

template std::optional<MeshError> SimplexMesh<2>::build(const MeshInput<2>&, SimplexMesh<2>&);
template std::optional<MeshError> SimplexMesh<3>::build(const MeshInput<3>&, SimplexMesh<3>&);
}
