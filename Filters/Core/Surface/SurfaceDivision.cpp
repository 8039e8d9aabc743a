// SPDX-License-Identifier: BSD-3-Clause
// The first half of the division: kept facets, their edges, which of these are curves, and patches.
// Corners and curves follow in SurfaceDivisionCurves.cpp.
#include "Surface/SurfaceDivision.h"

#include "Mesh/Ids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshopt
{
namespace
{
/// The least tolerance, in units in the last place of the greatest coordinate.
constexpr double Ulps = 8.0;
/// No tolerance is greater than this part of the diagonal.
constexpr double Most = 0.1;
/// Below this part of the diagonal, only what is flat can change at all.
constexpr double ExactBelow = 1e-6;
/// A surface that bends gently everywhere is not flat as a whole. That is not tried for the rest of
/// it any more once these many times all facets have been filled in vain.
constexpr std::size_t MostInVain = 100;

/// Whether the triangle runs through its edge ab from a to b.
bool runsForwards(const Facet<3>& f, Index a, Index b)
{
  return (f[0] == a && f[1] == b) || (f[1] == a && f[2] == b) || (f[2] == a && f[0] == b);
}

Index thirdNode(const Facet<3>& f, const std::array<Index, 2>& edge)
{
  return f[0] != edge[0] && f[0] != edge[1] ? f[0]
                                            : (f[1] != edge[0] && f[1] != edge[1] ? f[1] : f[2]);
}

template <class T>
bool contains(const std::vector<T>& sorted, const T& value)
{
  return std::binary_search(sorted.begin(), sorted.end(), value);
}
}

double SurfaceDivision::cosine(double degrees)
{
  return std::cos(degrees * std::acos(-1.0) / 180.0);
}

SurfaceDivision::SurfaceDivision(const SimplexMesh<3>& mesh, const SurfaceOptions& options)
  : mesh_(mesh)
{
  // The order matters: each step reads what those before it have found.
  this->tolerance = options.tolerance;
  this->measure();
  this->collectFacets(options);
  this->lockTwins();
  this->collectEdges();
  this->findCurves(options);
  this->findPatches();
  this->findCorners(options);
  this->findChains();
}

/// Tolerances are relative to the diagonal, rounding to the greatest coordinate: a small body may
/// lie far from the origin.
void SurfaceDivision::measure()
{
  Eigen::AlignedBox<double, 3> box;
  for (Index p = 0; p < this->mesh_.numberOfPointSlots(); ++p)
  {
    if (this->mesh_.isPointAlive(p))
    {
      box.extend(this->mesh_.point(p));
    }
  }
  if (box.isEmpty())
  {
    return;
  }
  this->diagonal = box.diagonal().norm();
  const double greatest = std::max(
    box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  // By the tolerance as it was asked for, before it is raised to rounding.
  this->isExact = this->tolerance < ExactBelow * this->diagonal;
  this->rounding = Ulps * std::numeric_limits<double>::epsilon() * greatest;
  this->tolerance = std::clamp(
    this->tolerance, this->rounding, std::max(this->rounding, Most * this->diagonal));
}

/// Each kept facet once: from the side with the lower region, or with the lower handle.
void SurfaceDivision::collectFacets(const SurfaceOptions& options)
{
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && this->mesh_.isAlive(c); ++i)
    {
      if (!this->mesh_.isKept(c, i))
      {
        continue;
      }
      KeptFacet facet;
      facet.handle = this->mesh_.handle(c, i);
      facet.region = this->mesh_.region(c);
      const Index h = this->mesh_.adjacent(c, i);
      if (h != None)
      {
        facet.other = this->mesh_.region(this->mesh_.cellOf(h));
        // Once for both sides.
        if (facet.other < facet.region || (facet.other == facet.region && h < facet.handle))
        {
          continue;
        }
      }
      facet.nodes = this->mesh_.facet(c, i);
      std::swap(facet.nodes[1], facet.nodes[2]); // now as seen from outside
      const Facet<3> key = sortedIds(facet.nodes);
      // The list is sorted by the caller: see SurfaceOptions::labels.
      const auto label = std::lower_bound(options.labels.begin(), options.labels.end(), key,
        [](const auto& entry, const Facet<3>& f) { return entry.first < f; });
      facet.label = label != options.labels.end() && label->first == key ? label->second : None;
      // A facet whose nodes may not move cannot move either.
      const bool isFixed = std::all_of(key.begin(), key.end(),
        [&](Index p)
        { return (this->mesh_.pointData(p).flags & SimplexMesh<3>::PointFixedByUser) != 0; });
      const bool isListed = contains(options.locked, key);
      facet.isLocked = isFixed || isListed;
      this->numberOfTwins += isListed;
      this->facets.push_back(facet);
    }
  }
}

