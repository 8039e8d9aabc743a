// SPDX-License-Identifier: BSD-3-Clause
// Apart from the header, since a compiler takes seconds for the eigensolver wherever it is used.
#include "Metric/SymmetricEigen.h"

#include <Eigen/Eigenvalues>

namespace meshopt
{
template <int D>
SymmetricEigen<D> SymmetricEigen<D>::of(const Tensor<D>& m)
{
  SymmetricEigen e;
  const double scale = m.cwiseAbs().maxCoeff();
  if (scale > 0.0)
  {
    const Eigen::Matrix<double, D, D> scaled = m / scale;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> solver(scaled);
    e.vectors = solver.eigenvectors();
    e.values = scale * solver.eigenvalues();
  }
  return e;
}

template struct SymmetricEigen<2>;
template struct SymmetricEigen<3>;
}
