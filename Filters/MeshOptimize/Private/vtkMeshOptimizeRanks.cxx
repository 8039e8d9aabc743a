// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeRanks.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshOptimizeArrays.h"
#include "vtkMeshOptimizeHistory.h"
#include "vtkMeshOptimizeRun.h"
#include "vtkMeshRanksBand.h"
#include "vtkMeshRanksCheck.h"
#include "vtkMeshRanksIds.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

constexpr int MostRounds = 4;
constexpr int Layers[MostRounds] = { 2, 2, 3, 4 };

/**
 * All that the steps of one update share.
 */
struct Rounds
{
  const Ranks& All;
  const Request& Wanted;
  Schema Points, Cells;
  vtkMeshRanks::Numbering Ids;
  Part Mine;
  Outcome& Result;

  std::string Optimize(Part& part, Request request, Outcome& outcome);
  std::string Round(int layers);
  bool IsDone() const;
  void Record(const char* stage, const Outcome& run);
};

std::string Rounds::Optimize(Part& part, Request request, Outcome& outcome)
{
  std::string error = this->All.Together(
    [&]()
    {
      if (part.CellIds.empty())
      {
        return std::string();
      }
      const auto grid = MakeGrid(part, this->Points, this->Cells);
      InputArrays arrays;
      std::string problem = FindInputArrays(request.Filter, grid, arrays);
      vtkNew<vtkUnsignedCharArray> fixed; // the array itself is interpolated at moved points
      fixed->SetNumberOfValues(part.GetNumberOfPoints());
      for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
      {
        fixed->SetValue(p, (part.Flags[p] & PointFlag::Fixed) != 0);
      }
      arrays.FixedPoints = fixed;
      vtkNew<vtkUnstructuredGrid> after;
      problem = problem.empty() ? OptimizeGrid(grid, arrays, request, after, outcome) : problem;
      if (problem.empty())
      {
        part = ReadGrid(after, part);
      }
      return problem;
    });
  const auto count = [](const std::vector<vtkIdType>& ids)
  { return static_cast<vtkIdType>(std::count(ids.begin(), ids.end(), -1)); };
  const vtkIdType mine[2] = { count(part.PointIds), count(part.CellIds) };
  const std::vector<vtkIdType> points = this->All.Gather(mine[0]);
  const std::vector<vtkIdType> cells = this->All.Gather(mine[1]);
  vtkIdType first[2] = { this->Ids.NextPoint, this->Ids.NextCell };
  for (int r = 0; r < this->All.GetCount(); ++r)
  {
    first[0] += r < this->All.GetRank() ? points[r] : 0;
    first[1] += r < this->All.GetRank() ? cells[r] : 0;
    this->Ids.NextPoint += points[r];
    this->Ids.NextCell += cells[r];
  }
  NumberNew(first[0], first[1], part);
  return error;
}

void Rounds::Record(const char* stage, const Outcome& run)
{
  meshopt::PassRecord row;
  for (const meshopt::PassRecord& pass : run.Report.history)
  {
    row.addWork(pass);
  }
  for (int op = 0; op < meshopt::NumberOfOperations; ++op)
  {
    row.tried[op] = static_cast<long>(this->All.Sum(row.tried[op]));
    row.done[op] = static_cast<long>(this->All.Sum(row.done[op]));
  }
  Shared shared;
  FindShared(this->All, this->Mine, shared);
  const Figures now = Measure(this->All, this->Mine, shared, this->Wanted.Options.targetQuality);
  meshopt::Report& report = this->Result.Report;
  row.pass = static_cast<int>(report.history.size());
  row.stage = stage;
  row.worst = report.worstAfter = now.Worst;
  row.mean = report.meanAfter = now.Mean;
  row.belowTarget = static_cast<long>(now.BelowTarget);
  row.cells = static_cast<long>(now.Cells);
  row.points = static_cast<long>(now.Points);
  report.invertedAfter = static_cast<long>(now.NotPositive);
  report.history.push_back(row);
  this->Result.NumberOfCells = now.Cells;
}

bool Rounds::IsDone() const
{
  bool isWaiting = false;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
  {
    const vtkIdType* ids = this->Mine.GetCell(c);
    isWaiting = isWaiting ||
      (this->Mine.Quality[c] < this->Wanted.Options.targetQuality &&
        std::any_of(ids, ids + this->Mine.Corners,
          [&](vtkIdType p) { return (this->Mine.Flags[p] & Waiting) != 0; }));
  }
  return !this->All.IsAny(isWaiting);
}

