// SPDX-License-Identifier: BSD-3-Clause
// The arrays that Mesh Optimize and Mesh Quality Min Max read, in one table.
#include "Request/vtkMeshOptimizeArrays.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace vtkMeshOptimizeBridge
{
namespace
{

// Name, wanted by default, on cells, whole numbers, number of components.
constexpr vtkMeshBridge::ArrayRole Roles[NumberOfInputArrays] = {
  { "region array", nullptr, true, true, { { 1, 0 } } },
  { "fixed point array", nullptr, false, false, { { 1, 0 } } },
  { "size array", nullptr, false, false, { { 1, 0 } } },
  { "metric array", nullptr, false, false, { { 6, 9 } } },
  { "corner array", nullptr, false, false, { { 1, 0 } } },
  { "patch array", nullptr, true, true, { { 1, 0 } } },
};

constexpr vtkMeshBridge::ArrayRole PatchesAtPoints = { "patch array", nullptr, false, false,
  { { 0, 0 } } };

/**
 * The array of this index in the grid, and its role. Patches may be on cells or at points: first
 * where the caller says, then at the other place (ParaView calls what is not chosen a point array).
 */
vtkAbstractArray* FindInRole(
  vtkAlgorithm* filter, vtkUnstructuredGrid* grid, int index, vtkMeshBridge::ArrayRole& role)
{
  // A copy: for patches the role depends on where the array was found.
  role = Roles[index];
  vtkAbstractArray* found = vtkMeshBridge::FindArray(filter, grid, index, role);
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  const bool isAtPoints = wanted->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
    wanted->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkAbstractArray* atPoints = index == PatchArray && (isAtPoints || !found)
    ? vtkMeshBridge::FindArray(filter, grid, index, PatchesAtPoints)
    : nullptr;
  if (atPoints)
  {
    role = PatchesAtPoints;
    found = atPoints;
  }
  return found;
}

/**
 * Marks are values that are not 0, which NaN is not, either: but it means that nothing is known.
 */
std::string CheckMarks(vtkDataArray* marks, const vtkMeshBridge::ArrayRole& role)
{
  const bool mayBeNaN = marks && !vtkMeshBridge::HoldsIntegers(marks);
  for (vtkIdType p = 0; mayBeNaN && p < marks->GetNumberOfTuples(); ++p)
  {
    if (std::isnan(marks->GetComponent(p, 0)))
    {
      const char* name = marks->GetName();
      return std::string("The ") + role.Noun + " '" + (name ? name : "(no name)") + "' at point " +
        std::to_string(p) + " is not a number.";
    }
  }
  return {};
}

} // namespace

void ChooseArray(vtkAlgorithm* filter, ArrayIndex index, const char* name)
{
  filter->SetInputArrayToProcess(index, 0, 0,
    Roles[index].OnCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                         : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    name ? name : "");
}

std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays)
{
  // Once for each grid: blocks have arrays of their own.
  // In the order of ArrayIndex.
  vtkDataArray** targets[NumberOfInputArrays] = { &arrays.Region, &arrays.FixedPoints, &arrays.Size,
    &arrays.Metric, &arrays.Corners, &arrays.Patch };
  arrays = InputArrays();
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    vtkMeshBridge::ArrayRole role;
    vtkAbstractArray* found = FindInRole(filter, grid, i, role);
    const std::string error = found ? vtkMeshBridge::CheckArray(found, role) : std::string();
    if (!error.empty())
    {
      return error;
    }
    *targets[i] = vtkDataArray::SafeDownCast(found);
    if (i == FixedPointArray || i == CornerArray)
    {
      const std::string unknown = CheckMarks(*targets[i], role);
      if (!unknown.empty())
      {
        return unknown;
      }
    }
    arrays.PatchIsAtPoints |= found && i == PatchArray && !role.OnCells;
  }
  return {};
}

std::string CheckArraysAreThere(
  vtkAlgorithm* filter, const std::vector<vtkUnstructuredGrid*>& grids, int elsewhere)
{
  // Without cells there is nothing that an array could be missing for.
  const bool hasCells = std::any_of(grids.begin(), grids.end(),
    [](vtkUnstructuredGrid* grid) { return grid->GetNumberOfCells() > 0; });
  for (int i = 0; i < NumberOfInputArrays && hasCells; ++i)
  {
    // A block may lack what others have: only an array that none has is an error.
    const auto hasArray = [&](vtkUnstructuredGrid* grid)
    {
      vtkMeshBridge::ArrayRole role;
      return FindInRole(filter, grid, i, role) != nullptr;
    };
    // The array of index `elsewhere` comes from another input.
    if (vtkMeshBridge::IsWanted(filter, i) && i != elsewhere &&
      std::none_of(grids.begin(), grids.end(), hasArray))
    {
      const char* name = filter->GetInputArrayInformation(i)->Get(vtkDataObject::FIELD_NAME());
      return i == PatchArray && name ? "The patch array '" + std::string(name) +
          "' is not there: the input has no such cell or point array."
                                     : vtkMeshBridge::DescribeMissing(name, Roles[i]);
    }
  }
  return {};
}

} // namespace vtkMeshOptimizeBridge
