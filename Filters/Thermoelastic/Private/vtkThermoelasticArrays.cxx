// SPDX-License-Identifier: BSD-3-Clause
// The arrays that the filter reads, in one table, with the names that it looks for if none is
// chosen.
#include "vtkThermoelasticArrays.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkUnstructuredGrid.h"

namespace vtkThermoelasticBridge
{
namespace
{

// In the order of ArrayIndex. Only the region array has no default name: without one the body is
// one region, and an array that happens to be there must not divide it.
constexpr vtkMeshBridge::ArrayRole Roles[NumberOfInputArrays] = {
  { "temperature array", "Temperature", false, false, { { 1, 0 } } },
  { "array of Young's modulus", "YoungsModulus", true, false, { { 1, 0 } } },
  { "array of Poisson's ratio", "PoissonsRatio", true, false, { { 1, 0 } } },
  { "array of the thermal expansion", "ThermalExpansion", true, false, { { 1, 0 } } },
  { "region array", nullptr, true, true, { { 1, 0 } } },
  { "constraint array", "Constraint", false, false, { { 1, 3 } } },
  { "array of prescribed displacements", "PrescribedDisplacement", false, false, { { 3, 0 } } },
  { "traction array", "Traction", false, false, { { 1, 3 } } },
  { "facet traction array", "FacetTraction", true, false, { { 1, 3 } } },
};

} // namespace

const char* DefaultName(ArrayIndex index) { return Roles[index].DefaultName; }

std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays)
{
  arrays.fill(nullptr);
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    vtkAbstractArray* found = vtkMeshBridge::FindArray(filter, grid, i, Roles[i]);
    // Only an array that was chosen must be there: the default names are offers.
    if (!found && vtkMeshBridge::IsWanted(filter, i))
    {
      return vtkMeshBridge::DescribeMissing(
        filter->GetInputArrayInformation(i)->Get(vtkDataObject::FIELD_NAME()), Roles[i]);
    }
    const std::string error = found ? vtkMeshBridge::CheckArray(found, Roles[i]) : std::string();
    if (!error.empty())
    {
      return error;
    }
    arrays[i] = vtkDataArray::SafeDownCast(found);
  }
  return {};
}

} // namespace vtkThermoelasticBridge
