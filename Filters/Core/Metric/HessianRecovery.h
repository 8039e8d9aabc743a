// SPDX-License-Identifier: BSD-3-Clause
/// @file HessianRecovery.h
/// Second derivatives at the points of a mesh, from values at its points.
///
/// References: Buscaglia, Dari, Zavattieri (1996), section 5.2. Zhang, Naga, "A new finite element
/// gradient recovery method: superconvergence property" (2005), for the quadratic fit over patches.
///
/// Departures from the paper: (5.5) lacks a minus sign in print; (5.4) is right and is used here.
/// The paper leaves open how to impose dH/dn = 0. Here the interior values stay, and the boundary
/// values minimize int |grad H|^2; dH/dn = 0 is the natural condition of this problem.
#ifndef meshopt_Metric_HessianRecovery_h
#define meshopt_Metric_HessianRecovery_h

#include "Mesh/SimplexMesh.h"

#include <string>
#include <vector>

namespace meshopt
{
enum class Recovery
{
  /// The paper's (5.4): weak form with a lumped mass matrix. Needs interior points. The Hessian of
  /// a linear function is 0; quadratics are exact where the patch is symmetric about its point.
  LumpedMass = 0,
  /// Least-squares fit of a quadratic over a patch of neighbours. Exact for quadratics, also on the
  /// boundary and on irregular meshes. Invariant to affine maps of the mesh.
  LeastSquares = 1
};

/// Recovers the Hessians of a field with `components` values per point: values[components * p + i],
/// finite at points that cells use. `hessians` has the same layout; it is 0 at points that no cell
/// uses. The field is assumed smooth over the whole mesh, across regions, but not across a crack,
/// whose sides have points of their own.
///
/// Inverted cells count with the sign of their volume; flat cells do not count. Returns an empty
/// string, or a sentence that names a point with too little mesh around it: no interior point in
/// its part of the mesh, or fewer than 6 points (10 in 3D). O(n), except for the sparse
/// factorization over boundary points in LumpedMass.
template <int D>
std::string recoverHessians(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, Recovery recovery, std::vector<Tensor<D>>& hessians);

extern template std::string recoverHessians<2>(
  const SimplexMesh<2>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<2>>&);
extern template std::string recoverHessians<3>(
  const SimplexMesh<3>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<3>>&);
}

#endif
