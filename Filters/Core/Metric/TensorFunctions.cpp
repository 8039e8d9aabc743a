// SPDX-License-Identifier: BSD-3-Clause
// Logarithm and exponential of symmetric tensors. The exponential is called for each cell that is
// tried in a metric, and is written for speed; the logarithm is called once per point.
#include "Metric/TensorFunctions.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <utility>

namespace meshopt
{
namespace
{
/// (2^-k, k): a tensor of this norm is halved k times, since the series needs a norm of at most
/// 1/2.
std::pair<double, int> halvings(double norm)
{
  std::pair<double, int> result(1.0, 0);
  while (norm * result.first > 0.5 && result.second < 60)
  {
    result.first *= 0.5;
    ++result.second;
  }
  return result;
}

/// exp(a) of a symmetric tensor without trace, by scaling and squaring. By Cayley and Hamilton a^3
/// = p a + q, p = tr(a^2) / 2, q = det(a). So every power is x + y a + z a^2, and the series and
/// the squarings work on three numbers. It is called for each cell that is tried, so it uses no
/// eigenvalues and no division.
Tensor<3> exponentialWithoutTrace(const Tensor<3>& symmetric)
{
  static constexpr double inverseFactorials[] = { 1.0, 1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120,
    1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800,
    1.0 / 479001600, 1.0 / 6227020800.0, 1.0 / 87178291200.0 };
  const auto [scale, squarings] = halvings(symmetric.norm());
  const Tensor<3> a = scale * symmetric;
  const double xx = a(0, 0), yy = a(1, 1), zz = a(2, 2), xy = a(1, 0), yz = a(2, 1), xz = a(2, 0);
  const double xx2 = xx * xx + xy * xy + xz * xz, yy2 = xy * xy + yy * yy + yz * yz,
               zz2 = xz * xz + yz * yz + zz * zz, xy2 = xx * xy + xy * yy + xz * yz,
               yz2 = xy * xz + yy * yz + yz * zz, xz2 = xx * xz + xy * yz + xz * zz;
  const double p = 0.5 * (xx2 + yy2 + zz2);
  const double q = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  double x = 0.0, y = 0.0, z = 0.0;
  for (int k = 14; k >= 0; --k) // Horner
  {
    // Times a: (x + y a + z a^2) a = q z + (x + p z) a + y a^2.
    const double next = q * z + inverseFactorials[k], zNext = y;
    y = x + p * z;
    x = next;
    z = zNext;
  }
  for (int k = 0; k < squarings; ++k)
  {
    // a^3 = p a + q and a^4 = p a^2 + q a bring the square back to three numbers.
    const double cubic = 2.0 * y * z, quartic = z * z;
    const double next = x * x + q * cubic, zNext = y * y + 2.0 * x * z + p * quartic;
    y = 2.0 * x * y + p * cubic + q * quartic;
    x = next;
    z = zNext;
  }
  Tensor<3> e;
  e(0, 0) = x + y * xx + z * xx2;
  e(1, 1) = x + y * yy + z * yy2;
  e(2, 2) = x + y * zz + z * zz2;
  e(0, 1) = e(1, 0) = y * xy + z * xy2;
  e(1, 2) = e(2, 1) = y * yz + z * yz2;
  e(0, 2) = e(2, 0) = y * xz + z * xz2;
  return e;
}

/// The same in 2D: a^2 = w^2, so exp(a) = cosh(w) + a sinh(w) / w.
Tensor<2> exponentialWithoutTrace(const Tensor<2>& symmetric)
{
  const auto [scale, squarings] = halvings(symmetric.norm());
  const Tensor<2> a = scale * symmetric;
  const double w2 = a(0, 0) * a(0, 0) + a(0, 1) * a(1, 0);
  double even = 1.0, odd = 1.0, x = 1.0, y = 1.0;
  for (int k = 1; k <= 7; ++k)
  {
    x *= w2 / ((2 * k - 1) * (2 * k));
    y *= w2 / ((2 * k) * (2 * k + 1));
    even += x;
    odd += y;
  }
  Tensor<2> e = even * Tensor<2>::Identity() + odd * a;
  for (int k = 0; k < squarings; ++k)
  {
    e = (e * e).eval();
  }
  return 0.5 * (e + e.transpose());
}
}

template <int D>
Tensor<D> exponential(const Tensor<D>& l)
{
  // The trace is split off: it commutes with everything, and what remains needs fewer squarings.
  const double mean = l.trace() / D;
  const Tensor<D> a = l - mean * Tensor<D>::Identity();
  return std::exp(mean) * exponentialWithoutTrace(a);
}

/// By eigenvalues, unlike exponential(): it is needed once per point of the input, not per try, and
/// they also tell whether the tensor is positive definite.
template <int D>
bool logarithm(const Tensor<D>& m, Tensor<D>& l)
{
  double norm = m.norm();
  if (!(norm > 1e-150 && norm < 1e150) && m.allFinite()) // its square may underflow or overflow
  {
    norm = m.cwiseAbs().maxCoeff();
  }
  if (!std::isfinite(norm) || norm == 0.0 || (m - m.transpose()).norm() > 1e-9 * norm)
  {
    return false;
  }
  // Scaled, so that neither very large nor very small tensors overflow in the eigenvalue iteration.
  // In 2D there is a third direction that does not interact.
  Eigen::Matrix3d scaled = Eigen::Matrix3d::Identity();
  scaled.topLeftCorner<D, D>() = 0.5 * (m + m.transpose()) / norm;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
  if (solver.info() != Eigen::Success || !(solver.eigenvalues()[0] > 1e-15))
  {
    return false;
  }
  const Eigen::Vector3d logs = solver.eigenvalues().array().log() + std::log(norm);
  // In 2D the third direction has the logarithm of the norm, which is no more than the others'.
  constexpr double most = 460.5; // ln(1e200)
  if (logs.minCoeff() < -most || logs.maxCoeff() > most)
  {
    return false;
  }
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
