// SPDX-License-Identifier: BSD-3-Clause
/// @file SymmetricEigen.h
/// Eigenvalues and eigenvectors of symmetric tensors, and tensors from them.
#ifndef meshopt_Metric_SymmetricEigen_h
#define meshopt_Metric_SymmetricEigen_h

#include "Mesh/Types.h"

namespace meshopt
{
/// A symmetric tensor Q diag(values) Q'.
template <int D>
struct SymmetricEigen
{
  Tensor<D> vectors = Tensor<D>::Identity(); ///< Q: orthonormal columns
  Vec<D> values = Vec<D>::Zero();            ///< ascending

  /// `m` must be finite; only its lower half is read. Safe for all magnitudes, since m is scaled
  /// first.
  static SymmetricEigen of(const Tensor<D>& m);

  /// The tensor; symmetric to the last bit.
  Tensor<D> compose() const
  {
    const Tensor<D> m = this->vectors * this->values.asDiagonal() * this->vectors.transpose();
    return 0.5 * (m + m.transpose());
  }
};
}

#endif
