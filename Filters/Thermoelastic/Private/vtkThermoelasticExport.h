// SPDX-License-Identifier: BSD-3-Clause
/**
 * core -> grid: the solution as arrays.
 */
#ifndef vtkThermoelasticExport_h
#define vtkThermoelasticExport_h

#include "vtkThermoelasticProblem.h"

class vtkTable;

namespace vtkThermoelasticBridge
{

/**
 * Adds the point and cell arrays of the results to `output`, a copy of model.Grid. Points and cells
 * that are not part of the mesh get NaN; displacements and reactions there are 0.
 */
template <int D>
void ExportSolution(
  const Model<D>& model, const meshopt::fem::Solution<D>& solution, vtkUnstructuredGrid* output);

/**
 * Adds the point array `Temperature` with the values used.
 */
void ExportTemperature(const std::vector<double>& temperature, vtkUnstructuredGrid* output);

/**
 * Adds the figures to the field data of `output`.
 */
void ExportFigures(const Outcome& outcome, vtkUnstructuredGrid* output);

/**
 * Columns Iteration and RelativeResidual.
 */
void ExportHistory(const std::vector<double>& history, vtkTable* table);

} // namespace vtkThermoelasticBridge

#endif
