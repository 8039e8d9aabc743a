// SPDX-License-Identifier: BSD-3-Clause
/// @file SpaceCurve.h
/// A polyline in space, along which nodes of the surface slide.
#ifndef meshopt_Surface_SpaceCurve_h
#define meshopt_Surface_SpaceCurve_h

#include "Mesh/Types.h"

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
  /// Unit vector along the curve at s. At a point between two lines: that of the second.
  Vec<3> direction(double s) const;

  /// Parameter of the point of the curve nearest to x, among those that can be reached from `s`
  /// while the distance to x falls.
  double closest(const Vec<3>& x, double s) const;

  /// How far the curve between two parameters, and its chord, are from each other at most: both
  /// ways. Infinite where the curve turns back, as seen along the chord.
  double deviation(double from, double to) const;

  /// How far other parts of the surface leave room at each point of the constructor.
  void setRooms(std::vector<double> rooms);
  /// The least room at the points between two parameters, and at the next ones beyond them.
  double room(double from, double to) const;

private:
  double inRange(double s) const;
  std::size_t segmentAt(double s) const;

  std::vector<Vec<3>> points_; ///< of a closed curve: the first one again at the end
  std::vector<double> knots_;  ///< parameter of each point
  std::vector<double> rooms_;  ///< like the points; empty: no limits
  bool isClosed_;
};
}

#endif
