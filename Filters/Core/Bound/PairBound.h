// SPDX-License-Identifier: BSD-3-Clause
/// @file PairBound.h
/// How good two tetrahedra can be that fill the angle between two kept facets and share their free node.
#ifndef meshopt_Bound_PairBound_h
#define meshopt_Bound_PairBound_h

#include "Bound/ApexBound.h"

namespace meshopt
{
/// Two facets with a common edge, at the angle theta in radians, 0 < theta < 2 pi. False if it is certain
/// that no place of a fourth node gives an S (2.3) of c or more to the tetrahedra on both; true where
/// there is such a place, or where it takes too long to know (which happens for c very near to the
/// best). c > 0; both views usable.
///
/// ApexBound.h's function for each facet, V^(1/3) - lambda P, is concave in the node, so is a weighted
/// mean of both, and where no place gives the mean a value of 0 none gives it to both. The weight for
/// which the mean says most is found by bisection: there both are the same.
bool pairReaches(double c, double theta, const EdgeView& first, const EdgeView& last);
}

#endif
