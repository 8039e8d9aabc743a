// SPDX-License-Identifier: BSD-3-Clause
// The limits of the constants: within them the elasticity tensor is positive definite.
#include "Thermoelastic/Material.h"

#include <cmath>
#include <sstream>

namespace meshopt::fem
{
std::string checkMaterial(const Material& m, const std::string& where)
{
  // Written as !(x > 0), so that NaN is refused, too.
  std::ostringstream text;
  if (!(m.youngsModulus > 0.0) || !std::isfinite(m.youngsModulus))
  {
    text << "Young's modulus" << where << " is " << m.youngsModulus
         << "; it must be positive and finite.";
  }
  else if (!(m.poissonsRatio > -1.0) || !(m.poissonsRatio < 0.5))
  {
    text
      << "Poisson's ratio" << where << " is " << m.poissonsRatio
      << "; it must be greater than -1 and less than 0.5 (at 0.5 the material is incompressible, "
         "which linear elements cannot follow).";
  }
  else if (!std::isfinite(m.thermalExpansion))
  {
    // Any sign is right: there are materials that shrink when they get warm.
    text << "The thermal expansion" << where << " is " << m.thermalExpansion
         << "; it must be finite.";
  }
  return text.str();
}
}
