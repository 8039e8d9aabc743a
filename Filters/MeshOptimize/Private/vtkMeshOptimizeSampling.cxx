#include "vtkMeshOptimizeSampling.h"

#include "vtkMeshOptimizeImport.h"

#include "vtkUnstructuredGrid.h"

#include <Eigen/LU>

#include <limits>

namespace vtkMeshOptimizeBridge
{

using meshopt::Background;
using meshopt::Index;

namespace
{

/**
 * Weights from ratios of volumes are poor in flat cells. One step of refinement makes sum w_i x_i equal to x to
 * rounding, so that linear fields come out right in any cell.
 */
template <int D>
void RefineWeights(const Background<D>& background, const meshopt::Vec<D>& x,
  meshopt::Location<D>& place)
{
  meshopt::Tensor<D> edges;
  meshopt::Vec<D> rest = x - background.point(place.nodes[0]);
  for (int i = 1; i <= D; ++i)
  {
    edges.col(i - 1) = background.point(place.nodes[i]) - background.point(place.nodes[0]);
    rest -= place.weights[i] * edges.col(i - 1);
  }
  const Eigen::FullPivLU<meshopt::Tensor<D>> lu(edges);
  if (lu.isInvertible())
  {
    const meshopt::Vec<D> change = lu.solve(rest);
    for (int i = 1; i <= D; ++i)
    {
      place.weights[i] += change[i - 1];
    }
    place.weights[0] -= change.sum();
  }
}

template <int D>
Sample MakeSample(
  const Background<D>& background, const meshopt::Vec<D>& x, const meshopt::Location<D>& place)
{
  Sample sample;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= D; ++i)
  {
    sample.Corners[i] = place.nodes[i];
    sample.Weights[i] = place.weights[i];
    const double distance = (background.point(place.nodes[i]) - x).squaredNorm();
    if (distance < nearest)
    {
      nearest = distance;
      sample.Nearest = place.nodes[i];
    }
  }
  return sample;
}

} // namespace

template <int D>
std::shared_ptr<const Background<D>> FindBackground(vtkUnstructuredGrid* grid, const Cells& cells,
  const Frame<D>& frame, std::shared_ptr<const Background<D>> existing)
{
  if (existing)
  {
    return existing;
  }
  meshopt::SimplexMesh<D> mesh;
  BuildMesh(grid, cells, InputArrays(), frame, mesh); // has gone well before
  return std::make_shared<const Background<D>>(mesh);
}

template <int D>
std::vector<Sample> SampleInput(const Background<D>& background, const OutputMap& map,
  const meshopt::SimplexMesh<D>& mesh)
{
  std::vector<Sample> samples;
  samples.reserve(map.SampledPoints.size());
  for (vtkIdType id : map.SampledPoints)
  {
    const Index slot = map.PointToSlot[id];
    // Cells of the background are those of the input: a new point is near the parent of its cell.
    const Index hint = slot < mesh.numberOfInputPoints() ? background.cellOfPoint(slot)
                                                         : mesh.parent(mesh.cellOfPoint(slot));
    meshopt::Location<D> place = background.locate(mesh.point(slot), hint);
    if (place.distance == 0.0)
    {
      RefineWeights(background, mesh.point(slot), place);
    }
    samples.push_back(MakeSample(background, mesh.point(slot), place));
  }
  return samples;
}

template std::shared_ptr<const Background<2>> FindBackground<2>(vtkUnstructuredGrid*, const Cells&,
  const Frame<2>&, std::shared_ptr<const Background<2>>);
template std::shared_ptr<const Background<3>> FindBackground<3>(vtkUnstructuredGrid*, const Cells&,
  const Frame<3>&, std::shared_ptr<const Background<3>>);
template std::vector<Sample> SampleInput<2>(
  const Background<2>&, const OutputMap&, const meshopt::SimplexMesh<2>&);
template std::vector<Sample> SampleInput<3>(
  const Background<3>&, const OutputMap&, const meshopt::SimplexMesh<3>&);

} // namespace vtkMeshOptimizeBridge
