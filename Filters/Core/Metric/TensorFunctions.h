// SPDX-License-Identifier: BSD-3-Clause
/// @file TensorFunctions.h
/// Exponential and logarithm of symmetric tensors, for log-Euclidean interpolation.
///
/// Reference: Arsigny, Fillard, Pennec, Ayache, "Log-Euclidean metrics for fast and simple calculus
/// on diffusion tensors" (2006).
#ifndef meshopt_Metric_TensorFunctions_h
#define meshopt_Metric_TensorFunctions_h

#include "Mesh/Types.h"

namespace meshopt
{
/// exp(l) of a symmetric tensor; symmetric to the last bit. Taylor series of l without its trace,
/// scaled and squared. The relative error is some 1e-15 times the norm of l. Several times faster
/// than by eigenvalues.
template <int D>
Tensor<D> exponential(const Tensor<D>& l);

/// ln(m) of a symmetric positive definite tensor. Returns false, with `l` unchanged, if m is not
/// finite, not symmetric (to 1e-9 of its norm), or has an eigenvalue that is not positive (to 1e-15
/// of the greatest) or outside 1e-200 to 1e200: volumes measured in it would not fit into a double.
template <int D>
bool logarithm(const Tensor<D>& m, Tensor<D>& l);

extern template Tensor<2> exponential<2>(const Tensor<2>&);
extern template Tensor<3> exponential<3>(const Tensor<3>&);
extern template bool logarithm<2>(const Tensor<2>&, Tensor<2>&);
extern template bool logarithm<3>(const Tensor<3>&, Tensor<3>&);
}

#endif
