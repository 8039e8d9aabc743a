// SPDX-License-Identifier: BSD-3-Clause
// The figures of a run on many ranks, and its output.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "OneGrid/vtkMeshOptimizeHistory.h"
#include "Ranks/vtkMeshRanksBound.h"
#include "Ranks/vtkMeshRanksCheck.h"
#include "Ranks/vtkMeshRanksGhosts.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "Rounds/vtkMeshOptimizeRanksSampling.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <limits>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;
using meshopt::StopReason;

namespace
{

/**
 * Global ids like those of the input; of a longer type if they do not fit into that one.
 */
void AddIds(vtkDataArray* like, const std::vector<vtkIdType>& ids, vtkDataSetAttributes* data)
{
  vtkNew<vtkIdTypeArray> values;
  values->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), values->GetPointer(0));
  const double greatest = ids.empty() ? 0.0 : static_cast<double>(ids.back()); // they ascend
  const bool fits = like && greatest <= like->GetDataTypeMax();
  auto array = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(fits ? like->GetDataType() : VTK_ID_TYPE));
  array->DeepCopy(values); // exact, unlike SetTuple1()
  array->SetName(like && like->GetName() ? like->GetName() : "GlobalIds");
  data->SetGlobalIds(array);
}

void AddFlags(const std::vector<unsigned char>& flags, vtkDataSetAttributes* data)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(vtkDataSetAttributes::GhostArrayName());
  array->SetNumberOfValues(static_cast<vtkIdType>(flags.size()));
  std::copy(flags.begin(), flags.end(), array->GetPointer(0));
  data->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
/**
 * Adds the row of the input to the history, and the figures of before.
 */
void Rounds::RecordInput(const Outcome& run)
{
  meshopt::Report& report = this->Result.Report;
  // A rank without cells has no rows.
  const bool isEmpty = run.Report.history.empty();
  meshopt::PassRecord row = isEmpty ? meshopt::PassRecord() : run.Report.history.front();
  const std::vector<long> cells = this->All.Gather(row.cells);
  const std::vector<double> worst = this->All.Gather(row.worst), mean = this->All.Gather(row.mean);
  double sum = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < cells.size(); ++r)
  {
    // The mean of all is that of the ranks, weighted by their cells.
    sum += mean[r] * static_cast<double>(cells[r]);
    least = cells[r] > 0 ? std::min(least, worst[r]) : least;
  }
  row.stage = "input";
  row.pass = 0;
  // Not the sum of the rows: points on borders would count several times.
  row.cells = static_cast<long>(this->CellsAtFirst);
  row.points = static_cast<long>(this->PointsAtFirst);
  row.belowTarget = static_cast<long>(this->All.Sum(row.belowTarget));
  row.worst = report.worstBefore = row.cells > 0 ? least : 0.0;
  row.mean = report.meanBefore = row.cells > 0 ? sum / static_cast<double>(row.cells) : 0.0;
  report.invertedBefore = static_cast<long>(this->All.Sum(run.Report.invertedBefore));
  report.history.push_back(row);
}

/**
 * The region of each cell; empty without regions. The hull of a zone is kept like an interface.
 */
std::vector<long long> Rounds::ReadRegions() const
{
  const auto grid = BorrowGrid(this->Mine, this->Points, this->Cells);
  InputArrays arrays;
  FindInputArrays(this->Wanted.Filter, grid, arrays); // has been checked
  std::vector<long long> regions;
  if (arrays.Region)
  {
    regions = vtkMeshBridge::ReadIntegers(arrays.Region);
  }
  else if (this->HasZone)
  {
    regions.assign(this->Mine.CellIds.size(), 0);
  }
  for (std::size_t c = 0; c < regions.size() && this->HasZone; ++c)
  {
    // Without a sign, since the product may be too large.
    regions[c] = static_cast<long long>(
      2 * static_cast<unsigned long long>(regions[c]) + (this->Mine.Kept[c] ? 1 : 0));
  }
  return regions;
}

/**
 * What the surface allows. As on one rank, nothing is known of one that slides.
 */
void Rounds::FindCaps(const Shared& shared)
{
  this->Surface = SurfaceFigures();
  this->Surface.IsCapped.assign(this->Mine.CellIds.size(), 0);
  if (!this->Wanted.Slide)
  {
    this->Surface = MeasureSurface(this->All, this->Mine, shared, this->ReadRegions(),
      this->Wanted.Options.measure, this->GetGoal(), this->Plane);
  }
}

/**
 * Adds a row of all ranks to the history.
 */
