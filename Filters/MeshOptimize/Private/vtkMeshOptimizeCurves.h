// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the boundary slides along: from the options, the mesh, and the geometry of the second input.
 */
#ifndef vtkMeshOptimizeCurves_h
#define vtkMeshOptimizeCurves_h

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeFrame.h"

#include "Surface/BoundaryCurves.h"

#include <string>

class vtkPolyData;

namespace vtkMeshOptimizeBridge
{

struct Request;

/**
 * Whether `geometry` has the corner array that the caller of `filter` wants.
 */
bool HasCornerArray(vtkAlgorithm* filter, vtkPolyData* geometry);

/**
 * Makes the curves for `mesh`, if its boundary is to slide. Returns a sentence about what cannot be
 * used, or an empty string.
 */
std::string BuildCurves(const Cells& cells, const InputArrays& arrays, const Frame<2>& frame,
  const Request& request, meshopt::SimplexMesh<2>& mesh, meshopt::BoundaryCurves& curves);
std::string BuildCurves(const Cells& cells, const InputArrays& arrays, const Frame<3>& frame,
  const Request& request, meshopt::SimplexMesh<3>& mesh, meshopt::BoundaryCurves& curves);

} // namespace vtkMeshOptimizeBridge

#endif
