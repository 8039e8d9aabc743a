// SPDX-License-Identifier: BSD-3-Clause
/// @file ShapeGeometry.h
/// Parts of the shape measures besides determinants and edges: facet normals and angles, with
/// gradients.
#ifndef meshopt_Quality_ShapeGeometry_h
#define meshopt_Quality_ShapeGeometry_h

#include "Mesh/SimplexGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshopt
{
/// Normals of the facets of a tetrahedron: n[i], opposite to node i, points out of a positive one
/// and has twice the facet's area. Each is computed only from the facet's own nodes. So for a
/// collapsed facet it is 0 up to rounding, wherever the other node is.
struct TetNormals
{
  /// n[i] = orientation * (f1 - f0) x (f2 - f0), with f = Local<3>::facets[i].
  static constexpr double orientation = -1.0;
  Vec<3> n[4];

  explicit TetNormals(const Corners<3>& x)
  {
    for (int i = 0; i < 4; ++i)
    {
      const int* f = Local<3>::facets[i];
      this->n[i] = (x[f[2]] - x[f[0]]).cross(x[f[1]] - x[f[0]]);
    }
  }
};

/// Angles of a simplex: between the facets at an edge (3D), between the edges at a node (2D).
template <int D>
struct AngleKernel;

template <>
struct AngleKernel<2>
{
  /// The least angle (of the mirrored triangle if inverted), as sine and cosine times a common
  /// positive factor; the sine has the sign of the area. Returns the node; -1 if an edge is
  /// collapsed (then 0, 1).
  static int least(const Corners<2>& x, double& sine, double& cosine)
  {
    sine = volumeDeterminant(x);
    // The least angle is opposite to the shortest edge.
    int node = 2;
    double shortest = squaredEdge(x, 0);
    for (int e = 1; e < 3; ++e)
    {
      const double l = squaredEdge(x, e);
      if (l < shortest)
      {
        shortest = l;
        node = 2 - e; // opposite to edge e: see Local<2>::edges
      }
    }
    if (shortest == 0.0)
    {
      sine = 0.0;
      cosine = 1.0;
      return -1;
    }
    cosine = (x[(node + 1) % 3] - x[node]).dot(x[(node + 2) % 3] - x[node]);
    return node;
  }

  /// Gradient, in radians, of the signed angle at a node; its two edges must not be collapsed.
  static void gradient(const Corners<2>& x, int node, std::array<Vec<2>, 3>& g)
  {
    const int b = (node + 1) % 3, c = (node + 2) % 3;
    const Vec<2> u = x[b] - x[node], v = x[c] - x[node];
    const double uu = u.squaredNorm(), vv = v.squaredNorm();
    // An end turns its edge by its motion across the edge, divided by the length. A translation of
    // all three nodes changes nothing.
    g[b] << u[1] / uu, -u[0] / uu;
    g[c] << -v[1] / vv, v[0] / vv;
    g[node] = -(g[b] + g[c]);
  }
};

template <>
struct AngleKernel<3>
{
  /// The two facets at edge e: those opposite to the two nodes that are not on it.
  static constexpr int facets[6][2] = { { 2, 3 }, { 1, 3 }, { 1, 2 }, { 0, 3 }, { 0, 2 },
    { 0, 1 } };

  /// The same as in 2D for the dihedral angles. Returns the edge; -1 if a facet is collapsed.
  static int least(const Corners<3>& x, double& sine, double& cosine)
  {
    const TetNormals n(x);
    double inverse[4];
    for (int i = 0; i < 4; ++i)
    {
      const double nn = n.n[i].squaredNorm();
      if (nn == 0.0)
      {
        sine = 0.0;
        cosine = 1.0;
        return -1;
      }
      inverse[i] = 1.0 / std::sqrt(nn);
    }
    // The least angle has the greatest cosine: no arc function in the loop. Normals point outwards,
    // so that their cosine is minus that of the dihedral angle.
    int edge = 0;
    double greatest = -2.0;
    for (int e = 0; e < 6; ++e)
    {
      const int i = facets[e][0], j = facets[e][1];
      const double c = -n.n[i].dot(n.n[j]) * inverse[i] * inverse[j];
      if (c > greatest)
      {
        greatest = c;
        edge = e;
      }
    }
    // Both times |n_i| |n_j|. The sine comes from the volume, whose sign it has to have.
    sine = volumeDeterminant(x) * std::sqrt(squaredEdge(x, edge));
    cosine = -n.n[facets[edge][0]].dot(n.n[facets[edge][1]]);
    return edge;
  }

  /// Gradient, in radians, of the signed dihedral angle at edge e; both its facets must have an
  /// area.
  static void gradient(const Corners<3>& x, int e, std::array<Vec<3>, 4>& g)
  {
    const int a = Local<3>::edges[e][0], b = Local<3>::edges[e][1];
    const Vec<3> v = x[b] - x[a];
    const double vv = v.squaredNorm(), l = std::sqrt(vv);
    const TetNormals n(x);
    g[a].setZero();
    g[b].setZero();
    for (int k = 0; k < 2; ++k)
    {
      // Node c turns its facet (a, b, c) about the edge; a and b turn it back, by leverage. The
      // height of c above the edge is |n| / l, the lever.
      const int c = facets[e][k], f = facets[e][1 - k];
      g[c] = n.n[f] * (l / n.n[f].squaredNorm());
      const double t = (x[c] - x[a]).dot(v) / vv;
      g[a] -= (1.0 - t) * g[c];
      g[b] -= t * g[c];
    }
  }
};

/// The least sine of the angles, with the sign of the volume; that of obtuse angles times `weight`.
template <int D>
struct SineKernel;

template <>
struct SineKernel<2>
{
  static constexpr double regular = 0.8660254037844386; ///< sin 60

  /// Squared least weighted sine over det^2, and its node; -1 if an edge is collapsed. All sines
  /// have the factor det: they are compared without it, and without roots.
  static int least(const Corners<2>& x, double weight, double& factor)
  {
    int node = -1;
    for (int i = 0; i < 3; ++i)
    {
      const Vec<2> u = x[(i + 1) % 3] - x[i], v = x[(i + 2) % 3] - x[i];
      const double d = u.squaredNorm() * v.squaredNorm();
      if (d == 0.0)
      {
        factor = 0.0;
        return -1;
      }
      const double f = (u.dot(v) < 0.0 ? weight * weight : 1.0) / d;
      if (node < 0 || f < factor)
      {
        factor = f;
        node = i;
      }
    }
    return node;
  }
  /// The least weighted sine.
  static double value(const Corners<2>& x, double weight)
  {
    double factor = 0.0;
    least(x, weight, factor);
    return volumeDeterminant(x) * std::sqrt(factor);
  }
  /// The same with its gradient, which is 0 if an edge is collapsed.
  static double gradient(const Corners<2>& x, double weight, std::array<Vec<2>, 3>& g)
  {
    double factor = 0.0;
    const int i = least(x, weight, factor);
    if (i < 0)
    {
      return setZero<2>(g);
    }
    const Vec<2> u = x[(i + 1) % 3] - x[i], v = x[(i + 2) % 3] - x[i];
    const double c = u.dot(v);
    const double cosine = c / std::sqrt(u.squaredNorm() * v.squaredNorm());
    // d sin = cos d(angle)
    AngleKernel<2>::gradient(x, i, g);
    for (Vec<2>& ga : g)
    {
      ga *= (c < 0.0 ? weight : 1.0) * cosine;
    }
    return volumeDeterminant(x) * std::sqrt(factor);
  }
};

template <>
struct SineKernel<3>
{
  static constexpr double regular = 0.9428090415820634; ///< sin 70.53

  /// The same as in 2D, with sine = det l / (|n_i| |n_j|) at the edge of length l between facets i
  /// and j.
  static int least(const Corners<3>& x, double weight, double& factor)
  {
    const TetNormals n(x);
    double nn[4];
    for (int i = 0; i < 4; ++i)
    {
      nn[i] = n.n[i].squaredNorm();
    }
    int edge = -1;
    for (int e = 0; e < 6; ++e)
    {
      const int i = AngleKernel<3>::facets[e][0], j = AngleKernel<3>::facets[e][1];
      const double d = nn[i] * nn[j];
      if (d == 0.0)
      {
        factor = 0.0;
        return -1;
      }
      double f = squaredEdge(x, e) / d;
      // Outward normals in about the same direction: the angle between the facets is obtuse.
      if (weight < 1.0 && n.n[i].dot(n.n[j]) > 0.0)
      {
        f *= weight * weight;
      }
      if (edge < 0 || f < factor)
      {
        factor = f;
        edge = e;
      }
    }
    return edge;
  }
  /// The least weighted sine.
  static double value(const Corners<3>& x, double weight)
  {
    double factor = 0.0;
    least(x, weight, factor);
    return volumeDeterminant(x) * std::sqrt(factor);
  }
  /// The same with its gradient, which is 0 if a facet is collapsed.
  static double gradient(const Corners<3>& x, double weight, std::array<Vec<3>, 4>& g)
  {
    double factor = 0.0;
    const int e = least(x, weight, factor);
    if (e < 0)
    {
      return setZero<3>(g);
    }
    const TetNormals n(x);
    const Vec<3>&u = n.n[AngleKernel<3>::facets[e][0]], &v = n.n[AngleKernel<3>::facets[e][1]];
    const double c = -u.dot(v);
    const double cosine = c / std::sqrt(u.squaredNorm() * v.squaredNorm());
    AngleKernel<3>::gradient(x, e, g);
    for (Vec<3>& ga : g)
    {
      ga *= (c < 0.0 ? weight : 1.0) * cosine;
    }
    return volumeDeterminant(x) * std::sqrt(factor);
  }
};
}

#endif
