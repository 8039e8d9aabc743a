// SPDX-License-Identifier: BSD-3-Clause
// Closed forms for one angle, and the fillings of an angle by several cells.
#include "Bound/AngleBound.h"

#include "Bound/ApexBound.h"
#include "Mesh/SimplexGeometry.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
constexpr double third = 1.0 / 3.0;

/// sqrt(2) sin(phi) / (1 + sin(phi / 2)^2): the edge has length 1, and the distance r of the other
/// nodes from its middle is r^2 = 1 / (1 + sin(phi / 2)^2).
double dihedralVolumeLength(double phi)
{
  const double s = std::sin(0.5 * phi);
  return std::sqrt(2.0) * std::sin(phi) / (1.0 + s * s);
}

/// The best fourth node is above the centroid of an isosceles face; the value is then the mean
/// ratio of the face.
double facialVolumeLength(double alpha)
{
  return std::sqrt(3.0) * std::sin(alpha) / (2.0 - std::cos(alpha));
}

double meanRatioOf(double volumeLength) { return std::cbrt(volumeLength * volumeLength); }

/// The radius of the inscribed sphere, in circumscribed ones, is at most the root x of x / sin(phi
/// / 2) = 1 + sqrt((1 + x) (1 - 3 x)): the inscribed sphere touches both planes of the angle, and
/// their common line meets the circumscribed one.
double insphere(double phi)
{
  const double s = std::sin(0.5 * phi);
  const auto isAbove = [s](double x)
  { return x > s * (1.0 + std::sqrt(std::max(0.0, (1.0 + x) * (1.0 - 3.0 * x)))); };
  double low = 0.0, high = third;
  if (!isAbove(high))
  {
    return high;
  }
  for (int k = 0; k < 60; ++k)
  {
    const double middle = 0.5 * (low + high);
    (isAbove(middle) ? high : low) = middle;
  }
  return high;
}

/// Greatest S of a tetrahedron with a face that has this angle. The best face is isosceles.
double facialShape(double alpha)
{
  return facetCap({ 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { std::cos(alpha), std::sin(alpha), 0.0 });
}

/// The worst cell of the best filling of an angle. `best`: where cap() is greatest.
template <class Cap>
double filled(double angle, double best, double slack, double regular, Cap&& cap)
{
  double most = 0.0;
  // Of n cells one has at most, and one at least, the n-th part of the angle: on either side of the
  // best angle, that is one with no greater cap than the n-th part has.
  for (int n = 1;; ++n)
  {
    const double low = (angle - slack) / n, high = (angle + slack) / n;
    // No cell has an angle of 180 degrees or more.
    if (high < Pi)
    {
      // An interval that contains the best angle proves nothing.
      most = std::max(most, high < best ? cap(high) : low > best ? cap(low) : regular);
    }
    if (high < best)
    {
      return most; // more cells only have smaller angles
    }
  }
}
}

double dihedralCap(Measure measure, double phi)
{
  const double regular = regularValue<3>(measure);
  double cap = regular;
  switch (measure)
  {
    case Measure::Shape:
      cap = angleCap(phi);
      break;
    case Measure::VolumeLength:
      cap = dihedralVolumeLength(phi);
      break;
    case Measure::MeanRatio:
      cap = meanRatioOf(dihedralVolumeLength(phi));
      break;
    case Measure::RadiusRatio:
      cap = std::min(std::sqrt(meanRatioOf(dihedralVolumeLength(phi))), 3.0 * insphere(phi));
      break;
    case Measure::MinimumSine:
      cap = std::sin(phi);
      break;
    case Measure::WarpedSine:
      // As the measure has it: sines of obtuse angles count three quarters.
      cap = (phi > 0.5 * Pi ? 0.75 : 1.0) * std::sin(phi);
      break;
    default: // nothing is known of other measures
      break;
  }
  return std::min(cap, regular);
}

double faceAngleCap(Measure measure, double alpha)
{
  const double regular = regularValue<3>(measure);
  double cap = regular;
  switch (measure)
  {
    case Measure::Shape:
      cap = facialShape(alpha);
      break;
    case Measure::VolumeLength:
      cap = facialVolumeLength(alpha);
      break;
    case Measure::MeanRatio:
      cap = meanRatioOf(facialVolumeLength(alpha));
      break;
    case Measure::RadiusRatio:
      cap = std::sqrt(meanRatioOf(facialVolumeLength(alpha)));
      break;
    default: // nothing is known of other measures
      break;
  }
  return std::min(cap, regular);
}

double angleBound(Measure measure, const AnglesToFill& angles)
{
  const double regular = regularValue<3>(measure);
  const double dihedral = std::acos(third), facial = Pi / 3.0; // of the regular tetrahedron
  double bound = regular;
  for (double angle : angles.dihedral)
  {
    bound = std::min(bound,
      filled(angle, dihedral, angles.slack, regular,
        [measure](double phi) { return dihedralCap(measure, phi); }));
  }
  for (double angle : angles.facial)
  {
    bound = std::min(bound,
      filled(angle, facial, angles.slack, regular,
        [measure](double alpha) { return faceAngleCap(measure, alpha); }));
  }
  return bound;
}
}
