// SPDX-License-Identifier: BSD-3-Clause
// Where a new point lies in the input, which decides the data it gets.
#include "Grid/vtkMeshOptimizeSampling.h"

#include "vtkMeshBridgeImport.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

namespace vtkMeshOptimizeBridge
{

using meshopt::Background;
using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

/**
 * Core ids, ascending, of the input simplices that have vanished or have a node that moved.
 */
template <int D>
std::vector<Index> ListChangedSimplices(const Model<D>& model, const OutputMap& map)
{
  const SimplexMesh<D>& mesh = model.Mesh;
  std::vector<char> hasMoved(mesh.numberOfPointSlots(), 0);
  std::vector<char> isKept(model.Cells.Simplices.size(), 0);
  for (const vtkIdType id : map.SampledPoints)
  {
    hasMoved[map.PointToSlot[id]] = 1;
  }
  for (vtkIdType c = 0; c < map.NumberOfOldCells; ++c)
  {
    // Points alone do not tell: cells between points that stayed may have changed as well.
    const Index slot = map.CellToSlot[c];
    if (slot != meshopt::None)
    {
      const auto& nodes = mesh.nodes(slot);
      isKept[slot] = std::none_of(
        nodes.begin(), nodes.end(), [&](Index p) { return hasMoved[p] != 0; });
    }
  }
  std::vector<Index> changed;
  for (std::size_t k = 0; k < isKept.size(); ++k)
  {
    if (!isKept[k])
    {
      changed.push_back(static_cast<Index>(k));
    }
  }
  return changed;
}

template <int D>
Background<D> MakeBackground(const Model<D>& model, const std::vector<Index>& changed)
{
  std::vector<vtkIdType> simplices(changed.size());
  std::transform(changed.begin(), changed.end(), simplices.begin(),
    [&](Index k) { return model.Cells.Simplices[k]; });
  SimplexMesh<D> mesh; // cannot fail: the whole mesh was built before
  SimplexMesh<D>::build(vtkMeshBridge::ImportGeometry(model.Grid, simplices, model.Frame), mesh);
  return Background<D>(mesh);
}

/**
 * A cell of the background near the point in slot p: one of the point, or the parent of a new cell.
 */
template <int D>
Index FindHint(const Background<D>& background, const std::vector<Index>& changed,
  const SimplexMesh<D>& mesh, Index p)
{
  if (p < mesh.numberOfInputPoints())
  {
    return background.cellOfPoint(p);
  }
  // A new point has no cell in the input. The parent of its cell is where that came from.
  const Index parent = mesh.parent(mesh.cellOfPoint(p));
  const auto found = std::lower_bound(changed.begin(), changed.end(), parent);
  return found != changed.end() && *found == parent ? static_cast<Index>(found - changed.begin())
                                                    : meshopt::None;
}

} // namespace

template <int D>
Sample MakeSample(
  const Background<D>& background, const meshopt::Vec<D>& x, const meshopt::Location<D>& place)
{
  Sample sample;
  double nearest = std::numeric_limits<double>::infinity();
  // The nearest corner serves data that cannot be averaged.
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

template <int D>
std::vector<Sample> SampleInput(const Model<D>& model, const OutputMap& map)
{
  const SimplexMesh<D>& mesh = model.Mesh;
  // Points that have moved or come lie where cells have changed: the others are not searched.
  const std::vector<Index> changed = ListChangedSimplices(model, map);
  const Background<D> background = MakeBackground(model, changed);
  std::vector<Sample> samples;
  samples.reserve(map.SampledPoints.size());
  for (const vtkIdType id : map.SampledPoints)
  {
    const Index p = map.PointToSlot[id];
    const meshopt::Location<D> place = background.locate(
      mesh.point(p), FindHint(background, changed, mesh, p));
    samples.push_back(MakeSample(background, mesh.point(p), place));
  }
  return samples;
}

template Sample MakeSample<2>(
  const Background<2>&, const meshopt::Vec<2>&, const meshopt::Location<2>&);
template Sample MakeSample<3>(
  const Background<3>&, const meshopt::Vec<3>&, const meshopt::Location<3>&);
template std::vector<Sample> SampleInput<2>(const Model<2>&, const OutputMap&);
template std::vector<Sample> SampleInput<3>(const Model<3>&, const OutputMap&);

} // namespace vtkMeshOptimizeBridge
