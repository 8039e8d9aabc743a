// SPDX-License-Identifier: BSD-3-Clause
// What the reference is, and where: facets with their frames, a tree over them, the nearest point,
// and the room that other sheets leave. Whether a change stays near it: ReferenceSurfaceProof.cpp.
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
/// The part of a wall that is left to a facet. Both sides may use it: the volume of the wall
/// changes by less than a quarter.
constexpr double RoomOfWalls = 1.0 / 7.0;
/// The same for a gap, outside.
constexpr double RoomOfGaps = 0.25;
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
  // Zero vectors where there is no direction. A facet without area has the height q = 0: a needle,
  // which proves nothing and is asked nothing.
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
  // Facets are known by their numbers: the tree holds these, in an order of its own.
  this->tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
  // The tree comes first: room() searches it.
  std::vector<int> near;
  for (Facet& f : this->facets_)
  {
    f.tolerance = std::max(least, std::min(tolerance, this->room(f, near)));
  }
}

/// What the next sheet of the surface leaves, behind the facet or in front of it.
double ReferenceSurface::room(const Facet& f, std::vector<int>& near) const
{
  // A sheet farther away than this leaves room for the whole tolerance.
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
    // A sheet that looks the same way is another part of this side, not the far side of a wall.
    const bool looksAway = o.normal.dot(f.normal) < 0.0 || !o.isSigned || !f.isSigned;
    // At a sharp edge there is no room at all, and none is needed.
    if (looksAway && std::none_of(o.x.begin(), o.x.end(), isShared))
    {
      const Heights h = this->heights(f, { o.x, o.patch, None });
      const bool isGap = f.isOuter && f.normal.dot(o.x[0] + o.x[1] + o.x[2] - 3.0 * f.origin) > 0.0;
      // Of the whole sheet only what lies over this facet counts, at its least height.
      room = h.most >= 0.0 ? std::min(room, (isGap ? RoomOfGaps : RoomOfWalls) * h.least) : room;
    }
  }
  return room;
}

/// Branch and bound over the boxes of the tree.
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
        // Facets of other patches are in the same tree: they never are the nearest.
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

/// Only facets that face x are in its way, not those beside it.
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
  // One factor for the whole way: the point stays on the straight line.
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

/// All facets whose boxes touch the box; the order is that of the tree, which depends on the
/// surface only.
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
}
