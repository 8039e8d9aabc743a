// SPDX-License-Identifier: BSD-3-Clause
/**
 * The geometry of the second input, along which the boundary of triangles slides.
 */
#ifndef vtkMeshOptimizeGeometry_h
#define vtkMeshOptimizeGeometry_h

#include "Request/vtkMeshOptimizeRequest.h"
#include "vtkMeshBridgeFrame.h"

#include "Surface/LineNetwork.h"

#include <string>

class vtkAlgorithm;
class vtkPolyData;

namespace vtkMeshOptimizeBridge
{

/**
 * Whether `geometry` has the corner array that the caller of `filter` chose.
 */
bool HasCornerArray(vtkAlgorithm* filter, vtkPolyData* geometry);

/**
 * The lines of the geometry of the request, in the plane of the mesh. Returns an empty string, or a
 * sentence about what cannot be used.
 */
std::string ReadGeometry(
  const Request& request, const vtkMeshBridge::Frame<2>& frame, meshopt::LineNetwork& network);

} // namespace vtkMeshOptimizeBridge

#endif
