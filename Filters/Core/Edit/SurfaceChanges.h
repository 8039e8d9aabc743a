// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceChanges.h
/// What a proposal does to the surface, by coordinates, for Surface::allows().
#ifndef meshopt_Edit_SurfaceChanges_h
#define meshopt_Edit_SurfaceChanges_h

#include "Edit/Proposal.h"
#include "Mesh/Ids.h"
#include "Surface/Surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace meshopt
{
/// Facets that vanish and facets that come, as the surface sees them: corners, patch, region and
/// sets. Keeps its memory between calls, since the engine asks for each change.
template <int D>
class SurfaceChanges
{
public:
  /// Asks the surface whether the cells of p may replace those of its cavity.
  bool allowsReplacement(
    const Surface<D>& surface, const SimplexMesh<D>& mesh, const Proposal<D>& p)
  {
    this->change_.clear();
    this->seen_.clear();
    for (Index c : p.cavity)
    {
      for (int i = 0; i <= D; ++i)
      {
        if (mesh.isKept(c, i) && find(p.kept.gone, sortedIds(mesh.facet(c, i))) >= 0)
        {
          this->addFacet(surface, mesh, c, i, this->change_.gone);
        }
      }
    }
    // A facet that goes and comes again is on both lists.
    this->seen_.clear();
    for (std::size_t n = 0; n < p.cells.size(); ++n)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Facet<D> f = facetOf(p.cells[n], i);
        const int k = find(p.kept.come, sortedIds(f));
        if (k >= 0 && this->isNew(f))
        {
          this->change_.come.push_back(
            pieceOf(surface, mesh, f, p.kept.patches[k], p.kept.regions[n]));
        }
      }
    }
    // An edge on no known curve ends it before distances are computed, which cost more.
    return std::all_of(p.kept.comeEdges.begin(), p.kept.comeEdges.end(),
             [&](const std::array<Index, 2>& e)
             { return this->addSpan(surface.span(mesh, e[0], e[1])); }) &&
      surface.allows(this->change_);
  }

  /// To be called before the nodes of p move.
  void beforeMoves(const Surface<D>& surface, const SimplexMesh<D>& mesh, const Proposal<D>& p)
  {
    this->change_.clear();
    this->addMoved(surface, mesh, p, this->change_.gone);
  }
  /// Asks the surface whether they may have moved.
  bool allowsMoves(const Surface<D>& surface, const SimplexMesh<D>& mesh, const Proposal<D>& p)
  {
    this->addMoved(surface, mesh, p, this->change_.come);
    for (Index c : p.cavity)
    {
      for (int e = 0; e < Local<D>::numberOfEdges; ++e)
      {
        const Index a = mesh.nodes(c)[Local<D>::edges[e][0]];
        const Index b = mesh.nodes(c)[Local<D>::edges[e][1]];
        if (mesh.isEdgeKeptByItself(c, e) && (slides(p, a) || slides(p, b)) &&
          !this->addSpan(surface.span(mesh, a, b)))
        {
          return false;
        }
      }
    }
    return surface.allows(this->change_);
  }

  /// Whether the surface allows the angles between its facets at these cells, and those beside
  /// them. To be called after the change.
  bool allowsAngles(
    const Surface<D>& surface, const SimplexMesh<D>& mesh, const std::vector<Index>& cells) const
  {
    for (Index c : cells)
    {
      for (int i = 0; i <= D; ++i)
      {
        for (int k = 0; k < D && mesh.isKept(c, i) && mesh.patch(c, i) != None; ++k)
        {
          if (!this->allowsAngle(surface, mesh, c, i, Local<D>::facets[i][k]))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

private:
  /// At the edge of facet i of cell c that is opposite to node k: the next facet of the surface is
  /// found by walking around the edge, on the side of c.
  bool allowsAngle(
    const Surface<D>& surface, const SimplexMesh<D>& mesh, Index c, int i, int k) const
  {
    Index current = c, exit = k;
    Index edge[2] = { None, None };
    bool isKept = false;
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const int p = Local<D>::edges[e][0], q = Local<D>::edges[e][1];
      if (p != i && p != k && q != i && q != k)
      {
        edge[0] = mesh.nodes(c)[p];
        edge[1] = mesh.nodes(c)[q];
        isKept = mesh.isEdgeKept(c, e);
      }
    }
    const auto cross = [&]
    {
      const Index h = mesh.adjacent(current, exit);
      current = mesh.cellOf(h);
      exit = mesh.otherFacet(current, mesh.facetOf(h), edge[0], edge[1]);
    };
    const auto cosine = [&]
    {
      const Vec<D> n = normal(mesh, c, i), m = normal(mesh, current, exit);
      return n.dot(m) / std::max(Tiny, n.norm() * m.norm());
    };
    // It ends: around an edge of the surface there is another facet of it.
    while (!mesh.isKept(current, exit))
    {
      cross();
    }
    if (!surface.allowsAngle(mesh, edge[0], edge[1], isKept, cosine()))
    {
      return false;
    }
    // From one outer facet through interfaces to the next.
    if (mesh.adjacent(c, i) != None || mesh.adjacent(current, exit) == None)
    {
      return true;
    }
    while (mesh.adjacent(current, exit) != None)
    {
      cross();
    }
    return surface.allowsAngleOutside(mesh, edge[0], edge[1], cosine());
  }
  static Vec<D> normal([[maybe_unused]] const SimplexMesh<D>& mesh, Index c, int i)
  {
    const Facet<D> f = mesh.facet(c, i);
    if constexpr (D == 3)
    {
      const Vec<3>& a = mesh.point(f[0]);
      return (mesh.point(f[1]) - a).cross(mesh.point(f[2]) - a);
    }
    // Of lines in the plane the angle is that of their directions, and the same reflection of both
    // leaves it as it is.
    const Vec<D> d = mesh.point(f[1]) - mesh.point(f[0]);
    return Vec<D>(d.reverse());
  }
  static constexpr double Tiny = std::numeric_limits<double>::min();

  static Facet<D> facetOf(const Simplex<D>& nodes, int i)
  {
    Facet<D> f;
    std::transform(std::begin(Local<D>::facets[i]), std::end(Local<D>::facets[i]), f.begin(),
      [&](int k) { return nodes[k]; });
    return f;
  }
  /// The number of the facet with these sorted ids, or -1.
  static int find(const std::vector<Facet<D>>& facets, const Facet<D>& key)
  {
    const auto found = std::find_if(
      facets.begin(), facets.end(), [&](const Facet<D>& f) { return sortedIds(f) == key; });
    return found == facets.end() ? -1 : static_cast<int>(found - facets.begin());
  }
  /// Whether the point is among those that move along the surface.
  static bool slides(const Proposal<D>& p, Index q)
  {
    return std::any_of(p.moves.begin(), p.moves.end(),
      [&](const auto& m) { return m.point == q && m.place.mayMove(); });
  }

  /// Whether the facet comes for the first time: an interface has cells on both sides.
  bool isNew(const Facet<D>& f)
  {
    const bool is = find(this->seen_, sortedIds(f)) < 0;
    if (is)
    {
      this->seen_.push_back(f);
    }
    return is;
  }
  static SurfacePiece<D> pieceOf(const Surface<D>& surface, const SimplexMesh<D>& mesh,
    const Facet<D>& f, Index patch, Index region)
  {
    SurfacePiece<D> piece;
    std::transform(f.begin(), f.end(), piece.x.begin(), [&](Index q) { return mesh.point(q); });
    piece.patch = patch;
    piece.region = region;
    // In a set as a whole, if all its nodes are.
    piece.sets = surface.sets(mesh, f[0]);
    for (int k = 1; k < D && piece.sets != 0; ++k)
    {
      piece.sets &= surface.sets(mesh, f[k]);
    }
    return piece;
  }
  /// Facet i of cell c, as it is.
  void addFacet(const Surface<D>& surface, const SimplexMesh<D>& mesh, Index c, int i,
    std::vector<SurfacePiece<D>>& pieces)
  {
    const Facet<D> f = mesh.facet(c, i);
    if (this->isNew(f))
    {
      pieces.push_back(pieceOf(surface, mesh, f, mesh.patch(c, i), mesh.region(c)));
    }
  }

  /// The kept facets with a point that moves.
  void addMoved(const Surface<D>& surface, const SimplexMesh<D>& mesh, const Proposal<D>& p,
    std::vector<SurfacePiece<D>>& pieces)
  {
    this->seen_.clear();
    for (Index c : p.cavity)
    {
      for (int i = 0; i <= D; ++i)
      {
        // Most facets are inside: their points are not asked for.
        const auto hasSliding = [&](const Facet<D>& f)
        { return std::any_of(f.begin(), f.end(), [&](Index q) { return slides(p, q); }); };
        if (mesh.isKept(c, i) && hasSliding(mesh.facet(c, i)))
        {
          this->addFacet(surface, mesh, c, i, pieces);
        }
      }
    }
  }

  /// False if the edge lies on no known curve: such a change is refused.
  bool addSpan(const std::optional<Span>& span)
  {
    if (span)
    {
      this->change_.spans.push_back(*span);
    }
    return span.has_value();
  }

  SurfaceChange<D> change_;
  std::vector<Facet<D>> seen_;
};
}

#endif
