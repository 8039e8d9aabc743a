// SPDX-License-Identifier: BSD-3-Clause
/// @file Problem.h
/// The problem to be solved: material, temperature, loads and constraints on a mesh.
#ifndef meshopt_Thermoelastic_Problem_h
#define meshopt_Thermoelastic_Problem_h

#include "Mesh/SimplexMesh.h"
#include "Thermoelastic/Material.h"

#include <optional>
#include <string>
#include <vector>

namespace meshopt::fem
{
/// Why a problem cannot be solved: a sentence for the user that says what is wrong and where.
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

/// How to handle rigid motions that the constraints leave free. They do not change stress, but
/// without a choice among them the solution is not unique.
enum class RigidMotion
{
  Forbid = 0, ///< an error that names one of them
  /// Single components of points are held at zero, as many as there are free motions (the 3-2-1
  /// rule if nothing else is prescribed). The points are chosen far apart, see pinRigidMotions().
  Pin = 1,
  /// The free part of the displacement is removed: mean translation and rotation, weighted by
  /// volume, are zero. Conjugate gradients need no pins for this, and converge faster.
  Project = 2
};

/// A linear thermoelastic problem on a SimplexMesh<D>: displacement per point, P1 elements. In 2D
/// everything is per unit of thickness.
template <int D>
struct Problem
{
  /// One for all cells, or one per cell.
  std::vector<Material> materials = std::vector<Material>(1);
  PlaneState planeState = PlaneState::PlaneStrain; ///< D = 2 only
  double outOfPlaneStrain = 0.0;                   ///< D = 2 with PlaneStrain only

  /// Per point; empty: no thermal load. Linear in each element. Points that no cell uses may have
  /// any value.
  std::vector<double> temperature;
  double referenceTemperature = 0.0; ///< at which there is no thermal strain

  std::vector<Constraint> constraints; ///< if a component occurs twice, the last one counts
  std::vector<Vec<D>> forces;          ///< per point, or empty: none. See Loads.h
  RigidMotion rigidMotion = RigidMotion::Forbid;

  const Material& material(Index cell) const
  {
    return this->materials.size() == 1 ? this->materials[0] : this->materials[cell];
  }
};

/// Lowest shape quality (2.3) at which an element does not count as flat. Below it, rounding
/// decides the sign of the volume.
inline constexpr double FlatShape = 1e-12;

/// All checks that are possible before solving: lengths of arrays, material, temperature, forces,
/// constraints, inverted and flat cells. (Free rigid motions: see RigidModes.h.)
template <int D>
std::optional<Error> check(const SimplexMesh<D>& mesh, const Problem<D>& problem);

/// The strain along `axis` (0 .. D - 1; for D = 2 also 2, the normal of the plane) at which a body
/// with free sides has no resultant force along it. It is the mean of alpha (T - Tref), weighted by
/// E and volume. Exact for a prism along the axis with the same nu everywhere. The sum is over the
/// elements with their mean temperatures. Precondition: check() has found no error.
template <int D>
double freeAxialStrain(const SimplexMesh<D>& mesh, const Problem<D>& problem);

/// Generalised plane strain: appends constraints so that the displacement along `axis` is zero at
/// all points of the lowest plane, and strain times height at all points of the highest plane. A
/// point belongs to a plane if it is within `tolerance` times the height. Other components stay
/// free.
template <int D>
void constrainEnds(
  const SimplexMesh<D>& mesh, int axis, double strain, double tolerance, Problem<D>& problem);
}

#endif
