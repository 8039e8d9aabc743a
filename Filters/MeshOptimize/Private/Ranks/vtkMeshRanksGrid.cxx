// SPDX-License-Identifier: BSD-3-Clause
// Between the parts of a divided mesh and grids, which a run reads and writes.
#include "Ranks/vtkMeshRanksPart.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <type_traits>

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
    const int place = vtkMeshBridge::AddBesideOthers(arrays[i], data);
    // What is active stays active: colours and later filters go by it.
    if (schema.Attributes[i] >= 0)
    {
      data->SetActiveAttribute(place, schema.Attributes[i]);
    }
  }
}

/**
 * A list as an array: a copy, or the list itself, if it has the type of the array.
 */
template <class Array, class T>
vtkSmartPointer<Array> MakeArray(
  const std::vector<T>& values, const char* name, int components, bool borrows)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  if constexpr (std::is_same_v<typename Array::ValueType, T>)
  {
    if (borrows && !values.empty())
    {
      constexpr int save = 1; // the array never frees it
      array->SetArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()), save);
      return array;
    }
  }
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

/**
 * Narrow ids are those of the part itself, which needs half the memory; wide ones are a copy.
 */
template <class Ids>
vtkSmartPointer<vtkCellArray> CellsOf(const Part& part, bool borrows)
{
  vtkNew<Ids> offsets;
  offsets->SetNumberOfValues(part.GetNumberOfCells() + 1);
  for (vtkIdType c = 0; c <= part.GetNumberOfCells(); ++c)
  {
    offsets->SetValue(c, static_cast<typename Ids::ValueType>(c * part.Corners));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, MakeArray<Ids>(part.Cells, nullptr, 1, borrows));
  return cells;
}

vtkSmartPointer<vtkUnstructuredGrid> GridOf(const Part& part, const Schema& pointSchema,
  const Schema& cellSchema, bool borrows, vtkCellArray* cells)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  // Double, whatever the input had: moved points must not be rounded at each round.
  const auto coordinates = MakeArray<vtkDoubleArray>(part.Coordinates, nullptr, 3, borrows);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  grid->SetPoints(points);
  grid->SetCells(part.Corners == 4 ? VTK_TETRA : VTK_TRIANGLE, cells);
  AddArrays(part.PointArrays, pointSchema, grid->GetPointData());
  AddArrays(part.CellArrays, cellSchema, grid->GetCellData());
  // Moved points keep their ids, new ones get -1.
  grid->GetPointData()->SetGlobalIds(MakeArray<vtkIdTypeArray>(part.PointIds, IdName, 1, borrows));
  grid->GetCellData()->SetGlobalIds(MakeArray<vtkIdTypeArray>(part.CellIds, IdName, 1, borrows));
  // Origin and home are cell data, so that the run hands them on from parents to new cells, as it
  // does with those of the user.
  grid->GetCellData()->AddArray(MakeArray<vtkIdTypeArray>(part.Origin, OriginName, 1, borrows));
  if (!part.Home.empty())
  {
    grid->GetCellData()->AddArray(MakeArray<vtkIntArray>(part.Home, HomeName, 1, borrows));
  }
  return grid;
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

/**
 * The arrays of the schema, each at the chosen points or cells. What a rank lacks, which may have
 * points but no cells, is 0 there.
 */
void Choose(vtkDataSetAttributes* data, const Schema& schema, const std::vector<vtkIdType>& chosen,
  Arrays& arrays)
{
  int next = 0; // the schema lists arrays in the order of the grid, which may have others between
  for (std::size_t a = 0; a < schema.Arrays.size(); ++a)
  {
    const char* name = schema.Arrays[a]->GetName();
    const auto isIt = [&](const char* other)
    { return name && other ? !std::strcmp(name, other) : name == other; }; // both may have none
    int i = next;
    while (i < data->GetNumberOfArrays() && !isIt(data->GetAbstractArray(i)->GetName()))
    {
      ++i;
    }
    if (i < data->GetNumberOfArrays())
    {
      arrays[a] = Select(data->GetAbstractArray(i), chosen);
      next = i + 1;
      continue;
    }
    arrays[a]->SetNumberOfTuples(static_cast<vtkIdType>(chosen.size()));
    if (auto numbers = vtkDataArray::SafeDownCast(arrays[a]))
    {
      numbers->Fill(0.0);
    }
  }
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
  if (home)
  {
    part.Home.assign(home->GetPointer(0), home->GetPointer(0) + n);
  }
  part.Kept.assign(n, 0); // it has taken part in one
  part.Cells.reserve(n * part.Corners);
  for (vtkIdType c = 0; c < n; ++c)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, size, ids);
    std::transform(ids, ids + size, std::back_inserter(part.Cells),
      [](vtkIdType p) { return static_cast<meshopt::Index>(p); });
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
  std::vector<meshopt::Index> index(use.size(), -1);
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
      index[p] = static_cast<meshopt::Index>(pointsOfGrid.size());
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
  Choose(grid->GetPointData(), points, pointsOfGrid, part.PointArrays);
  Choose(grid->GetCellData(), cells, simplices, part.CellArrays);
  return part;
}

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const Part& part, const Schema& points, const Schema& cellData)
{
  return GridOf(part, points, cellData, false, CellsOf<vtkTypeInt64Array>(part, false));
}

vtkSmartPointer<vtkUnstructuredGrid> BorrowGrid(
  const Part& part, const Schema& points, const Schema& cellData, vtkCellArray* cells)
{
  vtkSmartPointer<vtkCellArray> own;
  if (!cells)
  {
    own = part.Cells.size() <= static_cast<std::size_t>(VTK_INT_MAX)
      ? CellsOf<vtkTypeInt32Array>(part, true)
      : CellsOf<vtkTypeInt64Array>(part, true);
  }
  return GridOf(part, points, cellData, true, cells ? cells : own.Get());
}

bool HasSameCells(vtkUnstructuredGrid* grid, const Part& part)
{
  bool isSame = grid->GetNumberOfCells() == part.GetNumberOfCells() &&
    grid->GetNumberOfPoints() == part.GetNumberOfPoints();
  for (vtkIdType c = 0; c < part.GetNumberOfCells() && isSame; ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, n, ids);
    isSame = n == part.Corners && std::equal(ids, ids + n, part.GetCell(c));
  }
  return isSame;
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
