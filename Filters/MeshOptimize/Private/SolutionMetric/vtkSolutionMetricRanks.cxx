// SPDX-License-Identifier: BSD-3-Clause
// Points, simplices and the one array that is read come to the first rank; the metric goes back.
// Layers of ghost cells would do for second derivatives inside of the body, but not for the rest:
// on the surface all of them are found together, the gradation runs over the whole mesh in the
// order of its points, and the number of elements is that of all pieces. So the values are those
// of one rank, and that rank needs memory for all of them, but for no other array.
#include "SolutionMetric/vtkSolutionMetricRanks.h"

#include "Ranks/vtkMeshRanksIds.h"
#include "Ranks/vtkMeshRanksPart.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <utility>

namespace vtkSolutionMetricBridge
{

using namespace vtkMeshRanks;

namespace
{

// No user's array has this name.
constexpr const char* PlaceName = "vtkSolutionMetric.Place";

/**
 * What a rank brings along.
 */
struct Piece
{
  Part Mesh;                     ///< with the values as its only array
  std::vector<vtkIdType> Wanted; ///< the id of each point of the grid; -1: no rank has it
  Schema Points, Cells;          ///< one of them has the values, the other is empty
  bool IsFloat = false;          ///< the coordinates
};

std::vector<vtkIdType> ReadIds(vtkDataArray* array, const std::vector<vtkIdType>& chosen)
{
  std::vector<vtkIdType> ids;
  if (array)
  {
    const std::vector<long long> all = vtkMeshBridge::ReadIntegers(array);
    std::transform(chosen.begin(), chosen.end(), std::back_inserter(ids),
      [&](vtkIdType i) { return static_cast<vtkIdType>(all[i]); });
  }
  return ids;
}

/**
 * The schema of the values, the same on all ranks. A rank without cells may lack the array.
 */
Schema AgreeOnValues(const Ranks& ranks, vtkDataArray* values)
{
  Schema mine;
  Bytes bytes, common;
  if (values)
  {
    mine.Arrays.push_back(MakeLike(values));
    mine.Attributes.push_back(-1);
    bytes = mine.Describe();
  }
  bool differs = false;
  for (const Bytes& theirs : ranks.Gather(bytes))
  {
    differs = differs || (!theirs.empty() && !common.empty() && theirs != common);
    common = common.empty() ? theirs : common;
  }
  ranks.Agree(differs ? "The array is not of the same name, type and size on all ranks." : "");
  Reader reader(common);
  return values || common.empty() ? mine : Schema::From(reader);
}

/**
 * Reads this rank's piece, and numbers its points over all ranks.
 */
Piece ReadPiece(const Ranks& ranks, vtkUnstructuredGrid* grid, const Request& request,
  const std::vector<vtkIdType>& simplices, int dimension)
{
  Piece piece;
  (request.UseErrors ? piece.Cells : piece.Points) = AgreeOnValues(ranks, request.Values);
  // A grid with no other array, so that only what is read is sent.
  vtkNew<vtkUnstructuredGrid> lean;
  if (grid->GetPoints())
  {
    lean->SetPoints(grid->GetPoints());
  }
  if (grid->GetNumberOfCells() > 0)
  {
    lean->CopyStructure(grid);
  }
  const vtkIdType n = grid->GetNumberOfPoints();
  vtkNew<vtkIdTypeArray> places;
  places->SetName(PlaceName);
  places->SetNumberOfValues(n);
  std::generate(
    places->GetPointer(0), places->GetPointer(0) + n, [p = vtkIdType(0)]() mutable { return p++; });
  if (request.Values)
  {
    lean->GetAttributes(request.UseErrors ? 1 : 0)->AddArray(request.Values);
  }
  lean->GetPointData()->AddArray(places);
  Schema points = piece.Points;
  points.Arrays.push_back(MakeLike(places));
  points.Attributes.push_back(-1);
  std::vector<vtkIdType> chosen;
  piece.Mesh = vtkMeshRanks::ReadPiece(
    lean, simplices, dimension + 1, points, piece.Cells, nullptr, 0, chosen);
  vtkDataArray* pointIds = simplices.empty() ? nullptr : grid->GetPointData()->GetGlobalIds();
  vtkDataArray* cellIds = simplices.empty() ? nullptr : grid->GetCellData()->GetGlobalIds();
  Numbering numbering;
  numbering.Else = "";
  numbering.HasPointIds = ranks.IsAny(pointIds != nullptr);
  numbering.HasCellIds = ranks.IsAny(cellIds != nullptr);
  const bool lacksOne = !simplices.empty() &&
    ((numbering.HasPointIds && !pointIds) || (numbering.HasCellIds && !cellIds));
  ranks.Agree(lacksOne ? "Some ranks have global ids, this one has not." : "");
  const std::vector<CellFacet> open = FindOpenFacets(piece.Mesh);
  Number(
    ranks, ReadIds(pointIds, chosen), ReadIds(cellIds, simplices), open, numbering, piece.Mesh);
  // Points of ghost cells have no place in the part, but their ids tell what they are copies of.
  piece.Wanted.assign(n, -1);
  if (pointIds)
  {
    const std::vector<long long> all = vtkMeshBridge::ReadIntegers(pointIds);
    piece.Wanted.assign(all.begin(), all.end());
  }
  auto ordered = vtkIdTypeArray::SafeDownCast(piece.Mesh.PointArrays.back());
  for (vtkIdType p = 0; p < piece.Mesh.GetNumberOfPoints(); ++p)
  {
    piece.Wanted[ordered->GetValue(p)] = piece.Mesh.PointIds[p];
  }
  piece.Mesh.PointArrays.pop_back();
  const bool isFloat = simplices.empty() || grid->GetPoints()->GetDataType() == VTK_FLOAT;
  piece.IsFloat = !ranks.IsAny(!isFloat);
  return piece;
}

/**
 * The mesh of all ranks, on the first one; nothing on the others. Empties the piece's mesh.
 */
Part Gather(const Ranks& ranks, Piece& piece)
{
  std::vector<Bytes> out(ranks.GetCount());
  if (!ranks.IsFirst())
  {
    out[0] = Pack(piece.Mesh);
  }
  const int corners = piece.Mesh.Corners;
  std::vector<Part> parts{ std::exchange(piece.Mesh, Part()) };
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    if (!bytes.empty())
    {
      parts.push_back(Unpack(bytes, corners, piece.Points, piece.Cells));
    }
  }
  Part whole;
  ranks.Agree(ranks.IsFirst() ? Join(std::move(parts), whole) : "");
  return whole;
}

/**
 * What the first rank adds to the whole mesh. Returns an error.
 */
std::string Compute(const Part& whole, const Piece& piece, Request request,
  vtkUnstructuredGrid* result, Outcome& outcome)
{
  if (whole.CellIds.empty())
  {
    return {};
  }
  const auto grid = MakeGrid(whole, piece.Points, piece.Cells);
  if (piece.IsFloat)
  {
    // As exact as the input: how far points may be from their plane depends on it.
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    points->DeepCopy(grid->GetPoints());
    grid->SetPoints(points);
  }
  request.Values = grid->GetAttributes(request.UseErrors ? 1 : 0)->GetArray(0);
  const int before = grid->GetPointData()->GetNumberOfArrays();
  const std::string error = AddArrays(grid, request, outcome);
  for (int i = before; error.empty() && i < grid->GetPointData()->GetNumberOfArrays(); ++i)
  {
    result->GetPointData()->AddArray(grid->GetPointData()->GetAbstractArray(i));
  }
  return error.empty() ? error
                       : error +
      " (Points and cells are counted over all ranks, in the order of "
      "their global ids.)";
}

/**
 * The first rank answers each one with the values at the points that it wants.
 */
void SendBack(const Ranks& ranks, const Part& whole, vtkUnstructuredGrid* result,
  const std::vector<vtkIdType>& wanted, vtkUnstructuredGrid* grid)
{
  std::vector<Bytes> out(ranks.GetCount()), answers(ranks.GetCount());
  PutAll(out[0], wanted);
  const std::vector<Bytes> in = ranks.Exchange(std::move(out));
  for (int r = 0; r < ranks.GetCount() && ranks.IsFirst(); ++r)
  {
    // A point that no simplex uses gets the values of another one: a tensor, at least.
    std::vector<vtkIdType> places = Reader(in[r]).TakeAll<vtkIdType>();
    for (vtkIdType& place : places)
    {
      const auto found = std::lower_bound(whole.PointIds.begin(), whole.PointIds.end(), place);
      const bool exists = found != whole.PointIds.end() && *found == place;
      place = exists ? found - whole.PointIds.begin() : 0;
    }
    const Schema schema = Schema::Of(result->GetPointData());
    const Bytes names = schema.Describe();
    answers[r].insert(answers[r].end(), names.begin(), names.end());
    for (int i = 0; i < result->GetPointData()->GetNumberOfArrays(); ++i)
    {
      Pack(Select(result->GetPointData()->GetAbstractArray(i), places), answers[r]);
    }
  }
  const std::vector<Bytes> got = ranks.Exchange(std::move(answers));
  Reader reader(got[0]);
  for (vtkAbstractArray* like : Schema::From(reader).Arrays)
  {
    const auto array = Unpack(reader, like);
    if (grid->GetNumberOfCells() > 0)
    {
      grid->GetPointData()->AddArray(array);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
std::string AddArraysOnRanks(vtkMultiProcessController* controller, vtkAlgorithm* filter,
  vtkUnstructuredGrid* grid, Request& request, Outcome& outcome)
{
  const Ranks ranks(controller);
  return ranks.Together(
    [&]()
    {
      vtkMeshBridge::Cells cells;
      std::string error = FindArray(filter, grid, request);
      error = error.empty() ? CheckInput(grid, request, cells) : error;
      ranks.Agree(error);
      const std::vector<int> all = ranks.Gather(cells.Dimension);
      const int dimension = *std::max_element(all.begin(), all.end());
      if (dimension == 0)
      {
        ranks.Agree(grid->GetNumberOfCells() > 0 ? vtkMeshBridge::NoSimplices : "");
        return std::string();
      }
      if (cells.Dimension != dimension)
      {
        // A rank that has got faces of the mesh alone: they pass through, as beside tetrahedra.
        cells.Simplices.clear();
        request.Values = nullptr;
      }
      Piece piece = ReadPiece(ranks, grid, request, cells.Simplices, dimension);
      const Part whole = Gather(ranks, piece);
      vtkNew<vtkUnstructuredGrid> result;
      // The first rank works alone; what it throws ends the wait of the others.
      error = ranks.IsFirst() ? Compute(whole, piece, request, result, outcome) : "";
      ranks.Agree(error);
      SendBack(ranks, whole, result, piece.Wanted, grid);
      outcome = ranks.Gather(outcome)[0];
      return std::string();
    });
}

} // namespace vtkSolutionMetricBridge
