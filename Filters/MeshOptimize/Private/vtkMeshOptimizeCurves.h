// SPDX-License-Identifier: BSD-3-Clause
/**
 * The curves that the boundary slides along: from the options, the mesh, and the geometry of the
 * second input.
 */
#ifndef vtkMeshOptimizeCurves_h
#define vtkMeshOptimizeCurves_h

#include "vtkMeshOptimizeModel.h"
#include "vtkMeshOptimizeRequest.h"

#include "Surface/BoundaryCurves.h"

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
 * Makes the curves for the model's mesh, if its boundary is to slide. Returns an empty string, or a
 * sentence about what cannot be used.
 */
std::string BuildCurves(const Request& request, Model<2>& model, meshopt::BoundaryCurves& curves);
std::string BuildCurves(const Request& request, Model<3>& model, meshopt::BoundaryCurves& curves);

} // namespace vtkMeshOptimizeBridge

#endif
