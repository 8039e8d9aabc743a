// SPDX-License-Identifier: BSD-3-Clause
// Reads the cells of a grid once, with all checks that later steps rely on. Nothing behind this
// file looks for a bad id, a point twice, or a coordinate that is not finite.
#include "vtkMeshBridgeCells.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeGridView.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace vtkMeshBridge
{
namespace
{

// The core numbers points and cells with 32 bits, and facets with 32 bits of which 2 are the local
// number.
constexpr vtkIdType MaximumNumberOfPoints = vtkIdType(1) << 30;
using meshopt::MaximumNumberOfCells;

/**
 * Dimension of cells by VTK type; types unknown to VTK count as volumes. Each type is asked for
 * only once.
 */
class CellDimensions
{
public:
  int Get(int type)
  {
    const auto known = this->Known.find(type);
    if (known != this->Known.end())
    {
      return known->second;
    }
    vtkNew<vtkGenericCell> cell; // a new one: that of an unknown type cannot be used again
    cell->SetCellType(type);
    return this->Known[type] = cell->GetRepresentativeCell() ? cell->GetCellDimension() : 3;
  }

private:
  std::map<int, int> Known;
};

/**
 * Whoever reads arrays later trusts that each has a value for each point or cell.
 */
std::string CheckLengths(vtkDataSetAttributes* attributes, vtkIdType wanted, const char* kind)
{
  std::string error;
  for (int i = 0; i < attributes->GetNumberOfArrays() && error.empty(); ++i)
  {
    error = CheckLength(attributes->GetAbstractArray(i), wanted, kind);
  }
  return error;
}

vtkIdType CountTypes(vtkUnstructuredGrid* grid)
{
  vtkSmartPointer<vtkUnsignedCharArray> types = grid->GetCellTypesArray();
  return types ? types->GetNumberOfValues() : 0;
}

std::string CheckSizes(vtkUnstructuredGrid* grid)
{
  // GetCellType() would read what is not there.
  if (CountTypes(grid) < grid->GetNumberOfCells())
  {
    return "The grid has " + std::to_string(grid->GetNumberOfCells()) + " cells, but types of " +
      std::to_string(CountTypes(grid)) + " only.";
  }
  if (grid->GetNumberOfPoints() > MaximumNumberOfPoints ||
    grid->GetNumberOfCells() > MaximumNumberOfCells)
  {
    return "The grid has more than 2^30 points or 2^29 cells in one piece.";
  }
  std::string error = CheckLengths(grid->GetPointData(), grid->GetNumberOfPoints(), "point");
  return error.empty() ? CheckLengths(grid->GetCellData(), grid->GetNumberOfCells(), "cell")
                       : error;
}

std::string CellName(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  return "Cell " + std::to_string(cell) + " (" +
    vtkCellTypes::GetClassNameFromTypeId(grid->GetCellType(cell)) + ")";
}

/**
 * Later steps would read a point that does not exist. A polyhedron lists its points twice; both
 * lists must be correct.
 */
std::string CheckPointIds(
  vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdType n, const vtkIdType* ids)
{
  const vtkIdType numberOfPoints = grid->GetNumberOfPoints();
  for (vtkIdType k = 0; k < n; ++k)
  {
    if (ids[k] < 0 || ids[k] >= numberOfPoints)
    {
      return CellName(grid, cell) + " uses point " + std::to_string(ids[k]) +
        ", but the grid has " + std::to_string(numberOfPoints) + " points.";
    }
  }
  return {};
}

/**
 * The stream of faces says itself how long its faces are: this is checked before it is trusted.
 */
std::string CheckPolyhedron(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> stream; // number of faces, then for each its number of points and the points
  grid->GetFaceStream(cell, stream);
  vtkIdType place = 1;
  while (place < stream->GetNumberOfIds())
  {
    const vtkIdType n = stream->GetId(place);
    if (n < 0 || place + n >= stream->GetNumberOfIds())
    {
      return CellName(grid, cell) + " has a face that is cut short.";
    }
    const std::string error = CheckPointIds(grid, cell, n, stream->GetPointer(place + 1));
    if (!error.empty())
    {
      return error;
    }
    place += n + 1;
  }
  return {};
}

std::string CheckSimplex(vtkUnstructuredGrid* grid, vtkIdType cell, int nodes, vtkIdType n,
  const vtkIdType* ids, std::vector<std::uint8_t>& use)
{
  if (n != nodes)
  {
    return CellName(grid, cell) + " has " + std::to_string(n) + " points instead of " +
      std::to_string(nodes) + ".";
  }
  for (int i = 0; i < nodes; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if (ids[i] == ids[j])
      {
        return CellName(grid, cell) + " uses point " + std::to_string(ids[i]) + " twice.";
      }
    }
    // Looked at already, with an earlier cell.
    if (use[ids[i]] & UsedBySimplex)
    {
      continue;
    }
    double x[3];
    grid->GetPoint(ids[i], x);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return "Point " + std::to_string(ids[i]) + ", used by cell " + std::to_string(cell) +
        ", has a coordinate that is not finite: (" + std::to_string(x[0]) + ", " +
        std::to_string(x[1]) + ", " + std::to_string(x[2]) + ").";
    }
  }
  return {};
}

