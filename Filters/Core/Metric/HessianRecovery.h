// SPDX-License-Identifier: BSD-3-Clause
/// @file HessianRecovery.h
/// Second derivatives at the points of a mesh, from values at its points.
///
/// References: Buscaglia, Dari, Zavattieri (1996), section 5.2. Zhang, Naga, "A new finite element
/// gradient recovery method: superconvergence property" (2005), for the quadratic fit over patches.
///
/// Departures from the paper: (5.5) lacks a minus sign in print; (5.4) is right and used here. How
/// dH/dn = 0 is imposed the paper leaves open: here the boundary values are those that minimize
/// int |grad H|^2 while the interior ones stay, which has this as its natural condition.
#ifndef meshopt_Metric_HessianRecovery_h
#define meshopt_Metric_HessianRecovery_h

#include "Mesh/SimplexMesh.h"

#include <string>
#include <vector>

namespace meshopt
{
enum class Recovery
{
  /// The paper's (5.4): weak form with a lumped mass matrix. Needs interior points. A linear
  /// function has the Hessian 0; quadratics are exact where the patch is symmetric about its point.
  LumpedMass = 0,
  /// Least-squares fit of a quadratic over a patch of neighbours; exact for quadratics, also on the
  /// boundary and on irregular meshes. Independent of affine maps of the mesh.
  LeastSquares = 1
};

/// Recovers the Hessians of a field with `components` values per point: values[components * p + i],
/// finite at points that cells use; `hessians` gets the same layout. Points that no cell uses get
/// 0. The field is taken as smooth over the whole mesh: regions are not told apart, while the two
/// sides of a crack (points of their own) are.
///
/// Inverted cells count with the sign of their volume, flat ones not at all. Returns a sentence
/// that names a point where the mesh has too little around it to recover from (no interior point in
/// its part of the mesh; fewer than 6 points, 10 in 3D), or an empty string. O(n), but for the
/// sparse factorization over boundary points that LumpedMass needs.
template <int D>
std::string recoverHessians(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, Recovery recovery, std::vector<Tensor<D>>& hessians);

extern template std::string recoverHessians<2>(
  const SimplexMesh<2>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<2>>&);
extern template std::string recoverHessians<3>(
  const SimplexMesh<3>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<3>>&);
}

#endif
