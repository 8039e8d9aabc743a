// SPDX-License-Identifier: BSD-3-Clause
// One grid from input to output, as steps that read like the header says: each is one call.
#include "OneGrid/vtkMeshOptimizeRun.h"

#include "Boundary/vtkMeshOptimizeConditions.h"
#include "Boundary/vtkMeshOptimizeRiding.h"
#include "Boundary/vtkMeshOptimizeSets.h"
#include "Boundary/vtkMeshOptimizeSurface.h"
#include "Grid/vtkMeshOptimizeExport.h"
#include "Grid/vtkMeshOptimizeImport.h"
#include "Grid/vtkMeshOptimizeModel.h"
#include "Grid/vtkMeshOptimizeTransfer.h"
#include "OneGrid/vtkMeshOptimizeHistory.h"
#include "OneGrid/vtkMeshOptimizeQuality.h"
#include "OneGrid/vtkMeshOptimizeSizes.h"
#include "OneGrid/vtkMeshOptimizeTangle.h"
#include "OneGrid/vtkMeshOptimizeZone.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeFrame.h"
#include "vtkMeshBridgeValues.h"

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

/**
 * Books the volume of each region: before (0) or after (1).
 */
template <int D>
void AddVolumes(const Request& request, const Model<D>& model, int when, Outcome& outcome)
{
  if (D != 3 || !request.Slide) // only a surface in space that slides can change a volume
  {
    return;
  }
  const meshopt::SimplexMesh<D>& mesh = model.Mesh;
  const std::vector<long long> replaced = vtkMeshBridge::FindReplacedRegions(
    model.Arrays.Region, model.Cells);
  for (meshopt::Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      const long long region = replaced.empty() ? mesh.region(c) : replaced[mesh.region(c)];
      outcome.Volumes[region][when] += meshopt::signedVolume(mesh.corners(c));
    }
  }
}

/**
 * The run itself, and what can be said of it before the export.
 */
template <int D>
void Optimize(
  const Request& request, typename SurfaceOf<D>::type& surface, Model<D>& model, Outcome& outcome)
{
  const auto start = std::chrono::steady_clock::now();
  const double areaBefore = D == 2 ? model.Mesh.volume() : 0.0;
  AddVolumes<D>(request, model, 0, outcome);
  outcome.NumberOfCellsBefore = model.Mesh.numberOfInputCells();
  outcome.Report = meshopt::optimize(
    model.Mesh, model.Metric, request.Options, request.Control, request.Slide ? &surface : nullptr);
  AddVolumes<D>(request, model, 1, outcome);
  outcome.NumberOfCells = model.Mesh.countCells();
  outcome.Sizes = Joined(DescribeSizes(outcome.Report, request),
    D == 2 ? DescribeArea(areaBefore, model.Mesh.volume(), request) : "");
  outcome.NumberOfOperations = 0;
  for (const meshopt::PassRecord& row : outcome.Report.history)
  {
    outcome.NumberOfOperations += std::accumulate(row.done.begin(), row.done.end(), 0L);
  }
  // Without import and export, and so comparable with the time of a run of the core.
  outcome.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!model.Metric.isTrivial() || (request.UsesSizes() && request.Options.desiredSize > 0.0))
  {
    outcome.Lengths = meshopt::measureEdges(model.Mesh, model.Metric);
  }
}

/**
 * The same for the part that may change, if not all may. If cells overlap, a changed zone may not
 * fit to the rest any more. Then its points are only moved, which always fits.
 */
template <int D>
void OptimizeZone(
  const Request& request, typename SurfaceOf<D>::type& surface, Model<D>& model, Outcome& outcome)
{
  std::vector<meshopt::Simplex<D>> others;
  const LeftOut rest = RestrictToZone(request, model, others);
  std::optional<std::pair<meshopt::SimplexMesh<D>, meshopt::NodalMetric<D>>> before;
  // A copy of the state before, in case that the zone does not fit to the rest afterwards.
  if (!others.empty())
  {
    before.emplace(model.Mesh, model.Metric);
  }
  Optimize<D>(request, surface, model, outcome);
  if (before && outcome.Report.invertedBefore > 0 && !FitsTogether(model.Mesh, others))
  {
    std::tie(model.Mesh, model.Metric) = *before;
    Request moving = request;
    moving.Options.reconnect = moving.Options.insertNodes = moving.Options.removeNodes = false;
    const double seconds = outcome.Seconds;
    const std::int64_t evaluations = outcome.Report.evaluations;
    Optimize<D>(moving, surface, model, outcome);
    // What the first run has cost counts, too.
    outcome.Seconds += seconds;
    outcome.Report.evaluations += evaluations;
  }
  AddLeftOut(rest, outcome);
}

double DistanceOf(const meshopt::BoundaryCurves&, const meshopt::SimplexMesh<2>&) { return 0.0; }

double DistanceOf(const meshopt::SlidingSurface& surface, const meshopt::SimplexMesh<3>& mesh)
{
  return surface.distance(mesh);
}

/**
 * Whether a point that moves gets other data: all but global ids change with the place.
 */
bool NeedsSamples(vtkDataSetAttributes* data)
{
  const int ids = data->GetGlobalIds() ? 1 : 0;
  return data->GetNumberOfArrays() > ids;
}

/**
 * Node sets come after the other point data, whose interpolated values they replace.
 */
