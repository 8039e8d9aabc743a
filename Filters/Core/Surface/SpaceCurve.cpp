// SPDX-License-Identifier: BSD-3-Clause
// A polyline in space with its length as parameter. Parameters of closed curves may be any number
// of turns away: neighbours then have parameters near each other.
#include "Surface/SpaceCurve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshopt
{
namespace
{
constexpr double LengthRounding = 1e-12; ///< of a length
}

/// A closed curve has its first point again at the end: then each line has a knot at both ends.
SpaceCurve::SpaceCurve(std::vector<Vec<3>> points, bool isClosed)
  : points_(std::move(points))
  , isClosed_(isClosed)
{
  if (isClosed)
  {
    this->points_.push_back(Vec<3>(this->points_.front()));
  }
  this->knots_.assign(1, 0.0);
  for (std::size_t k = 1; k < this->points_.size(); ++k)
  {
    this->knots_.push_back(this->knots_.back() + (this->points_[k] - this->points_[k - 1]).norm());
  }
}

double SpaceCurve::inRange(double s) const
{
  if (!this->isClosed_)
  {
    return std::clamp(s, 0.0, this->length());
  }
  // The remainder has the sign of s.
  const double rest = std::fmod(s, this->length());
  return rest < 0.0 ? rest + this->length() : rest;
}

std::size_t SpaceCurve::segmentAt(double s) const
{
  // Without the first and the last knot: both ends of the curve lie in a segment, too.
  const auto next = std::upper_bound(this->knots_.begin() + 1, this->knots_.end() - 1, s);
  return static_cast<std::size_t>(next - this->knots_.begin()) - 1;
}

Vec<3> SpaceCurve::at(double s) const
{
  const double r = this->inRange(s);
  const std::size_t k = this->segmentAt(r);
  const double l = this->knots_[k + 1] - this->knots_[k];
  const double t = l > 0.0 ? (r - this->knots_[k]) / l : 0.0;
  // In this form a coordinate that both ends have in common stays as it is, to the last bit.
  return this->points_[k] + t * (this->points_[k + 1] - this->points_[k]);
}

Vec<3> SpaceCurve::direction(double s) const
{
  const std::size_t k = this->segmentAt(this->inRange(s));
  return (this->points_[k + 1] - this->points_[k]).normalized();
}

/// Walks both ways as long as the distance falls. A branch of the curve that comes near elsewhere
/// is not taken.
double SpaceCurve::closest(const Vec<3>& x, double s) const
{
  const std::size_t n = this->points_.size() - 1;
  const double r = this->inRange(s);
  const auto along = [&](std::size_t k, double& distance)
  {
    const Vec<3> d = this->points_[k + 1] - this->points_[k];
    const double l2 = d.squaredNorm();
    const double t = l2 > 0.0 ? std::clamp((x - this->points_[k]).dot(d) / l2, 0.0, 1.0) : 0.0;
    distance = (this->points_[k] + t * d - x).norm();
    return this->knots_[k] + t * (this->knots_[k + 1] - this->knots_[k]);
  };
  const std::size_t start = this->segmentAt(r);
  double best = 0.0;
  double nearest = along(start, best) - r;
  // A step past the end of a closed curve goes on at its other end, a turn later.
  for (int step : { 1, -1 }) // from segment to segment, forwards, then backwards
  {
    double turns = 0.0, least = best;
    for (std::size_t k = start, done = 1; done < n; ++done)
    {
      const bool wraps = step > 0 ? k + 1 == n : k == 0;
      if (wraps && !this->isClosed_)
      {
        break;
      }
      turns += wraps ? step * this->length() : 0.0;
      k = wraps ? (step > 0 ? 0 : n - 1) : k + step;
      double distance = 0.0;
      const double there = along(k, distance) + turns - r;
      // Farther away again: the valley that begins at s ends here.
      if (!(distance < least))
      {
        break;
      }
      least = distance;
      if (distance < best)
      {
        best = distance;
        nearest = there;
      }
    }
  }
  // On a closed curve s may be some turns away from r. The result stays on the turn of s.
  return (this->isClosed_ ? s : r) + nearest;
}

void SpaceCurve::setLimits(std::vector<std::vector<RoomLimit>> limits)
{
  this->limits_ = std::move(limits);
}

/// Of all points of the reference that the span passes.
bool SpaceCurve::leavesRoom(double from, double to, const Vec<3>& a, const Vec<3>& b) const
{
  bool good = true;
  const auto check = [&](std::size_t k, const Vec<3>& away)
  {
    // Each limit says which part of the way from the reference to the line may be used.
    for (const RoomLimit& limit : this->limits_[k])
    {
      good = good && !(limit.part(-away) < 1.0);
    }
  };
  return this->limits_.empty() || (this->forBetween(from, to, a, b, check) && good);
}

double SpaceCurve::deviation(double from, double to, const Vec<3>& a, const Vec<3>& b) const
{
  // Between points of both that belong together, the distance is a convex function: it is greatest
  // at one of them.
  double farthest = std::sqrt(
    std::max((this->at(from) - a).squaredNorm(), (this->at(to) - b).squaredNorm()));
  const auto measure = [&](std::size_t, const Vec<3>& away)
  { farthest = std::max(farthest, away.norm()); };
  return this->forBetween(from, to, a, b, measure) ? farthest
                                                   : std::numeric_limits<double>::infinity();
}

/// Calls f(k, away) for the points between two parameters: the number in the constructor, and the
/// way from the line from a to b. False where the curve turns back as seen along the line, which
/// may then be far from it.
template <class F>
bool SpaceCurve::forBetween(double from, double to, Vec<3> a, Vec<3> b, F&& f) const
{
  const double low = std::min(from, to), high = std::max(from, to);
  if (from > to)
  {
    std::swap(a, b);
  }
  const Vec<3> line = b - a;
  const double l = line.norm();
  // A chord without length spans no part of the curve, or all of it.
  if (!(l > 0.0))
  {
    return !(high > low);
  }
  // Rounding, at points that lie at an end of the chord.
  const double slack = LengthRounding * l;
  // Knots are within the first turn: they are shifted to that of the span.
  double last = (this->at(low) - a).dot(line) / l;
  const double end = (this->at(high) - a).dot(line) / l;
  const double shift = this->isClosed_ ? std::floor(low / this->length()) * this->length() : 0.0;
  const std::size_t n = this->points_.size() - 1;
  std::size_t k = this->segmentAt(this->inRange(low)) + 1;
  double turns = shift;
  while (true)
  {
    if (k >= n && this->isClosed_)
    {
      k -= n;
      turns += this->length();
    }
    if (k >= n || !(this->knots_[k] + turns < high))
    {
      return end >= last - slack;
    }
    const Vec<3> d = this->points_[k] - a;
    const double t = d.dot(line) / l;
    if (!(t >= last - slack && t <= end + slack))
    {
      return false;
    }
    last = t;
    f(k, Vec<3>(d - line * (std::clamp(t, 0.0, l) / l)));
    ++k;
  }
}
}
