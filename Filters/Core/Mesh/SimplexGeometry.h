// SPDX-License-Identifier: BSD-3-Clause
/// @file SimplexGeometry.h
/// Determinants and edges of a simplex, with gradients.
#ifndef meshopt_Mesh_SimplexGeometry_h
#define meshopt_Mesh_SimplexGeometry_h

#include "Mesh/Types.h"

#include <Eigen/Geometry>

#include <cmath>

namespace meshopt
{
/// Sets all gradients to zero. Returns 0, the value that belongs to them.
template <int D>
inline double setZero(std::array<Vec<D>, D + 1>& g)
{
  for (Vec<D>& ga : g)
  {
    ga.setZero();
  }
  return 0.0;
}

inline double squaredEdge(const Corners<2>& x, int e)
{
  const Vec<2>&a = x[Local<2>::edges[e][0]], &b = x[Local<2>::edges[e][1]];
  const double u = b[0] - a[0], v = b[1] - a[1];
  return u * u + v * v;
}

inline double squaredEdge(const Corners<3>& x, int e)
{
  const Vec<3>&a = x[Local<3>::edges[e][0]], &b = x[Local<3>::edges[e][1]];
  const double u = b[0] - a[0], v = b[1] - a[1], w = b[2] - a[2];
  return (u * u + v * v) + w * w;
}

inline double sumOfSquaredEdges(const Corners<2>& x)
{
  return squaredEdge(x, 0) + squaredEdge(x, 1) + squaredEdge(x, 2);
}

inline double sumOfSquaredEdges(const Corners<3>& x)
{
  return ((squaredEdge(x, 0) + squaredEdge(x, 1)) + (squaredEdge(x, 2) + squaredEdge(x, 3))) +
    (squaredEdge(x, 4) + squaredEdge(x, 5));
}

/// Half the gradient of the sum of squared edges with respect to x_a: sum_b (x_a - x_b). Computed
/// from differences only, so that it is as accurate far from the origin as near it.
template <std::size_t N, int D>
inline Eigen::Matrix<double, D, 1, Eigen::DontAlign> sumOfDifferences(
  const std::array<Eigen::Matrix<double, D, 1, Eigen::DontAlign>, N>& x, std::size_t a)
{
  Eigen::Matrix<double, D, 1, Eigen::DontAlign> s = x[a] - x[0];
  for (std::size_t b = 1; b < N; ++b)
  {
    s += x[a] - x[b];
  }
  return s;
}

/// Not EIGEN_PI, which is a long double.
inline constexpr double Pi = 3.14159265358979323846;

constexpr double cubed(double x) { return x * x * x; }

/// Cube root. If x is scaled by a power of eight, the result keeps its bits: std::cbrt() does not.
inline double cubeRoot(double x)
{
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  const int shift = exponent + 3000; // not negative for any double, 0 included
  const int third = shift / 3;
  return std::ldexp(std::cbrt(std::ldexp(mantissa, shift - 3 * third)), third - 1000);
}

/// D! times the signed volume.
inline double volumeDeterminant(const Corners<2>& x)
{
  const Vec<2> a = x[1] - x[0], b = x[2] - x[0];
  return a[0] * b[1] - a[1] * b[0];
}

inline double volumeDeterminant(const Corners<3>& x)
{
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The same with its gradient.
inline double volumeDeterminantGradient(const Corners<2>& x, std::array<Vec<2>, 3>& g)
{
  const Vec<2> a = x[1] - x[0], b = x[2] - x[0];
  g[1] << b[1], -b[0];
  g[2] << -a[1], a[0];
  g[0] = -(g[1] + g[2]);
  return a[0] * b[1] - a[1] * b[0];
}

inline double volumeDeterminantGradient(const Corners<3>& x, std::array<Vec<3>, 4>& g)
{
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  g[1] = b.cross(c);
  g[2] = c.cross(a);
  g[3] = a.cross(b);
  g[0] = -(g[1] + g[2] + g[3]);
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}
}

#endif
