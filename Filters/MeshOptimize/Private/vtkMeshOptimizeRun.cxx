// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeRun.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeImport.h"
#include "vtkMeshOptimizeCurves.h"
#include "vtkMeshOptimizeExport.h"
#include "vtkMeshOptimizeHistory.h"
#include "vtkMeshOptimizeQuality.h"
#include "vtkMeshOptimizeSizes.h"
#include "vtkMeshOptimizeTangle.h"
#include "vtkMeshOptimizeTransfer.h"
#include "vtkMeshOptimizeZone.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include "Optimize/Optimizer.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace vtkMeshOptimizeBridge
{
namespace
{

std::string Joined(const std::string& a, const std::string& b)
{
  return a + (a.empty() || b.empty() ? "" : " ") + b;
}

template <int D>
void Optimize(meshopt::SimplexMesh<D>& mesh, meshopt::NodalMetric<D>& metric,
  const Request& request, const meshopt::BoundaryCurves& curves, Outcome& outcome)
{
  const auto start = std::chrono::steady_clock::now();
  const double areaBefore = D == 2 ? mesh.volume() : 0.0;
  outcome.NumberOfCellsBefore = mesh.numberOfInputCells();
  outcome.Report = meshopt::optimize(
    mesh, metric, request.Options, request.Control, request.Slide ? &curves : nullptr);
  if (outcome.Report.stopReason == meshopt::StopReason::Aborted && request.TimeLimit->WasSeen())
  {
    outcome.Report.stopReason = meshopt::StopReason::TimeLimit;
  }
  outcome.NumberOfCells = mesh.countCells();
  outcome.Sizes = Joined(DescribeSizes(outcome.Report, request),
    D == 2 ? DescribeArea(areaBefore, mesh.volume(), request) : "");
  for (const meshopt::PassRecord& row : outcome.Report.history)
  {
    outcome.NumberOfOperations += std::accumulate(row.done.begin(), row.done.end(), 0L);
  }
  outcome.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!metric.isTrivial() || (request.UsesSizes() && request.Options.desiredSize > 0.0))
  {
    outcome.Lengths = meshopt::measureEdges(mesh, metric);
  }
}

template <int D>
void Export(vtkUnstructuredGrid* input, const Cells& cells, const Frame<D>& frame,
  const meshopt::SimplexMesh<D>& mesh, const meshopt::NodalMetric<D>& metric,
  const Request& request, vtkUnstructuredGrid* output, Outcome& outcome)
{
  const OutputMap map = MapOutput(input, cells, frame, mesh);
  ExportMesh(input, map, frame, mesh, output);
  std::vector<Sample> samples;
  if (input->GetPointData()->GetNumberOfArrays() > 0 && !map.SampledPoints.empty())
  {
    samples = SampleInput(input, cells, frame, map, mesh);
  }
  TransferPointData(input->GetPointData(), map, samples, output->GetPointData());
  TransferCellData(input->GetCellData(), map, output->GetCellData());
  AddMeshQuality(input, map, mesh, metric, request.Options, output);
  outcome.Tangle = DescribeTangle(output, map, mesh, outcome.Report);
}

template <int D>
std::string OptimizeSimplices(vtkUnstructuredGrid* input, Cells& cells, const InputArrays& arrays,
  const Request& request, vtkUnstructuredGrid* output, Outcome& outcome)
{
  Frame<D> frame;
  std::string error = FindFrame(input, cells, frame);
  if (!error.empty())
  {
    return error;
  }
  meshopt::SimplexMesh<D> mesh;
  error = BuildMesh(input, cells, arrays, frame, mesh);
  if (!error.empty())
  {
    return error;
  }
  meshopt::NodalMetric<D> metric(request.Options.desiredSize);
  error = SetMetric(cells, arrays, frame, request, mesh, metric);
  error = error.empty() ? CheckCount(request, mesh, metric) : error;
  meshopt::BoundaryCurves curves;
  error = error.empty() ? BuildCurves(cells, arrays, frame, request, mesh, curves) : error;
  if (!error.empty())
  {
    return error;
  }
  outcome.NumberOfReorientedCells = mesh.numberOfReorientedCells();
  LeftOut rest;
  std::vector<meshopt::Simplex<D>> others;
  if (request.OptimizeBelow > 0.0)
  {
    rest = RestrictToZone(input, arrays, frame, metric, request.Options, request.OptimizeBelow,
      request.NumberOfLayers, cells, mesh, others);
  }
  std::optional<std::pair<meshopt::SimplexMesh<D>, meshopt::NodalMetric<D>>> before;
  if (!others.empty())
  {
    before.emplace(mesh, metric);
  }
  Optimize(mesh, metric, request, curves, outcome);
  if (before && outcome.Report.invertedBefore > 0 && !FitsTogether(mesh, others))
  {
    std::tie(mesh, metric) = *before;
    Request moving = request; // which always fits
    moving.Options.reconnect = moving.Options.insertNodes = moving.Options.removeNodes = false;
    outcome.NumberOfOperations = 0;
    Optimize(mesh, metric, moving, curves, outcome);
  }
  AddLeftOut(rest, outcome);
  Export(input, cells, frame, mesh, metric, request, output, outcome);
  return {};
}

void PassThrough(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output, Outcome& outcome)
{
  output->DeepCopy(input);
  AddNoMeshQuality(output);
  outcome.Report.stopReason = meshopt::StopReason::NothingToDo;
}

/**
 * Which of two stop reasons says more about a whole of several grids.
 */
int Strength(meshopt::StopReason reason)
{
  using meshopt::StopReason;
  switch (reason)
  {
    case StopReason::Aborted:
      return 8;
    case StopReason::TimeLimit:
      return 7;
    case StopReason::IterationLimit:
      return 6;
    case StopReason::GrowthLimit:
      return 5;
    case StopReason::NoFurtherGain:
      return 4;
    case StopReason::CappedBySurface:
      return 3;
    case StopReason::TargetReached:
      return 2;
    case StopReason::NothingToDo:
      return 1;
    case StopReason::NotRun:
      break;
  }
  return 0;
}

double Mean(double a, vtkIdType countA, double b, vtkIdType countB)
{
  return (a * static_cast<double>(countA) + b * static_cast<double>(countB)) /
    static_cast<double>(std::max<vtkIdType>(countA + countB, 1));
}

} // namespace

