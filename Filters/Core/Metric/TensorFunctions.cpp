// SPDX-License-Identifier: BSD-3-Clause
#include "Metric/TensorFunctions.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace meshopt
{
namespace
{
/// Taylor series of exp(a) for a symmetric tensor without trace, of norm at most 1/2. By Cayley and
/// Hamilton a^3 = p a + q, p = tr(a^2) / 2, q = det(a): every power is x + y a + z a^2.
Tensor<3> series(const Tensor<3>& a)
{
  const Tensor<3> square = a * a;
  const double p = 0.5 * square.trace(), q = a.determinant();
  double x = 1.0, y = 0.0, z = 0.0; // a^k / k!
  double sx = 1.0, sy = 0.0, sz = 0.0;
  for (int k = 1; k <= 14; ++k)
  {
    const double next = q * z / k;
    const double zNext = y / k;
    y = (x + p * z) / k;
    x = next;
    z = zNext;
    sx += x;
    sy += y;
    sz += z;
  }
  return sx * Tensor<3>::Identity() + sy * a + sz * square;
}

/// The same in 2D: a^2 = w^2, so that exp(a) = cosh(w) + a sinh(w) / w.
Tensor<2> series(const Tensor<2>& a)
{
  const double w2 = a(0, 0) * a(0, 0) + a(0, 1) * a(1, 0);
  double even = 1.0, odd = 1.0, x = 1.0, y = 1.0;
  for (int k = 1; k <= 7; ++k)
  {
    x *= w2 / ((2 * k - 1) * (2 * k));
    y *= w2 / ((2 * k) * (2 * k + 1));
    even += x;
    odd += y;
  }
  return even * Tensor<2>::Identity() + odd * a;
}
}

template <int D>
Tensor<D> exponential(const Tensor<D>& l)
{
  const double mean = l.trace() / D;
  const Tensor<D> a = l - mean * Tensor<D>::Identity();
  const double norm = a.norm();
  int squarings = 0;
  double scale = 1.0;
  while (norm * scale > 0.5 && squarings < 60)
  {
    scale *= 0.5;
    ++squarings;
  }
  Tensor<D> e = series(Tensor<D>(scale * a));
  for (int k = 0; k < squarings; ++k)
  {
    e = (e * e).eval();
  }
  return 0.5 * std::exp(mean) * (e + e.transpose());
}

template <int D>
bool logarithm(const Tensor<D>& m, Tensor<D>& l)
{
  const double norm = m.norm();
  if (!std::isfinite(norm) || norm == 0.0 || (m - m.transpose()).norm() > 1e-9 * norm)
  {
    return false;
  }
  // scaled, so that neither very large nor very small tensors overflow in the eigenvalue iteration;
  // in 2D with a third direction of its own
  Eigen::Matrix3d scaled = Eigen::Matrix3d::Identity();
  scaled.topLeftCorner<D, D>() = 0.5 * (m + m.transpose()) / norm;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
  if (solver.info() != Eigen::Success || !(solver.eigenvalues()[0] > 1e-15))
  {
    return false;
  }
  const Eigen::Vector3d logs = solver.eigenvalues().array().log() + std::log(norm);
  const Eigen::Matrix3d full = solver.eigenvectors() * logs.asDiagonal() *
    solver.eigenvectors().transpose();
  l = full.topLeftCorner<D, D>();
  l = (0.5 * (l + l.transpose())).eval();
  return true;
}

template Tensor<2> exponential<2>(const Tensor<2>&);
template Tensor<3> exponential<3>(const Tensor<3>&);
template bool logarithm<2>(const Tensor<2>&, Tensor<2>&);
template bool logarithm<3>(const Tensor<3>&, Tensor<3>&);
}
