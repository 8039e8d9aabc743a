// SPDX-License-Identifier: BSD-3-Clause
/// @file ApexBound.h
/// The best shape an element can have when part of it is given: upper bounds that no mesh can beat.
///
/// In all cases S = c V / P^3 (2.3) is maximized over where the free node is. V is affine and P
/// convex in one node, so V^(1/3) - lambda P is concave, and there is one maximum. It is found by
/// Newton's method on that function, lambda being the best V^(1/3) / P so far (Dinkelbach), and
/// what the last gradient leaves open is added: the result is never less than the maximum (but for
/// rounding errors of some 1e-15).
#ifndef meshopt_Bound_ApexBound_h
#define meshopt_Bound_ApexBound_h

#include "Mesh/Types.h"

#include <limits>

namespace meshopt
{
/// Greatest S of a tetrahedron one of whose facets is (a, b, c): in [0, 1], 1 for a regular facet,
/// 0 for a collapsed one; 1 (nothing known) if a coordinate is not finite. Where the maximum is
/// above `enough`, the result may be any value from `enough` to the maximum's bound, which is
/// cheaper. `apex`, if given, gets the best place of the fourth node, on the side where (a, b, c,
/// apex) is positive.
double facetCap(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c,
  double enough = std::numeric_limits<double>::infinity(), Vec<3>* apex = nullptr);

/// Greatest S of a tetrahedron with one dihedral angle phi, in radians, 0 < phi < pi. It is the one
/// with an edge of length 1 and the other two nodes at the same distance from its middle.
double angleCap(double phi);

/// Greatest S of a triangle with one angle phi, in radians, 0 < phi < pi: the isosceles one.
double angleCap2(double phi);

/// Where angleCap() is at least c, 0 < c <= 1: all phi in [low, high], rounded outwards by at
/// most `width`.
void angleCapLevel(double c, double& low, double& high, double width = 1e-9);

/// A facet seen from one of its edges, whose length is the unit of length: the third node is at
/// `along` on the edge's line, `off` away from it.
struct EdgeView
{
  double along = 0.5, off = 0.0;
  double perimeter = 0.0; ///< of the facet, in the same unit
  double best =
    0.0; ///< dihedral angle at the edge of the best tetrahedron at this facet (or a good one)
  bool usable = false; ///< false: collapsed, or not finite

  EdgeView() = default;
  /// The facet (a, b, c) from its edge (a, b), with an apex as facetCap() gives it (on
  /// either side): level() knows
  /// levels up to the shape of that apex only.
  EdgeView(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& apex);

  /// Greatest S of a tetrahedron at this facet whose dihedral angle at the edge is phi, 0 < phi <
  /// pi; above `enough` as in facetCap().
  double cap(double phi, double enough = std::numeric_limits<double>::infinity()) const;

  /// Where cap() is at least c: all phi in [low, high], rounded outwards by at most `width`.
  /// False if nowhere.
  bool level(double c, double& low, double& high, double width = 1e-9) const;

private:
  double capFrom(double phi, double enough, Eigen::Vector2d& place) const;
};

/// The angle theta at a kept edge, between two kept facets, has to be filled by k >= 1 tetrahedra.
/// The first and the last have a given facet; k = 1 is the tetrahedron that both span, of
/// quality `spanned` (<= 0 or so where theta >= pi); k = 2 have a node in common, see pairReaches();
/// of more only the angles are looked at. True if no way to fill it has a worst S of c
/// or more; c must not be above what both facets allow. theta is known up to `slack`, and what is
/// computed from the facets up to that relative error. The greater `width` (of the levels), the
/// quicker, and the more edges seem to forbid nothing.
bool edgeForbids(double c, double theta, const EdgeView& first, const EdgeView& last,
  double spanned, double slack = 0.0, double width = 1e-9);

/// Least c that edgeForbids(), for an edge that forbids c = `above`: the certified bound of the
/// edge, rounded upwards by at most the relative tolerance.
double edgeCap(double above, double theta, const EdgeView& first, const EdgeView& last,
  double spanned, double tolerance = 1e-7, double slack = 0.0, double width = 1e-9);
}

#endif
