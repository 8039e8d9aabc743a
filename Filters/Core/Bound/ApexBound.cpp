// SPDX-License-Identifier: BSD-3-Clause
// All bounds here come from one kind of maximum, ApexProblem, which Newton's method solves. What is
// left when it ends is added, never neglected: a bound that is too low would be wrong, one that is
// a little too high is only weaker.
#include "Bound/ApexBound.h"

#include "Bound/PairBound.h"
#include "Mesh/SimplexGeometry.h"
#include "Quality/Shape.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
constexpr double shapeConstant = MeanEdgeShape<3>::constant;

/// The dihedral angle of the regular tetrahedron.
const double bestAngle = std::acos(1.0 / 3.0);

/// How well a maximum is known where it sets a bound: relative. Some hundred times the rounding
/// error; with less the steps would not end, with more the bound would be too high by it.
constexpr double Exactly = 1e-13;
/// Qualities that differ by less, relatively, count as equal. Above what rounding does to them
/// (about 1e-14), or levels that are reached would seem to be missed; below all tolerances.
constexpr double Rounding = 1e-12;
/// Stands for a bound that is not known: above each lambda, so that it is always valid.
constexpr double NoBound = 1e30;
/// Where the search for the best node begins: its height over the facet, as a part of the
/// perimeter. That of a regular apex, sqrt(2/3) / 3, rounded; another one only takes longer.
constexpr double ApexHeight = 0.27;
/// Newton steps: about a dozen are taken, on needles, too. Where they do not do, no bound is known,
/// so that there should be some to spare.
constexpr int MostSteps = 60;
/// Halvings of a step: the shortest is 1e-12 of it, and moves the node by little more than rounding
/// does.
constexpr int MostHalvings = 40;
/// A step leaves the node at least this part of its height. Nearer to the facet the root is so
/// steep that the next step is useless; with a larger part a node too high comes down slowly.
constexpr double LeastHeight = 0.1;
/// Where the quality does not rise any more, steps go on while each makes the slope smaller by this
/// factor. Newton's do so by far unless rounding stops them.
constexpr double Falling = 0.5;
/// Where the search for the best tetrahedron at an angle begins: near the radius of the regular
/// one. The best radii are from 0.77 to 1.04, and five Newton steps find them to the last bit.
constexpr double RadiusAtEdge = 0.85;
constexpr int StepsAtEdge = 8;
/// Tries of false position: about 40 are taken for the smallest width. Fewer leave it wider.
constexpr int MostTries = 100;
/// How far a try stays away from both ends, as a part of the wanted width. Under 1/2, so that two
/// tries close the interval once the zero is found; with much less, rounding would decide on which
/// side of the zero they are.
constexpr double OffEnds = 0.4;
/// How well a maximum is known where an angle is wanted, as a part of the width of that angle: what
/// is left widens the interval of angles, and must be small beside the width.
constexpr double PartOfWidth = 3e-3;
/// What an error of the angle does to a quality, relatively (views of facets have that error, too),
/// and to the quality of two tetrahedra. Both rounded up: smaller ones would not be certain.
constexpr double ViewErrors = 8.0, PairErrors = 100.0;
/// While the level known to be reached is below this part of the forbidden one, false position
/// knows too little of the curve: the level then falls by a factor.
constexpr double FarBelow = 0.1, FallByFactor = 0.3;
/// The width of levels, relative to the angle or to 1, that is tried first.
constexpr double CoarseLevels = 1e-2;
/// False position keeps this part of the interval away from both its ends. With less, an end that
/// is almost right leaves the other one where it is; with more, good guesses are cut off.
constexpr double LeastPart = 0.02;

/// Maximizes z^(1/3) / P(p). Here z > 0 is the last coordinate of p, and P(p) = base + sum_i of
/// sqrt(|p - pole_i|^2 + offset_i): three edges lead from the free node to given ones. The given
/// facet has a constant area, so V is z times a constant.
template <int N>
struct ApexProblem
{
  using Point = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  double base = 0.0;
  Point pole[3];
  double offset[3] = { 0.0, 0.0, 0.0 };

