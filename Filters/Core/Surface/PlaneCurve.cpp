// SPDX-License-Identifier: BSD-3-Clause
// A polyline, or a B-spline through its points. A closed spline is fitted as an open one that runs
// on for some points beyond both ends: their influence has faded where it is used.
#include "Surface/PlaneCurve.h"

#include "Base/GoldenSection.h"

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// A closed curve is fitted with this many additional points on either side: the influence of an
/// end of the spline fades by a factor 3.7 per point.
constexpr int Wrap = 16;
constexpr int Samples = 8;
constexpr int SearchSteps = 48; ///< to 1e-10 of a segment

/// Points closer to a straight line than this fraction of its length lie on it.
constexpr double Straight = 1e-10;

/// The parameter of the point of segment ab nearest to x, in [0, 1].
double alongSegment(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x)
{
  const Vec<2> d = b - a;
  const double l = d.squaredNorm();
  return l > 0.0 ? std::clamp((x - a).dot(d) / l, 0.0, 1.0) : 0.0;
}

/// Whether all points lie on a straight line. As a spline such a line would be straight only up to
/// rounding, and a later selection of its points by x == 2 would miss some.
bool isStraight(const std::vector<Vec<2>>& points)
{
  const Vec<2> along = points.back() - points.front();
  const double length = along.norm();
  return length > 0.0 &&
    std::all_of(points.begin(), points.end(),
      [&](const Vec<2>& p)
      {
        const Vec<2> d = p - points.front();
        const double t = d.dot(along) / length;
        return std::fabs(along[0] * d[1] - along[1] * d[0]) <= Straight * length * length &&
          t >= -Straight * length && t <= (1.0 + Straight) * length;
      });
}
}

/// A spline through points on a straight line stays a polyline: see isStraight().
PlaneCurve::PlaneCurve(std::vector<Vec<2>> points, bool isClosed, bool isSpline)
  : points_(std::move(points))
  , isClosed_(isClosed)
  , isSpline_(isSpline && points_.size() > 2 && !isStraight(points_))
{
  if (isClosed)
  {
    this->points_.push_back(Vec<2>(this->points_.front()));
  }
  this->knots_.assign(1, 0.0);
  for (std::size_t k = 1; k < this->points_.size(); ++k)
  {
    this->knots_.push_back(this->knots_.back() + (this->points_[k] - this->points_[k - 1]).norm());
  }
  if (this->isSpline_)
  {
    this->fit();
  }
}

/// Finds the control points by a sparse solve: Eigen's own SplineFitting uses a full matrix.
void PlaneCurve::fit()
{
  const int n = static_cast<int>(this->points_.size()) - (this->isClosed_ ? 1 : 0);
  const int wrap = this->isClosed_ ? Wrap : 0;
  const int total = this->isClosed_ ? n + 1 + 2 * wrap : n;
  // With fewer than four points no cubic is determined.
  const int degree = std::min(3, total - 1);
  Spline::ParameterVectorType u(total);
  Eigen::MatrixXd values(total, 2);
  for (int i = 0; i < total; ++i)
  {
    // A closed curve is run through more than once: the same points, a period later.
    const int k = i - wrap;
    const int turns = this->isClosed_ ? static_cast<int>(std::floor(k / static_cast<double>(n)))
                                      : 0;
    const int j = k - turns * n;
    u[i] = this->knots_[j] + turns * this->length();
    values.row(i) = this->points_[j].transpose();
  }
  this->splineBegin_ = u[0];
  this->splineLength_ = u[total - 1] - u[0];
  // Eigen's splines run from 0 to 1.
  u = (u - this->splineBegin_) / this->splineLength_;
  Spline::KnotVectorType knots;
  // De Boor's averages: with them the interpolation matrix is regular.
  Eigen::KnotAveraging(u, degree, knots);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < total; ++i)
  {
    const auto span = Spline::Span(u[i], degree, knots);
    const auto basis = Spline::BasisFunctions(u[i], degree, knots);
    for (int k = 0; k <= degree; ++k)
    {
      entries.emplace_back(i, static_cast<int>(span) - degree + k, basis[k]);
    }
  }
  Eigen::SparseMatrix<double> matrix(total, total);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // A row has at most four entries, so that many points are no burden.
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::MatrixXd control = solver.solve(values);
  this->spline_ = Spline(knots, control.transpose().array());
}

double PlaneCurve::inRange(double s) const
{
  if (this->isClosed_)
  {
    s -= std::floor(s / this->length()) * this->length();
  }
  // An open curve ends here. Of a closed one, rounding can leave s a little outside.
  return std::clamp(s, 0.0, this->length());
}

