// SPDX-License-Identifier: BSD-3-Clause
// From the data on the ports to grids: one, those of a tree, or pieces on many ranks.
#include "Tasks/vtkMeshOptimizeTasks.h"

#include "Boundary/vtkMeshOptimizeSurface.h"
#include "OneGrid/vtkMeshOptimizeHistory.h"
#include "OneGrid/vtkMeshOptimizeRun.h"
#include "Ranks/vtkMeshRanksBlocks.h"
#include "Rounds/vtkMeshOptimizeRanks.h"
#include "Tasks/vtkMeshOptimizePieces.h"
#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeControl.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <vector>

namespace vtkMeshOptimizeBridge
{
namespace
{

/**
 * A grid to optimize, with its arrays and its output.
 */
struct Task
{
  vtkUnstructuredGrid* Input;
  vtkUnstructuredGrid* Output;
  int Block;
  InputArrays Arrays;
};

/**
 * The grids in `input`, with an output for each. Other leaves of a tree are passed on unchanged.
 */
std::vector<Task> ListTasks(vtkAlgorithm* filter, vtkDataObject* input, vtkDataObject* output)
{
  std::vector<Task> tasks;
  for (const vtkMeshBridge::Block& block :
    vtkMeshBridge::ListBlocks(filter, input, output, vtkMeshBridge::OtherLeaves::Pass))
  {
    tasks.push_back({ block.Input, block.Output, block.Index, {} }); // the tree holds the output
  }
  return tasks;
}

std::vector<vtkUnstructuredGrid*> GridsOf(const std::vector<Task>& tasks)
{
  std::vector<vtkUnstructuredGrid*> grids;
  grids.reserve(tasks.size());
  for (const Task& task : tasks)
  {
    grids.push_back(task.Input);
  }
  return grids;
}

/**
 * Finds the arrays of all tasks. Returns a sentence about the first unusable part of the request.
 */
std::string CheckRequest(const Request& request, std::vector<Task>& tasks)
{
  const std::vector<vtkUnstructuredGrid*> grids = GridsOf(tasks);
  // Where there are no cells, nothing needs a size: other ranks, or times, may have both.
  bool hasSizes = std::all_of(grids.begin(), grids.end(),
    [](vtkUnstructuredGrid* grid) { return grid->GetNumberOfCells() == 0; });
  for (Task& task : tasks)
  {
    const std::string error = FindInputArrays(request.Filter, task.Input, task.Arrays);
    if (!error.empty())
    {
      return error;
    }
    // Sizes in one grid are enough for the options that need them.
    hasSizes |= task.Arrays.Size != nullptr;
  }
  // Written so that what is not a number is refused, too.
  if (!(request.TimeLimit >= 0.0))
  {
    return "The time limit must be a number of seconds >= 0 (0: none).";
  }
  if (!(request.OptimizeBelow >= 0.0))
  {
    return "OptimizeBelow, the quality under which cells may change, must be a number.";
  }
  if (!(request.Surface.tolerance >= 0.0) || !(request.Surface.featureAngle >= 0.0) ||
    !(request.Surface.cornerAngle >= 0.0))
  {
    return "SurfaceTolerance, FeatureAngle and CornerAngle must be numbers.";
  }
  if (request.Slide && request.OptimizeBelow > 0.0)
  {
    return "The boundary mode Slide works on the whole mesh; it cannot be used with OptimizeBelow.";
  }
  if (request.Slide && request.Options.algorithm != meshopt::Algorithm::WorstFirst)
  {
    return "The boundary mode Slide needs the algorithm WorstFirst.";
  }
  // Corners may be marked in the geometry alone: the grids then need no such array.
  const std::string error = CheckArraysAreThere(
    request.Filter, grids, request.HasGeometryCorners ? CornerArray : -1);
  return error.empty() ? request.Options.check(hasSizes) : error;
}

} // namespace

//------------------------------------------------------------------------------
bool HasPieces(const Ports& ports)
{
  return ports.Controller && ports.Controller->GetNumberOfProcesses() > 1 &&
    ports.NumberOfPieces == ports.Controller->GetNumberOfProcesses();
}

namespace
{

bool HasRanks(const Ports& ports) { return ports.OptimizeBorders && HasPieces(ports); }

/**
 * The border of a piece is not a boundary of the mesh, so it cannot slide.
 */
std::string CheckPieces(const Ports& ports, const Request& request)
{
  return request.Slide && ports.NumberOfPieces > 1 && !HasRanks(ports)
    ? "The boundary mode Slide needs the whole mesh in one piece, or triangles on several ranks "
      "with OptimizeBorders on."
    : "";
}

/**
 * Of each task, whether its triangles alone are no mesh, since other ranks have volumes.
 */
std::vector<char> FindPiecesOfVolumes(const Ports& ports, const std::vector<Task>& tasks)
{
  std::vector<int> blocks;
  std::vector<char> volumes;
  for (const Task& task : tasks)
  {
    blocks.push_back(task.Block);
    volumes.push_back(HasPieces(ports) && vtkMeshBridge::HasVolumes(task.Input));
  }
  return HasPieces(ports) ? vtkMeshRanks::FindVolumes(ports.Controller, blocks, volumes) : volumes;
}

/**
 * Optimizes the meshes that all ranks have: one, or one in each block. If it is not built for this
 * input and request, an obstacle says why, and what has been done does not count.
 */
std::string OptimizeWhole(const Ports& ports, Request& request, std::vector<Task>& tasks,
  Outcome& outcome, std::string& obstacle)
{
  vtkMultiProcessController* controller = ports.Controller;
  auto tree = vtkDataObjectTree::SafeDownCast(ports.Output);
  std::vector<int> here, blocks;
  for (const Task& task : tasks)
  {
    here.push_back(task.Block);
  }
  const std::vector<int> places = tree ? vtkMeshBridge::ListPlaces(tree) : here;
  if (!vtkMeshRanks::ListBlocks(controller, here, places, blocks))
  {
    obstacle = "the blocks of the ranks differ";
    return {};
  }
  request.NumberOfGhostLevels = std::max(request.NumberOfGhostLevels, ports.NumberOfGhostLevels);
  // On several ranks no surface of tetrahedra slides.
  StartHistory(ports.History, tree != nullptr, false);
  Outcome all;
  for (const int block : blocks)
  {
    const auto mine = std::find_if(
      tasks.begin(), tasks.end(), [block](const Task& task) { return task.Block == block; });
    vtkNew<vtkUnstructuredGrid> empty, fresh; // other ranks alone have this block
    const bool isHere = mine != tasks.end();
    vtkUnstructuredGrid* output = isHere ? mine->Output : fresh.Get();
    const std::string title = tree ? "Block " + std::to_string(block) + ": " : "";
    Outcome one;
    const std::string error = OptimizeOnRanks(
      controller, request, [&]() { return CheckRequest(request, tasks); },
      isHere ? mine->Input : empty.Get(), output, one, obstacle);
    if (!error.empty())
    {
      return title + error;
    }
    if (!obstacle.empty())
    {
      // Blocks before this one are made again, by each rank for itself.
      for (const int done : blocks)
      {
        if (tree && std::find(here.begin(), here.end(), done) == here.end())
        {
          vtkMeshBridge::SetLeaf(tree, done, nullptr);
        }
      }
      for (const Task& task : tasks)
      {
        task.Output->Initialize();
      }
      ports.History->Initialize();
      return {};
    }
    if (!isHere && output->GetNumberOfCells() > 0)
    {
      vtkMeshBridge::SetLeaf(tree, block, output);
    }
    // The rows are the same on all ranks: one table will do.
    if (controller->GetLocalProcessId() == 0)
    {
      AppendHistory(one.Report, block, ports.History);
    }
    for (std::string* text : { &one.Overlap, &one.Tangle, &one.Sizes, &one.Fault })
    {
      *text = text->empty() ? "" : title + *text;
    }
    const std::string fault = all.Fault.empty() ? one.Fault : all.Fault;
    const bool isFirst = block == blocks.front();
    const vtkIdType bands = all.NumberOfCellsInBands + one.NumberOfCellsInBands;
    isFirst ? void(all = one) : all.Add(one);
    all.Fault = fault;
    all.NumberOfCellsInBands = bands;
  }
  outcome = all;
  return {};
}

/**
 * Optimizes the grids one after the other. `volumes`: see FindPiecesOfVolumes().
 */
std::string OptimizeGrids(const Ports& ports, Request request, std::vector<Task>& tasks,
  const std::vector<char>& volumes, Outcome& outcome)
{
  const bool isComposite = vtkDataObjectTree::SafeDownCast(ports.Input) != nullptr;
  std::string error = CheckRequest(request, tasks);
  if (!error.empty())
  {
    return error;
  }
  request.NumberOfThreads = vtkMeshBridge::ResolveNumberOfThreads(request.NumberOfThreads);
  // Faces that two blocks share stay in both, so that the blocks still fit together.
  const auto locked = PrepareSurface(request, GridsOf(tasks));
  const bool slides = request.Slide &&
    std::any_of(tasks.begin(), tasks.end(),
      [](const Task& t) { return vtkMeshBridge::FindDimension(t.Input) == 3; });
  // The columns are decided before the first grid, so that all rows have the same.
  StartHistory(ports.History, isComposite, slides);
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const double first = static_cast<double>(i) / static_cast<double>(tasks.size());
    const double last = static_cast<double>(i + 1) / static_cast<double>(tasks.size());
    request.Control = vtkMeshBridge::MakeControl(
      request.Filter, request.NumberOfThreads, first, last, request.Control.deadline);
    request.Surface.locked = locked[i];
    request.IsPieceOfVolume = volumes[i] != 0;
    const Task& task = tasks[i];
    const std::string title = isComposite ? "Block " + std::to_string(task.Block) + ": " : "";
    Outcome one;
    error = OptimizeGrid(task.Input, task.Arrays, request, task.Output, one);
    if (!error.empty())
    {
      return title + error;
    }
    AppendHistory(one.Report, task.Block, ports.History);
    for (std::string* text : { &one.Twins, &one.Overlap, &one.Tangle, &one.Sizes })
    {
      *text = text->empty() ? "" : title + *text;
    }
    outcome.Add(one);
  }
  return {};
}

} // namespace

