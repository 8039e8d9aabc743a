// SPDX-License-Identifier: BSD-3-Clause
/**
 * Tractions and pressures of a grid as forces on the points of the core.
 */
#ifndef vtkThermoelasticLoads_h
#define vtkThermoelasticLoads_h

#include "vtkThermoelasticProblem.h"

namespace vtkThermoelasticBridge
{

/**
 * Adds the pressure on the whole surface, the traction array at points and the one on facets to
 * model.Problem.forces. Returns a sentence about the first value that cannot be used, or an empty
 * string.
 */
template <int D>
std::string SetLoads(const Request& request, Model<D>& model);

} // namespace vtkThermoelasticBridge

#endif