  double sum(const Point& p) const
  {
    double s = this->base;
    for (int i = 0; i < 3; ++i)
    {
      s += std::sqrt((p - this->pole[i]).squaredNorm() + this->offset[i]);
    }
    return s;
  }

  /// First and second derivatives of sum().
  void derivatives(const Point& p, Point& g, Matrix& h) const
  {
    g.setZero();
    h.setZero();
    for (int i = 0; i < 3; ++i)
    {
      const Point v = p - this->pole[i];
      const double d = 1.0 / std::sqrt(v.squaredNorm() + this->offset[i]);
      g += d * v;
      h += d * Matrix::Identity() - (d * d * d) * v * v.transpose();
    }
  }

  /// Returns an upper bound of the maximum. Starts at p, which becomes the best place. Stops as
  /// soon as `enough` is reached, or the bound is known to the relative `precision`.
  double maximize(Point& p, double enough, double precision = Exactly) const
  {
    double z = p[N - 1];
    double s = this->sum(p);
    // Cubes are compared, since roots take long. The margin is for rounding: what is returned is
    // then not below `enough`.
    const double most = cubed(enough) * (1.0 + Rounding);
    double lastRest = NoBound;
    for (int iteration = 0; iteration < MostSteps; ++iteration)
    {
      if (z >= most * cubed(s))
      {
        return std::cbrt(z) / s;
      }
      // The maximum of a quotient z^(1/3) / s is where z^(1/3) - lambda s has its maximum 0
      // (Dinkelbach). All of that is in units of lambda here: the step does not depend on it.
      Point slope;
      Matrix h;
      this->derivatives(p, slope, h);
      slope = -slope;
      slope[N - 1] += s / (3.0 * z);
      // z^(1/3) - lambda P is concave and 0 at p, so its maximum is at most the slope times a
      // distance. The best node is nearer to the given ones than their perimeter, and so is p.
      const double rest = slope.norm() * 2.0 * this->base / s;
      if (rest <= precision)
      {
        return std::cbrt(z) / s * (1.0 + rest);
      }
      // One Newton step; the Hessian is definite, since the function is strictly concave.
      h(N - 1, N - 1) += 2.0 * s / (9.0 * z * z);
      const Point step = h.llt().solve(slope);
      if (!this->advance(step, p, z, s))
      {
        // Rounding hides any further gain of z / s^3; steps may still make the slope smaller.
        if (rest > Falling * lastRest || p[N - 1] + step[N - 1] <= 0.0)
        {
          return std::cbrt(z) / s * (1.0 + std::min(rest, lastRest));
        }
        lastRest = rest;
        p += step;
        z = p[N - 1];
        s = this->sum(p);
      }
    }
    return NoBound; // not converged
  }

private:
  /// Takes the longest of the steps 1, 1/2, 1/4 ... that raises z / s^3. False if none does.
  bool advance(const Point& step, Point& p, double& z, double& s) const
  {
    double t = 1.0;
    for (int halving = 0; halving < MostHalvings; ++halving, t *= 0.5)
    {
      const Point next = p + t * step;
      // Stay on the positive side of the facet, and well off its plane, where the root is steep.
      if (next[N - 1] < LeastHeight * p[N - 1])
      {
        continue;
      }
      const double zNext = next[N - 1];
      const double sNext = this->sum(next);
      if (zNext * cubed(s) > z * cubed(sNext))
      {
        p = next;
        z = zNext;
        s = sNext;
        return true;
      }
    }
    return false;
  }
};

/// S from lambda = z^(1/3) / P, and back; `area` is the area of the given facet.
double shapeOf(double lambda, double area)
{
  // S = c V / P^3, with V = area z / 3 and lambda^3 = z / P^3.
  return std::min(1.0, shapeConstant * (area / 3.0) * cubed(lambda));
}
double lambdaOf(double shape, double area)
{
  return std::cbrt(shape * 3.0 / (shapeConstant * area));
}
}

