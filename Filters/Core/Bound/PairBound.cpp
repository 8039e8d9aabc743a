// SPDX-License-Identifier: BSD-3-Clause
// The case in which the angle at an edge is filled by two cells. Both share one free node, so the
// maximum is over a single place, for a weighted mean of both; false position finds the weight.
#include "Bound/PairBound.h"

#include "Quality/Shape.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// Where the search for the node begins: the distance from the edge, as a part of both perimeters.
/// About that of a regular apex (half of 0.27, since they are two); another one only takes longer.
constexpr double StartAway = 0.13;
/// Newton steps for one weight (about ten are taken), and tries of weights (some pairs use up all).
/// With fewer the bound is still valid, but too high.
constexpr int MostPairSteps = 40, MostWeights = 40;
/// Halvings of a step: the shortest is 1e-12 of it, and moves the node by little more than rounding
/// does.
constexpr int MostPairHalvings = 40;
/// How exactly the maximum for one weight has to be known, as a part of the tolerance for the cap.
/// What is left is added to the bound: with a larger part the tolerance might not be reached
/// (three times this part is spent), a smaller one takes more steps. Under the least precision
/// rounding keeps what is left from falling, and steps would be wasted.
constexpr double PartOfTolerance = 0.03, LeastPrecision = 1e-11;
/// The next weight keeps this part of the interval away from both its ends. With less, an end that
/// is almost right leaves the other one where it is; with more, good guesses are cut off.
constexpr double LeastPairPart = 0.01;

/// One of the two tetrahedra; p is the free node. The common edge goes from 0 to (1, 0, 0).
struct Half
{
  Vec<3> tip;    ///< third node of the facet
  Vec<3> inward; ///< its product with p is proportional to V
  double base;   ///< perimeter of the facet

  /// `angle` of the facet around the edge; `turn`, 1 or -1, says on which side of it the wedge is.
  Half(const EdgeView& view, double angle, double turn)
    : tip(view.along, view.off * std::cos(angle), view.off * std::sin(angle))
    , inward(turn * view.off * Vec<3>(0.0, -std::sin(angle), std::cos(angle)))
    , base(view.perimeter)
  {
  }

  /// (c V)^(1/3), in units of the perimeter of the facet.
  double root(const Vec<3>& p) const
  {
    return std::cbrt(MeanEdgeShape<3>::constant / 6.0 * this->inward.dot(p)) / this->base;
  }

  /// The sum of the edges, in the same unit.
  double sum(const Vec<3>& p) const
  {
    return 1.0 + (p.norm() + (p - Vec<3>::UnitX()).norm() + (p - this->tip).norm()) / this->base;
  }

  /// Adds the gradient of -(root - lambda sum), times weight, and its second derivatives.
  void differentiate(
    const Vec<3>& p, double lambda, double weight, Vec<3>& g, Eigen::Matrix3d& h) const
  {
    const double height = this->inward.dot(p);
    const double slope = weight * this->root(p) / (3.0 * height);
    g -= slope * this->inward;
    h += (2.0 * slope / (3.0 * height)) * this->inward * this->inward.transpose();
    for (const Vec<3>& pole : { Vec<3>(Vec<3>::Zero()), Vec<3>(Vec<3>::UnitX()), this->tip })
    {
      const Vec<3> v = p - pole;
      const double d = 1.0 / v.norm(), l = weight * lambda * d / this->base;
      g += l * v;
      h += l * Eigen::Matrix3d::Identity() - (l * d * d) * v * v.transpose();
    }
  }
};

class Pair
{
public:
  Pair(double theta, const EdgeView& first, const EdgeView& last)
    : first_(first, 0.0, 1.0)
    , last_(last, theta, -1.0)
  {
  }

  /// Only there both volumes are positive, and root() may be divided by.
  bool isInside(const Vec<3>& p) const
  {
    return this->first_.inward.dot(p) > 0.0 && this->last_.inward.dot(p) > 0.0;
  }

  /// In the middle of the angle, about as far from the edge as a regular apex.
  static Vec<3> start(double theta, const EdgeView& first, const EdgeView& last)
  {
    const double away = StartAway * (first.perimeter + last.perimeter);
    return { 0.25 + 0.25 * (first.along + last.along), away * std::cos(0.5 * theta),
      away * std::sin(0.5 * theta) };
  }

