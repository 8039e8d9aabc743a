// SPDX-License-Identifier: BSD-3-Clause
/// @file Shape.h
/// Shape measures of one simplex, as functors: values and analytic gradients.
///
/// References: Buscaglia, Dari, Zavattieri (1996), (2.3), for S; Shewchuk, "What is a good linear
/// element?" (2002), for the others.
///
/// All of them have these properties, which one battery of tests checks:
///  - they have a name, and regular: the value of the regular simplex, the greatest possible one;
///  - value(x) is dimensionless (degrees for MinimumAngleShape), and unchanged by translation,
///    rotation and scale; scaling by a power of two gives the same bits;
///  - it has the sign of the volume: value(mirrored element) = -value(element);
///  - it is 0 for an element without volume, even if nodes or the whole element coincide: nothing
///    is divided by the volume;
///  - it is NaN if a coordinate is not finite;
///  - gradient(x, g) returns the value and sets g[a] = d value / d x_a, in 1 / unit of length. For
///    a minimum over edges or angles it is the gradient of the term that attains the minimum, the
///    first in local numbering if there are several.
///
/// The range of safe sizes is wide: no intermediate result overflows or underflows for edges
/// between 1e-30 and 1e+30 units of length.
#ifndef meshopt_Quality_Shape_h
#define meshopt_Quality_Shape_h

#include "Quality/ShapeGeometry.h"

namespace meshopt
{
/// The paper's S = c V / P^D (2.3), with P the sum of the edge lengths; c = 36 / sqrt(3) in 2D,
/// 1296 sqrt(2) in 3D, which makes S = 1 for the regular simplex.
template <int D>
struct MeanEdgeShape
{
  static constexpr const char* name = "Shape";
  static constexpr double regular = 1.0;
  /// c of (2.3); the paper prints 20.78 and 1832.82.
  static constexpr double constant = D == 2 ? 20.784609690826528 : 1832.8207768355312;

  static double value(const Corners<D>& x)
  {
    // 0 only if all nodes coincide. V is det / D!, and keeps its sign.
    const double p = sumOfEdges(x);
    if constexpr (D == 2)
    {
      return p == 0.0 ? 0.0 : (0.5 * constant) * volumeDeterminant(x) / (p * p);
    }
    else
    {
      return p == 0.0 ? 0.0 : (constant / 6.0) * volumeDeterminant(x) / (p * p * p);
    }
  }

  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    std::array<Vec<D>, D + 1> p;
    const double det = volumeDeterminantGradient(x, g);
    const double perimeter = sumOfEdgesGradient(x, p);
    if (perimeter == 0.0)
    {
      return setZero<D>(g);
    }
    const double power = D == 2 ? perimeter * perimeter : perimeter * perimeter * perimeter;
    const double scale = (D == 2 ? 0.5 * constant : constant / 6.0) / power;
    const double s = scale * det;
    // grad S = c / P^D grad V - D S / P grad P. Nothing is divided by V: it is smooth at V = 0.
    const double slope = D * s / perimeter;
    for (int a = 0; a <= D; ++a)
    {
      g[a] = scale * g[a] - slope * p[a];
    }
    return s;
  }

private:
  static double sumOfEdges(const Corners<D>& x);
  static double sumOfEdgesGradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g);
};

template <int D>
inline double MeanEdgeShape<D>::sumOfEdges(const Corners<D>& x)
{
  constexpr int n = Local<D>::numberOfEdges;
  double l[n];
  // Two loops: the compiler can then take several roots at once.
  for (int e = 0; e < n; ++e)
  {
    l[e] = squaredEdge(x, e);
  }
  for (int e = 0; e < n; ++e)
  {
    l[e] = std::sqrt(l[e]);
  }
  if constexpr (D == 2)
  {
    return l[0] + l[1] + l[2];
  }
  else
  {
    return ((l[0] + l[1]) + (l[2] + l[3])) + (l[4] + l[5]);
  }
}

template <int D>
inline double MeanEdgeShape<D>::sumOfEdgesGradient(
  const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
{
  setZero<D>(g);
  constexpr int n = Local<D>::numberOfEdges;
  double l[n];
  for (int e = 0; e < n; ++e)
  {
    const int a = Local<D>::edges[e][0], b = Local<D>::edges[e][1];
    const Vec<D> v = x[b] - x[a];
    l[e] = std::sqrt(v.squaredNorm());
    const Vec<D> u = v * (l[e] > 0.0 ? 1.0 / l[e] : 0.0); // a collapsed edge has no direction
    g[b] += u;
    g[a] -= u;
  }
  if constexpr (D == 2)
  {
    return l[0] + l[1] + l[2];
  }
  else
  {
    return ((l[0] + l[1]) + (l[2] + l[3])) + (l[4] + l[5]);
  }
}

/// V / l_rms^D, normalized: 6 sqrt(2) V / l_rms^3 in 3D, 4 A / (sqrt(3) l_rms^2) in 2D. Smooth.
template <int D>
struct VolumeLengthShape
{
  static constexpr const char* name = "VolumeLength";
  static constexpr double regular = 1.0;
  /// Factor of det / (sum of squared edges)^(D/2): 2 sqrt(3), 12 sqrt(3). It follows from V = det /
  /// D! and l_rms^2 = sum / 3 in 2D, sum / 6 in 3D.
  static constexpr double constant = D == 2 ? 3.4641016151377544 : 20.784609690826528;

  static double value(const Corners<D>& x)
  {
    const double s = sumOfSquaredEdges(x);
    return s == 0.0 ? 0.0 : constant * volumeDeterminant(x) / power(s);
  }

  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    const double det = volumeDeterminantGradient(x, g);
    const double s = sumOfSquaredEdges(x);
    if (s == 0.0)
    {
      return setZero<D>(g);
    }
    const double scale = constant / power(s);
    const double q = scale * det;
    for (int a = 0; a <= D; ++a)
    {
      g[a] = scale * g[a] - (D * q / s) * sumOfDifferences<D + 1, D>(x, a);
    }
    return q;
  }

private:
  static double power(double s) { return D == 2 ? s : s * std::sqrt(s); }
};

