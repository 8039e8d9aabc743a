// SPDX-License-Identifier: BSD-3-Clause
/**
 * One grid through the optimizer: grid -> import -> SimplexMesh -> optimize -> export -> grid.
 */
#ifndef vtkMeshOptimizeRun_h
#define vtkMeshOptimizeRun_h

#include "Request/vtkMeshOptimizeArrays.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include <string>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Optimizes `input`, which has these `arrays`, into `output`, which shares nothing with it. Returns
 * an empty string, or one sentence about what makes the input unusable; `output` is then not
 * usable.
 */
std::string OptimizeGrid(vtkUnstructuredGrid* input, const InputArrays& arrays,
  const Request& request, vtkUnstructuredGrid* output, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
