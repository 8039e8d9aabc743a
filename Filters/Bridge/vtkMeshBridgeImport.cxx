// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshBridgeImport.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::MeshInput;

namespace
{

/**
 * Points of cells that pass through, and those of the caller's mask.
 */
template <int D>
void ImportFixedPoints(const Cells& cells, vtkDataArray* mask, MeshInput<D>& input)
{
  input.fixedPoints.assign(cells.PointUse.size(), 0);
  for (std::size_t p = 0; p < cells.PointUse.size(); ++p)
  {
    const bool isMasked = mask && mask->GetComponent(static_cast<vtkIdType>(p), 0) != 0.0;
    input.fixedPoints[p] = isMasked || (cells.PointUse[p] & UsedByOther);
  }
}

void KeepEdge(Index a, Index b, MeshInput<2>& input)
{
  input.constrainedFacets.push_back({ a, b });
}

void KeepEdge(Index a, Index b, MeshInput<3>& input) { input.constrainedEdges.push_back({ a, b }); }

void KeepTriangle(const vtkIdType*, MeshInput<2>&) {}

void KeepTriangle(const vtkIdType* ids, MeshInput<3>& input)
{
  input.constrainedFacets.push_back(
    { static_cast<Index>(ids[0]), static_cast<Index>(ids[1]), static_cast<Index>(ids[2]) });
}

/**
 * Triangles and lines that pass through are kept as faces and edges of the mesh where they are
 * such.
 */
template <int D>
void ImportKept(vtkUnstructuredGrid* grid, const Cells& cells, MeshInput<D>& input)
{
  if (cells.IsIdentity(grid->GetNumberOfCells()))
  {
    return;
  }
  std::size_t next = 0; // of cells.Simplices
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (next < cells.Simplices.size() && cells.Simplices[next] == c)
    {
      ++next;
      continue;
    }
    const int type = grid->GetCellType(c);
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, n, ids);
    if (n == 3 && (type == VTK_TRIANGLE || type == VTK_POLYGON))
    {
      KeepTriangle(ids, input);
    }
    if (type == VTK_LINE || type == VTK_POLY_LINE)
    {
      for (vtkIdType k = 0; k + 1 < n; ++k)
      {
        KeepEdge(static_cast<Index>(ids[k]), static_cast<Index>(ids[k + 1]), input);
      }
    }
  }
}

} // namespace

template <int D>
MeshInput<D> ImportGeometry(
  vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, const Frame<D>& frame)
{
  MeshInput<D> input;
  const vtkIdType numberOfPoints = grid->GetNumberOfPoints();
  input.points.resize(static_cast<std::size_t>(numberOfPoints));
  for (vtkIdType p = 0; p < numberOfPoints; ++p)
  {
    double x[3];
    grid->GetPoint(p, x);
    input.points[p] = frame.ToCore(x);
  }
  input.cells.resize(simplices.size());
  for (std::size_t k = 0; k < simplices.size(); ++k)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(simplices[k], n, ids);
    for (int i = 0; i <= D; ++i)
    {
      input.cells[k][i] = static_cast<Index>(ids[i]);
    }
  }
  return input;
}

template <int D>
MeshInput<D> ImportMesh(
  vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays, const Frame<D>& frame)
{
  MeshInput<D> input = ImportGeometry(grid, cells.Simplices, frame);
  input.regions = ReadRegions(arrays.Region, cells);
  ImportFixedPoints(cells, arrays.FixedPoints, input);
  ImportKept(grid, cells, input);
  return input;
}

template <int D>
std::string BuildMesh(vtkUnstructuredGrid* grid, const Cells& cells, const InputArrays& arrays,
  const Frame<D>& frame, meshopt::SimplexMesh<D>& mesh)
{
  const auto error = meshopt::SimplexMesh<D>::build(ImportMesh(grid, cells, arrays, frame), mesh);
  if (!error)
  {
    return {};
  }
  std::string message = error->message;
  if (error->cell != meshopt::None && !cells.IsIdentity(grid->GetNumberOfCells()))
  {
    message += std::string(" (Counted among the ") + (D == 3 ? "tetrahedra" : "triangles") +
      " that are optimized; number " + std::to_string(error->cell) + " of them is cell " +
      std::to_string(cells.Simplices[error->cell]) + " of the grid.)";
  }
  return message;
}

template meshopt::MeshInput<2> ImportGeometry<2>(
  vtkUnstructuredGrid*, const std::vector<vtkIdType>&, const Frame<2>&);
template meshopt::MeshInput<3> ImportGeometry<3>(
  vtkUnstructuredGrid*, const std::vector<vtkIdType>&, const Frame<3>&);
template meshopt::MeshInput<2> ImportMesh<2>(
  vtkUnstructuredGrid*, const Cells&, const InputArrays&, const Frame<2>&);
template meshopt::MeshInput<3> ImportMesh<3>(
  vtkUnstructuredGrid*, const Cells&, const InputArrays&, const Frame<3>&);
template std::string BuildMesh<2>(vtkUnstructuredGrid*, const Cells&, const InputArrays&,
  const Frame<2>&, meshopt::SimplexMesh<2>&);
template std::string BuildMesh<3>(vtkUnstructuredGrid*, const Cells&, const InputArrays&,
  const Frame<3>&, meshopt::SimplexMesh<3>&);

} // namespace vtkMeshOptimizeBridge
