// SPDX-License-Identifier: BSD-3-Clause
/// @file AngleBound.h
/// How good a mesh can be at best while only angles of its surface are given: those between planes
/// that meet in a ridge, and those between straight curves that meet in a corner of a flat patch.
///
/// An angle between two planes is filled by n >= 1 cells along each piece of the ridge, an angle in
/// a patch by the faces of n >= 1 cells. The n angles add up to the given one. The best quality of
/// a cell with one angle given rises up to the angle of the regular cell, and falls from there on;
/// so the worst of the n cells is the best where their angles are equal. The bound is the greatest
/// of these values for n = 1, 2, 3, ...
///
/// Best cells with one angle given: for measures V / N^3, where N is a norm of the edge lengths, V
/// is log-concave and N convex in two positions each of the free nodes, so the best cell is
/// symmetric. The sines see the dihedral angle itself. For the radius ratio two certified values
/// are used that no cell need reach: the square root of the mean ratio (the area of a tetrahedron
/// is at least that of the regular one of its volume, and 16 R^2 at least the sum of its squared
/// edges), and, for dihedral angles, the distance between the centres of the inscribed and of the
/// circumscribed sphere (d^2 <= (R + r) (R - 3 r), Grace and Danielsson).
#ifndef meshopt_Bound_AngleBound_h
#define meshopt_Bound_AngleBound_h

#include "Quality/Measure.h"

#include <vector>

namespace meshopt
{
/// At least the greatest quality of a tetrahedron with one dihedral angle phi, in radians, 0 < phi
/// < pi. It is reached by a tetrahedron for Shape, MeanRatio, VolumeLength, and up to 60 degrees
/// for the sines. For a measure that cannot be optimized: the value of the regular tetrahedron.
double dihedralCap(Measure measure, double phi);

/// The same with one angle alpha of a face, 0 < alpha < pi. Says nothing for the sines, which can
/// be good with any angle of a face.
double faceAngleCap(Measure measure, double alpha);

/// Angles that a mesh has to fill, in radians, up to `slack`.
struct AnglesToFill
{
  std::vector<double> dihedral; ///< in ]0, 2 pi[: between two planes, of one region
  std::vector<double> facial;   ///< in ]0, 2 pi[: in a flat patch, between two curves
  double slack = 0.0;
};

/// No mesh that fills these angles has a worst cell above this. Without angles: the value of the
/// regular tetrahedron.
double angleBound(Measure measure, const AnglesToFill& angles);
}

#endif
