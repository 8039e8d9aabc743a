// SPDX-License-Identifier: BSD-3-Clause
/// @file Stress.h
/// Symmetric stress in Voigt's form, and quantities derived from it.
#ifndef meshopt_Thermoelastic_Stress_h
#define meshopt_Thermoelastic_Stress_h

#include "Mesh/Types.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace meshopt::fem
{
/// Components of a stress: XX YY ZZ XY YZ XZ in 3D (VTK's order), XX YY ZZ XY in 2D, where Z is the
/// normal of the plane.
template <int D>
inline constexpr int StressSize = D == 3 ? 6 : 4;

/// Stress in the units of Young's modulus; tension is positive.
template <int D>
using Stress = Eigen::Matrix<double, StressSize<D>, 1, Eigen::DontAlign>;

template <int D>
Tensor<3> toTensor(const Stress<D>& s)
{
  Tensor<3> t = Tensor<3>::Zero();
  t.diagonal() = s.template head<3>();
  t(0, 1) = t(1, 0) = s[3];
  if constexpr (D == 3)
  {
    t(1, 2) = t(2, 1) = s[4];
    t(0, 2) = t(2, 0) = s[5];
  }
  return t;
}

/// Sum of the squares of all nine components.
template <int D>
double squaredNorm(const Stress<D>& s)
{
  return s.template head<3>().squaredNorm() +
    2.0 * s.template tail<StressSize<D> - 3>().squaredNorm();
}

template <int D>
double trace(const Stress<D>& s)
{
  return s[0] + s[1] + s[2];
}

/// Von Mises' equivalent stress: the norm of the deviator times sqrt(3/2). >= 0. By differences, in
/// which a pressure cancels: nothing is lost where it is much greater than the rest.
template <int D>
double vonMises(const Stress<D>& s)
{
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(
    0.5 * (a * a + b * b + c * c) + 3.0 * s.template tail<StressSize<D> - 3>().squaredNorm());
}

/// The three principal stresses, greatest first.
template <int D>
Vec<3> principalStresses(const Stress<D>& s)
{
  // The eigensolver is iterative: it is not made for NaN.
  if (!s.allFinite())
  {
    return Vec<3>::Constant(std::nan(""));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(toTensor<D>(s), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}
}

#endif
