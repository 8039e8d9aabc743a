// SPDX-License-Identifier: BSD-3-Clause
// The proof that the header gives, in computations: prisms over the facets of the reference,
// clipped polygons, and heights at their corners. Whatever cannot be proved is refused.
#include "Surface/ReferenceSurface.h"

#include "Surface/NearestInTriangle.h"

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
/// What facets beside a curve may use that has moved sideways: both together.
constexpr double ShareBesideCurves = 0.96;
/// How far to look for the reference, in tolerances.
constexpr double Reach = 2.0;

/// Not of unit length: twice the area.
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
    std::array<double, 8> side;
    bool isIn = true;
    for (int k = 0; k < this->size; ++k)
    {
      side[k] = a * this->x[k][0] + b * this->x[k][1] + c;
      isIn = isIn && side[k] >= 0.0;
    }
    if (isIn)
    {
      return;
    }
    Polygon kept;
    for (int k = 0; k < this->size; ++k)
    {
      // Sutherland and Hodgman: corners inside stay, and a new one comes where an edge crosses.
      // Points on the line itself count as inside, and bring no second corner.
      const int next = k + 1 < this->size ? k + 1 : 0;
      const Vec<3>&p = this->x[k], &q = this->x[next];
      const double sp = side[k], sq = side[next];
      if (sp >= 0.0)
      {
        kept.x[kept.size++] = p;
      }
      if ((sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0))
      {
        kept.x[kept.size++] = p + (q - p) * (sp / (sp - sq));
      }
    }
    this->size = kept.size;
    std::copy_n(kept.x.begin(), kept.size, this->x.begin());
  }
};

}

bool ReferenceSurface::isDivision(const std::vector<Piece>& gone, const std::vector<Piece>& come)
{
  constexpr double rounding = 1e-12; // of the longest edge; squared in areas
  const auto isPartOf = [](const SurfacePiece<3>& part, const SurfacePiece<3>& piece)
  {
    const double length = std::max({ (piece.x[1] - piece.x[0]).norm(),
      (piece.x[2] - piece.x[0]).norm(), (piece.x[2] - piece.x[1]).norm() });
    return normalOf(part).dot(normalOf(piece)) > 0.0 &&
      std::all_of(part.x.begin(), part.x.end(),
        [&](const Vec<3>& x)
        { return (nearestInTriangle(piece.x, x) - x).norm() <= rounding * length; });
  };
  double before = 0.0, after = 0.0;
  for (const SurfacePiece<3>& piece : gone)
  {
    before += normalOf(piece).norm();
  }
  for (const SurfacePiece<3>& part : come)
  {
    after += normalOf(part).norm();
    if (std::none_of(gone.begin(), gone.end(),
          [&](const SurfacePiece<3>& piece) { return isPartOf(part, piece); }))
    {
      return false;
    }
  }
  return std::fabs(after - before) <= 1e-9 * before;
}

/// q is the height over the longest edge, which is l.
bool ReferenceSurface::isNeedle(const Facet& r) const
{
  return r.q < Needle * this->tolerance_ && r.q < NeedleShape * r.l;
}

/// Clips the piece to the prism of r. Heights are linear on what is left, so its corners have the
/// extremes.
ReferenceSurface::Heights ReferenceSurface::heights(const Facet& r, const Piece& piece) const
{
  Polygon polygon;
  Heights result{ std::numeric_limits<double>::infinity(), -1.0, 1.0, 0.0 };
  for (const Vec<3>& x : piece.x)
  {
    const Vec<3> d = x - r.origin;
    polygon.x[polygon.size++] = Vec<3>(r.along.dot(d), r.across.dot(d), 0.0);
  }
  // The edges of r as lines: inside of it a u + b v + c >= 0.
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
  for (int k = 0; k < polygon.size; ++k)
  {
    polygon.x[k][2] = r.normal.dot(piece.x[k] - r.origin);
  }
  // Before it is clipped: the normal of what is left would be less certain.
  const Vec<3> n = (polygon.x[1] - polygon.x[0]).cross(polygon.x[2] - polygon.x[0]);
  const double size = n.norm();
  result.cosine = size > 0.0 ? n[2] / size : 1.0;
  result.cosine = r.isSigned ? result.cosine : std::fabs(result.cosine);
  for (const Vec<3>& s : sides)
  {
    polygon.clip(s[0], s[1], s[2]);
  }
  bool above = false, below = false;
  // Twice, as everywhere here: the factor cancels in all comparisons.
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
  // Where it passes through r the height is 0, although no corner has it.
  result.least = above && below ? 0.0 : result.least;
  return result;
}

