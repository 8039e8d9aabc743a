// SPDX-License-Identifier: BSD-3-Clause
/// @file Problem.h
/// What is to be solved: material, temperature, loads and constraints on a mesh.
#ifndef meshopt_Thermoelastic_Problem_h
#define meshopt_Thermoelastic_Problem_h

#include "Mesh/SimplexMesh.h"
#include "Thermoelastic/Material.h"

#include <optional>
#include <string>
#include <vector>

namespace meshopt::fem
{
/// Why a problem cannot be solved: a sentence for the user that names what is wrong and where.
struct Error
{
  std::string message;
  Index cell = None;  ///< first offending cell, or None
  Index point = None; ///< first offending point, or None
};

/// A prescribed component of the displacement of a point.
struct Constraint
{
  Index point = None;
  int component = 0; ///< 0 .. D - 1
  double value = 0.0;
};

/// What happens to rigid motions that the constraints leave free. They change no stress, but without
/// a choice among them the equations have no unique solution.
enum class RigidMotion
{
  Forbid = 0, ///< an error that names one of them
  /// As many components of single points are held at zero as there are free motions (the 3-2-1 rule
  /// if nothing else is prescribed). The points are chosen far apart, see pinRigidMotions().
  Pin = 1,
  /// The displacement is the one without a part in them: mean translation and rotation, weighted by
  /// volume, are zero. Conjugate gradients need no pins for that and converge faster.
  Project = 2
};

/// A linear thermoelastic problem on a SimplexMesh<D>: displacement per point, P1 elements. In the
/// plane everything is per unit of thickness.
template <int D>
struct Problem
{
  /// One for all cells, or one per cell.
  std::vector<Material> materials = std::vector<Material>(1);
  PlaneState planeState = PlaneState::PlaneStrain; ///< D = 2 only
  double outOfPlaneStrain = 0.0;                   ///< D = 2 with PlaneStrain only

  /// Per point, or empty: no thermal load. Linear in each element. Points that no cell uses may have
  /// anything.
  std::vector<double> temperature;
  double referenceTemperature = 0.0; ///< at which there is no thermal strain

  std::vector<Constraint> constraints; ///< of one component twice: the last one counts
  std::vector<Vec<D>> forces;          ///< per point, or empty: none. See Loads.h
  RigidMotion rigidMotion = RigidMotion::Forbid;

  const Material& material(Index cell) const
  {
    return this->materials.size() == 1 ? this->materials[0] : this->materials[cell];
  }
};

/// Least shape quality (2.3) of an element that is not taken for one of zero volume: below, rounding
/// decides about the sign of the volume.
inline constexpr double FlatShape = 1e-12;

/// Everything that can be said before solving: lengths of arrays, material, temperature, forces,
/// constraints, inverted and flat cells. (Free rigid motions: see RigidModes.h.)
template <int D>
std::optional<Error> check(const SimplexMesh<D>& mesh, const Problem<D>& problem);

/// The strain along `axis` (0 .. D - 1; for D = 2 also 2, the normal of the plane) at which a body
/// with free sides carries no resultant force along it: the mean of alpha (T - Tref), weighted by
/// E and volume. Exact for a prism along the axis where nu is the same everywhere. The sum runs over
/// the elements with their mean temperature. Preconditions: check() has found nothing.
template <int D>
double freeAxialStrain(const SimplexMesh<D>& mesh, const Problem<D>& problem);

/// Generalised plane strain: appends constraints such that the displacement along `axis` is zero at
/// all points of the lowest plane and strain times height at all points of the highest; a point
/// belongs to a plane within `tolerance` times the height. Their other components stay free.
template <int D>
void constrainEnds(
  const SimplexMesh<D>& mesh, int axis, double strain, double tolerance, Problem<D>& problem);
}

#endif
