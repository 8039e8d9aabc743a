// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeArrays.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{
namespace
{

constexpr vtkMeshBridge::ArrayRole Roles[NumberOfInputArrays] = {
  { "region array", nullptr, true, true, { { 1, 0 } } },
  { "fixed point array", nullptr, false, false, { { 1, 0 } } },
  { "size array", nullptr, false, false, { { 1, 0 } } },
  { "metric array", nullptr, false, false, { { 6, 9 } } },
  { "corner array", nullptr, false, false, { { 1, 0 } } },
  { "patch array", nullptr, true, true, { { 1, 0 } } },
};

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
  vtkDataArray** targets[NumberOfInputArrays] = { &arrays.Region, &arrays.FixedPoints, &arrays.Size,
    &arrays.Metric, &arrays.Corners, &arrays.Patch };
  arrays = InputArrays();
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    vtkAbstractArray* found = vtkMeshBridge::FindArray(filter, grid, i, Roles[i]);
    const std::string error = found ? vtkMeshBridge::CheckArray(found, Roles[i]) : std::string();
    if (!error.empty())
    {
      return error;
    }
    *targets[i] = vtkDataArray::SafeDownCast(found);
  }
  return {};
}

std::string CheckArraysAreThere(
  vtkAlgorithm* filter, const std::vector<vtkUnstructuredGrid*>& grids, int elsewhere)
{
  const bool hasCells = std::any_of(grids.begin(), grids.end(),
    [](vtkUnstructuredGrid* grid) { return grid->GetNumberOfCells() > 0; });
  for (int i = 0; i < NumberOfInputArrays && hasCells; ++i)
  {
    // A block may lack what others have: only an array that none has is an error.
    const auto hasArray = [&](vtkUnstructuredGrid* grid)
    { return vtkMeshBridge::FindArray(filter, grid, i, Roles[i]) != nullptr; };
    if (vtkMeshBridge::IsWanted(filter, i) && i != elsewhere &&
      std::none_of(grids.begin(), grids.end(), hasArray))
    {
      return vtkMeshBridge::DescribeMissing(
        filter->GetInputArrayInformation(i)->Get(vtkDataObject::FIELD_NAME()), Roles[i]);
    }
  }
  return {};
}

} // namespace vtkMeshOptimizeBridge
