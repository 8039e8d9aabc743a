// SPDX-License-Identifier: BSD-3-Clause
// Between the parts of a divided mesh and grids, which a run reads and writes.
#include "vtkMeshRanksPart.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>

namespace vtkMeshRanks
{
namespace
{

// No user's array has these names.
constexpr const char* IdName = "vtkMeshRanks.Id";
constexpr const char* OriginName = "vtkMeshRanks.Origin";
constexpr const char* HomeName = "vtkMeshRanks.Home";

void AddArrays(const Arrays& arrays, const Schema& schema, vtkDataSetAttributes* data)
{
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    const int place = data->AddArray(arrays[i]);
    // What is active stays active: colours and later filters go by it.
    if (schema.Attributes[i] >= 0)
    {
      data->SetActiveAttribute(place, schema.Attributes[i]);
    }
  }
}

void AddIds(const std::vector<vtkIdType>& ids, vtkDataSetAttributes* data)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(IdName);
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), array->GetPointer(0));
  data->SetGlobalIds(array); // moved points keep theirs, new ones get -1
}

/**
 * What MakeGrid() has added, as the run has left it: -1 for what is new.
 */
std::vector<vtkIdType> ReadIds(vtkDataSetAttributes* data)
{
  auto array = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(IdName));
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

/**
 * The first arrays of `data`, as many as the part had before: what MakeGrid() has added follows.
 */
Arrays ReadArrays(vtkDataSetAttributes* data, std::size_t n)
{
  Arrays arrays;
  for (std::size_t i = 0; i < n; ++i)
  {
    arrays.emplace_back(data->GetAbstractArray(static_cast<int>(i)));
  }
  return arrays;
}

void ReadCells(vtkUnstructuredGrid* grid, Part& part)
{
  const vtkIdType n = grid->GetNumberOfCells();
  part.CellIds = ReadIds(grid->GetCellData());
  // A run adds it always: see AddMeshQuality().
  auto quality = vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetArray("MeshQuality"));
  auto origin = vtkIdTypeArray::SafeDownCast(grid->GetCellData()->GetArray(OriginName));
  part.Quality.assign(quality->GetPointer(0), quality->GetPointer(0) + n);
  auto home = vtkIntArray::SafeDownCast(grid->GetCellData()->GetArray(HomeName));
  part.Origin.assign(origin->GetPointer(0), origin->GetPointer(0) + n);
  part.Home.assign(home->GetPointer(0), home->GetPointer(0) + n);
  part.Kept.assign(n, 0); // it has taken part in one
  part.Cells.reserve(n * part.Corners);
  for (vtkIdType c = 0; c < n; ++c)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, size, ids);
    part.Cells.insert(part.Cells.end(), ids, ids + size);
  }
}

} // namespace

//------------------------------------------------------------------------------
Part ReadPiece(vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, int corners,
  const Schema& points, const Schema& cells, vtkDataArray* fixedPoints, vtkIdType firstOrigin,
  std::vector<vtkIdType>& pointsOfGrid)
{
  Part part = MakePart(corners, points, cells);
  // Two bits: a point may have cells of both kinds.
  std::vector<char> use(grid->GetNumberOfPoints(), 0); // 1: by others, 2: by simplices
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, n, ids);
    std::for_each(ids, ids + n, [&](vtkIdType p) { use[p] |= 1; });
  }
  for (const vtkIdType c : simplices)
  {
    grid->GetCellPoints(c, n, ids);
    std::for_each(ids, ids + n, [&](vtkIdType p) { use[p] |= 2; });
  }
  std::vector<vtkIdType> index(use.size(), -1);
  const std::size_t most = use.size() - std::count(use.begin(), use.end(), 1);
  pointsOfGrid.reserve(most);
  part.Coordinates.reserve(3 * most);
  part.Flags.reserve(most);
  part.PointIds.reserve(most);
  part.Cells.reserve(simplices.size() * corners);
  part.CellIds.reserve(simplices.size());
  part.Origin.reserve(simplices.size());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    // A point of simplices, or of no cell at all. Those of other cells only stay where they are.
    if (use[p] != 1)
    {
      index[p] = static_cast<vtkIdType>(pointsOfGrid.size());
      pointsOfGrid.push_back(p);
      double x[3];
      grid->GetPoint(p, x);
      part.Coordinates.insert(part.Coordinates.end(), x, x + 3);
      const bool isFixed = fixedPoints && fixedPoints->GetComponent(p, 0) != 0.0;
      part.Flags.push_back(
        static_cast<std::uint8_t>((use[p] == 0 ? Loose : 0) | (isFixed ? PointFlag::Fixed : 0)));
      part.PointIds.push_back(index[p]);
    }
  }
  for (const vtkIdType c : simplices)
  {
    grid->GetCellPoints(c, n, ids);
    std::for_each(ids, ids + n, [&](vtkIdType p) { part.Cells.push_back(index[p]); });
    // Ids are local at first. The caller gives them global ones.
    part.CellIds.push_back(static_cast<vtkIdType>(part.CellIds.size()));
    part.Origin.push_back(firstOrigin + c);
  }
  part.Quality.assign(simplices.size(), 0.0);
  part.Home.assign(simplices.size(), 0);
  part.Kept.assign(simplices.size(), 0);
  part.Hint.assign(part.PointIds.size(), -1);
  const auto choose = [](vtkDataSetAttributes* data, const Schema& schema,
                        const std::vector<vtkIdType>& chosen, Arrays& arrays)
  {
    // The schema lists arrays in the order of the grid, so that one walk finds them all.
    std::size_t a = 0;
    for (int i = 0; i < data->GetNumberOfArrays() && a < schema.Arrays.size(); ++i)
    {
      vtkAbstractArray* array = data->GetAbstractArray(i);
      const char* name = schema.Arrays[a]->GetName();
      // Unnamed arrays match each other: a missing name equals a missing name.
      if (name && array->GetName() ? !std::strcmp(name, array->GetName())
                                   : name == array->GetName())
      {
        arrays[a++] = Select(array, chosen);
      }
    }
  };
  choose(grid->GetPointData(), points, pointsOfGrid, part.PointArrays);
  choose(grid->GetCellData(), cells, simplices, part.CellArrays);
  return part;
}

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const Part& part, const Schema& pointSchema, const Schema& cellSchema)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  // Double, whatever the input had: moved points must not be rounded at each round.
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(part.GetNumberOfPoints());
  std::copy(part.Coordinates.begin(), part.Coordinates.end(), coordinates->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  grid->SetPoints(points);
  vtkNew<vtkIdTypeArray> offsets, connectivity;
  offsets->SetNumberOfValues(part.GetNumberOfCells() + 1);
  for (vtkIdType c = 0; c <= part.GetNumberOfCells(); ++c)
  {
    offsets->SetValue(c, c * part.Corners);
  }
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(part.Cells.size()));
  std::copy(part.Cells.begin(), part.Cells.end(), connectivity->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  grid->SetCells(part.Corners == 4 ? VTK_TETRA : VTK_TRIANGLE, cells);
  AddArrays(part.PointArrays, pointSchema, grid->GetPointData());
  AddArrays(part.CellArrays, cellSchema, grid->GetCellData());
  AddIds(part.PointIds, grid->GetPointData());
  AddIds(part.CellIds, grid->GetCellData());
  // Origin and home are cell data, so that the run hands them on from parents to new cells, as it
  // does with those of the user.
  vtkNew<vtkIdTypeArray> origin;
  origin->SetName(OriginName);
  origin->SetNumberOfValues(part.GetNumberOfCells());
  std::copy(part.Origin.begin(), part.Origin.end(), origin->GetPointer(0));
  grid->GetCellData()->AddArray(origin);
  vtkNew<vtkIntArray> home;
  home->SetName(HomeName);
  home->SetNumberOfValues(part.GetNumberOfCells());
  std::copy(part.Home.begin(), part.Home.end(), home->GetPointer(0));
  grid->GetCellData()->AddArray(home);
  return grid;
}

