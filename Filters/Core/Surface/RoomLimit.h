// SPDX-License-Identifier: BSD-3-Clause
/// @file RoomLimit.h
/// How far a point of the surface may go towards another sheet of it.
#ifndef meshopt_Surface_RoomLimit_h
#define meshopt_Surface_RoomLimit_h

#include "Mesh/Types.h"

#include <cmath>
#include <vector>

namespace meshopt
{
/// A motion u of the point is within the limit if u . way <= most. Then at least the wanted part of
/// the distance is left: the distance from a facet is convex, so it shrinks by no more than the
/// motion along the way there. Motions along the other sheet are free, and so are those away from
/// it, except where a thin region would get several times its volume.
struct RoomLimit
{
  Vec<3> way;            ///< to the nearest point of a facet of the other sheet
  double most;           ///< the part of the distance that may be used, times the distance
  bool bothWays = false; ///< also away from the other sheet

  /// The part of the motion that may be made.
  double part(const Vec<3>& motion) const
  {
    const double along = motion.dot(this->way), counts = this->bothWays ? std::fabs(along) : along;
    return counts > this->most ? this->most / counts : 1.0;
  }
};

/// Removes the limits that others imply, for motions of at most this length.
void keepBinding(double length, std::vector<RoomLimit>& limits);
}

#endif
