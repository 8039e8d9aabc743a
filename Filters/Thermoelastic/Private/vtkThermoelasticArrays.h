// SPDX-License-Identifier: BSD-3-Clause
/**
 * The input arrays of vtkThermoelasticFilter: found, under the names chosen or their default ones,
 * and checked.
 */
#ifndef vtkThermoelasticArrays_h
#define vtkThermoelasticArrays_h

#include <array>
#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace vtkThermoelasticBridge
{

/**
 * Indices of vtkAlgorithm::SetInputArrayToProcess().
 */
enum ArrayIndex
{
  TemperatureArray = 0,
  YoungsModulusArray = 1,
  PoissonsRatioArray = 2,
  ThermalExpansionArray = 3,
  RegionArray = 4,
  ConstraintArray = 5,
  PrescribedDisplacementArray = 6,
  TractionArray = 7,
  FacetTractionArray = 8,
  NumberOfInputArrays = 9
};

/**
 * The arrays of a grid; nullptr for those that are not there.
 */
using InputArrays = std::array<vtkDataArray*, NumberOfInputArrays>;

/**
 * Name under which an array is looked for that the caller has not chosen; nullptr: none.
 */
const char* DefaultName(ArrayIndex index);

/**
 * Finds the arrays of `grid`. Returns a sentence about the first that was chosen and is not there,
 * or that cannot be used because of its type or its number of components; else an empty string.
 */
std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays);

} // namespace vtkThermoelasticBridge

#endif