//------------------------------------------------------------------------------
std::string OptimizeAll(const Ports& ports, Request request, Outcome& outcome)
{
  const std::string unfit = CheckPieces(ports, request);
  if (!unfit.empty())
  {
    return unfit;
  }
  std::vector<Task> tasks = ListTasks(request.Filter, ports.Input, ports.Output);
  if (HasRanks(ports))
  {
    std::string obstacle;
    const std::string error = OptimizeWhole(ports, request, tasks, outcome, obstacle);
    if (!error.empty() || obstacle.empty())
    {
      return error;
    }
    if (request.Slide)
    {
      return "The boundary mode Slide cannot be used on several ranks here: " + obstacle + ".";
    }
    if (ports.Controller->GetLocalProcessId() == 0)
    {
      vtkWarningWithObjectMacro(
        request.Filter, << "The borders between the ranks' pieces are kept: " << obstacle << ".");
    }
  }
  const std::vector<char> volumes = FindPiecesOfVolumes(ports, tasks);
  const auto optimize = [&](Outcome& all)
  { return OptimizeGrids(ports, request, tasks, volumes, all); };
  if (!HasPieces(ports))
  {
    return optimize(outcome);
  }
  const std::string error = OptimizePieces(ports.Controller, optimize, outcome);
  // The field data of a grid alone are figures of the piece so far.
  if (error.empty() && !vtkDataObjectTree::SafeDownCast(ports.Output))
  {
    AddFigures(outcome, ports.Output);
  }
  return error;
}

} // namespace vtkMeshOptimizeBridge
