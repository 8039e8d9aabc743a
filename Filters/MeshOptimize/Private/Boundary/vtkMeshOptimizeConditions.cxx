// SPDX-License-Identifier: BSD-3-Clause
#include "Boundary/vtkMeshOptimizeConditions.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

/**
 * Whether the array is 0 at a point, in all components.
 */
bool IsZero(vtkDataArray* array, vtkIdType p)
{
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    if (array->GetComponent(p, i) != 0.0)
    {
      return false;
    }
  }
  return true;
}

template <int D>
std::vector<Index> ListInside(const SimplexMesh<D>& mesh)
{
  std::vector<Index> inside;
  for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
  {
    if (mesh.cellOfPoint(p) != meshopt::None && mesh.isFree(p))
    {
      inside.push_back(p);
    }
  }
  return inside;
}

/**
 * Whether the array is 0 all over some kept facet.
 */
template <int D>
bool IsZeroOnSomeFacet(const SimplexMesh<D>& mesh, vtkDataArray* array)
{
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(c, i))
      {
        const auto facet = mesh.facet(c, i);
        if (std::all_of(facet.begin(), facet.end(), [&](Index p) { return IsZero(array, p); }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace

template <int D>
void FindConditions(Model<D>& model)
{
  vtkPointData* data = model.Grid->GetPointData();
  if (data->GetNumberOfArrays() == 0)
  {
    return;
  }
  const std::vector<Index> inside = ListInside(model.Mesh);
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = data->GetArray(k);
    if (!array || vtkMeshBridge::HoldsIds(data, k))
    {
      continue;
    }
    // Without points inside, a field of numbers with fractions may well be 0 on some facets.
    if ((vtkMeshBridge::HoldsIntegers(array) || !inside.empty()) &&
      std::all_of(inside.begin(), inside.end(), [&](Index p) { return IsZero(array, p); }) &&
      IsZeroOnSomeFacet(model.Mesh, array))
    {
      model.Conditions.push_back(k);
    }
  }
}

template <int D>
void ClearConditionsInside(
  const Model<D>& model, const OutputMap& map, vtkDataSetAttributes* output)
{
  for (const int k : model.Conditions)
  {
    vtkDataArray* array = output->GetArray(k); // in the order of the input
    for (const vtkIdType id : map.SampledPoints)
    {
      for (int i = 0; model.Mesh.isFree(map.PointToSlot[id]) && i < array->GetNumberOfComponents();
           ++i)
      {
        array->SetComponent(id, i, 0.0);
      }
    }
  }
}

template void FindConditions<2>(Model<2>&);
template void FindConditions<3>(Model<3>&);
template void ClearConditionsInside<2>(const Model<2>&, const OutputMap&, vtkDataSetAttributes*);
template void ClearConditionsInside<3>(const Model<3>&, const OutputMap&, vtkDataSetAttributes*);

} // namespace vtkMeshOptimizeBridge
