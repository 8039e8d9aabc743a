// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshBridgeTuples.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"

namespace vtkMeshBridge
{

vtkSmartPointer<vtkAbstractArray> MakeLike(vtkAbstractArray* source)
{
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(
    vtkAbstractArray::CreateArray(source->GetDataType()));
  array->SetName(source->GetName());
  array->SetNumberOfComponents(source->GetNumberOfComponents());
  array->CopyComponentNames(source);
  // Information tells units, for example, which a copy must keep.
  if (source->HasInformation())
  {
    array->CopyInformation(source->GetInformation(), 1);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> Select(vtkAbstractArray* source, vtkIdList* ids)
{
  vtkSmartPointer<vtkAbstractArray> array = MakeLike(source);
  array->SetNumberOfTuples(ids->GetNumberOfIds());
  if (vtkDataArray::SafeDownCast(source))
  {
    source->GetTuples(ids, array);
    return array;
  }
  // vtkStringArray::GetTuples() copies as many values as there are tuples: too few for two
  // components.
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    array->SetTuple(i, ids->GetId(i), source);
  }
  return array;
}

} // namespace vtkMeshBridge
