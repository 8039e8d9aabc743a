// SPDX-License-Identifier: BSD-3-Clause
// From the optimized mesh to a grid. What has not changed is copied from the input, so that it is
// the same to the last bit; ids of points and cells stay in the order of the input.
#include "Grid/vtkMeshOptimizeExport.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

/**
 * Compared in the core: on the way back to the grid a tilted plane would round.
 */
template <int D>
bool HasMoved(const Model<D>& model, Index p)
{
  double x[3];
  model.Grid->GetPoint(p, x);
  return model.Frame.ToCore(x) != model.Mesh.point(p);
}

/**
 * Old points first, in their order. Those that have moved, or are new, are noted for sampling.
 */
template <int D>
void MapPoints(const Model<D>& model, OutputMap& map)
{
  const SimplexMesh<D>& mesh = model.Mesh;
  map.SlotToPoint.assign(mesh.numberOfPointSlots(), -1);
  map.PointToSlot.reserve(mesh.numberOfPointSlots());
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    // Slots from here on came with the run.
    const bool isOld = p < mesh.numberOfInputPoints();
    // A point that no simplex used, or that another cell still uses, is not the optimizer's to
    // remove.
    const bool isOthers = isOld && model.Cells.PointUse[p] != vtkMeshBridge::UsedBySimplex;
    if (!isOthers && !mesh.isPointAlive(p))
    {
      continue;
    }
    const vtkIdType id = static_cast<vtkIdType>(map.PointToSlot.size());
    map.SlotToPoint[p] = id;
    map.PointToSlot.push_back(p);
    map.NumberOfOldPoints += isOld;
    const bool isUsed = mesh.isPointAlive(p);
    if (!isOld || (isUsed && HasMoved(model, p)))
    {
      map.SampledPoints.push_back(id);
    }
  }
}

/**
 * Whether the cell in slot k is still simplex k of the grid. (Its last nodes may have been
 * swapped.)
 */
template <int D>
bool IsStillThere(vtkUnstructuredGrid* grid, vtkIdType cell, const SimplexMesh<D>& mesh, Index k)
{
  if (!mesh.isAlive(k))
  {
    return false;
  }
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cell, n, ids);
  const auto& nodes = mesh.nodes(k);
  return std::is_permutation(nodes.begin(), nodes.end(), ids);
}

/**
 * Old cells first, in their order; then the new ones, each with the data of its parent.
 */
template <int D>
void MapCells(const Model<D>& model, OutputMap& map)
{
  vtkUnstructuredGrid* grid = model.Grid;
  const vtkMeshBridge::Cells& cells = model.Cells;
  const SimplexMesh<D>& mesh = model.Mesh;
  std::vector<char> isOld(mesh.numberOfCellSlots(), 0);
  // Lists that double as they grow would take twice the memory.
  const vtkIdType others = grid->GetNumberOfCells() -
    static_cast<vtkIdType>(cells.Simplices.size());
  map.CellToSource.reserve(static_cast<std::size_t>(mesh.countCells() + others));
  map.CellToSlot.reserve(static_cast<std::size_t>(mesh.countCells() + others));
  const auto add = [&](vtkIdType source, Index slot)
  {
    map.CellToSource.push_back(source);
    map.CellToSlot.push_back(slot);
  };
  // Simplices are in the order of the grid, so that one walk meets them all.
  std::size_t next = 0; // of cells.Simplices
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (next == cells.Simplices.size() || cells.Simplices[next] != c)
    {
      add(c, meshopt::None);
      continue;
    }
    const Index k = static_cast<Index>(next++);
    if (IsStillThere(grid, c, mesh, k))
    {
      isOld[k] = 1;
      add(c, k);
    }
  }
  map.NumberOfOldCells = static_cast<vtkIdType>(map.CellToSource.size());
  for (Index k = 0; k < mesh.numberOfCellSlots(); ++k)
  {
    if (mesh.isAlive(k) && !isOld[k])
    {
      // All cells of the run stem from some cell of the input, whose data they get.
      add(cells.Simplices[mesh.parent(k)], k);
    }
  }
}

template <int D>
void ExportPoints(const Model<D>& model, const OutputMap& map, vtkUnstructuredGrid* output)
{
  vtkUnstructuredGrid* grid = model.Grid;
  const vtkIdType n = static_cast<vtkIdType>(map.PointToSlot.size());
  vtkNew<vtkPoints> points;
  // What has been optimized is not rounded to floats; what has not changed keeps its type.
  points->SetDataType(map.SampledPoints.empty() ? grid->GetPoints()->GetDataType() : VTK_DOUBLE);
  points->SetNumberOfPoints(n);
  // First all old ones, then those that have moved are overwritten.
  for (vtkIdType id = 0; id < map.NumberOfOldPoints; ++id)
  {
    // From the grid, bit for bit: the way through a tilted plane and back would round.
    double x[3];
    grid->GetPoint(map.PointToSlot[id], x);
    points->SetPoint(id, x);
  }
  for (vtkIdType id : map.SampledPoints)
  {
    double x[3];
    model.Frame.ToGrid(model.Mesh.point(map.PointToSlot[id]), x);
    points->SetPoint(id, x);
  }
  output->SetPoints(points);
}

/**
 * Node ids of an output cell, in the core's order: the qualities that it reports are those of this
 * order, to the last bit. It is the order of the grid, except for cells that were renumbered, or
 * removed and made again.
 */
