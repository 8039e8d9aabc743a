// SPDX-License-Identifier: BSD-3-Clause
// The search by the best direction first, and the division of cones along the outline of a facet.
#include "Bound/SightBound.h"

#include "Bound/ApexBound.h"
#include "Mesh/SimplexGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace meshopt
{
namespace
{
/// Most sides that are looked at: those with the worst cells.
constexpr std::size_t MostSides = 1000;
/// Of stepsInSight(). A step takes some 20 us: the most make less than half a second.
constexpr long FewestSightSteps = 500, UsualSightSteps = 2000, MostSightSteps = 20000;
/// How many cells bring one step more: in a small mesh, and where the usual steps are used up.
constexpr long CellsPerFirstStep = 2, CellsPerStep = 20;

/// From where a facet is looked at: the weights of its corners. From the middle most is seen; what
/// lies near its ends is in the way of places near these only.
const Vec<3> Places[] = { { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 }, { 0.8, 0.1, 0.1 }, { 0.1, 0.8, 0.1 },
  { 0.1, 0.1, 0.8 } };

/// A facet is in the way of a place if the segment meets it before this part of its length. At its
/// end the fourth node may lie on a facet; at its beginning the segment is on its own one.
constexpr double NearEnd = 1.0 - 1e-6, NearBeginning = 1e-9;
/// What is narrower than this, as a part of its length or seen as an angle, is left over by
/// rounding between two facets with a common edge: nothing is to be seen there.
constexpr double Narrow = 1e-12;
/// A direction that is as near to a plane, relative to its length, is in it.
constexpr double InPlane = 1e-13;
/// The same for a place and the plane of a facet, which is then seen from its edge, and hides
/// nothing: the other side of the facet itself, a lip of a crack that lies on it, what goes on in
/// its plane.
constexpr double EdgeOn = 1e-10;
/// The greatest distance to a corner of the first cones, by that to their ends' plane: they form a
/// pyramid on the plane of the facet with the apex above, whose sides are at 1 / sqrt(5).
constexpr double Widens = 2.3;

constexpr double Unlimited = std::numeric_limits<double>::infinity();

using Polygon = std::vector<Vec<3>>;

/// Cuts a polygon by the plane through the tip with the normal n.
void cut(const Polygon& polygon, const Vec<3>& n, Polygon& inside, Polygon& outside)
{
  inside.clear();
  outside.clear();
  const auto side = [&](const Vec<3>& x)
  {
    const double s = n.dot(x);
    return std::fabs(s) < InPlane * x.norm() ? 0.0 : s;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec<3>&x = polygon[i], &y = polygon[(i + 1) % polygon.size()];
    const double a = side(x), b = side(y);
    if (a >= 0.0)
    {
      inside.push_back(x);
    }
    if (a <= 0.0)
    {
      outside.push_back(x);
    }
    if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))
    {
      inside.push_back(x + a / (a - b) * (y - x));
      outside.push_back(inside.back());
    }
  }
}

/// Whether a cone is wide enough to see anything through it.
bool isWide(const Cone& cone)
{
  const Vec<3> x = cone[0].normalized(), u = cone[1].normalized() - x, v = cone[2].normalized() - x;
  const double longest = std::max({ u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm() });
  return longest > Narrow * Narrow && u.cross(v).norm() > Narrow * longest;
}
}

/// Some directions, as far as is known to be in sight.
struct Sight::Part
{
  Cone cone;
  ApexInCone::Best best;
  bool operator<(const Part& other) const { return this->best.bound < other.best.bound; }
};

/// The search from one place.
class Sight::Search
{
public:
  Search(
    const Sight& sight, std::size_t side, const ApexInCone& apex, double atLeast, double enough)
    : sight_(sight)
    , side_(side)
    , apex_(apex)
    , atLeast_(atLeast)
    , enough_(enough)
  {
  }

  /// At any time no apex in sight is better than the best of the parts.
  double run(long& steps)
  {
    this->lookEverywhere();
    while (!this->parts_.empty())
    {
      const Part part = this->parts_.top();
      // Also if the best place is seen: then the bound is certain, and cannot get lower.
      const std::size_t facet = this->sight_.firstInTheWay(
        this->side_, this->apex_.from(), this->apex_.unit() * part.best.place);
      if (facet == this->sight_.sides_.size() || steps <= 0)
      {
        return part.best.bound; // seen, and the best of all; or no step is left
      }
      --steps;
      this->parts_.pop();
      if (!this->divide(part, this->sight_.corners(facet)))
      {
        return part.best.bound; // the facet is only touched: rounding
      }
    }
    return this->atLeast_;
  }

private:
  void lookEverywhere();
  bool divide(const Part& part, const std::array<Vec<3>, 3>& corners);