/**
 * Whether `is` holds for the type of a cell.
 */
template <class Is>
bool HasType(vtkUnstructuredGrid* grid, Is&& is)
{
  const vtkIdType n = std::min(grid->GetNumberOfCells(), CountTypes(grid));
  vtkIdType c = 0;
  while (c < n && !is(grid->GetCellType(c)))
  {
    ++c;
  }
  return c < n;
}

} // namespace

bool HasVolumes(vtkUnstructuredGrid* grid)
{
  CellDimensions dimensions;
  return HasType(grid, [&](int type) { return dimensions.Get(type) == 3; });
}

/**
 * Tetrahedra are the mesh, whatever is beside them: triangles there are marks on it. Triangles are
 * the mesh only if no other cell has a volume.
 */
int FindDimension(vtkUnstructuredGrid* grid)
{
  if (HasType(grid, [](int type) { return type == VTK_TETRA; }))
  {
    return 3;
  }
  return HasType(grid, [](int type) { return type == VTK_TRIANGLE; }) && !HasVolumes(grid) ? 2 : 0;
}

std::string ClassifyCells(vtkUnstructuredGrid* grid, Cells& cells)
{
  cells = Cells();
  std::string error = CheckSizes(grid);
  if (!error.empty())
  {
    return error;
  }
  cells.NumberOfCells = grid->GetNumberOfCells();
  cells.PointUse.assign(static_cast<std::size_t>(grid->GetNumberOfPoints()), 0);
  cells.Dimension = FindDimension(grid);
  const int simplexType = cells.Dimension == 3 ? VTK_TETRA : VTK_TRIANGLE;
  const GhostCells ghosts(grid);
  for (vtkIdType c = 0; c < cells.NumberOfCells; ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, n, ids);
    // Also of cells that pass through: their points are looked up by these ids later.
    error = CheckPointIds(grid, c, n, ids);
    const int type = grid->GetCellType(c);
    if (error.empty() && type == VTK_POLYHEDRON)
    {
      error = CheckPolyhedron(grid, c);
    }
    const bool isSimplex = cells.Dimension != 0 && type == simplexType;
    if (error.empty() && isSimplex)
    {
      error = CheckSimplex(grid, c, cells.Dimension + 1, n, ids, cells.PointUse);
    }
    if (!error.empty())
    {
      return error;
    }
    // Points of ghosts count as used by others: they will neither move nor vanish.
    const bool isOfMesh = isSimplex && !ghosts.Has(c);
    for (vtkIdType k = 0; k < n; ++k)
    {
      cells.PointUse[ids[k]] |= isOfMesh ? UsedBySimplex : UsedByOther;
    }
    if (isOfMesh)
    {
      cells.Simplices.push_back(c);
    }
    cells.NumberOfGhostSimplices += isSimplex && !isOfMesh;
    cells.NumberOfSurfaceTriangles += cells.Dimension == 0 && type == VTK_TRIANGLE;
    cells.NumberOfQuadraticSimplices += type == VTK_QUADRATIC_TETRA ||
      (type == VTK_QUADRATIC_TRIANGLE && cells.Dimension != 3);
  }
  return {};
}

std::string CheckOnlySimplices(vtkUnstructuredGrid* grid, const Cells& cells)
{
  const int simplex = cells.Dimension == 3 ? VTK_TETRA : VTK_TRIANGLE;
  const int least = cells.Dimension == 3 ? 3 : 2;
  CellDimensions dimensions;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type != simplex && dimensions.Get(type) >= least)
    {
      return CellName(grid, c) +
        " is neither a linear triangle nor a linear tetrahedron. Only these can be used. (In "
        "ParaView, Tetrahedralize splits other cells.)";
    }
  }
  return {};
}

/**
 * The core counts the cells of its mesh, while the user knows those of the grid.
 */
std::string WithGridIds(const std::string& message, meshopt::Index cell, const Cells& cells)
{
  if (cell == meshopt::None || cells.IsIdentity())
  {
    return message;
  }
  return message + " (Counted among the " + (cells.Dimension == 3 ? "tetrahedra" : "triangles") +
    " of the mesh; number " + std::to_string(cell) + " of them is cell " +
    std::to_string(cells.Simplices[cell]) + " of the grid.)";
}

} // namespace vtkMeshBridge
