#include "vtkMeshOptimizeSampling.h"

#include "vtkMeshOptimizeImport.h"

#include "vtkUnstructuredGrid.h"

#include <limits>

namespace vtkMeshOptimizeBridge
{

using meshopt::Background;
using meshopt::Index;

namespace
{

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
    const meshopt::Location<D> place = background.locate(mesh.point(slot), hint);
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
