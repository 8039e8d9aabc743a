// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeQuality.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include "Quality/ElementQuality.h"

#include <limits>

namespace vtkMeshOptimizeBridge
{
namespace
{

/** The array belongs to the grid. */
vtkDoubleArray* AddQualityArray(vtkUnstructuredGrid* output)
{
  vtkNew<vtkDoubleArray> quality;
  quality->SetName("MeshQuality");
  quality->SetNumberOfValues(output->GetNumberOfCells());
  quality->FillValue(std::numeric_limits<double>::quiet_NaN());
  output->GetCellData()->AddArray(quality);
  return quality;
}

/**
 * Core points of an output cell; false if it is no simplex of dimension D.
 */
template <int D>
bool GetSimplex(vtkUnstructuredGrid* grid, const OutputMap& map,
  const meshopt::SimplexMesh<D>& mesh, std::size_t cell, meshopt::Simplex<D>& nodes)
{
  if (map.CellToSlot[cell] != meshopt::None)
  {
    nodes = mesh.nodes(map.CellToSlot[cell]);
    return true;
  }
  const vtkIdType source = map.CellToSource[cell];
  if (grid->GetCellType(source) != (D == 3 ? VTK_TETRA : VTK_TRIANGLE))
  {
    return false;
  }
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(source, n, ids);
  for (int i = 0; i <= D; ++i)
  {
    nodes[i] = static_cast<meshopt::Index>(ids[i]);
  }
  return true;
}

} // namespace

template <int D>
void AddMeshQuality(vtkUnstructuredGrid* grid, const OutputMap& map,
  const meshopt::SimplexMesh<D>& mesh, const meshopt::NodalMetric<D>& metric,
  const meshopt::Options& options, vtkUnstructuredGrid* output)
{
  double* values = AddQualityArray(output)->GetPointer(0);
  meshopt::dispatch<D>(options.measure,
    [&](auto shape)
    {
      const meshopt::ElementQuality<D, decltype(shape)> quality{ options.beta };
      meshopt::Simplex<D> nodes;
      for (std::size_t c = 0; c < map.CellToSource.size(); ++c)
      {
        if (GetSimplex(grid, map, mesh, c, nodes))
        {
          meshopt::Corners<D> corners;
          for (int i = 0; i <= D; ++i)
          {
            corners[i] = mesh.point(nodes[i]);
          }
          values[c] = quality.value(corners, metric.element(nodes));
        }
      }
    });
}

void AddNoMeshQuality(vtkUnstructuredGrid* output) { AddQualityArray(output); }

template void AddMeshQuality<2>(vtkUnstructuredGrid*, const OutputMap&,
  const meshopt::SimplexMesh<2>&, const meshopt::NodalMetric<2>&, const meshopt::Options&,
  vtkUnstructuredGrid*);
template void AddMeshQuality<3>(vtkUnstructuredGrid*, const OutputMap&,
  const meshopt::SimplexMesh<3>&, const meshopt::NodalMetric<3>&, const meshopt::Options&,
  vtkUnstructuredGrid*);

} // namespace vtkMeshOptimizeBridge