double facetCap(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, double enough, Vec<3>* apex)
{
  // A frame in the plane of the facet: the origin at its centre, the unit its longest edge.
  const Vec<3> u = b - a, v = c - a;
  if (apex) // also where nothing is computed: callers go there
  {
    *apex = a + (u + v) / 3.0;
  }
  const double unit = std::sqrt(
    std::max(u.squaredNorm(), std::max(v.squaredNorm(), (v - u).squaredNorm())));
  if (!std::isfinite(u.squaredNorm() + v.squaredNorm()))
  {
    return 1.0;
  }
  const Vec<3> normal = u.cross(v);
  const double twiceArea = normal.norm();
  if (twiceArea == 0.0)
  {
    return 0.0;
  }
  const Vec<3> e0 = u / u.norm();
  const Vec<3> e2 = normal / twiceArea;
  const Vec<3> e1 = e2.cross(e0);
  const Vec<3> centre = (u + v) / 3.0;
  ApexProblem<3> problem;
  const Vec<3> corners[3] = { -centre, u - centre, v - centre };
  for (int i = 0; i < 3; ++i)
  {
    problem.pole[i] << e0.dot(corners[i]) / unit, e1.dot(corners[i]) / unit, 0.0;
  }
  problem.base = (u.norm() + v.norm() + (v - u).norm()) / unit;
  const double area = 0.5 * twiceArea / (unit * unit);
  Eigen::Vector3d p(0.0, 0.0, ApexHeight * problem.base);
  const double target = std::isfinite(enough) ? lambdaOf(enough, area) : enough;
  const double lambda = problem.maximize(p, target);
  if (apex)
  {
    *apex = a + centre + unit * (p[0] * e0 + p[1] * e1 + p[2] * e2);
  }
  return shapeOf(lambda, area);
}

double angleCap(double phi)
{
  // The edge has length 1, and the other nodes have distance r from its middle. dS/dr = 0 means m
  // (1 - r s) = 2 r^2 - 1, with s = sin(phi / 2), m = sqrt(r^2 + 1/4). The difference falls in r.
  const double s = std::sin(0.5 * phi);
  double r = RadiusAtEdge;
  for (int i = 0; i < StepsAtEdge; ++i)
  {
    const double m = std::sqrt(r * r + 0.25);
    const double f = m * (1.0 - r * s) - 2.0 * r * r + 1.0;
    const double df = r / m * (1.0 - r * s) - m * s - 4.0 * r;
    const double next = r - f / df;
    if (next == r)
    {
      break; // so would all other steps
    }
    r = next;
  }
  const double p = 1.0 + 4.0 * std::sqrt(r * r + 0.25) + 2.0 * r * s;
  return std::min(1.0, shapeConstant * r * r * std::sin(phi) / 6.0 / cubed(p));
}

double angleCap2(double phi)
{
  // Two sides of length 1: the third is 2 sin(phi / 2), and the area is sin(phi) / 2.
  const double p = 2.0 + 2.0 * std::sin(0.5 * phi);
  return std::min(1.0, MeanEdgeShape<2>::constant * 0.5 * std::sin(phi) / (p * p));
}

namespace
{
/// The place between `out` (where f < c) and `in` (where f >= c) at which f reaches c, approached
/// from outside. False position; the weight of an end that stays is halved (Illinois).
template <class F>
double crossing(double out, double fOut, double in, double fIn, double c, double width, F&& f)
{
  double a = fOut - c, b = fIn - c;
  for (int i = 0; i < MostTries && std::fabs(in - out) > width; ++i)
  {
    double x = b > a ? out + (in - out) * (-a / (b - a)) : 0.5 * (in + out);
    // Keep a little off both ends, so that the interval closes from both sides.
    const double least = OffEnds * width, margin = in > out ? least : -least;
    x = std::fabs(x - out) < least ? out + margin : std::fabs(x - in) < least ? in - margin : x;
    const double y = f(x) - c;
    if (y >= 0.0)
    {
      in = x;
      b = y;
      a *= 0.5;
    }
    else
    {
      out = x;
      a = y;
      b *= 0.5;
    }
  }
  // The outer end: intervals are rounded outwards, so that the bound stays certified.
  return out;
}
}

