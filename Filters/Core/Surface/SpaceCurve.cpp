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
constexpr double Rounding = 1e-12; ///< of a length
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

void SpaceCurve::setRooms(std::vector<double> rooms)
{
  this->rooms_ = std::move(rooms);
  if (this->isClosed_ && !this->rooms_.empty())
  {
    this->rooms_.push_back(double(this->rooms_.front()));
  }
}

/// Of all lines that the span touches, even in part.
double SpaceCurve::room(double from, double to) const
{
  const std::size_t n = this->points_.size() - 1;
  const double low = this->inRange(std::min(from, to));
  double left = low + std::fabs(to - from);
  double least = std::numeric_limits<double>::infinity();
  std::size_t k = this->segmentAt(low);
  for (std::size_t done = 0; done < n && !this->rooms_.empty(); ++done)
  {
    least = std::min({ least, this->rooms_[k], this->rooms_[k + 1] });
    if (!(this->knots_[k + 1] < left))
    {
      break;
    }
    left -= k + 1 == n ? this->length() : 0.0; // only a closed one goes on
    k = k + 1 == n ? 0 : k + 1;
  }
  return least;
}

double SpaceCurve::deviation(double from, double to) const
{
  const double low = std::min(from, to), high = std::max(from, to);
  const Vec<3> a = this->at(low), chord = this->at(high) - a;
  const double l = chord.norm();
  // A span that comes back to its start has no chord to be compared with.
  if (!(l > 0.0))
  {
    return high > low ? std::numeric_limits<double>::infinity() : 0.0;
  }
  const double slack = Rounding * l;
  double farthest = 0.0, last = 0.0;
  // The points between. The distance of a line from a convex set is greatest at one of its ends.
  // Knots are within the first turn: they are shifted to that of the span.
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
      return farthest;
    }
    const Vec<3> d = this->points_[k] - a;
    const double t = d.dot(chord) / l;
    if (!(t >= last - slack &&
          t <= l + slack)) // it turns back: the chord may then be far from the curve
    {
      return std::numeric_limits<double>::infinity();
    }
    last = t;
    farthest = std::max(farthest, (d - chord * (t / l)).norm());
    ++k;
  }
}
}
