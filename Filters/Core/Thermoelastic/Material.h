// SPDX-License-Identifier: BSD-3-Clause
/// @file Material.h
/// The isotropic linear thermoelastic law, in 3D and 2D.
#ifndef meshopt_Thermoelastic_Material_h
#define meshopt_Thermoelastic_Material_h

#include "Thermoelastic/Stress.h"

#include <string>

namespace meshopt::fem
{
/// Material of an element, in any consistent units: stresses have the units of Young's modulus. The
/// defaults are uranium dioxide in SI.
struct Material
{
  double youngsModulus = 2e11;    ///< E > 0
  double poissonsRatio = 0.316;   ///< nu in ]-1, 0.5[
  double thermalExpansion = 1e-5; ///< alpha, per unit of temperature; any finite value
};

/// The state across the plane (D = 2 only).
enum class PlaneState
{
  PlaneStrain = 0, ///< the strain along the normal is given (zero, or Problem::outOfPlaneStrain)
  PlaneStress = 1  ///< the stress along the normal is zero
};

/// A sentence that says why `m` is unusable, such as "Young's modulus is -1; ...". `where` ("", "
/// of cell 5") is put behind the name. Empty if `m` is usable.
std::string checkMaterial(const Material& m, const std::string& where);

/// The law in Lame's form: sigma = lambda tr(e) I + 2 mu e - beta dT I. For plane stress, lambda
/// and beta are those of the condensed law, the trace is over the plane, and ZZ is zero.
template <int D>
struct Elasticity
{
  double lambda = 0.0, mu = 0.0;
  double beta = 0.0; ///< stress per unit of temperature if all strain is prevented
  double youngsModulus = 0.0, poissonsRatio = 0.0;
  bool planeStress = false;

  Elasticity() = default;
  Elasticity(const Material& m, PlaneState state)
    : youngsModulus(m.youngsModulus)
    , poissonsRatio(m.poissonsRatio)
    , planeStress(D == 2 && state == PlaneState::PlaneStress)
  {
    this->mu = m.youngsModulus / (2.0 * (1.0 + m.poissonsRatio));
    // In plane stress the strain along the normal is eliminated by sigma_zz = 0: 1 - 2 nu becomes
    // 1 - nu, and two directions are held in place of three.
    this->lambda = 2.0 * this->mu * m.poissonsRatio /
      (1.0 - (this->planeStress ? 1.0 : 2.0) * m.poissonsRatio);
    this->beta = ((this->planeStress ? 2.0 : 3.0) * this->lambda + 2.0 * this->mu) *
      m.thermalExpansion;
  }

  /// Stress from the displacement gradient g(i, j) = d u_i / d x_j, the temperature above the
  /// reference, and in 2D the strain along the normal.
  Stress<D> stress(const Tensor<D>& g, double dT, double outOfPlaneStrain) const
  {
    const double normal = D == 2 && !this->planeStress ? outOfPlaneStrain : 0.0;
    const double pressure = this->lambda * (g.trace() + normal) - this->beta * dT;
    Stress<D> s;
    for (int i = 0; i < D; ++i)
    {
      s[i] = pressure + 2.0 * this->mu * g(i, i);
    }
    if constexpr (D == 2)
    {
      s[2] = this->planeStress ? 0.0 : pressure + 2.0 * this->mu * normal;
    }
    else
    {
      s[4] = this->mu * (g(1, 2) + g(2, 1));
      s[5] = this->mu * (g(0, 2) + g(2, 0));
    }
    s[3] = this->mu * (g(0, 1) + g(1, 0));
    return s;
  }

  /// The stress that `dT` adds at the same strain.
  Stress<D> thermalStress(double dT) const
  {
    Stress<D> s = Stress<D>::Zero();
    s.template head<3>().setConstant(-this->beta * dT);
    s[2] = this->planeStress ? 0.0 : s[2];
    return s;
  }

  /// sigma : C^-1 : sigma, twice the density of the strain energy. By the compliance of the solid
  /// also in 2D, since the stress along the normal is among the components.
  double energyProduct(const Stress<D>& s) const
  {
    const double t = trace<D>(s);
    return ((1.0 + this->poissonsRatio) * squaredNorm<D>(s) - this->poissonsRatio * t * t) /
      this->youngsModulus;
  }
};
}

#endif