double lowestAngle(double c, double width)
{
  return crossing(0.0, 0.0, bestAngle, 1.0, c, width, angleCap);
}

double highestAngle(double c, double width)
{
  return crossing(Pi, 0.0, bestAngle, 1.0, c, width, angleCap);
}

/// In units of the edge, which both facets there share.
EdgeView::EdgeView(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& apex)
{
  const Vec<3> u = b - a, v = c - a;
  const double l2 = u.squaredNorm(), l = std::sqrt(l2);
  this->along = u.dot(v) / l2;
  this->off = u.cross(v).norm() / l2;
  this->perimeter = 1.0 + (v.norm() + (v - u).norm()) / l;
  this->usable = l2 > 0.0 && std::isfinite(this->perimeter) && this->off > 0.0;
  if (this->usable)
  {
    const Vec<3> t = u / l, w = apex - a;
    const Vec<3> across = v - v.dot(t) * t;
    // The dihedral angle of (facet, apex) at the edge. The apex may be on either side.
    this->best = std::atan2(std::fabs(w.dot(t.cross(across))), w.dot(across));
    this->place = { w.dot(t) / l, (w - w.dot(t) * t).norm() / l };
  }
}

double EdgeView::cap(double phi, double enough) const
{
  Eigen::Vector2d p = this->place;
  return this->capFrom(phi, enough, p, Exactly);
}

double EdgeView::capFrom(double phi, double enough, Eigen::Vector2d& p, double precision) const
{
  // In the half plane at angle phi: s along the edge, r away from it; V = off r sin(phi) / 6.
  const double sine = std::sin(phi), cosine = std::cos(phi);
  ApexProblem<2> problem;
  problem.base = this->perimeter;
  problem.pole[0] << 0.0, 0.0;
  problem.pole[1] << 1.0, 0.0;
  problem.pole[2] << this->along, this->off * cosine;
  problem.offset[2] = this->off * sine * this->off * sine;
  const double area = 0.5 * this->off * sine; // V = area r / 3
  if (!(area > 0.0))
  {
    return 0.0;
  }
  const double target = std::isfinite(enough) ? lambdaOf(enough, area) : enough;
  return shapeOf(problem.maximize(p, target, precision), area);
}

/// Each search starts from the best place of the one before. What is left open makes the interval
/// wider, never narrower.
double EdgeView::limit(double c, double end, double width) const
{
  const double most = std::numeric_limits<double>::infinity();
  const double precision = std::max(Exactly, PartOfWidth * width);
  Eigen::Vector2d p = this->place;
  const auto value = [&](double phi) { return this->capFrom(phi, most, p, precision); };
  const double atBest = value(this->best);
  // Not even at its best angle is the facet good enough.
  return atBest < c * (1.0 - Rounding)
    ? -1.0
    : crossing(end, 0.0, this->best, std::max(atBest, c), c, width, value);
}

double EdgeView::lowest(double c, double width) const { return this->limit(c, 0.0, width); }
double EdgeView::highest(double c, double width) const { return this->limit(c, Pi, width); }

