// SPDX-License-Identifier: BSD-3-Clause
/// @file SpaceCurve.h
/// A polyline in space, along which nodes of the surface slide.
#ifndef meshopt_Surface_SpaceCurve_h
#define meshopt_Surface_SpaceCurve_h

#include "Surface/RoomLimit.h"

#include <vector>

namespace meshopt
{
/// The parameter is the length from the first point on. Closed curves are periodic in it.
/// Immutable: any number of threads may use it at the same time.
class SpaceCurve
{
public:
  /// Needs at least two points (closed: three).
  SpaceCurve(std::vector<Vec<3>> points, bool isClosed);

  bool isClosed() const { return this->isClosed_; }
  double length() const { return this->knots_.back(); }
  /// Parameter of point k of the constructor.
  double parameter(std::size_t k) const { return this->knots_[k]; }

  Vec<3> at(double s) const;
  /// The number of the line at s, from point k of the constructor to the next.
  std::size_t line(double s) const { return this->segmentAt(this->inRange(s)); }
  /// Unit vector along the curve at s. At a point between two lines: that of the second.
  Vec<3> direction(double s) const;

  /// Parameter of the point of the curve nearest to x, among those that can be reached from `s`
  /// while the distance to x falls.
  double closest(const Vec<3>& x, double s) const;

  /// How far the curve between two parameters and the line from a to b are from each other at most,
  /// both ways. Infinite where the curve turns back, as seen along the line.
  double deviation(double from, double to, const Vec<3>& a, const Vec<3>& b) const;
  /// The same for its chord.
  double deviation(double from, double to) const
  {
    return this->deviation(from, to, this->at(from), this->at(to));
  }

  /// What other sheets of the surface leave at each point of the constructor.
  void setLimits(std::vector<std::vector<RoomLimit>> limits);
  /// Whether the line from a to b keeps the limits of the points between two parameters.
  bool leavesRoom(double from, double to, const Vec<3>& a, const Vec<3>& b) const;

private:
  double inRange(double s) const;
  std::size_t segmentAt(double s) const;
  template <class F>
  bool forBetween(double from, double to, Vec<3> a, Vec<3> b, F&& f) const;

  std::vector<Vec<3>> points_; ///< of a closed curve: the first one again at the end
  std::vector<double> knots_;  ///< parameter of each point
  std::vector<std::vector<RoomLimit>> limits_; ///< like the points; empty: none
  bool isClosed_;
};
}

#endif