std::string Rounds::Round(int layers)
{
  const Signature before = Sign(this->All, this->Mine);
  Shared shared;
  std::string error = FindShared(this->All, this->Mine, shared);
  if (!error.empty())
  {
    return error;
  }
  std::vector<char> isMoved;
  error = Move(this->All, FindBands(this->All, this->Mine, shared, layers), this->Points,
    this->Cells, this->Mine, isMoved);
  error = error.empty() ? FindShared(this->All, this->Mine, shared) : error;
  if (!error.empty())
  {
    return error;
  }
  error = Compare(before, Sign(this->All, this->Mine), true);
  if (!error.empty())
  {
    return "After cells have moved between ranks " + error + ".";
  }
  for (vtkIdType p = 0; p < this->Mine.GetNumberOfPoints(); ++p)
  {
    if (!shared.Has(p))
    {
      this->Mine.Flags[p] &= static_cast<std::uint8_t>(~Waiting);
    }
  }
  std::vector<Part> parts = Split(
    this->Mine, std::vector<int>(isMoved.begin(), isMoved.end()), 2, 0);
  Outcome run;
  Request request = this->Wanted;
  error = this->Optimize(parts[1], request, run);
  if (!error.empty())
  {
    return error;
  }
  error = this->All.Agree(Join(parts, this->Mine));
  if (!error.empty())
  {
    return error;
  }
  error = Compare(before, Sign(this->All, this->Mine), false);
  this->Result.NumberOfOperations += this->All.Sum(run.NumberOfOperations);
  this->Record("borders", run);
  return error.empty() ? "" : "After a round at the borders " + error + ".";
}

std::vector<vtkIdType> ReadIds(vtkDataArray* array, const std::vector<vtkIdType>& chosen)
{
  std::vector<vtkIdType> ids;
  for (const vtkIdType i : chosen)
  {
    ids.push_back(array ? static_cast<vtkIdType>(array->GetTuple1(i)) : 0);
  }
  return ids;
}

/**
 * Global ids like those of the input.
 */
void AddIds(vtkDataArray* like, const std::vector<vtkIdType>& ids, vtkDataSetAttributes* data)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(like ? like->GetDataType() : VTK_ID_TYPE));
  array->SetName(like && like->GetName() ? like->GetName() : "GlobalIds");
  array->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    array->SetTuple1(static_cast<vtkIdType>(i), static_cast<double>(ids[i]));
  }
  data->SetGlobalIds(array);
}

void WriteOutput(const Rounds& run, vtkUnstructuredGrid* input, vtkUnstructuredGrid* output)
{
  const auto grid = MakeGrid(run.Mine, run.Points, run.Cells);
  output->ShallowCopy(grid);
  RemoveOwn(output);
  if (run.Ids.HasPointIds)
  {
    AddIds(input->GetPointData()->GetGlobalIds(), run.Mine.PointIds, output->GetPointData());
  }
  if (run.Ids.HasCellIds)
  {
    AddIds(input->GetCellData()->GetGlobalIds(), run.Mine.CellIds, output->GetCellData());
  }
  vtkNew<vtkDoubleArray> quality;
  quality->SetName("MeshQuality");
  quality->SetNumberOfValues(run.Mine.GetNumberOfCells());
  std::copy(run.Mine.Quality.begin(), run.Mine.Quality.end(), quality->GetPointer(0));
  output->GetCellData()->AddArray(quality);
  output->GetFieldData()->DeepCopy(input->GetFieldData());
}

} // namespace

//------------------------------------------------------------------------------
std::string FindObstacle(
  const Ranks& ranks, const Request& request, vtkUnstructuredGrid* input, std::string& error)
{
  std::string obstacle;
  vtkMeshBridge::Cells cells;
  if (!input)
  {
    obstacle = "the input is composite";
  }
  else
  {
    error = error.empty() ? vtkMeshBridge::ClassifyCells(input, cells) : error;
    obstacle = !cells.IsIdentity() ? "there are other cells than tetrahedra, or ghost cells" : "";
    obstacle = cells.Dimension == 2 ? "the mesh is of triangles" : obstacle;
    for (int kind : { 0, 1 })
    {
      vtkDataSetAttributes* data = input->GetAttributes(kind);
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        obstacle = CanPack(data->GetAbstractArray(i)) ? obstacle : "an array cannot be sent";
      }
    }
  }
  if (request.OptimizeBelow > 0.0)
  {
    obstacle = "OptimizeBelow is set";
  }
  if (request.Options.algorithm != meshopt::Algorithm::WorstFirst)
  {
    obstacle = "the algorithm is Paper1996";
  }
  if (request.UsesSizes() || vtkMeshBridge::IsWanted(request.Filter, MetricArray))
  {
    obstacle = "sizes or a metric are used";
  }
  // Arrays must be the same on all ranks that have cells.
  std::string arrays;
  if (input && input->GetNumberOfCells() > 0)
  {
    arrays = std::to_string(input->GetPointData()->GetGlobalIds() != nullptr) +
      std::to_string(input->GetCellData()->GetGlobalIds() != nullptr) +
      Schema::Of(input->GetPointData(), "").Describe() + "|" +
      Schema::Of(input->GetCellData(), "MeshQuality").Describe();
  }
  std::string common;
  for (const Bytes& bytes : ranks.Gather(Bytes(arrays.begin(), arrays.end())))
  {
    const std::string one(bytes.begin(), bytes.end());
    obstacle = one.empty() || common.empty() || one == common ? obstacle
                                                              : "ranks have different arrays";
    common = common.empty() ? one : common;
  }
  for (const Bytes& bytes : ranks.Gather(Bytes(obstacle.begin(), obstacle.end())))
  {
    if (!bytes.empty())
    {
      return { bytes.begin(), bytes.end() };
    }
  }
  return {};
}