namespace
{
/// Whether a filling by three or more tetrahedra is found easily. It is for the many edges that
/// forbid nothing, and saves the expensive search.
bool fillsSimply(double c, double theta, const EdgeView& first, const EdgeView& last)
{
  const auto between = [c](double angle, int n)
  { return angle > 0.0 && angle < n * Pi && angleCap(angle / n) >= c; };
  const auto ends = [c, &first, &last](double angle)
  { return angle < Pi && first.cap(angle, c) >= c && last.cap(angle, c) >= c; };
  const int most = std::max(
    3, static_cast<int>(theta) + 1); // with more, each has less than 57 degrees
  for (int k = most; k >= 3 && k >= most - 2; --k)
  {
    if (between(theta - first.best - last.best, k - 2) ||
      (between(theta * (k - 2) / k, k - 2) && ends(theta / k)))
    {
      return true;
    }
  }
  return false;
}

/// By how much three or more tetrahedra with a worst S of c or more exceed the angle of the wedge,
/// at least: if it is above 0, there is no such filling. `width`: as for edgeCap(). With `inner`
/// the levels are taken from inside, where each tetrahedron is good enough: but for the precision
/// of the caps, what comes out is at least what any smaller width gives.
double excess(double c, const FacetWedge& wedge, double width, bool inner = false)
{
  const auto& [theta, first, last, spanned, slack] = wedge;
  // On the safe side: the views of the facets have this error.
  c *= 1.0 - ViewErrors * slack;
  const double l1 = first.lowest(c, width), l2 = last.lowest(c, width);
  if (l1 < 0.0 || l2 < 0.0)
  {
    return -theta; // the best place is not known well enough
  }
  const double in = inner ? width : 0.0;
  // There are k - 2 >= 1 tetrahedra between the first and the last. At most edges that are convex,
  // already one is too many.
  const double low = lowestAngle(c, width) + in;
  const double byOne = l1 + l2 + 2.0 * in + low - theta - slack;
  if (byOne > 0.0)
  {
    return byOne;
  }
  // Fewer than `between` do not reach theta; if that many exceed it, all larger numbers do, too.
  const double u1 = first.highest(c, width), u2 = last.highest(c, width);
  const double between = std::ceil(
    (theta - slack - u1 - u2 + 2.0 * in) / (highestAngle(c, width) - in));
  return byOne + std::max(0.0, between - 1.0) * low;
}
}

/// First what one or two tetrahedra reach: mostly three or more cannot reach that, and it is the
/// cap. Else false position between it and the level that is forbidden (Illinois). Only a forbidden
/// level is returned, so that the result is certified.
double edgeCap(double above, const FacetWedge& wedge, double tolerance, double width)
{
  const auto& [theta, first, last, spanned, slack] = wedge;
  constexpr double nothing = 1.0;
  if (!first.usable || !last.usable || !std::isfinite(theta) || above <= 0.0 || spanned >= above)
  {
    return nothing;
  }
  if (fillsSimply(above, theta, first, last))
  {
    return nothing;
  }
  // Most edges forbid nothing, and coarse levels prove it.
  const double coarse = CoarseLevels * std::min(1.0, theta);
  if (coarse > width && !(excess(above, wedge, coarse, true) > 0.0))
  {
    return nothing;
  }
  // Filling by two: V at the other facet is wrong by slack times the distance of the node, and S by
  // at most 1833 / 24 slack.
  const double pair = (pairCap(theta, first, last, tolerance, above) + PairErrors * slack) /
    (1.0 - ViewErrors * slack);
  double low = (1.0 + Rounding) * std::max({ 0.0, spanned, pair }), high = above;
  if (low >= high)
  {
    return nothing;
  }
  const auto by = [&](double c) { return excess(c, wedge, width); };
  double atLow = low > 0.0 ? by(low) : -theta;
  if (atLow > 0.0)
  {
    return low;
  }
  double atHigh = by(high);
  if (!(atHigh > 0.0))
  {
    return nothing;
  }
  while (high - low > tolerance * high && high > Rounding)
  {
    const double part = std::clamp(atLow / (atLow - atHigh), LeastPart, 1.0 - LeastPart);
    const double middle = low > FarBelow * high ? low + part * (high - low) : FallByFactor * high;
    const double value = by(middle);
    (value > 0.0 ? high : low) = middle;
    (value > 0.0 ? atHigh : atLow) = value;
    (value > 0.0 ? atLow : atHigh) *= 0.5;
  }
  return high;
}
}
