// SPDX-License-Identifier: BSD-3-Clause
/// @file StressRecovery.h
/// From stresses that are constant in each element to continuous ones. The difference between them
/// gives an error estimate.
///
/// References: O. C. Zienkiewicz, J. Z. Zhu, "The superconvergent patch recovery and a posteriori
/// error estimates", parts 1 and 2, Int. J. Numer. Meth. Eng. 33 (1992) 1331-1382.
///
/// - In the interior, a linear polynomial is fitted by least squares to the stresses at the
///   centroids of the cells around a point.
/// - A point of the surface takes a mean, as the authors advise: that of the polynomials of all
///   interior points with which it shares a cell. This repairs most of the error that bad elements
///   at the surface cause in the stress. StressRecovery::LocalPatch shows this error: it treats
///   points of the surface like all others, with the cells around them.
/// - A patch that does not determine a polynomial is enlarged layer by layer. If that fails, the
///   volume average is used.
/// - Stresses jump where materials meet. Recovery therefore does not cross the border of a region,
///   and has one value per side there.
/// Linear stress fields are reproduced exactly, except by volume averages.
#ifndef meshopt_Thermoelastic_StressRecovery_h
#define meshopt_Thermoelastic_StressRecovery_h

#include "Thermoelastic/Assembly.h"

#include <vector>

namespace meshopt::fem
{
enum class StressRecovery
{
  Patch = 0, ///< superconvergent patch recovery; on the surface from interior points
  /// The same with each point's own patch, also on the surface. A patch needs as many cells as a
  /// complete quadratic polynomial has coefficients: 10 in 3D, 6 in 2D.
  LocalPatch = 1,
  VolumeAverage = 2, ///< mean of the cells around the point, weighted by volume
  None = 3
};

/// The mesh with points split where regions meet: one node per point and region.
template <int D>
struct RecoveryMesh
{
  std::vector<Simplex<D>> cells;         ///< in terms of nodes
  std::vector<Index> pointOfNode;        ///< ascending
  std::vector<std::uint8_t> isOnSurface; ///< per node: of the mesh or of its region
  Rows cellsOfNode;                      ///< ascending
  Index count() const { return static_cast<Index>(this->pointOfNode.size()); }
};

template <int D>
RecoveryMesh<D> makeRecoveryMesh(const SimplexMesh<D>& mesh);

/// Stress at each node, from the stress at the centroid of each cell. Precondition: method is not
/// None.
template <int D>
std::vector<Stress<D>> recoverStress(const SimplexMesh<D>& mesh, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& elementStress, StressRecovery method, const Control& control);

/// One value per point: the mean over the regions that meet there, weighted by the volume of the
/// cells around the point. Zero at points that no cell uses.
template <int D>
std::vector<Stress<D>> stressAtPoints(const SimplexMesh<D>& mesh, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& nodalStress);

/// Zienkiewicz and Zhu's estimate per cell: the energy norm, sqrt(integral of e : C^-1 : e), of the
/// difference between the recovered stress and that of the solution. Both are linear in the cell;
/// the latter with the linear temperature of `problem`. Units: square root of an energy.
template <int D>
std::vector<double> estimateErrors(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const Discretization<D>& discretization, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& elementStress, const std::vector<Stress<D>>& nodalStress,
  const Control& control);
}

#endif
