// SPDX-License-Identifier: BSD-3-Clause
// The quality of each cell of the output, in the same measure and metric as in the run.
#include "OneGrid/vtkMeshOptimizeQuality.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include "Quality/ElementQuality.h"

#include <cmath>
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
  // NaN: a cell that is not measured must not pass for a bad one.
  quality->FillValue(std::numeric_limits<double>::quiet_NaN());
  output->GetCellData()->AddArray(quality);
  if (!output->GetCellData()->GetScalars()) // what ParaView colours by
  {
    output->GetCellData()->SetActiveScalars("MeshQuality");
  }
  return quality;
}

/**
 * Core points of an output cell; false if it is not a simplex of dimension D.
 */
template <int D>
bool GetSimplex(
  const Model<D>& model, const OutputMap& map, std::size_t cell, meshopt::Simplex<D>& nodes)
{
  // Cells that passed through, such as ghosts, are measured by their nodes in the grid.
  if (map.CellToSlot[cell] != meshopt::None)
  {
    nodes = model.Mesh.nodes(map.CellToSlot[cell]);
    return true;
  }
  const vtkIdType source = map.CellToSource[cell];
  if (model.Grid->GetCellType(source) != (D == 3 ? VTK_TETRA : VTK_TRIANGLE))
  {
    return false;
  }
  vtkIdType n = 0;
  // Point ids of the core are those of the grid.
  const vtkIdType* ids = nullptr;
  model.Grid->GetCellPoints(source, n, ids);
  for (int i = 0; i <= D; ++i)
  {
    nodes[i] = static_cast<meshopt::Index>(ids[i]);
  }
  return true;
}

} // namespace

template <int D>
void AddMeshQuality(const Model<D>& model, const OutputMap& map, const meshopt::Options& options,
  vtkUnstructuredGrid* output)
{
  double* values = AddQualityArray(output)->GetPointer(0);
  meshopt::dispatch<D>(options.measure,
    [&](auto shape)
    {
      const meshopt::ElementQuality<D, decltype(shape)> quality{ options.beta };
      meshopt::Simplex<D> nodes;
      for (std::size_t c = 0; c < map.CellToSource.size(); ++c)
      {
        if (GetSimplex(model, map, c, nodes))
        {
          meshopt::Corners<D> corners;
          for (int i = 0; i <= D; ++i)
          {
            corners[i] = model.Mesh.point(nodes[i]);
          }
          const meshopt::ElementMetric<D> metric = model.Metric.element(nodes);
          // A ghost without a usable size is not measured: only its shape would count.
          const bool isUsable = options.beta == 0.0 || !std::isnan(metric.desiredSize);
          values[c] = isUsable ? quality.value(corners, metric) : values[c];
        }
      }
    });
}

void AddNoMeshQuality(vtkUnstructuredGrid* output) { AddQualityArray(output); }

template void AddMeshQuality<2>(
  const Model<2>&, const OutputMap&, const meshopt::Options&, vtkUnstructuredGrid*);
template void AddMeshQuality<3>(
  const Model<3>&, const OutputMap&, const meshopt::Options&, vtkUnstructuredGrid*);

} // namespace vtkMeshOptimizeBridge
