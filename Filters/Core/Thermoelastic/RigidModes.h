// SPDX-License-Identifier: BSD-3-Clause
/// @file RigidModes.h
/// Rigid motions that a set of constraints leaves free: found, named, pinned or projected out.
///
/// A body is a set of cells connected over facets. Bodies that share only points or edges move
/// against each other like hinged parts. A group is a set of bodies connected by hinges. The free
/// motions of a group are the null space of its constraints and hinges: a dense eigenproblem with 6
/// (2D: 3) unknowns per body.
#ifndef meshopt_Thermoelastic_RigidModes_h
#define meshopt_Thermoelastic_RigidModes_h

#include "Mesh/SimplexMesh.h"
#include "Thermoelastic/Problem.h"

#include <string>
#include <vector>

namespace meshopt::fem
{
/// A group with more bodies counts as one rigid body, since the eigenproblem is dense. If its
/// hinges are free to move, the solver fails.
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
    Index group = None; ///< the group of the body
    Index place = 0;    ///< its number in the group
  };
  struct Group
  {
    Vec<D> centre = Vec<D>::Zero(); ///< rotations are about it
    double length = 1.0;            ///< unit of length in rotations: size of the group
    /// Free motions, a column each, orthonormal; MotionSize<D> rows per body.
    Eigen::MatrixXd free;
    /// A basis of the same space in motions that a person recognises: first as many translations as
    /// possible, then rotations.
    Eigen::MatrixXd named;
  };

  std::vector<Index> bodyOfPoint; ///< a body that contains the point; None: no cell uses it
  std::vector<Body> bodies;       ///< ordered by their first cell
  std::vector<Group> groups;      ///< ordered by their first cell

  /// Number of free motions.
  Index count() const;
  /// Displacements of point p: one column per column of `motions`, which are motions of its group.
  /// Precondition: a cell uses p.
  Eigen::Matrix<double, D, Eigen::Dynamic> displacements(
    const SimplexMesh<D>& mesh, Index p, const Eigen::MatrixXd& motions) const;
  /// Named motion of a group in words: "the mesh can translate along (0, 0, 1)".
  std::string describe(Index group, Index mode) const;
  /// The first named motions, separated by semicolons.
  std::string describe() const;
};

/// Finds the rigid motions that do not move any constrained component. O(cells + constraints).
template <int D>
RigidModes<D> findRigidModes(
  const SimplexMesh<D>& mesh, const std::vector<Constraint>& constraints);

/// As many constraints of single components at zero as there are free motions, so that no motion is
/// left. Each is the component that the remaining motions displace most (ties: lowest point id).
/// O(points * motions) per group.
template <int D>
std::vector<Constraint> pinRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes);

/// Removes from `displacement` its part in the free motions. The rest is orthogonal to them in the
/// scalar product with `weight` (> 0, per point).
template <int D>
void removeRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<double>& weight, std::vector<Vec<D>>& displacement);

/// A free motion along which `forces` have a resultant, in words; empty if they are in equilibrium.
/// They must be where something moves freely. A resultant below `tolerance` times the sum of the
/// norms of the group's forces counts as rounding.
template <int D>
std::string findImbalance(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<Vec<D>>& forces, double tolerance);
}

#endif
