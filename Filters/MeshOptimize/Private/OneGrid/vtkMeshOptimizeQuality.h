// SPDX-License-Identifier: BSD-3-Clause
/**
 * The cell array `MeshQuality` of the output.
 */
#ifndef vtkMeshOptimizeQuality_h
#define vtkMeshOptimizeQuality_h

#include "Grid/vtkMeshOptimizeExport.h"

#include "Run/Options.h"

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Quality (2.2) of every output cell that is a simplex of dimension D (including ghosts), by the
 * measure, beta and metric of the run; NaN for all other cells.
 */
template <int D>
void AddMeshQuality(const Model<D>& model, const OutputMap& map, const meshopt::Options& options,
  vtkUnstructuredGrid* output);

/**
 * The array for a grid in which nothing was optimized: all NaN.
 */
void AddNoMeshQuality(vtkUnstructuredGrid* output);

} // namespace vtkMeshOptimizeBridge

#endif