/// The number of the point at the end of the straight line that contains s.
std::size_t PlaneCurve::segmentAt(double s) const
{
  const auto next = std::upper_bound(this->knots_.begin(), this->knots_.end(), s);
  return std::clamp<std::size_t>(
    static_cast<std::size_t>(next - this->knots_.begin()), 1, this->knots_.size() - 1);
}

Vec<2> PlaneCurve::at(double s) const
{
  s = this->inRange(s);
  if (this->isSpline_)
  {
    return Vec<2>(this->spline_((s - this->splineBegin_) / this->splineLength_).matrix());
  }
  const std::size_t k = this->segmentAt(s);
  const double step = this->knots_[k] - this->knots_[k - 1];
  const double t = step > 0.0 ? (s - this->knots_[k - 1]) / step : 0.0;
  return Vec<2>(this->points_[k - 1] + t * (this->points_[k] - this->points_[k - 1]));
}

Vec<2> PlaneCurve::direction(double s) const
{
  s = this->inRange(s);
  if (this->isSpline_)
  {
    const auto d = this->spline_.derivatives((s - this->splineBegin_) / this->splineLength_, 1);
    return Vec<2>(d.col(1).matrix().normalized());
  }
  const std::size_t k = this->segmentAt(s);
  return Vec<2>(this->points_[k] - this->points_[k - 1]).normalized();
}

/// Searches for the nearest point on one segment of the polygon, by golden section.
double PlaneCurve::refine(std::size_t segment, const Vec<2>& x, double& distance) const
{
  const double s0 = this->knots_[segment], s1 = this->knots_[segment + 1];
  // On a straight line the nearest point is known at once.
  if (!this->isSpline_)
  {
    const double s = s0 +
      (s1 - s0) * alongSegment(this->points_[segment], this->points_[segment + 1], x);
    distance = this->distanceAt(s, x);
    return s;
  }
  double nearest = 0.0;
  double best = goldenSection(
    s0, s1, SearchSteps, [&](double s) { return -this->distanceAt(s, x); }, nearest);
  distance = -nearest;
  for (double end : { s0, s1 }) // so that a point of the polygon gets exactly its own parameter
  {
    const double d = this->distanceAt(end, x);
    if (d <= distance)
    {
      best = end;
      distance = d;
    }
  }
  return best;
}

double PlaneCurve::closest(const Vec<2>& x, double& distance) const
{
  // The curve is near its polygon, so its nearest point lies on one of the few nearest segments.
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t k = 0; k + 1 < this->points_.size(); ++k)
  {
    const double t = alongSegment(this->points_[k], this->points_[k + 1], x);
    near.emplace_back(
      (this->points_[k] + t * (this->points_[k + 1] - this->points_[k]) - x).squaredNorm(), k);
  }
  // A polyline is its polygon: there the nearest segment has the nearest point.
  const std::size_t few = std::min<std::size_t>(this->isSpline_ ? 4 : 1, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(few), near.end());
  double best = 0.0;
  distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < few; ++k)
  {
    double d = 0.0;
    const double s = this->refine(near[k].second, x, d);
    if (d < distance)
    {
      distance = d;
      best = s;
    }
  }
  return best;
}

BoxTree::Box PlaneCurve::box() const
{
  const BoxTree::Box box = BoxTree::around(this->points_);
  return BoxTree::widened(box, box.diagonal().norm());
}

/// Sampled: good enough to compare segments, but no bound.
double PlaneCurve::sagitta(double s0, double s1) const
{
  const Vec<2> a = this->at(s0), b = this->at(s1);
  double result = 0.0;
  for (int k = 1; k < Samples; ++k)
  {
    const Vec<2> x = this->at(s0 + (s1 - s0) * k / Samples);
    result = std::max(result, (a + alongSegment(a, b, x) * (b - a) - x).norm());
  }
  return result;
}

/// Relative to the length of the segment, so that all segments of a circle are alike.
std::size_t PlaneCurve::mostCurvedSegment(double& share) const
{
  std::size_t result = 0;
  share = 0.0;
  for (std::size_t k = 0; k + 1 < this->points_.size() && this->isSpline_; ++k)
  {
    const double s = this->sagitta(this->knots_[k], this->knots_[k + 1]) /
      (this->points_[k + 1] - this->points_[k]).norm();
    if (s > share)
    {
      share = s;
      result = k;
    }
  }
  return result;
}
}
