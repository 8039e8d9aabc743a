// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/ReferenceSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshopt
{
namespace
{
/// Of 75 degrees: facets turned farther cannot stand for one another.
constexpr double LeastCosine = 0.2588;
/// Facets that are not this high, in tolerances and in their longest edge, have no normal worth the
/// name. What lies on them is this near to that edge, which other facets have, too.
constexpr double Needle = 0.1, NeedleShape = 0.05;
/// What is left of the tolerance, beside needles and the sides of curves.
constexpr double Share = 0.75;
/// What facets beside a curve may use that has moved sideways: both together.
constexpr double ShareBesideCurves = 0.96;
/// An overlay of less than this part of a facet's area is none.
constexpr double Touch = 1e-10;
/// How far to look for the reference, in tolerances.
constexpr double Reach = 2.0;
/// The part of a wall that is left to a facet. Both sides may use it: the volume of the wall
/// changes by less than a quarter.
constexpr double RoomOfWalls = 1.0 / 7.0;
/// The same for a gap, outside.
constexpr double RoomOfGaps = 0.25;

/// The point of the triangle nearest to x (Ericson, Real-time collision detection, 5.1.5).
Vec<3> nearestInTriangle(const std::array<Vec<3>, 3>& t, const Vec<3>& x)
{
  const Vec<3> ab = t[1] - t[0], ac = t[2] - t[0], ax = x - t[0];
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return t[0];
  }
  const Vec<3> bx = x - t[1];
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return t[1];
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return t[0] + ab * (d1 / (d1 - d3));
  }
  const Vec<3> cx = x - t[2];
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6)
  {
    return t[2];
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return t[0] + ac * (d2 / (d2 - d6));
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
  {
    return t[1] + (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  const double sum = va + vb + vc;
  return t[0] + ab * (vb / sum) + ac * (vc / sum);
}

Vec<3> normalOf(const SurfacePiece<3>& piece)
{
  return (piece.x[1] - piece.x[0]).cross(piece.x[2] - piece.x[0]);
}

/// A convex polygon in the frame of a facet of the reference: (u, v, height).
struct Polygon
{
  // A triangle that three lines clip has at most six corners.
  std::array<Vec<3>, 8> x;
  int size = 0;

  /// Keeps what has a u + b v + c >= 0.
  void clip(double a, double b, double c)
  {
    const auto side = [&](const Vec<3>& p) { return a * p[0] + b * p[1] + c; };
    Polygon kept;
    for (int k = 0; k < this->size; ++k)
    {
      const Vec<3>&p = this->x[k], &q = this->x[(k + 1) % this->size];
      const double sp = side(p), sq = side(q);
      if (sp >= 0.0)
      {
        kept.x[kept.size++] = p;
      }
      if ((sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0))
      {
        kept.x[kept.size++] = p + (q - p) * (sp / (sp - sq));
      }
    }
    *this = kept;
  }
};
}

void ReferenceSurface::add(
  const std::array<Vec<3>, 3>& x, Index patch, bool isSigned, bool isOuter, bool isThin)
{
  Facet f;
  // The longest edge first: the frame is then as exact as it can be.
  int first = 0;
  double longest = -1.0;
  for (int i = 0; i < 3; ++i)
  {
    const double l = (x[(i + 1) % 3] - x[i]).squaredNorm();
    first = l > longest ? i : first;
    longest = std::max(longest, l);
  }
  const Vec<3>&a = x[first], &b = x[(first + 1) % 3], &c = x[(first + 2) % 3];
  f.origin = a;
  f.l = (b - a).norm();
  f.along = f.l > 0.0 ? Vec<3>((b - a) / f.l) : Vec<3>::Zero();
  const Vec<3> n = (b - a).cross(c - a);
  f.normal = n.norm() > 0.0 ? Vec<3>(n.normalized()) : Vec<3>::Zero();
  f.across = f.normal.cross(f.along);
  f.p = f.along.dot(c - a);
  f.q = f.across.dot(c - a);
  f.patch = patch;
  f.isSigned = isSigned;
  f.isOuter = isOuter;
  f.isThin = isThin;
  f.x = x;
  this->facets_.push_back(f);
}

void ReferenceSurface::finish(double tolerance, double least)
{
  this->tolerance_ = tolerance;
  std::vector<int> ids;
  std::vector<Box> boxes;
  for (const Facet& f : this->facets_)
  {
    Box box;
    for (const Vec<3>& x : f.x)
    {
      box.extend(Eigen::Vector3d(x));
    }
    ids.push_back(static_cast<int>(ids.size()));
    boxes.push_back(box);
  }
  this->tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
  std::vector<int> near;
  for (Facet& f : this->facets_)
  {
    f.tolerance = std::max(least, std::min(tolerance, this->room(f, near)));
  }
}

/// What the next sheet of the surface leaves, behind the facet or in front of it.
double ReferenceSurface::room(const Facet& f, std::vector<int>& near) const
{
  const Vec<3> reach = f.normal * (this->tolerance_ / RoomOfWalls);
  Box box;
  for (const Vec<3>& x : f.x)
  {
    box.extend(Eigen::Vector3d(x + reach));
    box.extend(Eigen::Vector3d(x - reach));
  }
  this->findNear(box, None, near);
  double room = this->tolerance_;
  for (int k : near)
  {
    const Facet& o = this->facets_[k];
    const auto isShared = [&](const Vec<3>& x)
    { return std::find(f.x.begin(), f.x.end(), x) != f.x.end(); };
    const bool looksAway = o.normal.dot(f.normal) < 0.0 || !o.isSigned || !f.isSigned;
    // At a sharp edge there is no room at all, and none is needed.
    if (looksAway && std::none_of(o.x.begin(), o.x.end(), isShared))
    {
      const Heights h = this->heights(f, { o.x, o.patch, None });
      const bool isGap = f.isOuter && f.normal.dot(o.x[0] + o.x[1] + o.x[2] - 3.0 * f.origin) > 0.0;
      room = h.most >= 0.0 ? std::min(room, (isGap ? RoomOfGaps : RoomOfWalls) * h.least) : room;
    }
  }
  return room;
}

int ReferenceSurface::project(Index patch, const Vec<3>& x, Vec<3>& there) const
{
  struct Search
  {
    using Scalar = double;
    const ReferenceSurface& surface;
    Index patch;
    Eigen::Vector3d x;
    Vec<3> best = Vec<3>::Zero();
    double distance = std::numeric_limits<double>::infinity();
    int facet = -1;

    double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(this->x); }
    double minimumOnObject(int k)
    {
      const Facet& f = this->surface.facets_[k];
      if (f.patch != this->patch)
      {
        return std::numeric_limits<double>::infinity();
      }
      const Vec<3> y = nearestInTriangle(f.x, Vec<3>(this->x));
      const double d = (y - this->x).squaredNorm();
      // Of equals the first: the order in which the tree is searched must not matter.
      if (d < this->distance || (d == this->distance && k < this->facet))
      {
        this->distance = d;
        this->best = y;
        this->facet = k;
      }
      return d;
    }
  };
  Search search{ *this, patch, Eigen::Vector3d(x) };
  if (!this->facets_.empty())
  {
    Eigen::BVMinimize(this->tree_, search);
  }
  there = search.best;
  return search.facet;
}

