// SPDX-License-Identifier: BSD-3-Clause
/// @file Place.h
/// What a point may do, and where on the surface it lies.
#ifndef meshopt_Mesh_Place_h
#define meshopt_Mesh_Place_h

#include "Mesh/Types.h"

namespace meshopt
{
/// What a point may do.
enum class Freedom : std::uint8_t
{
  Free,  ///< anything: no kept facet and no kept edge has it
  Patch, ///< slides on a part of the surface, and may vanish into a neighbour there (D = 3)
  Curve, ///< slides along a curve of the surface, and may vanish into a neighbour there
  Fixed  ///< nothing: it neither moves nor vanishes
};

/// Where on the surface a point lies that may slide. Points of the surface without a place are fixed.
struct Place
{
  Freedom freedom = Freedom::Fixed;
  Index part = None;      ///< number of the curve or of the patch
  double parameter = 0.0; ///< along the curve
};
}

#endif