  /// Adds the triangles of a convex polygon; those that cannot be better than what is known are
  /// left out.
  void add(const Polygon& polygon)
  {
    for (std::size_t i = 2; i < polygon.size(); ++i)
    {
      const Cone cone{ polygon[0], polygon[i - 1], polygon[i] };
      if (!isWide(cone))
      {
        continue;
      }
      const ApexInCone::Best best = this->apex_.best(cone, this->atLeast_, this->enough_);
      if (best.bound > this->atLeast_)
      {
        this->parts_.push({ cone, best });
      }
    }
  }

  const Sight& sight_;
  std::size_t side_;
  const ApexInCone& apex_;
  double atLeast_, enough_;
  std::priority_queue<Part> parts_;
};

/// A pyramid on the plane of the facet. Beyond it nothing is good enough.
void Sight::Search::lookEverywhere()
{
  const double far = Widens * this->apex_.reach(this->atLeast_);
  const Vec<3>& n = this->apex_.normal();
  const Vec<3> x = n.unitOrthogonal(), y = n.cross(x);
  for (int k = 0; k < 3; ++k)
  {
    const auto end = [&](int i) -> Vec<3>
    {
      const double angle = 2.0 * Pi / 3.0 * i;
      return far * (std::cos(angle) * x + std::sin(angle) * y);
    };
    this->add({ end(k), end(k + 1), far * n });
  }
}

/// False if the facet has nothing in common with the part.
bool Sight::Search::divide(const Part& part, const std::array<Vec<3>, 3>& corners)
{
  std::array<Vec<3>, 3> seen;
  for (int i = 0; i < 3; ++i)
  {
    seen[i] = (corners[i] - this->apex_.from()) / this->apex_.unit();
  }
  if (seen[0].dot(seen[1].cross(seen[2])) < 0.0)
  {
    std::swap(seen[1], seen[2]);
  }
  Polygon behind(part.cone.begin(), part.cone.end()), inside, outside;
  std::vector<Polygon> beside;
  for (int i = 0; i < 3; ++i)
  {
    cut(behind, seen[i].cross(seen[(i + 1) % 3]).normalized(), inside, outside);
    beside.push_back(outside);
    behind = inside;
  }
  if (behind.size() < 3)
  {
    return false;
  }
  for (const Polygon& polygon : beside)
  {
    this->add(polygon);
  }
  // What is behind the facet is cut off. If rounding does not show where, it stays.
  const Vec<3> n = (seen[1] - seen[0]).cross(seen[2] - seen[0]);
  const double off = n.dot(seen[0]);
  Polygon before;
  for (const Vec<3>& x : behind)
  {
    const double t = off / n.dot(x);
    before.push_back(t > 0.0 && std::isfinite(t) ? Vec<3>(t * x) : x);
  }
  this->add(before);
  return true;
}

Sight::Sight(const Vec<3>* points, const std::vector<KeptSide<3>>& sides)
  : points_(points)
  , sides_(sides)
{
  // Sides with a common node are of one body: a forest over the nodes, its roots the lowest.
  Index most = 0;
  for (const KeptSide<3>& side : sides)
  {
    most = std::max({ most, side.nodes[0], side.nodes[1], side.nodes[2] });
  }
  std::vector<Index> up(most + 1);
  std::iota(up.begin(), up.end(), 0);
  const auto root = [&](Index p)
  {
    for (; up[p] != p; p = up[p])
    {
      up[p] = up[up[p]];
    }
    return p;
  };
  std::vector<BoxTree::Item> items;
  for (std::size_t s = 0; s < sides.size(); ++s)
  {
    const Index a = root(sides[s].nodes[0]);
    for (const Index p : sides[s].nodes)
    {
      const Index b = root(p), low = std::min(root(a), b);
      up[root(a)] = low;
      up[b] = low;
    }
    const auto corners = this->corners(s);
    if (corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite())
    {
      items.push_back({ static_cast<int>(s), BoxTree::around(corners) });
    }
  }
  this->bodies_.resize(sides.size());
  std::transform(sides.begin(), sides.end(), this->bodies_.begin(),
    [&](const KeptSide<3>& side) { return root(side.nodes[0]); });
  this->tree_.build(items);
}

std::array<Vec<3>, 3> Sight::corners(std::size_t side) const
{
  const Facet<3>& f = this->sides_[side].nodes;
  return { this->points_[f[0]], this->points_[f[1]], this->points_[f[2]] };
}

