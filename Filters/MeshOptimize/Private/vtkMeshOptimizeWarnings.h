// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the user is told after a run, beside errors.
 */
#ifndef vtkMeshOptimizeWarnings_h
#define vtkMeshOptimizeWarnings_h

#include "vtkMeshOptimizeRequest.h"

class vtkDataObject;
class vtkMeshOptimizeFilter;

namespace vtkMeshOptimizeBridge
{

/**
 * Warns about what was found and what was left.
 */
void Warn(vtkMeshOptimizeFilter* filter, const Outcome& outcome);

/**
 * Warns about settings and input that have no effect: a newcomer would wonder why nothing happens.
 */
void WarnOfNoEffect(
  vtkMeshOptimizeFilter* filter, vtkDataObject* input, bool hasGeometry, const Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