template <int D>
void Export(const Request& request, const typename SurfaceOf<D>::type& surface, Model<D>& model,
  vtkUnstructuredGrid* output, Outcome& outcome)
{
  vtkUnstructuredGrid* input = model.Grid;
  OutputMap map = MapOutput(model);
  if (request.Slide)
  {
    MapRiding(model, surface, map);
  }
  ExportMesh(model, map, output);
  std::vector<Sample> samples;
  if (NeedsSamples(input->GetPointData()) && !map.SampledPoints.empty())
  {
    samples = SampleInput(model, map);
  }
  TransferPointData(input->GetPointData(), map, samples, output->GetPointData());
  // After the other data: what was interpolated in arrays of conditions and sets is overwritten.
  ClearConditionsInside(model, map, output->GetPointData());
  if (request.Slide)
  {
    TransferNodeSets(model, surface, map, output->GetPointData());
  }
  TransferCellData(input->GetCellData(), map, output->GetCellData());
  // For the array of qualities alone: the run must not have seen values of ghosts.
  SetMetricOfGhosts(request, model);
  AddMeshQuality(model, map, request.Options, output);
  if (request.Slide)
  {
    AddBoundaryPlace(model, map, output);
    KeepPlaces(request, model, map, surface);
    outcome.HasSurfaceDistance = D == 3;
    outcome.SurfaceDistance = DistanceOf(surface, model.Mesh);
  }
  outcome.Tangle = DescribeTangle(output, map, model.Mesh, outcome.Report);
}

template <int D>
Model<D> StartModel(vtkUnstructuredGrid* input, const InputArrays& arrays,
  vtkMeshBridge::Cells&& cells, const Request& request)
{
  Model<D> model;
  model.Grid = input;
  model.Arrays = arrays;
  model.Cells = std::move(cells);
  model.Metric = meshopt::NodalMetric<D>(request.Options.desiredSize);
  return model;
}

std::string SetFrame(const Request&, vtkUnstructuredGrid* grid, const vtkMeshBridge::Cells& cells,
  vtkMeshBridge::Frame<3>& frame)
{
  return vtkMeshBridge::FindFrame(grid, cells, frame);
}

std::string SetFrame(const Request& request, vtkUnstructuredGrid* grid,
  const vtkMeshBridge::Cells& cells, vtkMeshBridge::Frame<2>& frame)
{
  // On many ranks: a piece alone might seem to lie in another plane.
  if (request.Plane) // all triangles have been found to lie in it
  {
    frame = *request.Plane;
    return {};
  }
  return vtkMeshBridge::FindFrame(grid, cells, frame);
}

/**
 * Completes a model that has been started, and makes what its boundary slides along.
 */
template <int D>
std::string MakeModel(const Request& request, Model<D>& model, typename SurfaceOf<D>::type& surface)
{
  // Before the mesh is built, since it changes which points are held.
  if (request.Slide)
  {
    FindRiding(model);
  }
  std::string error = SetFrame(request, model.Grid, model.Cells, model.Frame);
  error = error.empty() ? BuildMesh(model) : error;
  error = error.empty() ? SetMetric(request, model) : error;
  error = error.empty() ? CheckCount(request, model) : error;
  return error.empty() ? BuildSurface(request, model, surface) : error;
}

template <int D>
std::string OptimizeSimplices(
  const Request& request, Model<D> model, vtkUnstructuredGrid* output, Outcome& outcome)
{
  typename SurfaceOf<D>::type surface;
  const std::string error = MakeModel<D>(request, model, surface);
  if (!error.empty())
  {
    return error;
  }
  // What the builder has found, before anything changes.
  outcome.NumberOfReorientedCells = model.Mesh.numberOfReorientedCells();
  outcome.Overlap = DescribeOverlap(model.Mesh);
  outcome.Twins = DescribeTwins(surface);
  FindConditions(model);
  if (request.OptimizeBelow > 0.0)
  {
    OptimizeZone<D>(request, surface, model, outcome);
  }
  else
  {
    Optimize<D>(request, surface, model, outcome);
  }
  Export<D>(request, surface, model, output, outcome);
  return {};
}

/**
 * A deep copy, since the output shares nothing with the input.
 */
void PassThrough(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output, Outcome& outcome)
{
  output->DeepCopy(input);
  AddNoMeshQuality(output);
  outcome.Report.stopReason = meshopt::StopReason::NothingToDo;
}

} // namespace

//------------------------------------------------------------------------------
std::string OptimizeGrid(vtkUnstructuredGrid* input, const InputArrays& arrays,
  const Request& request, vtkUnstructuredGrid* output, Outcome& outcome)
{
  vtkMeshBridge::Cells cells;
  std::string error = vtkMeshBridge::ClassifyCells(input, cells);
  if (!error.empty())
  {
    return error;
  }
  outcome.NumberOfSimplices = static_cast<vtkIdType>(cells.Simplices.size());
  outcome.NumberOfGhostSimplices = cells.NumberOfGhostSimplices;
  outcome.NumberOfSurfaceTriangles = cells.NumberOfSurfaceTriangles;
  outcome.NumberOfQuadraticSimplices = cells.NumberOfQuadraticSimplices;
  if (cells.Simplices.empty() || (cells.Dimension == 2 && request.IsPieceOfVolume))
  {
    PassThrough(input, output, outcome);
  }
  else
  {
    error = cells.Dimension == 3
      ? OptimizeSimplices(
          request, StartModel<3>(input, arrays, std::move(cells), request), output, outcome)
      : OptimizeSimplices(
          request, StartModel<2>(input, arrays, std::move(cells), request), output, outcome);
    output->GetFieldData()->DeepCopy(input->GetFieldData());
  }
  AddFigures(outcome, output);
  return error;
}

} // namespace vtkMeshOptimizeBridge
