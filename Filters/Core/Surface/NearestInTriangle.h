// SPDX-License-Identifier: BSD-3-Clause
/// @file NearestInTriangle.h
/// The point of a triangle in space that is nearest to another point.
#ifndef meshopt_Surface_NearestInTriangle_h
#define meshopt_Surface_NearestInTriangle_h

#include "Mesh/Types.h"

#include <array>

namespace meshopt
{
/// The point of the triangle nearest to x (Ericson, Real-time collision detection, 5.1.5).
inline Vec<3> nearestInTriangle(const std::array<Vec<3>, 3>& t, const Vec<3>& x)
{
  // Squares of tiny lengths are 0: any corner is near enough then.
  const auto part = [](double some, double all) { return all != 0.0 ? some / all : 0.0; };
  const Vec<3> ab = t[1] - t[0], ac = t[2] - t[0], ax = x - t[0];
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return t[0];
  }
  const Vec<3> bx = x - t[1];
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return t[1];
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return t[0] + ab * part(d1, d1 - d3);
  }
  const Vec<3> cx = x - t[2];
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6)
  {
    return t[2];
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return t[0] + ac * part(d2, d2 - d6);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
  {
    return t[1] + (t[2] - t[1]) * part(d4 - d3, (d4 - d3) + (d5 - d6));
  }
  const double sum = va + vb + vc;
  return t[0] + ab * part(vb, sum) + ac * part(vc, sum);
}
}

#endif
