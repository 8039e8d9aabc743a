// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceAngles.h
/// The angles of a surface that stays the same set of points: every mesh of this body has to fill
/// them.
#ifndef meshopt_Surface_SurfaceAngles_h
#define meshopt_Surface_SurfaceAngles_h

#include "Surface/SurfaceDivision.h"

#include <vector>

namespace meshopt
{
/// In radians, ascending, each value once; 0 < angle < 2 pi.
struct SurfaceAngles
{
  std::vector<double> dihedral; ///< at straight curves, from patch to patch, inside the body
  std::vector<double> facial;   ///< in patches, at their corners, from curve to curve
  /// What rounding can make of an angle. Angles beside patches or curves that are too thin or too
  /// short for that are left out.
  static constexpr double slack = 1e-6;
};

/// Nothing if the tolerance is greater than rounding: where the surface may move, no angle is
/// certain, however small the tolerance is: facets may be as small. Angles where cells overlap
/// are left out. Cost: a few look-ups for each kept facet.
SurfaceAngles surfaceAngles(const SimplexMesh<3>& mesh, const SurfaceDivision& division);
}

#endif
