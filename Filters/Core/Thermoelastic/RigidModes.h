// SPDX-License-Identifier: BSD-3-Clause
/// @file RigidModes.h
/// Rigid motions that a set of constraints leaves free: found, named, pinned or projected out.
///
/// A body is a set of cells connected over facets. Bodies that share only points or edges move
/// against each other like hinged parts; a group is a set of bodies connected by hinges. The free
/// motions of a group are the null space of its constraints and hinges together: one dense
/// eigenproblem with 6 (in the plane 3) unknowns per body.
#ifndef meshopt_Thermoelastic_RigidModes_h
#define meshopt_Thermoelastic_RigidModes_h

#include "Mesh/SimplexMesh.h"
#include "Thermoelastic/Problem.h"

#include <string>
#include <vector>

namespace meshopt::fem
{
/// A group of more bodies is taken for one rigid body, since the eigenproblem is dense. Its hinges
/// then show as a solver that fails.
inline constexpr Index MostBodiesInGroup = 64;

/// Rigid motions of D translations and 1 or 3 rotations.
template <int D>
inline constexpr int MotionSize = D == 3 ? 6 : 3;

template <int D>
struct RigidModes
{
  struct Body
  {
    Index cell = None;  ///< the first of its cells
    Index cells = 0;    ///< their number
    Index group = None; ///< that it belongs to
    Index place = 0;    ///< its number in the group
  };
  struct Group
  {
    Vec<D> centre = Vec<D>::Zero(); ///< rotations are about it
    double length = 1.0;            ///< unit of length in rotations: size of the group
    /// Free motions, a column each, orthonormal; MotionSize<D> rows per body.
    Eigen::MatrixXd free;
    /// The same space spanned by motions that a person recognises: translations as far as there
    /// are, then rotations.
    Eigen::MatrixXd named;
  };

  std::vector<Index> bodyOfPoint; ///< one body that the point belongs to; None: no cell uses it
  std::vector<Body> bodies;       ///< ordered by their first cell
  std::vector<Group> groups;      ///< likewise

  /// Number of free motions.
  Index count() const;
  /// Displacements of point p, a column per motion in `motions`, which are those of its group.
  /// Precondition: a cell uses p.
  Eigen::Matrix<double, D, Eigen::Dynamic> displacements(
    const SimplexMesh<D>& mesh, Index p, const Eigen::MatrixXd& motions) const;
  /// Named motion of a group in words: "the mesh can translate along (0, 0, 1)".
  std::string describe(Index group, Index mode) const;
  /// The first of them, separated by semicolons.
  std::string describe() const;
};

/// Finds the rigid motions that leave all constrained components at rest. O(cells + constraints).
template <int D>
RigidModes<D> findRigidModes(
  const SimplexMesh<D>& mesh, const std::vector<Constraint>& constraints);

/// As many constraints as there are free motions, of single components at zero, such that none is
/// left: each time the component that the free motions displace most (ties: lowest point id).
/// O(points * motions) per group.
template <int D>
std::vector<Constraint> pinRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes);

/// Takes the part of `displacement` out that lies in the free motions, such that what is left is
/// orthogonal to them with `weight` (> 0, per point) as scalar product.
template <int D>
void removeRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<double>& weight, std::vector<Vec<D>>& displacement);

/// A free motion along which `forces` have a resultant, in words; empty if they are in equilibrium,
/// as they must be where something moves freely. A resultant of less than `tolerance` times the sum
/// of the norms of the group's forces is rounding.
template <int D>
std::string findImbalance(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<Vec<D>>& forces, double tolerance);
}

#endif
