// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where in the input the moved and new points of the output lie.
 */
#ifndef vtkMeshOptimizeSampling_h
#define vtkMeshOptimizeSampling_h

#include "vtkMeshOptimizeExport.h"

#include <array>
#include <vector>

namespace vtkMeshOptimizeBridge
{

/**
 * A place in the input: corners of a cell, and their weights, which sum to 1; none is negative.
 * Corners that are not needed have weight 0.
 */
struct Sample
{
  std::array<vtkIdType, 4> Corners{ { 0, 0, 0, 0 } };
  std::array<double, 4> Weights{ { 1.0, 0.0, 0.0, 0.0 } };
  /// The corner nearest to the point.
  vtkIdType Nearest = 0;
};

/**
 * Finds each of map.SampledPoints in the input mesh; points outside take the nearest place.
 *
 * It is looked for among the simplices that are not in the output as they were: these fill the very
 * part of space that the changed cells of the output fill. So the cost is that of what has changed.
 */
template <int D>
std::vector<Sample> SampleInput(const Model<D>& model, const OutputMap& map);

} // namespace vtkMeshOptimizeBridge

#endif
