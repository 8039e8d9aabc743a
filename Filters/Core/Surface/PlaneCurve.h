// SPDX-License-Identifier: BSD-3-Clause
/// @file PlaneCurve.h
/// A curve in the plane through given points: straight between them, or a cubic B-spline.
#ifndef meshopt_Surface_PlaneCurve_h
#define meshopt_Surface_PlaneCurve_h

#include "Mesh/Types.h"

#include <unsupported/Eigen/Splines>

#include <vector>

namespace meshopt
{
/// Parameter: the length of the polygon through the points, from the first one on. Closed curves
/// are periodic in it. Immutable: any number of threads may ask at the same time.
class PlaneCurve
{
public:
  /// At least two points (closed: three), neighbours at different places (two points alone may lie
  /// at one). A spline goes through all points, with continuous curvature also where a closed curve closes.
  PlaneCurve(std::vector<Vec<2>> points, bool isClosed, bool isSpline);

  bool isClosed() const { return this->isClosed_; }
  /// Greatest parameter.
  double length() const { return this->knots_.back(); }
  /// Parameter of point k of the constructor.
  double parameter(std::size_t k) const { return this->knots_[k]; }

  Vec<2> at(double s) const;
  /// Unit vector along the curve at s; at a point between two straight lines that of the line after it.
  Vec<2> direction(double s) const;

  /// Parameter of the point of the curve that is nearest to x, and the distance to it.
  double closest(const Vec<2>& x, double& distance) const;

  /// How far the curve goes from its chord between two parameters, at most (sampled).
  double sagitta(double s0, double s1) const;

  /// The segment between two neighbours of the points that the curve leaves farthest, in parts of the
  /// segment's length: its number, and that part in `share`. A circle by points every a degrees has
  /// tan(a / 4) / 2 everywhere.
  std::size_t mostCurvedSegment(double& share) const;

private:
  using Spline = Eigen::Spline<double, 2, Eigen::Dynamic>;

  void fit();
  double inRange(double s) const;
  std::size_t segmentAt(double s) const;
  double distanceAt(double s, const Vec<2>& x) const { return (this->at(s) - x).norm(); }
  double refine(std::size_t segment, const Vec<2>& x, double& distance) const;

  std::vector<Vec<2>> points_; ///< closed: the first one again at the end
  std::vector<double> knots_;  ///< parameter of each
  bool isClosed_;
  bool isSpline_;
  Spline spline_;
  double splineBegin_ = 0.0, splineLength_ = 1.0; ///< Eigen's splines live on [0, 1]
};
}

#endif
