// SPDX-License-Identifier: BSD-3-Clause
/**
 * Point arrays that hold boundary conditions: 0 at all points inside. New points inside, and those
 * that move there, must not get a part of what their neighbours on the surface have: Constraint,
 * for example, would then hold the body inside.
 */
#ifndef vtkMeshOptimizeConditions_h
#define vtkMeshOptimizeConditions_h

#include "Grid/vtkMeshOptimizeExport.h"
#include "Grid/vtkMeshOptimizeModel.h"

class vtkDataSetAttributes;

namespace vtkMeshOptimizeBridge
{

/**
 * Finds them, and notes them in the model: arrays of numbers that are 0 at all points inside and
 * all over some facet of the surface. Inside are points that no kept facet, kept edge or other cell
 * holds. If there are none the mesh does not tell, and only arrays of integers count. To be called
 * before the mesh is changed.
 */
template <int D>
void FindConditions(Model<D>& model);

/**
 * Sets 0 in these arrays at points inside that moved or are new.
 */
template <int D>
void ClearConditionsInside(
  const Model<D>& model, const OutputMap& map, vtkDataSetAttributes* output);

} // namespace vtkMeshOptimizeBridge

#endif