std::vector<RoomLimit> ReferenceSurface::limits(const Vec<3>& x) const
{
  constexpr double faces = 0.5; // cosine of the angle between a normal and the way there
  const double reach = this->tolerance_ / RoomOfWalls;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  std::vector<int> near;
  this->findNear(Box(Eigen::Vector3d(x) - margin, Eigen::Vector3d(x) + margin), None, near);
  std::vector<RoomLimit> limits;
  for (int k : near)
  {
    const Facet& f = this->facets_[k];
    const Vec<3> way = nearestInTriangle(f.x, x) - x;
    const double length = way.norm(), along = f.normal.dot(way);
    const bool isApart = length > Touch * f.l; // the others have x
    if (isApart && std::fabs(along) > faces * length)
    {
      const bool isGap = f.isOuter && along < 0.0;
      const double share = isGap ? RoomOfGaps : RoomOfWalls;
      limits.push_back({ way, share * way.squaredNorm(), f.isThin && !isGap });
    }
  }
  return limits;
}

Vec<3> ReferenceSurface::withinRoom(const Vec<3>& x, const Vec<3>& to, double most) const
{
  const Vec<3> move = to - x;
  const double off = move.norm();
  double part = off > most ? most / off : 1.0;
  for (const RoomLimit& limit : this->limits(x))
  {
    part = std::min(part, limit.part(move));
  }
  return part < 1.0 ? Vec<3>(x + part * move) : to;
}

