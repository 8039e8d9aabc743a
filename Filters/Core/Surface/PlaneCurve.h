// SPDX-License-Identifier: BSD-3-Clause
/// @file PlaneCurve.h
/// A plane curve through given points: straight lines between them, or a cubic B-spline.
#ifndef meshopt_Surface_PlaneCurve_h
#define meshopt_Surface_PlaneCurve_h

#include "Mesh/BoxTree.h"

#include <unsupported/Eigen/Splines>

#include <vector>

namespace meshopt
{
/// The parameter is the length of the polygon through the points, from the first point on. Closed
/// curves are periodic in it. Immutable: any number of threads may use it at the same time.
class PlaneCurve
{
public:
  /// Needs at least two points (closed: three), with neighbours at different places (except that
  /// two points alone may coincide). A spline passes through all points, with continuous curvature,
  /// also where a closed curve closes.
  PlaneCurve(std::vector<Vec<2>> points, bool isClosed, bool isSpline);

  bool isClosed() const { return this->isClosed_; }
  /// Greatest parameter.
  double length() const { return this->knots_.back(); }
  /// Parameter of point k of the constructor.
  double parameter(std::size_t k) const { return this->knots_[k]; }

  Vec<2> at(double s) const;
  /// Unit vector along the curve at s. At a point between two straight lines: that of the second.
  Vec<2> direction(double s) const;

  /// Parameter of the point of the curve nearest to x, and the distance to it.
  double closest(const Vec<2>& x, double& distance) const;

  /// A box that has the curve in it. For a spline, if no segment of it is farther from its chord
  /// than the box of the points is long.
  BoxTree::Box box() const;

  /// Greatest distance of the curve from its chord between two parameters (sampled).
  double sagitta(double s0, double s1) const;

  /// The number of the segment between two neighbouring points from which the curve is farthest,
  /// relative to the segment's length; `share` is that ratio. For a circle with a point every a
  /// degrees it is tan(a / 4) / 2 for all segments.
  std::size_t mostCurvedSegment(double& share) const;

private:
  using Spline = Eigen::Spline<double, 2, Eigen::Dynamic>;

  void fit();
  double inRange(double s) const;
  std::size_t segmentAt(double s) const;
  double distanceAt(double s, const Vec<2>& x) const { return (this->at(s) - x).norm(); }
  double refine(std::size_t segment, const Vec<2>& x, double& distance) const;

  std::vector<Vec<2>> points_; ///< of a closed curve: the first one again at the end
  std::vector<double> knots_;  ///< parameter of each point
  bool isClosed_;
  bool isSpline_;
  Spline spline_;
  double splineBegin_ = 0.0, splineLength_ = 1.0; ///< for Eigen's splines, whose range is [0, 1]
};
}

#endif
