// SPDX-License-Identifier: BSD-3-Clause
// The second half of SurfaceDivision: corners, and the curves between them.
#include "Mesh/Ids.h"
#include "Mesh/PinchedPoints.h"
#include "Surface/SurfaceDivision.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshopt
{
/// The patches that the edge separates.
std::vector<Index> SurfaceDivision::signature(Index edge) const
{
  std::vector<Index> patches;
  for (std::size_t i = this->edges_[edge].first; i < this->edges_[edge].last; ++i)
  {
    patches.push_back(this->facets[this->incidences_[i]].patch);
  }
  // Sorted, so that two edges of one curve compare equal.
  std::sort(patches.begin(), patches.end());
  return patches;
}

/// Whether the outer surface touches itself along the edge: the cells there are not connected.
bool SurfaceDivision::isTouching(const Edge& edge) const
{
  int outer = 0;
  for (std::size_t i = edge.first; i < edge.last; ++i)
  {
    outer += this->facets[this->incidences_[i]].other == None;
  }
  // Where the outer surface does not touch itself, two of its facets share the edge.
  return outer > 2;
}

/// Whether all facets at it stay as they are. (Then its ends are fixed, and it is a chain alone.)
bool SurfaceDivision::isLocked(const Edge& edge) const
{
  return std::all_of(this->incidences_.begin() + edge.first, this->incidences_.begin() + edge.last,
    [this](Index k) { return this->facets[k].isLocked; });
}

/// Whether the surface touches itself at point p. `around`: its facets; `curves`: its edges on
/// curves, none or two. There must be one fan of facets around a point of a patch, and one from
/// curve to curve for each facet at a curve.
bool SurfaceDivision::isPinched(
  Index p, const std::vector<Index>& around, const std::vector<Index>& curves) const
{
  // Facets are joined to fans over edges that are no curves, as in a flood.
  std::vector<char> seen(around.size(), 0);
  std::size_t fans = 0;
  for (std::size_t first = 0; first < around.size(); ++first)
  {
    if (seen[first])
    {
      continue;
    }
    ++fans;
    std::vector<std::size_t> front{ first };
    std::vector<Index> ends; // curves that the fan meets
    seen[first] = 1;
    while (!front.empty())
    {
      const Index facet = around[front.back()];
      front.pop_back();
      for (Index e : this->edgesOf_[facet])
      {
        const Edge& edge = this->edges_[e];
        if (!hasId(edge.nodes, p))
        {
          continue;
        }
        // A fan ends at curves: what lies beyond belongs to another fan.
        if (edge.isCurve)
        {
          ends.push_back(e);
          continue;
        }
        for (std::size_t i = edge.first; i < edge.last; ++i)
        {
          const auto k = static_cast<std::size_t>(
            std::find(around.begin(), around.end(), this->incidences_[i]) - around.begin());
          if (!seen[k])
          {
            seen[k] = 1;
            front.push_back(k);
          }
        }
      }
    }
    // From one curve to the other, and not back to the same; inside of a patch there is none to
    // meet.
    if (ends.size() != curves.size() || (ends.size() == 2 && ends[0] == ends[1]))
    {
      return true;
    }
  }
  // At a curve each sheet that meets there has a fan of its own.
  return curves.empty() && fans != 1;
}

/// What each point of the surface may do. In doubt it stays.
void SurfaceDivision::findCorners(const SurfaceOptions& options)
{
  const Index n = this->mesh_.numberOfPointSlots();
  // Free: not on the surface. All others get their freedom below.
  this->freedom.assign(n, Freedom::Free);
  this->patchOfPoint.assign(n, None);
  std::vector<std::uint8_t> touching = pinchedPoints<3>(this->mesh_);
  // Empty if no point is pinched.
  touching.resize(n, 0);
  // Facets and curves at each point, as one list each, sorted by point.
  std::vector<std::array<Index, 2>> facetsAt, curvesAt;
  for (std::size_t k = 0; k < this->facets.size(); ++k)
  {
    for (Index p : this->facets[k].nodes)
    {
      facetsAt.push_back({ p, static_cast<Index>(k) });
    }
  }
  for (std::size_t e = 0; e < this->edges_.size(); ++e)
  {
    for (Index p : this->edges_[e].nodes)
    {
      touching[p] |= this->isTouching(this->edges_[e]);
      if (this->edges_[e].isCurve)
      {
        curvesAt.push_back({ p, static_cast<Index>(e) });
      }
    }
  }
  std::sort(facetsAt.begin(), facetsAt.end());
  std::sort(curvesAt.begin(), curvesAt.end());
  // Both lists are sorted by point: one walk through them meets each point once.
  std::size_t i = 0, j = 0;
  std::vector<Index> around, curves;
  while (i < facetsAt.size())
  {
    const Index p = facetsAt[i][0];
    around.clear();
    curves.clear();
    for (; i < facetsAt.size() && facetsAt[i][0] == p; ++i)
    {
      around.push_back(facetsAt[i][1]);
    }
    for (; j < curvesAt.size() && curvesAt[j][0] == p; ++j)
    {
      curves.push_back(curvesAt[j][1]);
    }
    const bool isMarked = this->isCorner_[p] ||
      (this->mesh_.pointData(p).flags & SimplexMesh<3>::PointFixedByUser) ||
      (!options.corners.empty() && options.corners[p]);
    const bool isLocked = std::any_of(
      around.begin(), around.end(), [&](Index k) { return this->facets[k].isLocked; });
    const bool isFixed = isMarked || isLocked || touching[p];
    // It stays, unless it proves below to be inside of a patch or of a curve.
    this->freedom[p] = isFixed || this->isExact ? Freedom::Fixed : Freedom::Corner;
    const bool isEnd = !options.ends.empty() && options.ends[p];
    if (isFixed || isEnd || (!curves.empty() && curves.size() != 2) ||
      this->isPinched(p, around, curves))
    {
      continue;
    }
    if (curves.empty())
    {
      this->freedom[p] = Freedom::Patch;
      this->patchOfPoint[p] = this->facets[around[0]].patch;
    }
    else if (this->signature(curves[0]) == this->signature(curves[1]) &&
      // No end of a ridge, also where an interface ends in the outer surface, nor of a line.
      this->edges_[curves[0]].isSharp == this->edges_[curves[1]].isSharp &&
      this->edges_[curves[0]].isBent == this->edges_[curves[1]].isBent &&
      this->edges_[curves[0]].label == this->edges_[curves[1]].label &&
      !this->turns(p, curves, options.cornerAngle))
    {
      this->freedom[p] = Freedom::Curve;
    }
  }
}

/// Whether the curve turns sharply at p.
bool SurfaceDivision::turns(Index p, const std::vector<Index>& curves, double angle) const
{
  Vec<3> d[2];
  for (int k = 0; k < 2; ++k)
  {
    const std::array<Index, 2>& e = this->edges_[curves[k]].nodes;
    d[k] = this->mesh_.point(e[0] == p ? e[1] : e[0]) - this->mesh_.point(p);
  }
  // Both lead away from p: on a straight curve they are opposite.
  return -d[0].dot(d[1]) < cosine(std::min(angle, 90.0)) * d[0].norm() * d[1].norm();
}

/// From each corner along the curves to the next; then what is left, which is closed.
void SurfaceDivision::findChains()
{
  std::vector<std::array<Index, 2>> ends; // point, edge
  for (std::size_t e = 0; e < this->edges_.size(); ++e)
  {
    if (this->edges_[e].isCurve)
    {
      ends.push_back({ this->edges_[e].nodes[0], static_cast<Index>(e) });
      ends.push_back({ this->edges_[e].nodes[1], static_cast<Index>(e) });
    }
  }
  std::sort(ends.begin(), ends.end());
  // An edge belongs to one chain only.
  std::vector<char> used(this->edges_.size(), 0);
  // Walks from edge to edge up to a corner, or back to the start.
  const auto follow = [&](Index p, Index e)
  {
    Chain chain;
    chain.points.push_back(p);
    while (true)
    {
      used[e] = 1;
      chain.isSharp = chain.isSharp && this->edges_[e].isSharp;
      chain.isFixed = chain.isFixed || this->isTouching(this->edges_[e]) ||
        this->isLocked(this->edges_[e]);
      chain.isLine = chain.isLine || this->edges_[e].label != None;
      const std::array<Index, 2>& nodes = this->edges_[e].nodes;
      p = nodes[0] == p ? nodes[1] : nodes[0];
      chain.isClosed = p == chain.points[0] && this->freedom[p] == Freedom::Curve;
      if (chain.isClosed)
      {
        break;
      }
      chain.points.push_back(p);
      if (this->freedom[p] != Freedom::Curve)
      {
        break;
      }
      // A point inside of a curve stands twice in the list, with the edge before it and the one
      // after.
      // The first entry of p: edges have numbers from 0 on.
      auto next = std::lower_bound(ends.begin(), ends.end(), std::array<Index, 2>{ p, 0 });
      e = (*next)[1] == e ? (*(next + 1))[1] : (*next)[1];
    }
    this->chains.push_back(chain);
  };
  // Open chains first: a walk that began inside of one would find only a part of it.
  for (const bool fromCorners : { true, false })
  {
    for (const auto& [p, e] : ends)
    {
      if (!used[e] && (this->freedom[p] != Freedom::Curve) == fromCorners)
      {
        follow(p, e);
      }
    }
  }
  if (this->isExact)
  {
    this->straighten();
  }
}

/// Divides the chains into straight ones. Where they turn, their points become corners.
void SurfaceDivision::straighten()
{
  std::vector<Chain> straight;
  const auto isStraight = [&](const std::vector<Index>& points, std::size_t from, std::size_t to)
  {
    const Vec<3>& a = this->mesh_.point(points[from]);
    const Vec<3> along = this->mesh_.point(points[to]) - a;
    const double l = along.norm();
    double last = 0.0;
    for (std::size_t k = from + 1; k < to; ++k)
    {
      const Vec<3> d = this->mesh_.point(points[k]) - a;
      const double t = d.dot(along) / l;
      // Each point beyond the last one: a chain that turns back is not straight.
      if (!(t > last && t < l) || (d - along * (t / l)).norm() > this->slab())
      {
        return false;
      }
      last = t;
    }
    return l > 0.0;
  };
  for (Chain& chain : this->chains)
  {
    if (chain.isClosed)
    {
      // It begins where it turns: no straight chain then contains its first point.
      const std::size_t n = chain.points.size();
      std::size_t first = 0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const std::vector<Index> three{ chain.points[(k + n - 1) % n], chain.points[k],
          chain.points[(k + 1) % n] };
        if (!isStraight(three, 0, 2))
        {
          first = k;
          break;
        }
      }
      std::rotate(chain.points.begin(), chain.points.begin() + first, chain.points.end());
      chain.points.push_back(Index(chain.points[0]));
    }
    for (std::size_t from = 0; from + 1 < chain.points.size();)
    {
      // As far as it goes, tested as a whole each time: small turns cannot add up unseen.
      std::size_t to = from + 1;
      while (to + 1 < chain.points.size() && isStraight(chain.points, from, to + 1))
      {
        ++to;
      }
      Chain piece;
      piece.isSharp = chain.isSharp;
      piece.isFixed = chain.isFixed;
      piece.isLine = chain.isLine;
      piece.points.assign(chain.points.begin() + from, chain.points.begin() + to + 1);
      // Both ends of a straight piece stay: the line that the others slide on ends there.
      this->freedom[piece.points.front()] = this->freedom[piece.points.back()] = Freedom::Fixed;
      straight.push_back(piece);
      from = to;
    }
  }
  this->chains.swap(straight);
}
}
