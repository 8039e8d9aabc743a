// SPDX-License-Identifier: BSD-3-Clause
/// @file Measure.h
/// Names of the quality measures.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), equations (2.1)-(2.3).
#ifndef meshopt_Quality_Measure_h
#define meshopt_Quality_Measure_h

namespace meshopt
{
/// All measures are 0 for a flat simplex, negative for an inverted one (the sign of the volume is
/// kept), and invariant to scale. The regular simplex has the greatest value, 1 unless stated
/// otherwise. Formulas: Shape.h. Uses of each measure: Measures.h, which has a row for every one.
enum class Measure
{
  Shape = 0,       ///< the paper's S = c V / P^D, P the sum of the edge lengths
  RadiusRatio = 1, ///< D r / R
  MeanRatio = 2,   ///< 12 (3V)^(2/3) / sum l^2 in 3D; 4 sqrt(3) A / sum l^2 in 2D
  MinimumSine =
    3, ///< least sine of the dihedral (in 2D: corner) angles, unweighted; at most .9428 (.8660)
  WarpedSine = 4,          ///< the same with sines of obtuse angles times .75
  VolumeLength = 5,        ///< 6 sqrt(2) V / l_rms^3 in 3D; 4 A / (sqrt(3) l_rms^2) in 2D
  MinimumDihedralAngle = 6 ///< least dihedral (corner) angle in degrees, at most 70.53 (60)
};

/// The known bound on the quality of an element on a given facet (SurfaceBound.h).
enum class FacetBound
{
  None,                 ///< none: only the value of the regular simplex
  MeanRatio,            ///< the mean ratio of the facet itself
  MeanRatioToTwoThirds, ///< the mean ratio to the power 2/3
  BestApex              ///< the best fourth node, and angles at edges: certified for S
};

/// A row of the table of measures, as values.
struct MeasureInfo
{
  const char* name;
  bool isOptimizable; ///< otherwise it can only be reported
  FacetBound bound;
  double regular2, regular3; ///< value of the regular triangle and of the regular tetrahedron
};

/// The number of measures; they are numbered from 0.
int numberOfMeasures();

/// The row of a measure. The caller must not pass a measure that is not in the table.
const MeasureInfo& infoOf(Measure measure);

/// Whether the number is that of a measure.
inline bool isMeasure(int measure) { return measure >= 0 && measure < numberOfMeasures(); }

/// The value of the regular simplex: the greatest possible value.
template <int D>
double regularValue(Measure measure)
{
  return D == 2 ? infoOf(measure).regular2 : infoOf(measure).regular3;
}
}

#endif