template <int D>
void GetOutputNodes(vtkUnstructuredGrid* grid, const OutputMap& map, const SimplexMesh<D>& mesh,
  std::size_t cell, std::vector<vtkIdType>& nodes)
{
  nodes.clear();
  const auto add = [&](const auto& slots)
  {
    for (Index p : slots)
    {
      nodes.push_back(map.SlotToPoint[p]);
    }
  };
  const std::size_t firstLine = map.CellToSlot.size() - map.Lines.size();
  const std::size_t firstTriangle = firstLine - map.Triangles.size();
  if (cell >= firstLine)
  {
    add(map.Lines[cell - firstLine]);
    return;
  }
  if (cell >= firstTriangle)
  {
    add(map.Triangles[cell - firstTriangle]);
    return;
  }
  const Index slot = map.CellToSlot[cell];
  if (slot != meshopt::None)
  {
    add(mesh.nodes(slot));
    return;
  }
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  // A cell that passes through: the same points, under their new numbers.
  grid->GetCellPoints(map.CellToSource[cell], n, ids);
  for (vtkIdType k = 0; k < n; ++k)
  {
    nodes.push_back(map.SlotToPoint[ids[k]]);
  }
}

template <int D>
int OutputType(vtkUnstructuredGrid* grid, const OutputMap& map, std::size_t cell)
{
  return map.CellToSlot[cell] != meshopt::None ? (D == 3 ? VTK_TETRA : VTK_TRIANGLE)
                                               : grid->GetCellType(map.CellToSource[cell]);
}

/**
 * The face stream of a polyhedron with the ids of the output.
 */
void InsertPolyhedron(
  vtkUnstructuredGrid* grid, vtkIdType cell, const OutputMap& map, vtkUnstructuredGrid* output)
{
  vtkNew<vtkIdList> stream;
  grid->GetFaceStream(cell, stream);
  // The stream begins with the number of faces; each face with the number of its points.
  vtkIdType place = 1;
  while (place < stream->GetNumberOfIds())
  {
    const vtkIdType n = stream->GetId(place++);
    for (vtkIdType k = 0; k < n; ++k, ++place)
    {
      stream->SetId(place, map.SlotToPoint[stream->GetId(place)]);
    }
  }
  output->InsertNextCell(VTK_POLYHEDRON, stream);
}

/**
 * Copies cell by cell, which only polyhedra need.
 */
template <int D>
void InsertCells(vtkUnstructuredGrid* grid, const OutputMap& map, const SimplexMesh<D>& mesh,
  vtkUnstructuredGrid* output)
{
  output->Allocate(static_cast<vtkIdType>(map.CellToSource.size()));
  std::vector<vtkIdType> nodes;
  for (std::size_t c = 0; c < map.CellToSource.size(); ++c)
  {
    const int type = OutputType<D>(grid, map, c);
    if (type == VTK_POLYHEDRON)
    {
      InsertPolyhedron(grid, map.CellToSource[c], map, output);
      continue;
    }
    GetOutputNodes(grid, map, mesh, c, nodes);
    output->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
  }
}

template <int D>
void SetCells(vtkUnstructuredGrid* grid, const OutputMap& map, const SimplexMesh<D>& mesh,
  vtkUnstructuredGrid* output)
{
  const vtkIdType n = static_cast<vtkIdType>(map.CellToSource.size());
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIdTypeArray> offsets, connectivity;
  types->SetNumberOfValues(n);
  offsets->SetNumberOfValues(n + 1);
  // As many as there are if all cells are simplices; others let it grow.
  connectivity->Allocate(n * (D + 1));
  std::vector<vtkIdType> nodes;
  for (vtkIdType c = 0; c < n; ++c)
  {
    types->SetValue(c, static_cast<unsigned char>(OutputType<D>(grid, map, c)));
    offsets->SetValue(c, connectivity->GetNumberOfValues());
    GetOutputNodes(grid, map, mesh, c, nodes);
    for (vtkIdType id : nodes)
    {
      connectivity->InsertNextValue(id);
    }
  }
  offsets->SetValue(n, connectivity->GetNumberOfValues());
  connectivity->Squeeze();
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output->SetCells(types, cells);
}

// Only cells that passed through can be polyhedra.
bool HasPolyhedra(vtkUnstructuredGrid* grid, const OutputMap& map)
{
  for (std::size_t c = 0; c < map.CellToSource.size(); ++c)
  {
    if (map.CellToSlot[c] == meshopt::None &&
      grid->GetCellType(map.CellToSource[c]) == VTK_POLYHEDRON)
    {
      return true;
    }
  }
  return false;
}

} // namespace

template <int D>
OutputMap MapOutput(const Model<D>& model)
{
  OutputMap map;
  MapPoints(model, map);
  MapCells(model, map);
  return map;
}

template <int D>
void ExportMesh(const Model<D>& model, const OutputMap& map, vtkUnstructuredGrid* output)
{
  ExportPoints(model, map, output);
  if (HasPolyhedra(model.Grid, map))
  {
    InsertCells(model.Grid, map, model.Mesh, output);
  }
  else
  {
    SetCells(model.Grid, map, model.Mesh, output);
  }
}

template OutputMap MapOutput<2>(const Model<2>&);
template OutputMap MapOutput<3>(const Model<3>&);
template void ExportMesh<2>(const Model<2>&, const OutputMap&, vtkUnstructuredGrid*);
template void ExportMesh<3>(const Model<3>&, const OutputMap&, vtkUnstructuredGrid*);

} // namespace vtkMeshOptimizeBridge