/// Mean ratio: 12 (3 V)^(2/3) / sum l^2 in 3D; 4 sqrt(3) A / sum l^2 in 2D (the same as
/// VolumeLengthShape).
///
/// In 3D the slope is infinite at V = 0. The gradient therefore limits V^(-1/3) to its value at V =
/// 1e-12 times the cube of the rms edge length: it stays finite and keeps its direction.
template <int D>
struct MeanRatioShape
{
  static constexpr const char* name = "MeanRatio";
  static constexpr double regular = 1.0;
  static double value(const Corners<D>& x)
  {
    if constexpr (D == 2)
    {
      return VolumeLengthShape<2>::value(x);
    }
    else
    {
      const double s = sumOfSquaredEdges(x);
      const double r = cubeRoot(0.5 * volumeDeterminant(x));
      return s == 0.0 ? 0.0 : 12.0 * r * std::fabs(r) / s;
    }
  }

  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    if constexpr (D == 2)
    {
      return VolumeLengthShape<2>::gradient(x, g);
    }
    else
    {
      const double det = volumeDeterminantGradient(x, g);
      const double s = sumOfSquaredEdges(x);
      if (s == 0.0)
      {
        return setZero<3>(g);
      }
      const double r = cubeRoot(0.5 * det); // (3 V)^(1/3)
      const double q = 12.0 * r * std::fabs(r) / s;
      // d (r |r|) = 2 |r| dr, and dr = d det / (6 r^2). With s = 6 l_rms^2, 6e-5 sqrt(s) is |r| at
      // V = 1e-12 l_rms^3.
      const double slope = 4.0 / (std::max(std::fabs(r), 6e-5 * std::sqrt(s)) * s);
      for (int a = 0; a < 4; ++a)
      {
        g[a] = slope * g[a] - (2.0 * q / s) * sumOfDifferences<4, 3>(x, a);
      }
      return q;
    }
  }
};

/// Radius ratio D r / R, with r of the inscribed and R of the circumscribed sphere (circle).
template <int D>
struct RadiusRatioShape
{
  static constexpr const char* name = "RadiusRatio";
  static constexpr double regular = 1.0;
  static double value(const Corners<D>& x)
  {
    const double det = volumeDeterminant(x);
    double d;
    // det^2 as det |det|: the measure keeps the sign of the volume.
    if constexpr (D == 2)
    {
      // With p the perimeter, r = det / p and R = product of the edges / (2 det).
      double l[3];
      for (int e = 0; e < 3; ++e)
      {
        l[e] = std::sqrt(squaredEdge(x, e));
      }
      d = (l[0] + l[1] + l[2]) * (l[0] * l[1] * l[2]);
      return d == 0.0 ? 0.0 : 4.0 * det * std::fabs(det) / d;
    }
    else
    {
      // With the sum of |n_i|, twice the surface, r = det / sum; R = |circumVector| / (2 det).
      const TetNormals n(x);
      double area = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        area += std::sqrt(n.n[i].squaredNorm());
      }
      d = area * std::sqrt(circumVector(x).squaredNorm());
      return d == 0.0 ? 0.0 : 6.0 * det * std::fabs(det) / d;
    }
  }

  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    if constexpr (D == 2)
    {
      return gradient2(x, g);
    }
    else
    {
      return gradient3(x, g);
    }
  }

private:
  /// 2 det R, as a vector from node 0 towards the circumcentre; D = 3.
  static Vec<3> circumVector(const Corners<3>& x)
  {
    const Vec<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    return a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) +
      c.squaredNorm() * a.cross(b);
  }
  static double gradient2(const Corners<2>& x, std::array<Vec<2>, 3>& g);
  static double gradient3(const Corners<3>& x, std::array<Vec<3>, 4>& g);
};

