// SPDX-License-Identifier: BSD-3-Clause
/// @file LeastSquaresHessian.h
/// Hessians by fitting quadratics over patches. The entry point is HessianRecovery.h.
#ifndef meshopt_Metric_LeastSquaresHessian_h
#define meshopt_Metric_LeastSquaresHessian_h

#include "Metric/PointGraph.h"

#include <string>
#include <vector>

namespace meshopt
{
/// The same as recoverHessians() with Recovery::LeastSquares. A patch is the point with its
/// neighbours, and further layers of neighbours until there are enough points (2D: 7, 3D: 14) and
/// they determine a quadratic well. Coordinates are scaled by the spread of the patch in its
/// principal directions, so that stretched patches are fitted as well as round ones.
template <int D>
std::string recoverByLeastSquares(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, std::vector<Tensor<D>>& hessians);

extern template std::string recoverByLeastSquares<2>(
  const SimplexMesh<2>&, const std::vector<double>&, int, std::vector<Tensor<2>>&);
extern template std::string recoverByLeastSquares<3>(
  const SimplexMesh<3>&, const std::vector<double>&, int, std::vector<Tensor<3>>&);
}

#endif
