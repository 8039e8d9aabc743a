// SPDX-License-Identifier: BSD-3-Clause
/**
 * Copies of parts of data arrays of any type.
 */
#ifndef vtkMeshBridgeTuples_h
#define vtkMeshBridgeTuples_h

#include "vtkSmartPointer.h"

class vtkAbstractArray;
class vtkIdList;

namespace vtkMeshBridge
{

/**
 * An array without tuples that has the name, type, components and information of another.
 */
vtkSmartPointer<vtkAbstractArray> MakeLike(vtkAbstractArray* source);

/**
 * An array like `source`; its tuple i is tuple ids[i] of `source`.
 */
vtkSmartPointer<vtkAbstractArray> Select(vtkAbstractArray* source, vtkIdList* ids);

} // namespace vtkMeshBridge

#endif
