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
/// An overlay of less than this part of a facet's area is none.
constexpr double Touch = 1e-10;
/// How far to look for the reference, in tolerances.
constexpr double Reach = 2.0;

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

void ReferenceSurface::add(const std::array<Vec<3>, 3>& x, Index patch, bool isSigned)
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

/// A quarter of the thickness behind the facet, or a third of the gap in front of it. Found by rays
/// from its centre and from the middles of its edges, pulled inwards.
double ReferenceSurface::room(const Facet& f, std::vector<int>& near) const
{
  constexpr double inside = 0.25, outside = 1.0 / 3.0, pull = 0.1;
  const double reach = this->tolerance_ / inside;
  const Vec<3> centre = (f.x[0] + f.x[1] + f.x[2]) / 3.0;
  std::vector<Vec<3>> starts{ centre };
  Box box;
  for (int i = 0; i < 3; ++i)
  {
    const Vec<3> middle = 0.5 * (f.x[i] + f.x[(i + 1) % 3]);
    starts.push_back(middle + pull * (centre - middle));
    box.extend(Eigen::Vector3d(f.x[i] + reach * f.normal));
    box.extend(Eigen::Vector3d(f.x[i] - reach * f.normal));
  }
  this->findNear(box, None, near);
  double room = this->tolerance_;
  for (int k : near)
  {
    const Facet& o = this->facets_[k];
    const double slope = o.normal.dot(f.normal);
    const auto isShared = [&](const Vec<3>& x)
    { return std::find(f.x.begin(), f.x.end(), x) != f.x.end(); };
    if (std::any_of(o.x.begin(), o.x.end(), isShared)) // at a sharp edge there is no room at all
    {
      continue;
    }
    for (const Vec<3>& start : starts)
    {
      const double t = slope != 0.0 ? o.normal.dot(o.origin - start) / slope : reach;
      const Vec<3> d = start + t * f.normal - o.origin;
      const double u = o.along.dot(d), v = o.across.dot(d);
      const bool isHit = v >= 0.0 && o.q * u - o.p * v >= 0.0 &&
        o.q * o.l - o.q * u + (o.p - o.l) * v >= 0.0;
      if (isHit)
      {
        room = std::min(room, t > 0.0 ? outside * t : -inside * t);
      }
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
  for (const Vec<3>& x : piece.x)
  {
    const Vec<3> d = x - r.origin;
    polygon.x[polygon.size++] = Vec<3>(r.along.dot(d), r.across.dot(d), r.normal.dot(d));
  }
  Heights result{ std::numeric_limits<double>::infinity(), -1.0, 1.0 };
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

bool ReferenceSurface::covers(const std::vector<Piece>& gone, const std::vector<Piece>& come) const
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
  thread_local std::vector<int> near;
  this->findNear(box, gone[0].patch, near);
  for (int k : near)
  {
    const Facet& r = this->facets_[k];
    if (!this->isNeedle(r) && !this->covers(r, gone, come))
    {
      return false;
    }
  }
  return true;
}

/// The same for one facet of the reference.
bool ReferenceSurface::covers(
  const Facet& r, const std::vector<Piece>& gone, const std::vector<Piece>& come) const
{
  const double allowed = Share * r.tolerance;
  bool isFar = false;
  for (const Piece& piece : come)
  {
    const Heights h = this->heights(r, piece);
    if (h.most >= 0.0 && (h.most > allowed || h.cosine < LeastCosine))
    {
      // Another sheet of the patch, such as the far side of a thin wall, looks the other way.
      if (h.least <= Reach * r.tolerance && h.cosine > 0.0)
      {
        return false;
      }
      isFar = true;
    }
  }
  // What is far does not matter, unless the facets that go stood for this one.
  bool isTurned = false;
  for (const Piece& piece : gone)
  {
    isTurned |= r.isSigned && r.normal.dot(normalOf(piece)) <= 0.0 &&
      this->heights(r, piece).most >= 0.0;
  }
  return (!isFar && !isTurned) ||
    std::none_of(gone.begin(), gone.end(),
      [&](const Piece& piece)
      {
        const Heights h = this->heights(r, piece);
        return h.least <= r.tolerance && h.cosine > 0.0;
      });
}

double ReferenceSurface::height(const Piece& piece) const
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
    return 0.0; // it has not changed
  }
  double most = 0.0;
  for (int k : near)
  {
    const Facet& r = this->facets_[k];
    if (this->isNeedle(r))
    {
      continue;
    }
    const Heights h = this->heights(r, piece);
    if (h.least <= Reach * r.tolerance && h.cosine > 0.0)
    {
      most = std::max(most, h.most);
    }
  }
  return most;
}
}
