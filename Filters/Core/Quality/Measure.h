// SPDX-License-Identifier: BSD-3-Clause
/// @file Measure.h
/// Names of the quality measures.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), equations (2.1)-(2.3).
#ifndef meshopt_Quality_Measure_h
#define meshopt_Quality_Measure_h

namespace meshopt
{
/// All measures: 0 for a flat simplex, negative when inverted (the sign of the volume is kept),
/// invariant to scale. The regular simplex has the greatest value, 1 unless said otherwise.
/// Formulas: Shape.h.
enum class Measure
{
  Shape = 0,       ///< the paper's S = c V / P^D, P the sum of the edge lengths
  RadiusRatio = 1, ///< D r / R
  MeanRatio = 2,   ///< 12 (3V)^(2/3) / sum l^2 in 3D; 4 sqrt(3) A / sum l^2 in 2D
  MinimumSine =
    3, ///< least sine of the dihedral (in 2D: corner) angles, plain; at most .9428 (.8660)
  WarpedSine = 4,          ///< the same, sines of obtuse angles times .75
  VolumeLength = 5,        ///< 6 sqrt(2) V / l_rms^3 in 3D; 4 A / (sqrt(3) l_rms^2) in 2D
  MinimumDihedralAngle = 6 ///< least dihedral (corner) angle in degrees, at most 70.53 (60)
};

/// The value of the regular simplex, which is the greatest there is.
template <int D>
constexpr double regularValue(Measure measure)
{
  switch (measure)
  {
    case Measure::MinimumSine:
    case Measure::WarpedSine:
      return D == 2 ? 0.8660254037844386 : 0.9428090415820634;
    case Measure::MinimumDihedralAngle:
      return D == 2 ? 60.0 : 70.52877936550931;
    default:
      return 1.0;
  }
}
}

#endif
