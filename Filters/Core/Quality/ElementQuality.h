// SPDX-License-Identifier: BSD-3-Clause
/// @file ElementQuality.h
/// Quality of one element and its gradient, for a given shape measure.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), (2.2): Q = S exp(-beta^2 ln^2(h / h*)).
#ifndef meshopt_Quality_ElementQuality_h
#define meshopt_Quality_ElementQuality_h

#include "Metric/ElementMetric.h"
#include "Quality/Measures.h"

#include <cmath>
#include <utility>

namespace meshopt
{
/// The size factor phi = exp(-t), t = beta^2 ln^2(h / h*) >= 0, and its derivative by t.
///
/// In floating point exp(-t) is 0 from t = 745 on. All elements far from h* would then be equally
/// bad, with no way out. So from t = 500 on (phi < 1e-217) it is continued with the same slope by
/// exp(-500) / (1 + t - 500), which keeps falling. (2.2) thus holds to the last bit wherever it
/// differs from 0, and the order of elements remains that of ln Q.
inline double sizeFactor(double t, double& slope)
{
  constexpr double last = 500.0;
  if (t <= last)
  {
    const double phi = std::exp(-t);
    slope = -phi;
    return phi;
  }
  const double u = 1.0 / (1.0 + (t - last));
  const double phi = std::exp(-last) * u;
  slope = -phi * u;
  return phi;
}

/// Q of an element. Shape is one of the functors of Shape.h, or AnyShape, with
///   double value(const Corners<D>& x);
///   double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g); // returns value
///
/// The element is measured in the metric M: its corners are first mapped by M^(1/2). h is its
/// longest edge there (the paper's diameter). The size factor applies if beta > 0, h* > 0 and S >
/// 0.
template <int D, class Shape>
struct ElementQuality
{
  double beta = 0.0; ///< width of the size factor (2.2), >= 0
  Shape shape{};

  /// S phi; S if S <= 0 (inverted elements are compared by shape alone).
  double value(const Corners<D>& x, const ElementMetric<D>& m) const;
  /// The same with its gradient with respect to every node, in 1 / unit of length. The gradient of
  /// the diameter is that of the longest edge, the first in local numbering if there are several.
  /// For h < h* it is the gradient of a max-type function: trust only a measured increase.
  double gradient(
    const Corners<D>& x, const ElementMetric<D>& m, std::array<Vec<D>, D + 1>& g) const;

private:
  bool hasSize(const ElementMetric<D>& m) const { return this->beta > 0.0 && m.desiredSize > 0.0; }

  /// Local number of the longest edge; h2 is its squared length. Squares are compared: one root in
  /// place of one per edge.
  static int longestEdge(const Corners<D>& x, double& h2)
  {
    int edge = 0;
    h2 = squaredEdge(x, 0);
    for (int e = 1; e < Local<D>::numberOfEdges; ++e)
    {
      const double l = squaredEdge(x, e);
      if (l > h2)
      {
        h2 = l;
        edge = e;
      }
    }
    return edge;
  }

  static Corners<D> mapped(const Corners<D>& x, const Tensor<D>& map)
  {
    Corners<D> y;
    for (int a = 0; a <= D; ++a)
    {
      // Relative to node 0, so that an element far from the origin loses no digits.
      y[a] = map * (x[a] - x[0]);
    }
    return y;
  }
};

template <int D, class Shape>
inline double ElementQuality<D, Shape>::value(const Corners<D>& x, const ElementMetric<D>& m) const
{
  // The usual case: nothing is mapped or copied.
  if (m.euclidean && !this->hasSize(m))
  {
    return this->shape.value(x);
  }
  const Corners<D> y = m.euclidean ? x : mapped(x, m.map);
  const double s = this->shape.value(y);
  if (!(s > 0.0) || !this->hasSize(m))
  {
    return s;
  }
  double h2, slope;
  longestEdge(y, h2);
  const double l = this->beta * std::log(std::sqrt(h2) / m.desiredSize);
  return s * sizeFactor(l * l, slope);
}

template <int D, class Shape>
inline double ElementQuality<D, Shape>::gradient(
  const Corners<D>& x, const ElementMetric<D>& m, std::array<Vec<D>, D + 1>& g) const
{
  const Corners<D> y = m.euclidean ? x : mapped(x, m.map);
  double q = this->shape.gradient(y, g);
  if (q > 0.0 && this->hasSize(m))
  {
    double h2, slope;
    const int e = longestEdge(y, h2);
    const double l = this->beta * std::log(std::sqrt(h2) / m.desiredSize);
    const double phi = sizeFactor(l * l, slope);
    for (Vec<D>& ga : g)
    {
      ga *= phi;
    }
    // dt = 2 beta l dh / h, dh = (edge / h) . (dx_b - dx_a)
    const int a = Local<D>::edges[e][0], b = Local<D>::edges[e][1];
    const Vec<D> t = (q * slope * 2.0 * this->beta * l / h2) * (y[b] - y[a]);
    g[b] += t;
    g[a] -= t;
    q *= phi;
  }
  if (!m.euclidean)
  {
    // Back through y = M^(1/2) x. M is frozen: that it changes with the place of the node is no
    // part of the gradient.
    for (Vec<D>& ga : g)
    {
      ga = (m.map.transpose() * ga).eval();
    }
  }
  return q;
}
}

#endif