template <int D>
inline double RadiusRatioShape<D>::gradient2(const Corners<2>& x, std::array<Vec<2>, 3>& g)
{
  const double det = volumeDeterminantGradient(x, g);
  double l[3];
  for (int e = 0; e < 3; ++e)
  {
    l[e] = std::sqrt(squaredEdge(x, e));
  }
  const double p = l[0] + l[1] + l[2];
  const double d = p * (l[0] * l[1] * l[2]);
  if (d == 0.0)
  {
    return setZero<2>(g);
  }
  const double q = 4.0 * det * std::fabs(det) / d;
  const double slope = 8.0 * std::fabs(det) / d;
  for (Vec<2>& ga : g)
  {
    ga *= slope;
  }
  for (int e = 0; e < 3; ++e)
  {
    // d ln(denominator) / d l_e = 1 / p + 1 / l_e
    const int a = Local<2>::edges[e][0], b = Local<2>::edges[e][1];
    const Vec<2> t = (q * (1.0 / p + 1.0 / l[e]) / l[e]) * (x[b] - x[a]);
    g[b] -= t;
    g[a] += t;
  }
  return q;
}

template <int D>
inline double RadiusRatioShape<D>::gradient3(const Corners<3>& x, std::array<Vec<3>, 4>& g)
{
  const double det = volumeDeterminantGradient(x, g);
  const TetNormals n(x);
  double norms[4];
  for (int i = 0; i < 4; ++i)
  {
    norms[i] = std::sqrt(n.n[i].squaredNorm());
  }
  const double area = ((norms[0] + norms[1]) + norms[2]) + norms[3];
  const Vec<3> w = circumVector(x);
  const double radius = std::sqrt(w.squaredNorm());
  const double d = area * radius;
  if (d == 0.0)
  {
    return setZero<3>(g);
  }
  const double q = 6.0 * det * std::fabs(det) / d;
  const double slope = 12.0 * std::fabs(det) / d;
  for (Vec<3>& ga : g)
  {
    ga *= slope;
  }
  for (int i = 0; i < 4; ++i)
  {
    const Vec<3> u = n.n[i] * (norms[i] > 0.0 ? q / (area * norms[i]) : 0.0);
    const int* f = Local<3>::facets[i];
    for (int k = 0; k < 3; ++k)
    {
      // d |n| / d x_k = (next - after next) x unit normal
      g[f[k]] -= (x[f[(k + 1) % 3]] - x[f[(k + 2) % 3]]).cross(u) * TetNormals::orientation;
    }
  }
  // d ln |w| = w . dw / |w|^2. By a, dw = 2 (a . da) b x c + b^2 c x da + c^2 da x b; the other
  // edges follow in cyclic order. Node 0 is in all three.
  const Vec<3> u = w * (q / (radius * radius));
  const Vec<3> e[3] = { x[1] - x[0], x[2] - x[0], x[3] - x[0] };
  for (int k = 0; k < 3; ++k)
  {
    const Vec<3>&a = e[k], &b = e[(k + 1) % 3], &c = e[(k + 2) % 3];
    const Vec<3> t = 2.0 * u.dot(b.cross(c)) * a + b.squaredNorm() * u.cross(c) +
      c.squaredNorm() * b.cross(u);
    g[k + 1] -= t;
    g[0] += t;
  }
  return q;
}

/// The least sine of the dihedral angles (3D) or of the corner angles (2D), unweighted. The regular
/// simplex has the greatest value: sin 70.53 = .9428 (in 2D sin 60 = .8660). It is 0 for angles of
/// 0 and of 180 degrees.
template <int D>
struct MinimumSineShape
{
  static constexpr const char* name = "MinimumSine";
  static constexpr double regular = SineKernel<D>::regular;
  static double value(const Corners<D>& x) { return SineKernel<D>::value(x, 1.0); }
  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    return SineKernel<D>::gradient(x, 1.0, g);
  }
};

/// The same with the sines of obtuse angles times .75, to penalize large angles; jumps at 90
/// degrees.
template <int D>
struct WarpedSineShape
{
  static constexpr const char* name = "WarpedSine";
  static constexpr double regular = SineKernel<D>::regular;
  static constexpr double weight = 0.75;
  static double value(const Corners<D>& x) { return SineKernel<D>::value(x, weight); }
  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    return SineKernel<D>::gradient(x, weight, g);
  }
};

/// The least dihedral (3D) or corner (2D) angle in degrees: 70.53 (60) for the regular simplex.
template <int D>
struct MinimumAngleShape
{
  static constexpr const char* name = "MinimumDihedralAngle";
  static constexpr double regular = D == 2 ? 60.0 : 70.52877936550931;
  static double value(const Corners<D>& x)
  {
    double sine, cosine;
    AngleKernel<D>::least(x, sine, cosine);
    return angle(sine, cosine);
  }
  static double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g)
  {
    double sine, cosine;
    const int i = AngleKernel<D>::least(x, sine, cosine);
    if (i < 0)
    {
      return setZero<D>(g);
    }
    AngleKernel<D>::gradient(x, i, g);
    for (Vec<D>& ga : g)
    {
      ga *= degree;
    }
    return angle(sine, cosine);
  }

private:
  /// In degrees. The sum makes it NaN for infinite arguments, for which atan2() would give a
  /// number.
  static double angle(double sine, double cosine)
  {
    return std::atan2(sine, cosine) * degree + 0.0 * (sine + cosine);
  }
  static constexpr double degree = 57.295779513082323;
};
}

#endif