std::string OptimizeOnRanks(const Ranks& ranks, const Request& request, vtkUnstructuredGrid* input,
  vtkUnstructuredGrid* output, Outcome& outcome)
{
  Rounds run{ ranks, request, Schema::Of(input->GetPointData(), ""),
    Schema::Of(input->GetCellData(), "MeshQuality"), {}, {}, outcome };
  std::vector<vtkIdType> points, simplices(input->GetNumberOfCells());
  std::string error = ranks.Together(
    [&]()
    {
      InputArrays arrays;
      const std::string problem = FindInputArrays(request.Filter, input, arrays);
      for (std::size_t c = 0; c < simplices.size(); ++c)
      {
        simplices[c] = static_cast<vtkIdType>(c);
      }
      run.Mine = ReadPiece(input, simplices, 4, run.Points, run.Cells, arrays.FixedPoints, points);
      return problem;
    });
  vtkDataArray* pointIds = input->GetPointData()->GetGlobalIds();
  vtkDataArray* cellIds = input->GetCellData()->GetGlobalIds();
  run.Ids.HasPointIds = ranks.IsAny(pointIds && !simplices.empty());
  run.Ids.HasCellIds = ranks.IsAny(cellIds && !simplices.empty());
  Shared shared;
  error = error.empty()
    ? Number(ranks, ReadIds(pointIds, points), ReadIds(cellIds, simplices), run.Ids, run.Mine)
    : error;
  error = error.empty() ? FindShared(ranks, run.Mine, shared) : error;
  if (!error.empty())
  {
    return error;
  }
  for (vtkIdType p = 0; p < run.Mine.GetNumberOfPoints(); ++p)
  {
    run.Mine.Flags[p] |= shared.Has(p) ? Waiting : 0;
  }
  Outcome piece;
  error = run.Optimize(run.Mine, request, piece);
  if (!error.empty())
  {
    return error;
  }
  outcome.NumberOfSimplices = ranks.Sum(piece.NumberOfSimplices);
  outcome.NumberOfCellsBefore = ranks.Sum(piece.NumberOfCellsBefore);
  outcome.NumberOfReorientedCells = ranks.Sum(piece.NumberOfReorientedCells);
  outcome.NumberOfOperations = ranks.Sum(piece.NumberOfOperations);
  meshopt::Report& report = outcome.Report;
  report.invertedBefore = static_cast<long>(ranks.Sum(piece.Report.invertedBefore));
  report.worstBefore = 2.0;
  double sum = 0.0;
  const double cells = static_cast<double>(piece.NumberOfCellsBefore);
  for (const double q : ranks.Gather(cells > 0 ? piece.Report.worstBefore : 2.0))
  {
    report.worstBefore = std::min(report.worstBefore, q);
  }
  for (const double q : ranks.Gather(piece.Report.meanBefore * cells))
  {
    sum += q;
  }
  report.meanBefore = sum /
    static_cast<double>(std::max<vtkIdType>(outcome.NumberOfCellsBefore, 1));
  report.bound = 1.0; // unknown: the caps of borders are none of the mesh
  run.Record("pieces", piece);
  using meshopt::StopReason;
  const auto has = [&](StopReason reason)
  { return ranks.IsAny(piece.Report.stopReason == reason); };
  const bool aborted = has(StopReason::Aborted), late = has(StopReason::TimeLimit);
  for (int round = 0; round < MostRounds && !aborted && !late && !run.IsDone(); ++round)
  {
    error = run.Round(Layers[round]);
    if (!error.empty())
    {
      return error;
    }
  }
  report.stopReason = aborted                            ? StopReason::Aborted
    : late                                               ? StopReason::TimeLimit
    : report.worstAfter >= request.Options.targetQuality ? StopReason::TargetReached
                                                         : StopReason::NoFurtherGain;
  WriteOutput(run, input, output);
  AddFigures(outcome, output);
  return {};
}

} // namespace vtkMeshOptimizeBridge
