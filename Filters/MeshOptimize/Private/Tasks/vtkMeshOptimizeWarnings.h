// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the user is told after a run, beside errors.
 */
#ifndef vtkMeshOptimizeWarnings_h
#define vtkMeshOptimizeWarnings_h

#include "Request/vtkMeshOptimizeRequest.h"

class vtkAlgorithm;
class vtkDataObject;

namespace vtkMeshOptimizeBridge
{

/**
 * Warns about what was found and what was left.
 */
void Warn(vtkAlgorithm* filter, const Outcome& outcome);

/**
 * Warns about settings and input that have no effect: a newcomer would wonder why nothing happens.
 */
void WarnOfNoEffect(const Request& request, vtkDataObject* input, const Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