/// All pieces at once for each facet of the reference nearby: only together they tell whether it
/// stays covered.
bool ReferenceSurface::covers(
  const std::vector<Piece>& gone, const std::vector<Piece>& come, double sideways) const
{
  Box box;
  for (const auto* pieces : { &gone, &come })
  {
    for (const Piece& piece : *pieces)
    {
      box.extend(BoxTree::around(piece.x));
    }
  }
  // Facets of the reference that are farther away have no say: see Reach.
  box = BoxTree::widened(box, Reach * this->tolerance_);
  // Of each thread: chunks ask at the same time.
  thread_local std::vector<int> near;
  thread_local std::vector<std::uint8_t> unclear;
  findNear(this->all_, box, near);
  unclear.assign(come.size(), 0);
  for (int k : near)
  {
    const Facet& r = this->facets_[k];
    // Needles are left to the facets beside them: see Needle.
    if (r.patch == gone[0].patch && !this->isNeedle(r) &&
      !this->covers(r, gone, come, sideways, unclear))
    {
      return false;
    }
  }
  for (std::size_t k = 0; k < come.size(); ++k)
  {
    if (unclear[k] && !this->isNear(come[k], near))
    {
      return false;
    }
  }
  return !this->turnsInsideOut(gone, come, near);
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
  // Facets that were turned away covered R twice: then the same border does not mean the same
  // points.
  for (std::size_t k = 0; k < gone.size() && isClear; ++k)
  {
    isClear = !r.isSigned || r.normal.dot(normalOf(gone[k])) > 0.0 ||
      this->heights(r, gone[k]).most < 0.0;
  }
  if (isClear)
  {
    return true; // those with the same border then cover the same points
  }
  // Facets that are turned away take part of what others cover: see the header.
  struct Area
  {
    double standing = 0.0, net = 0.0;
  };
  const auto covered = [&](const std::vector<Piece>& pieces, double most)
  {
    Area area;
    for (const Piece& piece : pieces)
    {
      const Heights h = this->heights(r, piece);
      const bool isTurned = h.most >= 0.0 && h.cosine < 0.0 && h.least <= Reach * r.tolerance;
      area.standing += stands(h, most) ? h.area : 0.0;
      area.net += stands(h, most) ? h.area : isTurned ? -h.area : 0.0;
    }
    return area;
  };
  const Area after = covered(come, allowed), before = covered(gone, r.tolerance);
  // Areas are doubled, and so is the strip along the border that may be missing.
  constexpr double rounding = 1e-9;
  const double strip = (rounding * r.q + 2.0 * sideways) * r.l;
  return after.standing >= before.standing - strip || after.net >= before.net - strip;
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
  // Parts to look at in all. Many halvings mean a facet that is near to no single facet of the
  // reference; to refuse it is safe.
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
    // The longest side is halved, so that parts stay well shaped and shrink in all directions.
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

/// Whether more than before is inside out, by area; of facets that are not low, too. Parts of a
/// facet may be so where the whole is not, and a mesh must find its way out of that.
bool ReferenceSurface::turnsInsideOut(const std::vector<Piece>& gone,
  const std::vector<Piece>& come, const std::vector<int>& near) const
{
  // Of all of them, and of those that are not low.
  const auto areas = [&](const std::vector<Piece>& pieces)
  {
    std::array<double, 2> sums{ 0.0, 0.0 };
    for (const Piece& piece : pieces)
    {
      const double area = this->isInsideOut(piece, near) ? normalOf(piece).norm() : 0.0;
      sums[0] += area;
      sums[1] += this->isLow(piece) ? 0.0 : area;
    }
    return sums;
  };
  const auto after = areas(come);
  if (!(after[0] > 0.0))
  {
    return false; // the usual case
  }
  constexpr double rounding = 1.0 + 1e-9;
  const auto before = areas(gone);
  return after[0] > rounding * before[0] || after[1] > rounding * before[1];
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
      // Beyond the tolerance none counts (below), and no point of a facet is nearer than its plane.
      if ((!r.isSigned || (r.normal.dot(normal) < 0.0) == looksAway) &&
        std::fabs(r.normal.dot(centre - r.origin)) <= this->tolerance_)
      {
        least = std::min(least, (nearestInTriangle(r.x, centre) - centre).squaredNorm());
      }
    }
    return least;
  };
  constexpr double same = 1.0 - 1e-9; // at a sharp edge, both sides are as near
  const double away = distance(true);
  // Farther away than the tolerance there is nothing to be mistaken for.
  return away < this->tolerance_ * this->tolerance_ && same * away <= distance(false);
}

/// Whether the facet is no higher than the tolerance.
bool ReferenceSurface::isLow(const Piece& piece) const
{
  const double longest = std::max({ (piece.x[1] - piece.x[0]).norm(),
    (piece.x[2] - piece.x[0]).norm(), (piece.x[2] - piece.x[1]).norm() });
  return normalOf(piece).norm() <= this->tolerance_ * longest;
}

bool ReferenceSurface::isTurned(const Piece& piece) const
{
  if (this->isLow(piece))
  {
    return false;
  }
  std::vector<int> near;
  findNear(this->all_, BoxTree::widened(BoxTree::around(piece.x), Reach * this->tolerance_), near);
  return this->isInsideOut(piece, near);
}

ReferenceSurface::Offset ReferenceSurface::offset(const Piece& piece) const
{
  std::vector<int> near;
  if (static_cast<std::size_t>(piece.patch) < this->patches_.size())
  {
    findNear(this->patches_[piece.patch],
      BoxTree::widened(BoxTree::around(piece.x), Reach * this->tolerance_), near);
  }
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
    // For needles as if they were not met: least > most.
    const Heights h = this->isNeedle(r) ? Heights{ 0.0, -1.0, 1.0, 0.0 } : this->heights(r, piece);
    const bool stands = h.most <= ShareBesideCurves * r.tolerance && h.cosine >= LeastCosine;
    // What is beyond the share for patches is a matter of distance, not of height: see Offset.
    double& most = h.most <= Share * r.tolerance ? offset.height : offset.distance;
    most = stands ? std::max(most, h.most) : most;
    isClear = isClear &&
      (stands || h.most < 0.0 || h.least > Reach * r.tolerance || !(h.cosine > 0.0));
  }
  // Found by doubling: at most twice too great, down to this part of what is allowed.
  constexpr double first = 1.0 / 64.0;
  double part = isClear ? 0.0 : first;
  while (part > 0.0 && part < 1.0 && !this->isNear(piece, near, part))
  {
    part *= 2.0;
  }
  // In units of the greatest tolerance: facets with less room have even less.
  offset.distance = std::max(offset.distance, part * ShareBesideCurves * this->tolerance_);
  return offset;
}
}