void ForgetCells(Part& part)
{
  // The number of arrays still counts: see ReadGrid().
  Part points;
  std::swap(points.CellIds, part.CellIds);
  std::swap(points.Cells, part.Cells);
  std::swap(points.Quality, part.Quality);
  std::swap(points.Origin, part.Origin);
  std::swap(points.Home, part.Home);
  std::swap(points.Kept, part.Kept);
}

Part ReadGrid(vtkUnstructuredGrid* grid, const Part& before, bool isAgain)
{
  Part part;
  part.Corners = before.Corners;
  part.PointIds = ReadIds(grid->GetPointData());
  part.Coordinates.resize(3 * part.PointIds.size());
  part.Flags.assign(part.PointIds.size(), 0);
  part.Hint.assign(part.PointIds.size(), -1);
  ReadCells(grid, part);
  // From the last to the first, so that the cell with the lowest number stays.
  std::vector<vtkIdType> near(part.PointIds.size(), -1); // the origin of some cell of each point
  for (vtkIdType c = part.GetNumberOfCells() - 1; c >= 0; --c)
  {
    for (int i = 0; i < part.Corners; ++i)
    {
      near[part.GetCell(c)[i]] = part.Origin[c];
    }
  }
  std::size_t at = 0; // of the old points: those that are left have kept their order
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    double* x = &part.Coordinates[3 * p];
    grid->GetPoint(p, x);
    // New points stand at the end, with the id -1.
    const vtkIdType id = part.PointIds[p];
    while (id >= 0 && before.PointIds[at] != id)
    {
      ++at;
    }
    part.Flags[p] = id >= 0 ? before.Flags[at] : 0;
    part.Hint[p] = id >= 0 ? before.Hint[at] : -1;
    // Where a point has stayed, its data still are those of the input.
    if (isAgain && (id < 0 || !IsSamePlace(x, before.GetPoint(at))))
    {
      part.Hint[p] = near[p];
    }
  }
  // The user's own come first, and the run appends: the first arrays are those of the part.
  part.PointArrays = ReadArrays(grid->GetPointData(), before.PointArrays.size());
  part.CellArrays = ReadArrays(grid->GetCellData(), before.CellArrays.size());
  return part;
}

void RemoveOwn(vtkUnstructuredGrid* grid)
{
  grid->GetPointData()->RemoveArray(IdName);
  grid->GetCellData()->RemoveArray(IdName);
  grid->GetCellData()->RemoveArray(OriginName);
  grid->GetCellData()->RemoveArray(HomeName);
}

void NumberNew(vtkIdType firstPoint, vtkIdType firstCell, Part& part)
{
  // New ones stand behind the old ones and get greater ids: the order stays ascending.
  for (vtkIdType& id : part.PointIds)
  {
    id = id < 0 ? firstPoint++ : id;
  }
  for (vtkIdType& id : part.CellIds)
  {
    id = id < 0 ? firstCell++ : id;
  }
}

} // namespace vtkMeshRanks
