// SPDX-License-Identifier: BSD-3-Clause
/// @file Predicates.h
/// Exact signs of areas and volumes.
///
/// Reference: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates" (1997). Written from the paper, with one filter and one exact stage.
///
/// Exact means: the sign of the determinant of the given coordinates, as if computed with infinite
/// precision. This holds for finite coordinates that are 0 or of a size between 1e-80 and 1e+100,
/// in round-to-nearest IEEE double precision, without fused multiply-add (-ffp-contract=off) and
/// without fast-math.
#ifndef meshopt_Mesh_Predicates_h
#define meshopt_Mesh_Predicates_h

#include "Mesh/Types.h"

namespace meshopt
{
/// 1 if the triangle (a, b, c) is positive (counter-clockwise), -1 if it is inverted, 0 if its
/// nodes are exactly collinear.
int orient(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c);

/// 1 if the tetrahedron (a, b, c, d) is positive: det(b - a, c - a, d - a) > 0. -1 if it is
/// inverted, 0 if its nodes are exactly coplanar. Some 5 ns; some microseconds if nearly coplanar.
int orient(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d);

/// Exact sign of the volume (area) of a simplex.
inline int orientation(const Corners<2>& x) { return orient(x[0], x[1], x[2]); }
inline int orientation(const Corners<3>& x) { return orient(x[0], x[1], x[2], x[3]); }
}

#endif