/// Facets that lie on others, corner by corner, without having their points: the lips of a closed
/// crack. They stay, so that their nodes stay in pairs.
void SurfaceDivision::lockTwins()
{
  // By coordinates, bit for bit: the lips of a crack have different points.
  std::vector<std::pair<std::array<double, 9>, Index>> places;
  for (std::size_t k = 0; k < this->facets.size(); ++k)
  {
    std::array<std::array<double, 3>, 3> x;
    for (int i = 0; i < 3; ++i)
    {
      const Vec<3>& p = this->mesh_.point(this->facets[k].nodes[i]);
      x[i] = { p[0], p[1], p[2] };
    }
    // Both lips have the same corners, but in another order.
    std::sort(x.begin(), x.end());
    std::array<double, 9> key;
    for (int i = 0; i < 9; ++i)
    {
      key[i] = x[i / 3][i % 3];
    }
    places.emplace_back(key, static_cast<Index>(k));
  }
  std::sort(places.begin(), places.end());
  const auto isSame = [&](std::size_t k, std::size_t other)
  { return other < places.size() && places[k].first == places[other].first; };
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    if (isSame(k, k + 1) || (k > 0 && isSame(k, k - 1)))
    {
      KeptFacet& facet = this->facets[places[k].second];
      this->numberOfTwins += !facet.isLocked; // those that the caller lists are counted
      facet.isLocked = true;
    }
  }
}

/// All edges of the facets, each once, with the facets at it.
void SurfaceDivision::collectEdges()
{
  struct Incidence
  {
    std::array<Index, 2> nodes;
    Index facet;
    int opposite;
  };
  std::vector<Incidence> all;
  all.reserve(3 * this->facets.size());
  for (std::size_t k = 0; k < this->facets.size(); ++k)
  {
    const Facet<3>& f = this->facets[k].nodes;
    // Edge i is opposite to node i, as facets are in a cell.
    for (int i = 0; i < 3; ++i)
    {
      all.push_back({ sortedIds(f[(i + 1) % 3], f[(i + 2) % 3]), static_cast<Index>(k), i });
    }
  }
  // Incidences of one edge stand together, in the order of their facets.
  std::sort(all.begin(), all.end(),
    [](const Incidence& a, const Incidence& b)
    { return a.nodes != b.nodes ? a.nodes < b.nodes : a.facet < b.facet; });
  this->edgesOf_.resize(this->facets.size());
  for (const Incidence& i : all)
  {
    if (this->edges_.empty() || this->edges_.back().nodes != i.nodes)
    {
      this->edges_.push_back({ i.nodes, this->incidences_.size(), 0, false, false, false, None });
    }
    this->edgesOf_[i.facet][i.opposite] = static_cast<Index>(this->edges_.size()) - 1;
    this->incidences_.push_back(i.facet);
    this->edges_.back().last = this->incidences_.size();
  }
}

/// Not of unit length: twice the area.
Vec<3> SurfaceDivision::normal(const KeptFacet& facet) const
{
  const Vec<3>& a = this->mesh_.point(facet.nodes[0]);
  return (this->mesh_.point(facet.nodes[1]) - a).cross(this->mesh_.point(facet.nodes[2]) - a);
}

/// Whether the two facets of the edge lie in one plane. The greater of them decides which: a needle
/// has none. Its plane is uncertain by as many slabs as the other facet reaches beyond it; whether
/// all facets of a patch lie in one slab, fits() says.
bool SurfaceDivision::isFlat(const Edge& edge) const
{
  const KeptFacet* facets[2] = { &this->facets[this->incidences_[edge.first]],
    &this->facets[this->incidences_[edge.first + 1]] };
  Vec<3> n[2] = { this->normal(*facets[0]), this->normal(*facets[1]) };
  const auto [a, b] = edge.nodes;
  const bool alike = runsForwards(facets[0]->nodes, a, b) != runsForwards(facets[1]->nodes, a, b);
  const int greater = n[1].squaredNorm() > n[0].squaredNorm() ? 1 : 0;
  const double area = n[greater].norm();
  const double length = (this->mesh_.point(b) - this->mesh_.point(a)).norm();
  // The altitude of the greater facet over the edge.
  const double width = area / length;
  const Vec<3> other = this->mesh_.point(thirdNode(facets[1 - greater]->nodes, edge.nodes)) -
    this->mesh_.point(a);
  const double reach = 1.0 + other.norm() / std::min(width, length);
  return width > this->tolerance && (alike ? 1.0 : -1.0) * n[0].dot(n[1]) >= 0.0 &&
    std::fabs(n[greater].dot(other)) <= reach * this->slab() * area;
}

