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
  Free,   ///< anything: it is on no kept facet and no kept edge
  Patch,  ///< slide on a part of the surface, and vanish into a neighbour there (D = 3)
  Curve,  ///< slide along a curve of the surface, and vanish into a neighbour there
  Corner, ///< stay near the corner that it was, as the tolerance allows (D = 3)
  Fixed   ///< nothing: it neither moves nor vanishes
};

inline constexpr int NumberOfFreedoms = static_cast<int>(Freedom::Fixed) + 1;

/// The place on the surface of a point that may slide. Surface points without a place are fixed.
struct Place
{
  Freedom freedom = Freedom::Fixed;
  /// Number of the curve or of the patch; of a corner, the point that was there.
  Index part = None;
  double parameter = 0.0; ///< along the curve; on a patch: the distance from it

  bool mayMove() const { return this->freedom != Freedom::Fixed; }
};
}

#endif
