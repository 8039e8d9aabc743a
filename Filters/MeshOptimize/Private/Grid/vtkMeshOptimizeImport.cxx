// SPDX-License-Identifier: BSD-3-Clause
// From a grid to the mesh of the core. Cells that are not optimized hold their points, and
// triangles and lines among them keep faces and edges.
#include "Grid/vtkMeshOptimizeImport.h"

#include "vtkMeshBridgeImport.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::MeshInput;
using vtkMeshBridge::Cells;

namespace
{

/**
 * Fixes the points of cells that pass through, and those of the caller's mask.
 */
template <int D>
void ImportFixedPoints(const Cells& cells, vtkDataArray* mask, MeshInput<D>& input)
{
  input.fixedPoints.assign(cells.PointUse.size(), 0);
  for (std::size_t p = 0; p < cells.PointUse.size(); ++p)
  {
    const bool isMasked = mask && mask->GetComponent(static_cast<vtkIdType>(p), 0) != 0.0;
    input.fixedPoints[p] = isMasked || (cells.PointUse[p] & vtkMeshBridge::UsedByOther);
  }
}

template <int D>
void ImportBorder(vtkDataArray* mask, MeshInput<D>& input)
{
  for (vtkIdType p = 0; mask && p < mask->GetNumberOfTuples(); ++p)
  {
    input.borderPoints.push_back(mask->GetComponent(p, 0) != 0.0);
  }
}

/**
 * An edge of a plane mesh is a facet.
 */
void KeepEdge(Index a, Index b, MeshInput<2>& input) { input.keptFacets.push_back({ a, b }); }

void KeepEdge(Index a, Index b, MeshInput<3>& input) { input.keptEdges.push_back({ a, b }); }

/**
 * A triangle is a cell of a plane mesh, not a facet.
 */
void KeepTriangle(const vtkIdType*, MeshInput<2>&) {}

void KeepTriangle(const vtkIdType* ids, MeshInput<3>& input)
{
  input.keptFacets.push_back(
    { static_cast<Index>(ids[0]), static_cast<Index>(ids[1]), static_cast<Index>(ids[2]) });
}

/**
 * Keeps triangles and lines that pass through, if they are faces or edges of the mesh.
 */
template <int D>
void ImportKept(vtkUnstructuredGrid* grid, const Cells& cells, MeshInput<D>& input)
{
  // Every cell is a simplex of the mesh: none passes through.
  if (cells.IsIdentity())
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
MeshInput<D> ImportMesh(const Model<D>& model)
{
  MeshInput<D> input = vtkMeshBridge::ImportGeometry(
    model.Grid, model.Cells.Simplices, model.Frame);
  input.regions = vtkMeshBridge::ReadRegions(model.Arrays.Region, model.Cells);
  ImportFixedPoints(model.Cells, model.Arrays.FixedPoints, input);
  ImportBorder(model.Arrays.BorderPoints, input);
  ImportKept(model.Grid, model.Cells, input);
  return input;
}

template <int D>
std::string BuildMesh(Model<D>& model)
{
  const auto error = meshopt::SimplexMesh<D>::build(ImportMesh(model), model.Mesh);
  return error ? vtkMeshBridge::WithGridIds(error->message, error->cell, model.Cells)
               : std::string();
}

template meshopt::MeshInput<2> ImportMesh<2>(const Model<2>&);
template meshopt::MeshInput<3> ImportMesh<3>(const Model<3>&);
template std::string BuildMesh<2>(Model<2>&);
template std::string BuildMesh<3>(Model<3>&);

} // namespace vtkMeshOptimizeBridge
