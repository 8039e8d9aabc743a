// SPDX-License-Identifier: BSD-3-Clause
// Geometry only; regions and what is kept belong to the filters that know of them.
#include "vtkMeshBridgeImport.h"

#include "vtkMeshBridgeGridView.h"

namespace vtkMeshBridge
{

/**
 * All points, also those that no simplex uses: ids of points stay those of the grid.
 */
template <int D>
meshopt::MeshInput<D> ImportGeometry(
  vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, const Frame<D>& frame)
{
  const GridView view(grid);
  meshopt::MeshInput<D> input;
  input.points.resize(static_cast<std::size_t>(view.GetNumberOfPoints()));
  for (vtkIdType p = 0; p < view.GetNumberOfPoints(); ++p)
  {
    input.points[p] = frame.ToCore(view.GetPoint(p).data());
  }
  input.cells.resize(simplices.size());
  for (std::size_t k = 0; k < simplices.size(); ++k)
  {
    // Checked by ClassifyCells(): each has its corners, and their points exist.
    vtkIdType ids[D + 1] = {};
    view.GetCorners(simplices[k], D + 1, ids);
    for (int i = 0; i <= D; ++i)
    {
      input.cells[k][i] = static_cast<meshopt::Index>(ids[i]);
    }
  }
  return input;
}

template meshopt::MeshInput<2> ImportGeometry<2>(
  vtkUnstructuredGrid*, const std::vector<vtkIdType>&, const Frame<2>&);
template meshopt::MeshInput<3> ImportGeometry<3>(
  vtkUnstructuredGrid*, const std::vector<vtkIdType>&, const Frame<3>&);

} // namespace vtkMeshBridge
