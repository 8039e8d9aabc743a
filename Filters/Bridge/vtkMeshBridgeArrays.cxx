// SPDX-License-Identifier: BSD-3-Clause
// Which array of a grid a filter is to use, and what is wrong with it. All filters find and check
// their arrays here, so that the same fault gets the same sentence everywhere.
#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>

namespace vtkMeshBridge
{
namespace
{

bool HasRightComponents(vtkDataArray* array, const ArrayRole& role)
{
  const int n = array->GetNumberOfComponents();
  return role.Components[0] == 0 ? n > 0 : n == role.Components[0] || n == role.Components[1];
}

const char* InWords(int components)
{
  switch (components)
  {
    case 0:
      return "at least one";
    case 1:
      return "one";
    case 3:
      return "three";
    case 6:
      return "6 (XX YY ZZ XY YZ XZ)";
    default:
      return "9";
  }
}

std::string DescribeComponents(const ArrayRole& role)
{
  const int first = role.Components[0], second = role.Components[1];
  return std::string(InWords(first)) +
    (second > 0 ? std::string(" or ") + InWords(second) : std::string()) +
    (second == 0 && first <= 1 ? " is needed." : " are needed.");
}

} // namespace

//------------------------------------------------------------------------------
bool HoldsIntegers(vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

//------------------------------------------------------------------------------
bool HoldsIds(vtkDataSetAttributes* data, int i)
{
  const int attribute = data->IsArrayAnAttribute(i);
  return attribute == vtkDataSetAttributes::GLOBALIDS ||
    attribute == vtkDataSetAttributes::PEDIGREEIDS;
}

//------------------------------------------------------------------------------
bool IsOfEarlierRun(vtkAbstractArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return name == "MeshQuality" || name == "MinimumDihedralAngle";
}

//------------------------------------------------------------------------------
int AddBesideOthers(vtkAbstractArray* array, vtkDataSetAttributes* data)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  std::string free = name;
  while (!free.empty() && data->HasArray(free.c_str()))
  {
    free += " "; // for a moment only
  }
  array->SetName(free.empty() ? nullptr : free.c_str());
  const int place = data->AddArray(array);
  array->SetName(name.empty() ? nullptr : name.c_str());
  return place;
}

//------------------------------------------------------------------------------
bool IsWanted(vtkAlgorithm* filter, int index)
{
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  // ParaView sets a name always, "None" where nothing is chosen; other callers may set an
  // attribute.
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
    return name && *name && std::strcmp(name, "None") != 0;
  }
  return wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()) != 0;
}

/**
 * A chosen name decides, or what is active of the chosen kind. If nothing is chosen, the default
 * name of the role counts.
 */
vtkAbstractArray* FindArray(
  vtkAlgorithm* filter, vtkUnstructuredGrid* grid, int index, const ArrayRole& role)
{
  vtkDataSetAttributes* attributes = grid->GetPointData();
  if (role.OnCells)
  {
    attributes = grid->GetCellData();
  }
  // The name by default is looked up only if nothing is chosen: a choice that is not there is an
  // error.
  if (!IsWanted(filter, index))
  {
    return role.DefaultName ? attributes->GetAbstractArray(role.DefaultName) : nullptr;
  }
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    return attributes->GetAbstractArray(wanted->Get(vtkDataObject::FIELD_NAME()));
  }
  return attributes->GetAbstractAttribute(wanted->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
}

std::string CheckArray(vtkAbstractArray* found, const ArrayRole& role)
{
  const char* name = found->GetName();
  const std::string title = std::string("The ") + role.Noun + " '" + (name ? name : "(no name)") +
    "' has ";
  vtkDataArray* array = vtkDataArray::SafeDownCast(found);
  // Also arrays of strings: found by name, but no numbers.
  if (!array || (role.IsInteger && !HoldsIntegers(array)))
  {
    return title + "values of type " + found->GetDataTypeAsString() + "; " +
      (role.IsInteger ? "integers are needed." : "numbers are needed.");
  }
  return HasRightComponents(array, role) ? std::string()
                                         : title + std::to_string(array->GetNumberOfComponents()) +
      " components; " + DescribeComponents(role);
}

std::string CheckLength(vtkAbstractArray* array, vtkIdType wanted, const char* kind)
{
  if (array->GetNumberOfTuples() == wanted)
  {
    return {};
  }
  const char* name = array->GetName();
  return std::string("The ") + kind + " array '" + (name ? name : "(no name)") + "' has " +
    std::to_string(array->GetNumberOfTuples()) + " values, but the grid has " +
    std::to_string(wanted) + " " + kind + "s.";
}

std::string DescribeMissing(const char* name, const ArrayRole& role)
{
  return std::string("The ") + role.Noun + (name ? " '" + std::string(name) + "'" : "") +
    " is not there: the input has no such " + (role.OnCells ? "cell" : "point") + " array.";
}

} // namespace vtkMeshBridge