bool SurfaceDivision::isCurve(const Edge& edge, const SurfaceOptions& options) const
{
  // The border of a sheet, or where more than two facets meet.
  if (edge.last - edge.first != 2)
  {
    return true;
  }
  const KeptFacet &f = this->facets[this->incidences_[edge.first]],
                  &g = this->facets[this->incidences_[edge.first + 1]];
  // What differs across the edge belongs to different things: region, the caller's label, or a
  // lock.
  if (f.region != g.region || f.other != g.other || f.label != g.label || f.isLocked != g.isLocked)
  {
    return true;
  }
  if (this->isExact)
  {
    return !this->isFlat(edge);
  }
  return this->isSharp(edge, options.featureAngle);
}

/// Whether the two facets of the edge turn by more than the angle.
bool SurfaceDivision::isSharp(const Edge& edge, double featureAngle) const
{
  return this->isSharp(edge, this->facets[this->incidences_[edge.first]],
    this->facets[this->incidences_[edge.first + 1]], featureAngle);
}

/// Whether the outer surface turns by more than the angle at the edge, or touches itself there.
bool SurfaceDivision::isBentOutside(const Edge& edge, double angle) const
{
  std::vector<const KeptFacet*> outer;
  for (std::size_t i = edge.first; i < edge.last; ++i)
  {
    const KeptFacet& facet = this->facets[this->incidences_[i]];
    if (facet.other == None)
    {
      outer.push_back(&facet);
    }
  }
  return outer.size() > 2 ||
    (outer.size() == 2 && this->isSharp(edge, *outer[0], *outer[1], angle));
}

bool SurfaceDivision::isSharp(
  const Edge& edge, const KeptFacet& f, const KeptFacet& g, double featureAngle) const
{
  const Vec<3> n = this->normal(f), m = this->normal(g);
  const auto [a, b] = edge.nodes;
  // Facets that are seen from the same side run through their edge in opposite directions.
  const bool alike = runsForwards(f.nodes, a, b) != runsForwards(g.nodes, a, b);
  return (alike ? 1.0 : -1.0) * n.dot(m) < cosine(featureAngle) * n.norm() * m.norm();
}

/// First the edges that the geometry or a number makes curves, then kept edges of the caller. Of
/// those that leave the surface only the ends count.
void SurfaceDivision::findCurves(const SurfaceOptions& options)
{
  for (Edge& edge : this->edges_)
  {
    const auto line = std::lower_bound(options.lines.begin(), options.lines.end(), edge.nodes,
      [](const auto& entry, const std::array<Index, 2>& key) { return entry.first < key; });
    const bool isLine = line != options.lines.end() && line->first == edge.nodes;
    edge.label = isLine ? line->second : None;
    edge.isCurve = isLine || this->isCurve(edge, options);
    const bool hasAngle = edge.last - edge.first == 2;
    edge.isSharp = hasAngle && this->isSharp(edge, options.featureAngle);
    edge.isBent = this->isBentOutside(edge, options.featureAngle);
    // Only near these may new sharp edges come.
    if (!hasAngle || this->isSharp(edge, 0.5 * options.featureAngle))
    {
      this->bentEdges.push_back(edge.nodes);
    }
    if (this->isBentOutside(edge, 0.5 * options.featureAngle))
    {
      this->bentOutside.push_back(edge.nodes);
    }
  }
  this->isCorner_.assign(this->mesh_.numberOfPointSlots(), 0);
  for (Index c = 0; this->mesh_.hasKeptEdges() && c < this->mesh_.numberOfCellSlots(); ++c)
  {
    for (int e = 0; e < 6 && this->mesh_.isAlive(c); ++e)
    {
      if (this->mesh_.isEdgeKeptByItself(c, e))
      {
        const Simplex<3>& t = this->mesh_.nodes(c);
        const auto key = sortedIds(t[Local<3>::edges[e][0]], t[Local<3>::edges[e][1]]);
        const auto found = std::lower_bound(this->edges_.begin(), this->edges_.end(), key,
          [](const Edge& edge, const std::array<Index, 2>& k) { return edge.nodes < k; });
        if (found != this->edges_.end() && found->nodes == key)
        {
          found->isCurve = true;
          continue;
        }
        // A line that leaves the surface: its ends stay.
        this->isCorner_[key[0]] = this->isCorner_[key[1]] = 1;
      }
    }
  }
}