double ReferenceSurface::tolerance(int facet) const
{
  return Share * this->facets_[facet].tolerance;
}

void ReferenceSurface::findNear(const Box& box, Index patch, std::vector<int>& found) const
{
  struct Search
  {
    const ReferenceSurface& surface;
    const Box& box;
    Index patch;
    std::vector<int>& found;

    bool intersectVolume(const Box& other) const { return other.intersects(this->box); }
    bool intersectObject(int k)
    {
      if (this->patch == None || this->surface.facets_[k].patch == this->patch)
      {
        this->found.push_back(k);
      }
      return false; // go on
    }
  };
  found.clear();
  if (!this->facets_.empty())
  {
    Search search{ *this, box, patch, found };
    Eigen::BVIntersect(this->tree_, search);
  }
}

bool ReferenceSurface::isNeedle(const Facet& r) const
{
  return r.q < Needle * this->tolerance_ && r.q < NeedleShape * r.l;
}

ReferenceSurface::Heights ReferenceSurface::heights(const Facet& r, const Piece& piece) const
{
  Polygon polygon;
  Heights result{ std::numeric_limits<double>::infinity(), -1.0, 1.0, 0.0 };
  for (const Vec<3>& x : piece.x)
  {
    const Vec<3> d = x - r.origin;
    polygon.x[polygon.size++] = Vec<3>(r.along.dot(d), r.across.dot(d), r.normal.dot(d));
  }
  const std::array<Vec<3>, 3> sides{ Vec<3>(0.0, 1.0, 0.0), Vec<3>(r.q, -r.p, 0.0),
    Vec<3>(-r.q, r.p - r.l, r.q * r.l) };
  for (const Vec<3>& s : sides) // most are out of the prism: this is cheaper than to clip them
  {
    const auto isOut = [&](const Vec<3>& p) { return s[0] * p[0] + s[1] * p[1] + s[2] <= 0.0; };
    if (isOut(polygon.x[0]) && isOut(polygon.x[1]) && isOut(polygon.x[2]))
    {
      return result;
    }
  }
  const Vec<3> n = (polygon.x[1] - polygon.x[0]).cross(polygon.x[2] - polygon.x[0]);
  const double size = n.norm();
  result.cosine = size > 0.0 ? n[2] / size : 1.0;
  result.cosine = r.isSigned ? result.cosine : std::fabs(result.cosine);
  for (const Vec<3>& s : sides)
  {
    polygon.clip(s[0], s[1], s[2]);
  }
  bool above = false, below = false;
  double area = 0.0;
  for (int k = 0; k < polygon.size; ++k)
  {
    const Vec<3>&a = polygon.x[k], &b = polygon.x[(k + 1) % polygon.size];
    area += a[0] * b[1] - a[1] * b[0];
  }
  // Neighbours that only touch have their heights in common with those that lie between them.
  polygon.size = std::fabs(area) > Touch * r.l * r.q ? polygon.size : 0;
  result.area = std::fabs(area);
  for (int k = 0; k < polygon.size; ++k)
  {
    const double h = polygon.x[k][2];
    above |= h >= 0.0;
    below |= h <= 0.0;
    result.least = std::min(result.least, std::fabs(h));
    result.most = std::max(result.most, std::fabs(h));
  }
  result.least = above && below ? 0.0 : result.least;
  return result;
}

