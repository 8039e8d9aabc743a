// SPDX-License-Identifier: BSD-3-Clause
/// @file ApexBound.h
/// Upper bounds on the best shape of an element when part of it is given. No mesh can exceed them.
///
/// In all cases S = c V / P^3 (2.3) is maximized over the place of the free node. V is affine and P
/// convex in one node, so V^(1/3) - lambda P is concave, and there is one maximum. Newton's method
/// finds it for that function, where lambda is the best V^(1/3) / P so far (Dinkelbach). What the
/// last gradient leaves open is added. So the result is never less than the maximum (except for
/// rounding errors of some 1e-15).
#ifndef meshopt_Bound_ApexBound_h
#define meshopt_Bound_ApexBound_h

#include "Mesh/Types.h"

#include <limits>

namespace meshopt
{
/// Greatest S of a tetrahedron with the facet (a, b, c), in [0, 1]: 1 for a regular facet, 0 for a
/// collapsed one, 1 (nothing known) if a coordinate is not finite. If the maximum is above
/// `enough`, the result may be any value from `enough` to the bound of the maximum, which is
/// cheaper. `apex`, if given, receives the best place of the fourth node, on the side where (a, b,
/// c, apex) is positive.
double facetCap(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c,
  double enough = std::numeric_limits<double>::infinity(), Vec<3>* apex = nullptr);

/// Greatest S of a tetrahedron with one dihedral angle phi, in radians, 0 < phi < pi. The best one
/// has an edge of length 1, and its other two nodes have the same distance from the middle of that
/// edge.
double angleCap(double phi);

/// Greatest S of a triangle with one angle phi, in radians, 0 < phi < pi. The best one is
/// isosceles.
double angleCap2(double phi);

/// The ends of the interval of angles at which angleCap() is at least c, 0 < c <= 1. Rounded
/// outwards by at most `width`.
double lowestAngle(double c, double width = 1e-9);
double highestAngle(double c, double width = 1e-9);

/// A facet seen from one of its edges, whose length is the unit of length. The third node is at
/// `along` on the line of the edge, and `off` away from it.
struct EdgeView
{
  double along = 0.5, off = 0.0;
  double perimeter = 0.0; ///< of the facet, in the same unit
  /// Of the best (or a good) tetrahedron on this facet: the dihedral angle at the edge; and its
  /// apex, along the edge and away from it, where the searches for other angles begin.
  double best = 0.0;
  Eigen::Vector2d place = { 0.5, 1.0 };
  bool usable = false; ///< false: collapsed, or not finite

  EdgeView() = default;
  /// The facet (a, b, c) seen from its edge (a, b), with an apex as facetCap() gives it (on either
  /// side). level() knows only levels up to the shape of that apex.
  EdgeView(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& apex);

  /// Greatest S of a tetrahedron on this facet with the dihedral angle phi at the edge, 0 < phi <
  /// pi. For `enough` see facetCap().
  double cap(double phi, double enough = std::numeric_limits<double>::infinity()) const;

  /// The ends of the interval of angles at which cap() is at least c. Rounded outwards by at most
  /// `width`. Less than 0 if there is none.
  double lowest(double c, double width = 1e-9) const;
  double highest(double c, double width = 1e-9) const;

private:
  double capFrom(double phi, double enough, Eigen::Vector2d& place, double precision) const;
  double limit(double c, double end, double width) const;
};

/// A kept edge with its two kept facets; the angle between them is filled by tetrahedra.
struct FacetWedge
{
  double theta;         ///< the angle, known up to `slack`
  EdgeView first, last; ///< the facets, known up to the same relative error
  double spanned;       ///< S of the tetrahedron that both span, about 0 or less if theta >= pi
  double slack = 0.0;
};

/// How good the worst S can be in a wedge: a certified bound if that is below `above`, else 1
/// (nothing is forbidden). It is rounded upwards by at most the relative tolerance; so near `above`
/// it may be 1, too.
///
/// The angle is filled by k >= 1 tetrahedra; the first and the last have a given facet. k = 1: the
/// tetrahedron that both facets span. k = 2: both have a node in common, see pairCap(). k > 2: only
/// the angles are used. `above` must not exceed what both facets allow. A greater `width` (of the
/// levels) is faster, but more edges then seem to forbid nothing.
double edgeCap(double above, const FacetWedge& wedge, double tolerance = 1e-7, double width = 1e-9);
}

#endif
