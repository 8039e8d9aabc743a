// SPDX-License-Identifier: BSD-3-Clause
/// @file PairBound.h
/// How good two tetrahedra can be that fill the angle between two kept facets and share their free
/// node.
#ifndef meshopt_Bound_PairBound_h
#define meshopt_Bound_PairBound_h

#include "Bound/ApexBound.h"

namespace meshopt
{
/// Two facets have a common edge, at the angle theta in radians, 0 < theta < 2 pi. False if it is
/// certain that no place of a fourth node gives the tetrahedra on both facets an S (2.3) of c or
/// more. True if there is such a place, or if it takes too long to decide (which happens for c very
/// near the best). c > 0; both views must be usable.
///
/// The function of ApexBound.h for each facet, V^(1/3) - lambda P, is concave in the node, and so
/// is a weighted mean of both. If no place gives the mean the value 0, none gives it to both.
/// Bisection finds the weight for which the mean is most restrictive: there both qualities are the
/// same.
bool pairReaches(double c, double theta, const EdgeView& first, const EdgeView& last);
}

#endif
