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
/// Where it is sought: at first as far away as the facet is long, or this part of the whole way;
/// then farther away each time, since with a large tolerance most of the surface is in reach.
constexpr double LeastReach = 1e-3, WiderReach = 4.0;
static_assert(RoomOfWalls <= RoomOfGaps); // room() relies on it
/// The limits of a point are sought for this part of its motion at first, then for twice as much
/// each time; no farther once there are more than MostLimits. With a tolerance of many facets'
/// length a point has thousands, each of which would be compared with all others.
constexpr double LeastMotion = 1.0 / 64.0;
constexpr std::size_t MostLimits = 128;
}

void ReferenceSurface::add(
  const std::array<Vec<3>, 3>& x, Index patch, bool isSigned, bool isOuter, double thickness)
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
  f.thickness = thickness;
  f.x = x;
  this->facets_.push_back(f);
}

void ReferenceSurface::finish(double tolerance, double least)
{
  this->tolerance_ = tolerance;
  Box box;
  std::vector<BoxTree::Item> all;
  std::vector<std::vector<BoxTree::Item>> ofPatch;
  for (const Facet& f : this->facets_)
  {
    const auto patch = static_cast<std::size_t>(f.patch);
    ofPatch.resize(std::max(ofPatch.size(), patch + 1));
    all.push_back({ static_cast<int>(all.size()), BoxTree::around(f.x) });
    box.extend(all.back().box);
    ofPatch[patch].push_back(all.back());
  }
  this->diameter_ = all.empty() ? 0.0 : box.diagonal().norm();
  this->all_.build(all);
  this->patches_.resize(ofPatch.size());
  for (std::size_t k = 0; k < ofPatch.size(); ++k)
  {
    this->patches_[k].build(ofPatch[k]);
  }
  // The trees come first: room() searches one.
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
  const double most = std::min(this->tolerance_ / RoomOfWalls, this->diameter_);
  double reach = std::min(most, std::max(f.l, LeastReach * most));
  double room = this->roomWithin(reach, f, near);
  // What lies beyond the reach leaves at least this much room.
  while (room > RoomOfWalls * reach && reach < most)
  {
    reach = std::min(most, WiderReach * reach);
    room = this->roomWithin(reach, f, near);
  }
  return room;
}

double ReferenceSurface::roomWithin(double distance, const Facet& f, std::vector<int>& near) const
{
  const Vec<3> reach = f.normal * distance;
  Box box;
  for (const Vec<3>& x : f.x)
  {
    box.extend(Eigen::Vector3d(x + reach));
    box.extend(Eigen::Vector3d(x - reach));
  }
  findNear(this->all_, box, near);
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

int ReferenceSurface::project(Index patch, const Vec<3>& x, Vec<3>& there) const
{
  Vec<3> nearest = Vec<3>::Zero(); // x and `there` may be the same
  int facet = -1;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](int k)
  {
    const Vec<3> y = nearestInTriangle(this->facets_[k].x, x);
    const double d = (y - x).squaredNorm();
    // Of equals the first: the order in which the tree is searched must not matter.
    if (d < least || (d == least && k < facet))
    {
      least = d;
      nearest = y;
      facet = k;
    }
    return d;
  };
  if (static_cast<std::size_t>(patch) < this->patches_.size())
  {
    this->patches_[patch].findNearest(x, look);
  }
  there = nearest;
  return facet;
}

/// Only facets that face x are in its way, not those beside it.
std::vector<RoomLimit> ReferenceSurface::limits(const Vec<3>& x, double most) const
{
  constexpr double faces = 0.5; // cosine of the angle between a normal and the way there
  // What is farther away leaves room for the whole motion.
  const double reach = most / RoomOfWalls;
  std::vector<int> near, thin;
  findNear(this->all_, BoxTree::widened(Box(Eigen::Vector3d(x)), reach), near);
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
      if (share * length < most)
      {
        limits.push_back({ way, share * way.squaredNorm(), f.isThin() && !isGap });
      }
    }
    if (!isApart && f.isThin())
    {
      thin.push_back(k);
    }
  }
  // A feather edge: the nearer to it, the closer is the other sheet, and at it there is none.
  for (int k : thin)
  {
    const Vec<3> way = this->facets_[k].thickness * this->facets_[k].normal;
    const auto isOther = [&](int o)
    {
      const Vec<3> out = this->facets_[o].thickness * this->facets_[o].normal;
      return way.dot(out) < -faces * way.norm() * out.norm();
    };
    if (std::any_of(thin.begin(), thin.end(), isOther))
    {
      limits.push_back({ way, RoomOfWalls * way.squaredNorm(), true });
    }
  }
  return limits;
}

std::vector<RoomLimit> ReferenceSurface::fewLimits(const Vec<3>& x, double most) const
{
  const double least = LeastMotion * most;
  // 0 of the smallest numbers: twice that would still be 0.
  for (double motion = least > 0.0 ? least : most;; motion = std::min(most, 2.0 * motion))
  {
    std::vector<RoomLimit> limits = this->limits(x, motion);
    keepBinding(motion, limits);
    if (motion == most)
    {
      return limits;
    }
    if (limits.size() > MostLimits)
    {
      // A cube of such motions: all are shorter than `motion`, for which the others do not matter.
      for (int i = 0; i < 3; ++i)
      {
        limits.push_back({ Vec<3>::Unit(i), motion / std::sqrt(3.0), true });
      }
      return limits;
    }
  }
}

Vec<3> ReferenceSurface::withinRoom(const Vec<3>& x, const Vec<3>& to, double most) const
{
  const Vec<3> move = to - x;
  const double off = move.norm();
  // One factor for the whole way: the point stays on the straight line.
  double part = off > most ? most / off : 1.0;
  // What is too far for this motion is not looked at.
  for (const RoomLimit& limit : this->limits(x, std::min(off, most)))
  {
    part = std::min(part, limit.part(move));
  }
  return part < 1.0 ? Vec<3>(x + part * move) : to;
}

double ReferenceSurface::tolerance(int facet) const
{
  return Share * this->facets_[facet].tolerance;
}

/// All facets whose boxes touch the box.
void ReferenceSurface::findNear(const BoxTree& tree, const Box& box, std::vector<int>& found)
{
  found.clear();
  tree.findTouching(box, [&](int k) { found.push_back(k); });
}
}