//------------------------------------------------------------------------------
void Outcome::Add(const Outcome& other)
{
  const bool isFirst = this->NumberOfCellsBefore == 0;
  meshopt::Report& mine = this->Report;
  const meshopt::Report& its = other.Report;
  if (other.NumberOfCellsBefore > 0)
  {
    mine.worstBefore = isFirst ? its.worstBefore : std::min(mine.worstBefore, its.worstBefore);
    mine.worstAfter = isFirst ? its.worstAfter : std::min(mine.worstAfter, its.worstAfter);
    mine.bound = isFirst ? its.bound : std::min(mine.bound, its.bound);
    mine.meanBefore = Mean(
      mine.meanBefore, this->NumberOfCellsBefore, its.meanBefore, other.NumberOfCellsBefore);
    mine.meanAfter = Mean(mine.meanAfter, this->NumberOfCells, its.meanAfter, other.NumberOfCells);
    mine.cappedCells += its.cappedCells;
    mine.invertedBefore += its.invertedBefore;
    mine.invertedAfter += its.invertedAfter;
  }
  if (Strength(its.stopReason) > Strength(mine.stopReason))
  {
    mine.stopReason = its.stopReason;
  }
  this->NumberOfCells += other.NumberOfCells;
  this->NumberOfCellsBefore += other.NumberOfCellsBefore;
  this->NumberOfSimplices += other.NumberOfSimplices;
  this->NumberOfReorientedCells += other.NumberOfReorientedCells;
  this->NumberOfQuadraticSimplices += other.NumberOfQuadraticSimplices;
  this->NumberOfOperations += other.NumberOfOperations;
  this->Seconds += other.Seconds;
  this->Lengths.add(other.Lengths);
  this->Tangle = Joined(this->Tangle, other.Tangle);
  this->Sizes = Joined(this->Sizes, other.Sizes);
}

std::string OptimizeGrid(
  vtkUnstructuredGrid* input, const Request& request, vtkUnstructuredGrid* output, Outcome& outcome)
{
  Cells cells;
  std::string error = ClassifyCells(input, cells);
  if (!error.empty())
  {
    return error;
  }
  InputArrays arrays;
  error = FindInputArrays(request.Filter, input, arrays);
  if (!error.empty())
  {
    return error;
  }
  outcome.NumberOfSimplices = static_cast<vtkIdType>(cells.Simplices.size());
  outcome.NumberOfQuadraticSimplices = cells.NumberOfQuadraticSimplices;
  if (cells.Simplices.empty())
  {
    PassThrough(input, output, outcome);
  }
  else
  {
    error = cells.Dimension == 3
      ? OptimizeSimplices<3>(input, cells, arrays, request, output, outcome)
      : OptimizeSimplices<2>(input, cells, arrays, request, output, outcome);
    output->GetFieldData()->DeepCopy(input->GetFieldData());
  }
  AddFigures(outcome, output);
  return error;
}

} // namespace vtkMeshOptimizeBridge