void Rounds::Record(const char* stage, const Outcome& run)
{
  meshopt::PassRecord row;
  for (const meshopt::PassRecord& pass : run.Report.history)
  {
    row.addWork(pass);
  }
  // One message for all operations: each costs all ranks a meeting.
  using Counts = std::array<decltype(row.tried), 2>;
  const std::vector<Counts> counts = this->All.Gather(Counts{ row.tried, row.done });
  row.tried = row.done = {};
  for (const Counts& one : counts)
  {
    for (int op = 0; op < meshopt::NumberOfOperations; ++op)
    {
      row.tried[op] += one[0][op];
      row.done[op] += one[1][op];
    }
  }
  // Rows of `run` are of one piece each. What is true of the whole mesh is measured anew.
  const double target = this->Wanted.Options.targetQuality;
  const Shared shared = FindShared(this->All, this->Mine);
  const Figures now = Measure(this->All, this->Mine, shared, target);
  // The surface stays, and so does its bound, once it is known on which side of it the mesh is.
  // Caps are asked for cells under the target only.
  const bool isKnown = this->Result.Report.history.size() > 1 &&
    this->Result.Report.invertedAfter == 0;
  if (isKnown && !this->IsBest() && now.BelowTarget == 0)
  {
    this->Surface.IsCapped.assign(this->Mine.CellIds.size(), 0);
  }
  else
  {
    this->FindCaps(shared);
  }
  vtkIdType capped = 0;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
  {
    capped += this->Surface.IsCapped[c] && this->Mine.Quality[c] < target && !this->Mine.Kept[c];
  }
  meshopt::Report& report = this->Result.Report;
  row.pass = static_cast<int>(report.history.size());
  row.stage = stage;
  row.worst = report.worstAfter = now.Worst;
  row.mean = report.meanAfter = now.Mean;
  row.belowTarget = static_cast<long>(now.BelowTarget);
  row.cells = static_cast<long>(now.Cells);
  row.points = static_cast<long>(now.Points);
  report.invertedAfter = static_cast<long>(now.NotPositive);
  // What is outside of a zone stays: nothing can lift the whole above its worst.
  report.bound = std::min(this->Surface.Bound,
    this->HasZone ? this->WorstOutside : std::numeric_limits<double>::infinity());
  report.cappedCells = static_cast<long>(this->All.Sum(capped));
  report.history.push_back(row);
  this->Result.NumberOfCells = now.Cells;
}

//------------------------------------------------------------------------------
StopReason Rounds::FindReason() const
{
  const meshopt::Report& report = this->Result.Report;
  const long below = report.history.back().belowTarget - static_cast<long>(this->BelowOutside);
  // In the order of a run on one rank: the first that applies is the reason.
  return this->CellsAtFirst == 0          ? StopReason::NothingToDo
    : this->Stopped != StopReason::NotRun ? this->Stopped
    : below == 0                          ? StopReason::TargetReached
    : below == report.cappedCells         ? StopReason::CappedBySurface
    : this->IsShort                       ? StopReason::GrowthLimit
                                          : StopReason::NoFurtherGain;
}

void Rounds::Write(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output)
{
  this->CloseBoundary();
  SampleOnce(
    this->All, input, this->FirstCell, this->Points, this->FirstNewPoint, this->Plane, this->Mine);
  GhostFlags ghosts;
  const int layers = this->Wanted.NumberOfGhostLevels;
  if (layers > 0)
  {
    ghosts = AddGhosts(this->All, layers, this->Points, this->Cells, this->Mine);
  }
  const auto grid = MakeGrid(this->Mine, this->Points, this->Cells);
  meshopt::Report& report = this->Result.Report;
  report.stopReason = this->FindReason();
  // The grid was made for this output: nobody else has its arrays.
  output->ShallowCopy(grid);
  RemoveOwn(output);
  // Only where the input has global ids.
  if (this->Ids.HasPointIds)
  {
    AddIds(input->GetPointData()->GetGlobalIds(), this->Mine.PointIds, output->GetPointData());
  }
  if (this->Ids.HasCellIds)
  {
    AddIds(input->GetCellData()->GetGlobalIds(), this->Mine.CellIds, output->GetCellData());
  }
  vtkNew<vtkDoubleArray> quality;
  quality->SetName("MeshQuality");
  quality->SetNumberOfValues(this->Mine.GetNumberOfCells());
  std::copy(this->Mine.Quality.begin(), this->Mine.Quality.end(), quality->GetPointer(0));
  output->GetCellData()->AddArray(quality);
  if (layers > 0)
  {
    AddFlags(ghosts.Points, output->GetPointData());
    AddFlags(ghosts.Cells, output->GetCellData());
  }
  // The caller's first: figures of an earlier run, under the same names, are then replaced.
  output->GetFieldData()->DeepCopy(input->GetFieldData());
  AddFigures(this->Result, output);
  vtkNew<vtkIdTypeArray> bands;
  bands->SetName("NumberOfCellsInBands");
  bands->InsertNextValue(this->Result.NumberOfCellsInBands);
  output->GetFieldData()->AddArray(bands);
}

} // namespace vtkMeshOptimizeBridge
