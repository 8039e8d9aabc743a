// SPDX-License-Identifier: BSD-3-Clause
/**
 * The places in the input of the moved and new points of the output.
 */
#ifndef vtkMeshOptimizeSampling_h
#define vtkMeshOptimizeSampling_h

#include "Grid/vtkMeshOptimizeExport.h"

#include "Metric/Background.h"

#include <array>
#include <vector>

namespace vtkMeshOptimizeBridge
{

/**
 * A place in the input: corners of a cell, and their weights. These sum to 1, and none is negative.
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
 * The sample of a point `x` that was found in the background at `place`.
 */
template <int D>
Sample MakeSample(const meshopt::Background<D>& background, const meshopt::Vec<D>& x,
  const meshopt::Location<D>& place);

/**
 * Finds each of map.SampledPoints in the input mesh; points outside of it get the nearest place.
 *
 * The search is restricted to the simplices that are changed in the output. These fill the same
 * part of space as the changed cells of the output, so the cost is proportional to the change.
 */
template <int D>
std::vector<Sample> SampleInput(const Model<D>& model, const OutputMap& map);

} // namespace vtkMeshOptimizeBridge

#endif
