// SPDX-License-Identifier: BSD-3-Clause
/**
 * The input arrays of vtkThermoelasticFilter: found under the chosen or the default names, and
 * checked.
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
 * The arrays of a grid; nullptr for those that do not exist.
 */
using InputArrays = std::array<vtkDataArray*, NumberOfInputArrays>;

/**
 * The name of an array that the caller has not chosen; nullptr: none.
 */
const char* DefaultName(ArrayIndex index);

/**
 * Finds the arrays of `grid`. Returns an empty string, or a sentence about the first array that was
 * chosen but does not exist, or whose type or number of components is unusable.
 */
std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays);

} // namespace vtkThermoelasticBridge

#endif