bool ReferenceSurface::covers(
  const std::vector<Piece>& gone, const std::vector<Piece>& come, double sideways) const
{
  Box box;
  for (const auto* pieces : { &gone, &come })
  {
    for (const Piece& piece : *pieces)
    {
      for (const Vec<3>& x : piece.x)
      {
        box.extend(Eigen::Vector3d(x));
      }
    }
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(Reach * this->tolerance_);
  box = Box(box.min() - margin, box.max() + margin);
  // Of each thread: chunks ask at the same time.
  thread_local std::vector<int> near;
  thread_local std::vector<std::uint8_t> unclear;
  this->findNear(box, None, near);
  unclear.assign(come.size(), 0);
  for (int k : near)
  {
    const Facet& r = this->facets_[k];
    if (r.patch == gone[0].patch && !this->isNeedle(r) &&
      !this->covers(r, gone, come, sideways, unclear))
    {
      return false;
    }
  }
  for (std::size_t k = 0; k < come.size(); ++k)
  {
    if ((unclear[k] && !this->isNear(come[k], near)) || this->isInsideOut(come[k], near))
    {
      return false;
    }
  }
  return true;
}

/// The same for one facet of the reference. Notes in `unclear` which of `come` are turned away from
/// it, or too high, so that other facets of the reference must say that they are near.
bool ReferenceSurface::covers(const Facet& r, const std::vector<Piece>& gone,
  const std::vector<Piece>& come, double sideways, std::vector<std::uint8_t>& unclear) const
{
  double allowed = Share * r.tolerance;
  const auto stands = [](const Heights& h, double most)
  { return h.most >= 0.0 && h.most <= most && h.cosine >= LeastCosine; };
  bool isClear = true, isRaised = false;
  for (std::size_t k = 0; k < come.size(); ++k)
  {
    if (this->isFlatOn(r, come[k], allowed))
    {
      continue;
    }
    const Heights h = this->heights(r, come[k]);
    if (!isRaised && stands(h, ShareBesideCurves * r.tolerance) && !stands(h, allowed))
    {
      // Beside a curve that has moved, what was there may have been higher: it may stay so.
      isRaised = true;
      for (const Piece& piece : gone)
      {
        const Heights old = this->heights(r, piece);
        allowed = stands(old, ShareBesideCurves * r.tolerance) ? std::max(allowed, old.most)
                                                               : allowed;
      }
    }
    if (h.most >= 0.0 && !stands(h, allowed))
    {
      isClear = false;
      // Another sheet of the patch, such as the far side of a thin wall, looks the other way.
      unclear[k] |= h.least <= Reach * r.tolerance && h.cosine > 0.0;
    }
  }
  for (std::size_t k = 0; k < gone.size() && isClear; ++k)
  {
    isClear = !r.isSigned || r.normal.dot(normalOf(gone[k])) > 0.0 ||
      this->heights(r, gone[k]).most < 0.0;
  }
  if (isClear)
  {
    return true; // those with the same border then cover the same points
  }
  double after = 0.0, before = 0.0;
  for (const Piece& piece : come)
  {
    const Heights h = this->heights(r, piece);
    after += stands(h, allowed) ? h.area : 0.0;
  }
  for (const Piece& piece : gone)
  {
    const Heights h = this->heights(r, piece);
    before += stands(h, r.tolerance) ? h.area : 0.0;
  }
  constexpr double rounding = 1e-9;
  return after >= before - (rounding * r.q + 2.0 * sideways) * r.l;
}

/// Whether the facet would stand for all of a reference facet of any size: the usual case, and
/// cheap to find out.
bool ReferenceSurface::isFlatOn(const Facet& r, const Piece& piece, double allowed) const
{
  const Vec<3> n = normalOf(piece);
  const double slope = r.normal.dot(n);
  return std::all_of(piece.x.begin(), piece.x.end(),
           [&](const Vec<3>& x) { return std::fabs(r.normal.dot(x - r.origin)) <= allowed; }) &&
    (slope > 0.0 || !r.isSigned) && slope * slope >= LeastCosine * LeastCosine * n.squaredNorm();
}

/// Whether all of a facet is within a part of the tolerance of the reference, on its side. The
/// distance from one facet of the reference is convex: where it is kept at three corners, it is
/// kept between them. What has no such facet is halved.
bool ReferenceSurface::isNear(const Piece& piece, const std::vector<int>& near, double part) const
{
  constexpr int most = 64;
  const Vec<3> normal = normalOf(piece);
  std::vector<std::array<Vec<3>, 3>> open{ piece.x };
  for (int n = 0; !open.empty(); ++n)
  {
    const std::array<Vec<3>, 3> t = open.back();
    open.pop_back();
    const auto isNearTo = [&](int k)
    {
      const Facet& r = this->facets_[k];
      const double allowed = part * ShareBesideCurves * r.tolerance;
      return r.patch == piece.patch && (!r.isSigned || r.normal.dot(normal) > 0.0) &&
        std::all_of(t.begin(), t.end(),
          [&](const Vec<3>& x)
          { return (nearestInTriangle(r.x, x) - x).squaredNorm() <= allowed * allowed; });
    };
    if (std::any_of(near.begin(), near.end(), isNearTo))
    {
      continue;
    }
    if (n >= most)
    {
      return false;
    }
    int longest = 0;
    const auto length = [&](int i) { return (t[(i + 1) % 3] - t[i]).squaredNorm(); };
    longest = length(1) > length(longest) ? 1 : longest;
    longest = length(2) > length(longest) ? 2 : longest;
    const Vec<3>&a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
    const Vec<3> middle = 0.5 * (a + b);
    open.push_back({ a, middle, c });
    open.push_back({ middle, b, c });
  }
  return true;
}

/// Whether the reference nearest to the centre of a facet looks the other way, as beyond the tip of
/// a sharp edge.
bool ReferenceSurface::isInsideOut(const Piece& piece, const std::vector<int>& near) const
{
  const Vec<3> normal = normalOf(piece), centre = (piece.x[0] + piece.x[1] + piece.x[2]) / 3.0;
  const auto distance = [&](bool looksAway)
  {
    double least = std::numeric_limits<double>::infinity();
    for (int k : near)
    {
      const Facet& r = this->facets_[k];
      if (!r.isSigned || (r.normal.dot(normal) < 0.0) == looksAway)
      {
        least = std::min(least, (nearestInTriangle(r.x, centre) - centre).squaredNorm());
      }
    }
    return least;
  };
  constexpr double same = 1.0 - 1e-9; // at a sharp edge, both sides are as near
  const double away = distance(true);
  return away < this->tolerance_ * this->tolerance_ && same * away <= distance(false);
}

ReferenceSurface::Offset ReferenceSurface::offset(const Piece& piece) const
{
  Box box;
  for (const Vec<3>& x : piece.x)
  {
    box.extend(Eigen::Vector3d(x));
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(Reach * this->tolerance_);
  box = Box(box.min() - margin, box.max() + margin);
  std::vector<int> near;
  this->findNear(box, piece.patch, near);
  const auto isSame = [&](int k)
  {
    return std::is_permutation(
      piece.x.begin(), piece.x.end(), this->facets_[k].x.begin(), this->facets_[k].x.end());
  };
  if (std::any_of(near.begin(), near.end(), isSame))
  {
    return {}; // it has not changed
  }
  Offset offset;
  bool isClear = true;
  for (int k : near)
  {
    const Facet& r = this->facets_[k];
    const Heights h = this->isNeedle(r) ? Heights{ 0.0, -1.0, 1.0, 0.0 } : this->heights(r, piece);
    const bool stands = h.most <= ShareBesideCurves * r.tolerance && h.cosine >= LeastCosine;
    double& most = h.most <= Share * r.tolerance ? offset.height : offset.distance;
    most = stands ? std::max(most, h.most) : most;
    isClear = isClear &&
      (stands || h.most < 0.0 || h.least > Reach * r.tolerance || !(h.cosine > 0.0));
  }
  constexpr double first = 1.0 / 64.0;
  double part = isClear ? 0.0 : first;
  while (part > 0.0 && part < 1.0 && !this->isNear(piece, near, part))
  {
    part *= 2.0;
  }
  offset.distance = std::max(offset.distance, part * ShareBesideCurves * this->tolerance_);
  return offset;
}
}
