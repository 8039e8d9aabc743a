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
 * Adds the pressure on the whole surface, and the tractions at points and on facets, to
 * model.Problem.forces. Returns an empty string, or a sentence about the first unusable value.
 */
template <int D>
std::string SetLoads(const Request& request, Model<D>& model);

} // namespace vtkThermoelasticBridge

#endif