std::size_t Sight::firstInTheWay(std::size_t side, const Vec<3>& from, const Vec<3>& way) const
{
  std::size_t first = this->sides_.size();
  double end = NearEnd;
  const auto meets = [&](int s)
  {
    if (static_cast<std::size_t>(s) == side || this->bodies_[s] != this->bodies_[side])
    {
      return;
    }
    const auto x = this->corners(s);
    const Vec<3> a = x[0] - from, b = x[1] - from, c = x[2] - from;
    // The signs of the volumes with each edge: all the same if the line passes through.
    const double ab = way.dot(a.cross(b)), bc = way.dot(b.cross(c)), ca = way.dot(c.cross(a));
    if ((ab < 0.0 || bc < 0.0 || ca < 0.0) && (ab > 0.0 || bc > 0.0 || ca > 0.0))
    {
      return;
    }
    const Vec<3> n = (b - a).cross(c - a);
    if (std::fabs(n.dot(a)) <= EdgeOn * n.norm() * a.norm())
    {
      return;
    }
    const double t = n.dot(a) / n.dot(way); // not a number if the line is in the plane
    // Of several at the same place the first: the order in the tree must not matter.
    if (t > NearBeginning && (t < end || (t == end && static_cast<std::size_t>(s) < first)))
    {
      end = t;
      first = static_cast<std::size_t>(s);
    }
  };
  this->tree_.findAlong(from, way, end, meets);
  return first;
}

double Sight::guess(std::size_t side) const
{
  const std::array<Vec<3>, 3> x = this->corners(side);
  const ApexInCone apex(x, Places[0]);
  if (!apex.isUsable())
  {
    return Unlimited;
  }
  Vec<3> best;
  facetCap(x[0], x[1], x[2], Unlimited, &best);
  const Vec<3> way = best - apex.from();
  const std::size_t facet = this->firstInTheWay(side, apex.from(), way);
  if (facet == this->sides_.size())
  {
    return Unlimited;
  }
  const std::array<Vec<3>, 3> y = this->corners(facet);
  const Vec<3> n = (y[1] - y[0]).cross(y[2] - y[0]);
  const double part = n.dot(y[0] - apex.from()) / n.dot(way);
  return apex.shape(part / apex.unit() * way);
}

double Sight::cap(std::size_t side, double atLeast, double enough, long& steps) const
{
  double cap = enough;
  const std::array<Vec<3>, 3> x = this->corners(side);
  for (const Vec<3>& weights : Places)
  {
    const ApexInCone apex(x, weights);
    if (!apex.isUsable())
    {
      return enough;
    }
    // Most facets see the best place of all. That is quickly known.
    Vec<3> best;
    if (&weights == Places && facetCap(x[0], x[1], x[2], Unlimited, &best) >= enough &&
      this->firstInTheWay(side, apex.from(), best - apex.from()) == this->sides_.size())
    {
      return enough;
    }
    cap = std::min(cap, Search(*this, side, apex, atLeast, cap).run(steps));
    // Near the ends only what is known to be low already is looked at again.
    if (cap >= enough)
    {
      break;
    }
  }
  return std::max(cap, atLeast);
}

double boundInSight(
  const Vec<3>* points, const std::vector<KeptSide<3>>& sides, double bound, long steps)
{
  std::vector<std::size_t> worst;
  for (std::size_t s = 0; s < sides.size(); ++s)
  {
    if (sides[s].oriented && sides[s].quality > 0.0 && sides[s].quality < CapReached * bound)
    {
      worst.push_back(s);
    }
  }
  if (worst.empty())
  {
    return bound;
  }
  const std::size_t number = std::min(worst.size(), MostSides);
  std::partial_sort(worst.begin(), worst.begin() + number, worst.end(),
    [&](std::size_t a, std::size_t b)
    { return sides[a].quality != sides[b].quality ? sides[a].quality < sides[b].quality : a < b; });
  const Sight sight(points, sides);
  // The one that seems to see the least comes first: when the steps are used up, the caps of others
  // would hardly have been lower. That its cell is bad says little, since it may be stuck.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < number; ++k)
  {
    const double guess = sight.guess(worst[k]);
    if (guess < bound)
    {
      order.emplace_back(guess, k);
    }
  }
  std::sort(order.begin(), order.end());
  for (const auto& [guess, k] : order)
  {
    const double reached = sides[worst[k]].quality;
    if (steps <= 0 || guess >= bound)
    {
      break;
    }
    // A cap is at least what is reached there.
    if (reached < CapReached * bound)
    {
      bound = sight.cap(worst[k], reached, bound, steps);
    }
  }
  return bound;
}

long stepsInSight(long cells)
{
  return std::min({ std::max(FewestSightSteps, cells / CellsPerFirstStep),
    UsualSightSteps + cells / CellsPerStep, MostSightSteps });
}
}
