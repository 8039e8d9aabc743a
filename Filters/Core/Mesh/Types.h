// SPDX-License-Identifier: BSD-3-Clause
/// @file Types.h
/// Index and coordinate types of the core, and the local numbering of a simplex.
#ifndef meshopt_Mesh_Types_h
#define meshopt_Mesh_Types_h

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace meshopt
{
/// Id of a point or a cell. 32 bits: at most 2^29 cells, since a facet handle is 4 * cell + facet.
using Index = std::int32_t;
inline constexpr Index None = -1;
inline constexpr long MaximumNumberOfCells = 1L << 29;

/// A point or vector of D coordinates; not over-aligned, so that records stay packed.
template <int D>
using Vec = Eigen::Matrix<double, D, 1, Eigen::DontAlign>;

/// A D x D tensor (metric, Hessian, Jacobian).
template <int D>
using Tensor = Eigen::Matrix<double, D, D, Eigen::DontAlign>;

/// Point ids of a simplex: a triangle (D = 2) or a tetrahedron (D = 3). It is positively oriented
/// if det(x1 - x0, ..., xD - x0) > 0, which is VTK's convention.
template <int D>
using Simplex = std::array<Index, D + 1>;

/// Coordinates of the nodes of a simplex, in the order of its ids.
template <int D>
using Corners = std::array<Vec<D>, D + 1>;

/// Point ids of a facet: an edge (D = 2) or a triangle (D = 3).
template <int D>
using Facet = std::array<Index, D>;

/// Local numbering. Facet i is opposite to node i. (Facet nodes, node i) is an even permutation of
/// the simplex: if a point on the same side of the facet replaces node i, the simplex is positive
/// again.
///
///        2                  3          Facets of a triangle: 0 = (1 2), 1 = (2 0), 2 = (0 1).
///       / \                /|\         Facets of a tetrahedron, counter-clockwise from inside:
///     1/   \0             / | \        0 = (1 3 2), 1 = (0 2 3), 2 = (0 3 1), 3 = (0 1 2).
///     /     \            0- | -2
///    0-------1            \ | /
///        2                  1
///
/// edgeFirst[e] is an even permutation of the simplex that begins with an edge: in 2D that of facet
/// e, in 3D edges[e].
template <int D>
struct Local;

template <>
struct Local<2>
{
  static constexpr int facets[3][2] = { { 1, 2 }, { 2, 0 }, { 0, 1 } };
  static constexpr int edges[3][2] = { { 0, 1 }, { 0, 2 }, { 1, 2 } };
  static constexpr int edgeFirst[3][3] = { { 1, 2, 0 }, { 2, 0, 1 }, { 0, 1, 2 } };
  static constexpr int numberOfEdges = 3;
};

template <>
struct Local<3>
{
  static constexpr int facets[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  static constexpr int edges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };
  static constexpr int edgeFirst[6][4] = { { 0, 1, 2, 3 }, { 0, 2, 3, 1 }, { 0, 3, 1, 2 },
    { 1, 2, 0, 3 }, { 1, 3, 2, 0 }, { 2, 3, 0, 1 } };
  static constexpr int numberOfEdges = 6;
};

/// Signed volume (D = 3) or area (D = 2) of a simplex.
inline double signedVolume(const Corners<2>& x)
{
  const Vec<2> a = x[1] - x[0], b = x[2] - x[0];
  return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

inline double signedVolume(const Corners<3>& x)
{
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0])) /
    6.0;
}
}

#endif
