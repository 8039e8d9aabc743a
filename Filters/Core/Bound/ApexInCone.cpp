// SPDX-License-Identifier: BSD-3-Clause
// Places in a cone are written by the weights of its three ends: each is positive, and so is what
// is left to 1, the weight of the tip.
#include "Bound/ApexInCone.h"

#include "Mesh/SimplexGeometry.h"
#include "Quality/Shape.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshopt
{
namespace
{
constexpr int MostConeSteps = 40, MostConeHalvings = 20;
/// A step ends at this part of the way to the nearest face: on the face the barrier is infinite.
constexpr double OffFaces = 0.9;
/// The barrier at first, as a part of V^(1/3), and by what it falls after a long or a short step.
/// Less at first, and Newton's steps stay near the middle for long; the last one is far below
/// what Tolerance sees.
constexpr double FirstBarrier = 0.1, LastBarrier = 1e-7, Falls = 0.2, FallsSlowly = 0.6;
}

ApexInCone::ApexInCone(const std::array<Vec<3>, 3>& corners, const Vec<3>& weights)
{
  const Vec<3> u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double longest = std::max({ u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm() });
  this->unit_ = std::sqrt(longest);
  // From the first corner: far from the origin the difference is exact, the sum is not.
  const Vec<3> place = weights[1] * u + weights[2] * v;
  this->from_ = corners[0] + place;
  for (int i = 0; i < 3; ++i)
  {
    this->poles_[i] = (corners[i] - corners[0] - place) / this->unit_;
  }
  this->normal_ = (u / this->unit_).cross(v / this->unit_);
  const double twice = this->normal_.norm();
  this->normal_ /= twice;
  this->area_ = 0.5 * twice;
  this->perimeter_ = (u.norm() + v.norm() + (v - u).norm()) / this->unit_;
  this->usable_ = longest > 0.0 && std::isfinite(longest) && this->area_ > 0.0 &&
    std::isfinite(this->perimeter_) && this->from_.allFinite();
}

/// The edges of the element: those of the facet, and the three to the apex.
double ApexInCone::sum(const Vec<3>& place, Vec<3>* gradient, Tensor<3>* hessian) const
{
  double s = this->perimeter_;
  for (const Vec<3>& pole : this->poles_)
  {
    const Vec<3> v = place - pole;
    const double r = v.norm();
    s += r;
    if (gradient && r > 0.0) // at a pole any direction is a tangent
    {
      const Vec<3> t = v / r;
      *gradient += t;
      *hessian += (Tensor<3>::Identity() - t * t.transpose()) / r;
    }
  }
  return s;
}

double ApexInCone::shape(const Vec<3>& place) const
{
  const double volume = this->area_ * this->normal_.dot(place) / 3.0;
  return volume <= 0.0 ? 0.0 : MeanEdgeShape<3>::constant * volume / cubed(this->sum(place));
}

/// At the distance d, in units, V <= area d / 3 and P >= 3 (d - 1), since no corner is farther away
/// than 1. If d >= 2, d <= 2 (d - 1), and so S <= 2 c area / (81 (d - 1)^2).
double ApexInCone::reach(double shape) const
{
  return std::max(
    2.0, 1.0 + std::sqrt(2.0 * MeanEdgeShape<3>::constant * this->area_ / (81.0 * shape)));
}

ApexInCone::Best ApexInCone::best(const Cone& cone, double atLeast, double enough) const
{
  Tensor<3> ends;
  ends << cone[0], cone[1], cone[2];
  const Vec<3> heights = ends.transpose() * this->normal_;
  const double scale = MeanEdgeShape<3>::constant * this->area_ / 3.0; // S = scale z / P^3
  Vec<3> w = Vec<3>::Constant(0.25);
  Best result;
  result.bound = 1.0;
  result.place = ends * w;
  double reached = 0.0, barrier = -1.0;
  for (int step = 0; step < MostConeSteps; ++step)
  {
    const Vec<3> place = ends * w;
    const double z = heights.dot(w);
    if (!(z > 0.0))
    {
      // All of the cone is in the plane of the facet, or rounding has put it there.
      result.bound = (heights.array() <= 0.0).all() ? 0.0 : result.bound;
      return result;
    }
    Vec<3> slope = Vec<3>::Zero();
    Tensor<3> curvature = Tensor<3>::Zero();
    const double p = this->sum(place, &slope, &curvature);
    const double root = std::cbrt(z), lambda = root / p;
    // z^(1/3) - lambda P is 0 here; by the tangent plane it is nowhere above `rest`. And P is
    // nowhere less than one and a half perimeters.
    const Vec<3> gradient = heights * (root / (3.0 * z)) - lambda * (ends.transpose() * slope);
    const double rest = std::max(gradient.maxCoeff(), 0.0) - gradient.dot(w);
    const double bound = scale * cubed(lambda + std::max(rest, 0.0) / (1.5 * this->perimeter_));
    result.bound = std::min(result.bound, bound);
    if (scale * cubed(lambda) > reached)
    {
      reached = scale * cubed(lambda);
      result.place = place;
    }
    if (result.bound <= reached * (1.0 + Tolerance) || result.bound <= atLeast || reached >= enough)
    {
      break;
    }
    barrier = barrier < 0.0 ? FirstBarrier * root : std::max(barrier, LastBarrier * root);
    const double left = 1.0 - w.sum();
    const Vec<3> pull = gradient + barrier * (w.cwiseInverse().array() - 1.0 / left).matrix();
    Tensor<3> h = (2.0 / 9.0) * root / (z * z) * heights * heights.transpose() +
      lambda * (ends.transpose() * curvature * ends);
    h.diagonal() += barrier * w.cwiseAbs2().cwiseInverse();
    h.array() += barrier / (left * left);
    const Vec<3> way = Eigen::Matrix3d(h).ldlt().solve(Eigen::Vector3d(pull));
    // Nowhere through a face; then half as far until the function with its barrier is higher.
    double t = 1.0;
    for (int i = 0; i < 3; ++i)
    {
      t = way[i] < 0.0 ? std::min(t, -OffFaces * w[i] / way[i]) : t;
    }
    t = way.sum() > 0.0 ? std::min(t, OffFaces * left / way.sum()) : t;
    const auto value = [&](const Vec<3>& x)
    {
      const double height = heights.dot(x);
      return height <= 0.0 ? -std::numeric_limits<double>::infinity()
                           : std::cbrt(height) - lambda * this->sum(ends * x) +
          barrier * std::log(x.prod() * (1.0 - x.sum()));
    };
    const double now = barrier * std::log(w.prod() * left);
    int halvings = 0;
    for (; halvings < MostConeHalvings && !(value(w + t * way) >= now); ++halvings)
    {
      t *= 0.5;
    }
    w += halvings < MostConeHalvings ? Vec<3>(t * way) : Vec<3>::Zero();
    barrier *= t > 0.5 ? Falls : FallsSlowly;
  }
  return result;
}
}
