/**
 * Where in the input the moved and new points of the output lie.
 */
#ifndef vtkMeshOptimizeSampling_h
#define vtkMeshOptimizeSampling_h

#include "vtkMeshOptimizeExport.h"

#include "Metric/Background.h"

#include <array>
#include <memory>
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
 * The input mesh as it was, to look points up in: that of the metric if it has one, else built anew,
 * which costs time only where it is needed, and no memory during the optimization.
 */
template <int D>
std::shared_ptr<const meshopt::Background<D>> FindBackground(vtkUnstructuredGrid* grid,
  const Cells& cells, const Frame<D>& frame,
  std::shared_ptr<const meshopt::Background<D>> existing);

/**
 * Finds each of map.SampledPoints in the input mesh; points outside take the nearest place.
 */
template <int D>
std::vector<Sample> SampleInput(const meshopt::Background<D>& background, const OutputMap& map,
  const meshopt::SimplexMesh<D>& mesh);

} // namespace vtkMeshOptimizeBridge

#endif
