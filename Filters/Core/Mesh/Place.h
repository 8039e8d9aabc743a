// SPDX-License-Identifier: BSD-3-Clause
/// @file Place.h
/// The freedom of a point, and its place on the surface.
#ifndef meshopt_Mesh_Place_h
#define meshopt_Mesh_Place_h

#include "Mesh/Types.h"

namespace meshopt
{
/// What a point may do.
enum class Freedom : std::uint8_t
{
  Free,  ///< anything: it is on no kept facet and no kept edge
  Patch, ///< slide on a part of the surface, and vanish into a neighbour there (D = 3)
  Curve, ///< slide along a curve of the surface, and vanish into a neighbour there
  Fixed  ///< nothing: it neither moves nor vanishes
};

/// The place on the surface of a point that may slide. Surface points without a place are fixed.
struct Place
{
  Freedom freedom = Freedom::Fixed;
  Index part = None;      ///< number of the curve or of the patch
  double parameter = 0.0; ///< along the curve
};
}

#endif
