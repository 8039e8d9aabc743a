// SPDX-License-Identifier: BSD-3-Clause
/// @file PairBound.h
/// How good two tetrahedra can be that fill the angle between two kept facets and share their free
/// node.
#ifndef meshopt_Bound_PairBound_h
#define meshopt_Bound_PairBound_h

#include "Bound/ApexBound.h"

namespace meshopt
{
/// Two facets have a common edge, at the angle theta in radians, 0 < theta < 2 pi. The greatest
/// worst S (2.3) that the tetrahedra on both can have, in [0, 1]: a certified bound, rounded up by
/// at most the relative `tolerance`, unless it takes too long to find. If `enough` is reached, the
/// result may be any value from `enough` on, which is cheaper. Both views must be usable.
///
/// The function of ApexBound.h for each facet, V^(1/3) - lambda P, is concave in the node, and so
/// is a weighted mean of both. What no place gives the mean, none gives to both. The search finds
/// the weight for which the mean is most restrictive: there both qualities are the same.
double pairCap(
  double theta, const EdgeView& first, const EdgeView& last, double tolerance, double enough = 1.0);
}

#endif