/// Collects in filled_ the facets that are connected with the seed and belong to no patch; if
/// `plane` is given, only those that lie in it. Sides that could be either are chosen alike.
void SurfaceDivision::fill(Index seed, const Plane* plane)
{
  const auto isIn = [&](const KeptFacet& facet)
  {
    return !plane ||
      std::all_of(facet.nodes.begin(), facet.nodes.end(),
        [&](Index p) {
          return std::fabs(plane->normal.dot(this->mesh_.point(p) - plane->origin)) <= this->slab();
        });
  };
  // As a queue that is never emptied: afterwards it is the list of all facets.
  this->filled_.assign(1, seed);
  this->facets[seed].patch = this->numberOfPatches;
  for (std::size_t k = 0; k < this->filled_.size(); ++k)
  {
    const KeptFacet& f = this->facets[this->filled_[k]];
    for (Index e : this->edgesOf_[this->filled_[k]])
    {
      const Edge& edge = this->edges_[e];
      for (std::size_t i = edge.first; i < edge.last && !edge.isCurve; ++i)
      {
        KeptFacet& g = this->facets[this->incidences_[i]];
        if (g.patch != None || g.isLocked || !isIn(g))
        {
          continue;
        }
        const auto [a, b] = edge.nodes;
        // Inside of a region a facet has no outer side: it takes that of its neighbour.
        if (g.region == g.other && runsForwards(f.nodes, a, b) == runsForwards(g.nodes, a, b))
        {
          std::swap(g.nodes[1], g.nodes[2]);
          g.handle = this->mesh_.adjacent(
            this->mesh_.cellOf(g.handle), this->mesh_.facetOf(g.handle));
        }
        g.patch = this->numberOfPatches;
        this->filled_.push_back(this->incidences_[i]);
      }
    }
  }
}

/// Finds the plane of these facets. False if not all of them lie in it.
bool SurfaceDivision::fits(const std::vector<Index>& numbers, Plane& plane) const
{
  Vec<3> normal = Vec<3>::Zero();
  // Relative to a point of the patch: far from the origin, products with coordinates would lose
  // digits.
  const Vec<3> base = this->mesh_.point(this->facets[numbers[0]].nodes[0]);
  double sum = 0.0, count = 0.0;
  for (Index k : numbers)
  {
    // By area: needles, whose normals are uncertain, hardly count.
    normal += this->normal(this->facets[k]);
  }
  plane.normal = normal.normalized();
  for (Index k : numbers)
  {
    for (Index p : this->facets[k].nodes)
    {
      sum += plane.normal.dot(this->mesh_.point(p) - base);
      count += 1.0;
    }
  }
  // Through the mean of all corners: what rounding there is lies on both sides.
  plane.origin = base + plane.normal * (sum / count);
  return std::all_of(numbers.begin(), numbers.end(),
    [&](Index k)
    {
      const KeptFacet& facet = this->facets[k];
      return this->normal(facet).dot(plane.normal) >= 0.0 &&
        std::all_of(facet.nodes.begin(), facet.nodes.end(),
          [&](Index p) {
            return std::fabs(plane.normal.dot(this->mesh_.point(p) - plane.origin)) <= this->slab();
          });
    });
}

/// Facets that are connected with no curve between them; if exact, divided further by planes.
void SurfaceDivision::findPatches()
{
  // The largest facets first: their planes are the most reliable.
  // A stable sort: of equal areas, the first in the order of handles.
  std::vector<Index> order(this->facets.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> areas;
  for (const KeptFacet& facet : this->facets)
  {
    areas.push_back(this->normal(facet).squaredNorm());
  }
  std::stable_sort(
    order.begin(), order.end(), [&](Index a, Index b) { return areas[a] > areas[b]; });
  const auto release = [this]
  {
    for (Index k : this->filled_)
    {
      this->facets[k].patch = None;
    }
  };
  std::size_t inVain = 0; // facets that were filled as a whole
  for (Index seed : order)
  {
    if (this->facets[seed].patch != None || this->facets[seed].isLocked)
    {
      continue;
    }
    Plane plane;
    bool isWhole = !this->isExact || inVain <= MostInVain * this->facets.size();
    if (isWhole)
    {
      this->fill(seed, nullptr);
      isWhole = !this->isExact || this->fits(this->filled_, plane);
      if (!isWhole)
      {
        release();
        inVain += this->filled_.size();
      }
    }
    if (!isWhole)
    {
      // Flat from facet to facet, but not as a whole: only what lies in the plane of the seed.
      plane = { this->mesh_.point(this->facets[seed].nodes[0]),
        this->normal(this->facets[seed]).normalized() };
      const Plane ofSeed = plane;
      this->fill(seed, &ofSeed);
      if (!this->fits(this->filled_, plane))
      {
        release();
        // Not even that: the seed alone, which lies in its own plane.
        this->filled_.assign(1, seed);
        this->facets[seed].patch = this->numberOfPatches;
        this->fits(this->filled_, plane);
      }
    }
    this->planes.push_back(plane);
    ++this->numberOfPatches;
  }
  for (Edge& edge : this->edges_)
  {
    // Where a bent part of the surface was divided by planes, patches also meet at edges that are
    // no curves yet.
    edge.isCurve = edge.isCurve ||
      this->facets[this->incidences_[edge.first]].patch !=
        this->facets[this->incidences_[edge.last - 1]].patch;
    if (edge.isCurve)
    {
      this->curveEdges.push_back(edge.nodes);
    }
  }
}
}