  /// S^(1/3) of the first and of the last tetrahedron.
  double first(const Vec<3>& p) const { return this->first_.root(p) / this->first_.sum(p); }
  double last(const Vec<3>& p) const { return this->last_.root(p) / this->last_.sum(p); }

  double mean(const Vec<3>& p, double weight) const
  {
    return (weight * this->first_.root(p) + (1.0 - weight) * this->last_.root(p)) /
      (weight * this->first_.sum(p) + (1.0 - weight) * this->last_.sum(p));
  }

  /// Moves p to the best place for the weighted mean. Returns an upper bound, as S^(1/3), on what
  /// the worse of the two tetrahedra can reach anywhere. Stops where that is known to the relative
  /// `precision`.
  double maximize(double weight, double precision, Vec<3>& p) const
  {
    double lambda = this->mean(p, weight);
    double rest = 0.0;
    for (int iteration = 0; iteration < MostPairSteps; ++iteration)
    {
      Vec<3> g = Vec<3>::Zero();
      Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
      this->first_.differentiate(p, lambda, weight, g, h);
      this->last_.differentiate(p, lambda, 1.0 - weight, g, h);
      // The mean of root - lambda sum is concave and 0 at p: it is at most the slope times a
      // distance. The best place for both is no farther from the middle of the edge than the longer
      // perimeter: beyond it, both get better on the straight way back. Sums are at least 1, so the
      // mean() exceeds lambda by no more.
      const double radius = std::max(this->first_.base, this->last_.base);
      rest = g.norm() * (radius + (p - 0.5 * Vec<3>::UnitX()).norm());
      if (rest <= precision * lambda || !this->advance(h.llt().solve(-g), weight, p, lambda))
      {
        break;
      }
    }
    return lambda + rest;
  }

private:
  /// Takes the longest of the steps 1, 1/2, 1/4 ... that raises the mean. False if none does.
  bool advance(const Vec<3>& step, double weight, Vec<3>& p, double& lambda) const
  {
    double t = 1.0;
    for (int halving = 0; halving < MostPairHalvings; ++halving, t *= 0.5)
    {
      const Vec<3> next = p + t * step;
      const double value = this->isInside(next) ? this->mean(next, weight) : 0.0;
      if (value > lambda)
      {
        p = next;
        lambda = value;
        return true;
      }
    }
    return false;
  }

  Half first_, last_;
};
}

/// The weight is where both have the same quality. Their difference rises with the weight, so that
/// false position finds it; the weight of an end that stays is halved (Illinois).
double pairCap(
  double theta, const EdgeView& first, const EdgeView& last, double tolerance, double enough)
{
  const Pair pair(theta, first, last);
  const double wanted = std::cbrt(enough),
               precision = std::max(LeastPrecision, PartOfTolerance * tolerance);
  Vec<3> p = Pair::start(theta, first, last);
  double bound = 1.0, reached = 0.0; // as S^(1/3)
  double low = 0.0, high = 1.0, atLow = 0.0, atHigh = 0.0, weight = 0.5;
  for (int k = 0; k < MostWeights && pair.isInside(p); ++k)
  {
    const double s1 = pair.first(p), s2 = pair.last(p);
    reached = std::max(reached, std::min(s1, s2));
    // S has three times the relative difference.
    if (reached >= wanted || bound <= reached * (1.0 + tolerance / 3.0))
    {
      break;
    }
    if (k > 0 && s1 < s2)
    {
      low = weight;
      atLow = s1 - s2;
      atHigh *= 0.5;
    }
    else if (k > 0)
    {
      high = weight;
      atHigh = s1 - s2;
      atLow *= 0.5;
    }
    // Until both signs are known, by halving.
    const bool isBetween = atLow < 0.0 && atHigh > 0.0;
    const double part = isBetween
      ? std::clamp(atLow / (atLow - atHigh), LeastPairPart, 1.0 - LeastPairPart)
      : 0.5;
    weight = low + part * (high - low);
    bound = std::min(bound, pair.maximize(weight, precision, p));
  }
  return std::min(1.0, bound * bound * bound);
}
}
