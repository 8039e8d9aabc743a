// SPDX-License-Identifier: BSD-3-Clause
#include "vtkThermoelasticArrays.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <cstring>

namespace vtkThermoelasticBridge
{
namespace
{

struct Role
{
  const char* Noun;
  const char* Name; // looked for if none is chosen; nullptr: none then
  bool OnCells;
  bool MayBeScalar;
  bool MayBeVector;
  bool IsInteger;
};

constexpr Role Roles[NumberOfInputArrays] = {
  { "temperature array", "Temperature", false, true, false, false },
  { "array of Young's modulus", "YoungsModulus", true, true, false, false },
  { "array of Poisson's ratio", "PoissonsRatio", true, true, false, false },
  { "array of the thermal expansion", "ThermalExpansion", true, true, false, false },
  { "region array", nullptr, true, true, false, true },
  { "constraint array", "Constraint", false, true, true, false },
  { "array of prescribed displacements", "PrescribedDisplacement", false, false, true, false },
  { "traction array", "Traction", false, true, true, false },
  { "facet traction array", "FacetTraction", true, true, true, false },
};

/**
 * The name that the caller of `filter` has chosen, or nullptr. ParaView's "None" counts as none.
 */
const char* ChosenName(vtkAlgorithm* filter, int index)
{
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  if (!wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    return nullptr;
  }
  const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::strcmp(name, "None") != 0 ? name : nullptr;
}

bool IsInteger(vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

std::string CheckArray(const Role& role, const std::string& name, vtkAbstractArray* found)
{
  const std::string title = std::string("The ") + role.Noun + " '" + name + "'";
  vtkDataArray* array = vtkDataArray::SafeDownCast(found);
  if (!array || (role.IsInteger && !IsInteger(array)))
  {
    return title + " has values of type " + found->GetDataTypeAsString() + "; " +
      (role.IsInteger ? "integers are needed." : "numbers are needed.");
  }
  const int n = array->GetNumberOfComponents();
  if (!(role.MayBeScalar && n == 1) && !(role.MayBeVector && n == 3))
  {
    return title + " has " + std::to_string(n) + " components; " +
      (role.MayBeScalar && role.MayBeVector ? "one or three are needed."
          : role.MayBeScalar                ? "one is needed."
                                            : "three are needed.");
  }
  return {};
}

} // namespace

const char* DefaultName(ArrayIndex index) { return Roles[index].Name; }

std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays)
{
  arrays.fill(nullptr);
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    const Role& role = Roles[i];
    const char* chosen = ChosenName(filter, i);
    const char* name = chosen ? chosen : role.Name;
    vtkDataSetAttributes* attributes = grid->GetPointData();
    if (role.OnCells)
    {
      attributes = grid->GetCellData();
    }
    vtkAbstractArray* found = name ? attributes->GetAbstractArray(name) : nullptr;
    if (chosen && !found)
    {
      return std::string("The ") + role.Noun + " '" + chosen +
        "' is not there: the input has no such " + (role.OnCells ? "cell" : "point") + " array.";
    }
    const std::string error = found ? CheckArray(role, name, found) : std::string();
    if (!error.empty())
    {
      return error;
    }
    arrays[i] = vtkDataArray::SafeDownCast(found);
  }
  return {};
}

} // namespace vtkThermoelasticBridge
