// SPDX-License-Identifier: BSD-3-Clause
// Properties, ports and errors. The work is done by the functions of Private, one grid at a time.
#include "vtkMeshOptimizeFilter.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"
#include "vtkMeshOptimizeGeometry.h"
#include "vtkMeshOptimizeHistory.h"
#include "vtkMeshOptimizeRanks.h"
#include "vtkMeshOptimizeRun.h"
#include "vtkMeshOptimizeSurface.h"
#include "vtkMeshOptimizeWarnings.h"

#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkMeshOptimizeFilter);
vtkCxxSetObjectMacro(vtkMeshOptimizeFilter, Controller, vtkMultiProcessController);

namespace bridge = vtkMeshOptimizeBridge;

//------------------------------------------------------------------------------
vtkMeshOptimizeFilter::vtkMeshOptimizeFilter()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkMeshOptimizeFilter::~vtkMeshOptimizeFilter() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
void vtkMeshOptimizeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Algorithm: " << this->Algorithm << "\n";
  os << indent << "TargetQuality: " << this->TargetQuality << "\n";
  os << indent << "QualityMeasure: " << this->QualityMeasure << "\n";
  os << indent << "Beta: " << this->Beta << "\n";
  os << indent << "DesiredSize: " << this->DesiredSize << "\n";
  os << indent << "NeighborhoodLevel: " << this->NeighborhoodLevel << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Epsilon: " << this->Epsilon << "\n";
  os << indent << "ArmijoFactor: " << this->ArmijoFactor << "\n";
  os << indent << "MaximumNumberOfAlternations: " << this->MaximumNumberOfAlternations << "\n";
  os << indent << "MoveNodes: " << this->MoveNodes << "\n";
  os << indent << "Reconnect: " << this->Reconnect << "\n";
  os << indent << "InsertNodes: " << this->InsertNodes << "\n";
  os << indent << "RemoveNodes: " << this->RemoveNodes << "\n";
  os << indent << "LookAhead: " << this->LookAhead << "\n";
  os << indent << "Effort: " << this->Effort << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GrowthBudget: " << this->GrowthBudget << "\n";
  os << indent << "OptimizeBelow: " << this->OptimizeBelow << "\n";
  os << indent << "NumberOfLayers: " << this->NumberOfLayers << "\n";
  os << indent << "BoundaryMode: " << this->BoundaryMode << "\n";
  os << indent << "BoundaryCurve: " << this->BoundaryCurve << "\n";
  os << indent << "CornerAngle: " << this->CornerAngle << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "KeepFeatures: " << this->KeepFeatures << "\n";
  os << indent << "SurfaceTolerance: " << this->SurfaceTolerance << "\n";
  os << indent << "ToleranceIsAbsolute: " << this->ToleranceIsAbsolute << "\n";
  os << indent << "OptimizeBorders: " << this->OptimizeBorders << "\n";
  os << indent << "NumberOfGhostLevels: " << this->NumberOfGhostLevels << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "WorstQualityBefore: " << this->WorstQualityBefore << "\n";
  os << indent << "WorstQualityAfter: " << this->WorstQualityAfter << "\n";
  os << indent << "MeanQualityBefore: " << this->MeanQualityBefore << "\n";
  os << indent << "MeanQualityAfter: " << this->MeanQualityAfter << "\n";
  os << indent << "QualityBound: " << this->QualityBound << "\n";
  os << indent << "NumberOfCappedCells: " << this->NumberOfCappedCells << "\n";
  os << indent << "NumberOfInvertedCellsBefore: " << this->NumberOfInvertedCellsBefore << "\n";
  os << indent << "NumberOfInvertedCellsAfter: " << this->NumberOfInvertedCellsAfter << "\n";
  os << indent << "EdgeLengthShare: " << this->EdgeLengthShare << "\n";
  os << indent << "SurfaceDistance: " << this->SurfaceDistance << "\n";
  os << indent << "VolumeChange: " << this->VolumeChange << "\n";
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfOperations: " << this->NumberOfOperations << "\n";
  os << indent << "NumberOfEvaluations: " << this->NumberOfEvaluations << "\n";
  os << indent << "OptimizeSeconds: " << this->OptimizeSeconds << "\n";
}

//------------------------------------------------------------------------------
void vtkMeshOptimizeFilter::SetRegionArray(const char* name)
{
  bridge::ChooseArray(this, bridge::RegionArray, name);
}

void vtkMeshOptimizeFilter::SetFixedPointArray(const char* name)
{
  bridge::ChooseArray(this, bridge::FixedPointArray, name);
}

void vtkMeshOptimizeFilter::SetSizeArray(const char* name)
{
  bridge::ChooseArray(this, bridge::SizeArray, name);
}

void vtkMeshOptimizeFilter::SetMetricArray(const char* name)
{
  bridge::ChooseArray(this, bridge::MetricArray, name);
}

void vtkMeshOptimizeFilter::SetCornerArray(const char* name)
{
  bridge::ChooseArray(this, bridge::CornerArray, name);
}

void vtkMeshOptimizeFilter::SetPatchArray(const char* name)
{
  bridge::ChooseArray(this, bridge::PatchArray, name);
}

void vtkMeshOptimizeFilter::SetGeometryConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

void vtkMeshOptimizeFilter::SetGeometryData(vtkPolyData* geometry)
{
  this->SetInputData(1, geometry);
}

const char* vtkMeshOptimizeFilter::GetStopReasonAsString() { return this->StopReasonText.c_str(); }

//------------------------------------------------------------------------------
/**
 * The base class would always make a grid as output; the input may also be a tree.
 */
vtkTypeBool vtkMeshOptimizeFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, input, output);
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

int vtkMeshOptimizeFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  // The geometry that the boundary of a plane mesh is to follow.
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  vtkMeshBridge::AcceptBlocks(info);
  return 1;
}

int vtkMeshOptimizeFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

/**
 * The mesh has the type of the input: a grid, or a tree of grids.
 */
int vtkMeshOptimizeFilter::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMeshBridge::MakeOutputLikeInput(inputVector, outputVector);
  // All outputs are made here: the base class is not asked.
  if (!vtkTable::GetData(outputVector, 1))
  {
    outputVector->GetInformationObject(1)->Set(
      vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkTable>::New());
  }
  return 1;
}

//------------------------------------------------------------------------------
namespace
{

/**
 * The data on all ports.
 */
struct Ports
{
  vtkDataObject* Input;
  vtkPolyData* Geometry;
  vtkDataObject* Output;
  vtkTable* History;
  int NumberOfPieces, NumberOfGhostLevels;
};

/**
 * A grid to optimize, with its arrays and its output.
 */
struct Task
{
  vtkUnstructuredGrid* Input;
  vtkUnstructuredGrid* Output;
  int Block;
  bridge::InputArrays Arrays;
};

bridge::Request MakeRequest(vtkMeshOptimizeFilter* filter, vtkPolyData* geometry)
{
  bridge::Request request;
  request.Filter = filter;
  meshopt::Options& o = request.Options;
  o.algorithm = static_cast<meshopt::Algorithm>(filter->GetAlgorithm());
  o.measure = static_cast<meshopt::Measure>(filter->GetQualityMeasure());
  o.beta = filter->GetBeta();
  o.desiredSize = filter->GetDesiredSize();
  o.targetQuality = filter->GetTargetQuality();
  o.moveNodes = filter->GetMoveNodes();
  o.reconnect = filter->GetReconnect();
  o.insertNodes = filter->GetInsertNodes();
  o.removeNodes = filter->GetRemoveNodes();
  o.lookAhead = filter->GetLookAhead();
  o.neighborhoodLevel = filter->GetNeighborhoodLevel();
  o.maximumNumberOfIterations = filter->GetMaximumNumberOfIterations();
  o.epsilon = filter->GetEpsilon();
  o.armijo = filter->GetArmijoFactor();
  o.maximumNumberOfAlternations = filter->GetMaximumNumberOfAlternations();
  o.effort = static_cast<meshopt::Effort>(filter->GetEffort());
  request.NumberOfThreads = vtkMeshBridge::ResolveNumberOfThreads(filter->GetNumberOfThreads());
  o.growthBudget = filter->GetGrowthBudget();
  o.timeLimit = filter->GetTimeLimit();
  request.OptimizeBelow = filter->GetOptimizeBelow();
  request.NumberOfLayers = filter->GetNumberOfLayers();
  request.Slide = filter->GetBoundaryMode() == vtkMeshOptimizeFilter::Slide;
  request.Curves.splines = filter->GetBoundaryCurve() == vtkMeshOptimizeFilter::BSpline;
  request.Curves.cornerAngle = filter->GetCornerAngle();
  request.Surface.cornerAngle = filter->GetCornerAngle();
  // A facet cannot stand for both sides of an edge that turns by much more. Right angles stay.
  constexpr double least = 80.0;
  request.Surface.featureAngle = filter->GetKeepFeatures()
    ? filter->GetFeatureAngle()
    : std::max(filter->GetFeatureAngle(), least);
  request.Surface.tolerance = filter->GetSurfaceTolerance();
  request.ToleranceIsAbsolute = filter->GetToleranceIsAbsolute();
  request.Geometry = geometry;
  request.HasGeometryCorners = bridge::HasCornerArray(filter, geometry);
  return request;
}

/**
 * The grids in `input`, with an output for each. Other leaves of a tree are passed on unchanged.
 */
std::vector<Task> ListTasks(vtkDataObject* input, vtkDataObject* output)
{
  std::vector<Task> tasks;
  if (auto grid = vtkUnstructuredGrid::SafeDownCast(input))
  {
    tasks.push_back({ grid, vtkUnstructuredGrid::SafeDownCast(output), 0, {} });
    return tasks;
  }
  auto tree = vtkDataObjectTree::SafeDownCast(input);
  auto copy = vtkDataObjectTree::SafeDownCast(output);
  // The same tree with leaves of its own: those of the input must not change.
  copy->CopyStructure(tree);
  copy->GetFieldData()->DeepCopy(tree->GetFieldData());
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* object = leaf->GetCurrentDataObject();
    auto fresh = vtkSmartPointer<vtkDataObject>::Take(object->NewInstance());
    copy->SetDataSet(leaf, fresh);
    if (auto grid = vtkUnstructuredGrid::SafeDownCast(object))
    {
      tasks.push_back({ grid, vtkUnstructuredGrid::SafeDownCast(fresh),
        static_cast<int>(leaf->GetCurrentFlatIndex()), {} });
    }
    else
    {
      fresh->ShallowCopy(object);
    }
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
std::string CheckRequest(const bridge::Request& request, std::vector<Task>& tasks)
{
  const std::vector<vtkUnstructuredGrid*> grids = GridsOf(tasks);
  bool hasSizes = false;
  for (Task& task : tasks)
  {
    const std::string error = bridge::FindInputArrays(request.Filter, task.Input, task.Arrays);
    if (!error.empty())
    {
      return error;
    }
    // Sizes in one grid are enough for the options that need them.
    hasSizes |= task.Arrays.Size != nullptr;
  }
  // Written so that what is not a number is refused, too.
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
  const std::string error = bridge::CheckArraysAreThere(
    request.Filter, grids, request.HasGeometryCorners ? bridge::CornerArray : -1);
  return error.empty() ? request.Options.check(hasSizes) : error;
}

int CountPieces(vtkInformation* info)
{
  // Who asks for no pieces gets the whole.
  const auto pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return info->Has(pieces) ? info->Get(pieces) : 1;
}

int CountGhostLevels(vtkInformation* info)
{
  const auto levels = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
  return info->Has(levels) ? info->Get(levels) : 0;
}

bool HasTetrahedra(vtkUnstructuredGrid* grid)
{
  vtkIdType c = 0;
  while (c < grid->GetNumberOfCells() && grid->GetCellType(c) != VTK_TETRA)
  {
    ++c;
  }
  return c < grid->GetNumberOfCells();
}

bool HasVolumes(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkGenericCell> cell;
  int last = VTK_EMPTY_CELL; // neighbours mostly are of one type
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type != last)
    {
      cell->SetCellType(type);
      if (cell->GetCellDimension() == 3)
      {
        return true;
      }
      last = type;
    }
  }
  return false;
}

/**
 * Whether all ranks have been asked for their pieces of one mesh.
 */
bool HasPieces(vtkMeshOptimizeFilter* filter, const Ports& ports)
{
  vtkMultiProcessController* controller = filter->GetController();
  return controller && controller->GetNumberOfProcesses() > 1 &&
    ports.NumberOfPieces == controller->GetNumberOfProcesses();
}

/**
 * The same, and the borders of the pieces take part.
 */
bool HasRanks(vtkMeshOptimizeFilter* filter, const Ports& ports)
{
  return filter->GetOptimizeBorders() && HasPieces(filter, ports);
}

/**
 * The border of a piece is not a boundary of the mesh, so it cannot slide.
 */
std::string CheckPieces(vtkMeshOptimizeFilter* filter, const Ports& ports)
{
  return filter->GetBoundaryMode() == vtkMeshOptimizeFilter::Slide && ports.NumberOfPieces > 1 &&
      !HasRanks(filter, ports)
    ? "The boundary mode Slide needs the whole mesh in one piece, or triangles on several ranks "
      "with OptimizeBorders on."
    : "";
}

/**
 * Of each task, whether its triangles alone are no mesh, since other ranks have volumes.
 */
std::vector<char> FindPiecesOfVolumes(
  vtkMeshOptimizeFilter* filter, const Ports& ports, const std::vector<Task>& tasks)
{
  std::vector<int> blocks;
  std::vector<char> volumes;
  for (const Task& task : tasks)
  {
    blocks.push_back(task.Block);
    volumes.push_back(HasPieces(filter, ports) && HasVolumes(task.Input));
  }
  return HasPieces(filter, ports) ? bridge::FindVolumes(filter->GetController(), blocks, volumes)
                                  : volumes;
}

/**
 * Optimizes the meshes that all ranks have: one, or one in each block. If it is not built for this
 * input and request, an obstacle says why, and what has been done does not count.
 */
std::string OptimizeWhole(vtkMeshOptimizeFilter* filter, const Ports& ports,
  bridge::Request& request, std::vector<Task>& tasks, bridge::Outcome& outcome,
  std::string& obstacle)
{
  vtkMultiProcessController* controller = filter->GetController();
  auto tree = vtkDataObjectTree::SafeDownCast(ports.Output);
  std::vector<int> here, blocks;
  for (const Task& task : tasks)
  {
    here.push_back(task.Block);
  }
  const std::vector<int> places = tree ? vtkMeshBridge::ListPlaces(tree) : here;
  if (!bridge::ListBlocks(controller, here, places, blocks))
  {
    obstacle = "the blocks of the ranks differ";
    return {};
  }
  request.NumberOfThreads = filter->GetNumberOfThreads(); // 0: a share of the cores
  request.NumberOfGhostLevels = std::max(
    filter->GetNumberOfGhostLevels(), ports.NumberOfGhostLevels);
  // On several ranks no surface of tetrahedra slides.
  bridge::StartHistory(ports.History, tree != nullptr, false);
  bridge::Outcome all;
  for (const int block : blocks)
  {
    const auto mine = std::find_if(
      tasks.begin(), tasks.end(), [block](const Task& task) { return task.Block == block; });
    vtkNew<vtkUnstructuredGrid> empty, fresh; // other ranks alone have this block
    const bool isHere = mine != tasks.end();
    vtkUnstructuredGrid* output = isHere ? mine->Output : fresh.Get();
    const std::string title = tree ? "Block " + std::to_string(block) + ": " : "";
    bridge::Outcome one;
    const std::string error = bridge::OptimizeOnRanks(
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
      bridge::AppendHistory(one.Report, block, ports.History);
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
 * Optimizes all grids. Returns an empty string, or a sentence about the first unusable thing.
 */
std::string OptimizeAll(vtkMeshOptimizeFilter* filter, const Ports& ports, bridge::Outcome& outcome)
{
  std::vector<Task> tasks = ListTasks(ports.Input, ports.Output);
  const bool isComposite = vtkDataObjectTree::SafeDownCast(ports.Input) != nullptr;
  bridge::Request request = MakeRequest(filter, ports.Geometry);
  if (HasRanks(filter, ports))
  {
    std::string obstacle;
    const std::string error = OptimizeWhole(filter, ports, request, tasks, outcome, obstacle);
    if (!error.empty() || obstacle.empty())
    {
      return error;
    }
    if (request.Slide)
    {
      return "The boundary mode Slide cannot be used on several ranks here: " + obstacle + ".";
    }
    if (filter->GetController()->GetLocalProcessId() == 0)
    {
      vtkWarningWithObjectMacro(
        filter, << "The borders between the ranks' pieces are kept: " << obstacle << ".");
    }
  }
  const std::vector<char> volumes = FindPiecesOfVolumes(filter, ports, tasks);
  std::string error = CheckRequest(request, tasks);
  if (!error.empty())
  {
    return error;
  }
  // Faces that two blocks share stay in both, so that the blocks still fit together.
  const auto locked = bridge::PrepareSurface(request, GridsOf(tasks));
  const bool slides = request.Slide &&
    std::any_of(tasks.begin(), tasks.end(), [](const Task& t) { return HasTetrahedra(t.Input); });
  // The columns are decided before the first grid, so that all rows have the same.
  bridge::StartHistory(ports.History, isComposite, slides);
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const double first = static_cast<double>(i) / static_cast<double>(tasks.size());
    const double last = static_cast<double>(i + 1) / static_cast<double>(tasks.size());
    request.Control = vtkMeshBridge::MakeControl(filter, request.NumberOfThreads, first, last);
    request.Surface.locked = locked[i];
    request.IsPieceOfVolume = volumes[i] != 0;
    const Task& task = tasks[i];
    const std::string title = isComposite ? "Block " + std::to_string(task.Block) + ": " : "";
    bridge::Outcome one;
    error = bridge::OptimizeGrid(task.Input, task.Arrays, request, task.Output, one);
    if (!error.empty())
    {
      return title + error;
    }
    bridge::AppendHistory(one.Report, task.Block, ports.History);
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
// Keeps the bridge's types out of the public header.
struct vtkMeshOptimizeFilter::Results
{
  bridge::Outcome Outcome;
};

/**
 * After an error these are the results of a run that did nothing.
 */
void vtkMeshOptimizeFilter::StoreResults(const Results& results)
{
  const bridge::Outcome& outcome = results.Outcome;
  const meshopt::Report& report = outcome.Report;
  this->WorstQualityBefore = report.worstBefore;
  this->WorstQualityAfter = report.worstAfter;
  this->MeanQualityBefore = report.meanBefore;
  this->MeanQualityAfter = report.meanAfter;
  this->QualityBound = outcome.NumberOfCells > 0 ? report.bound : 0.0;
  this->NumberOfCappedCells = report.cappedCells;
  this->NumberOfInvertedCellsBefore = report.invertedBefore;
  this->NumberOfInvertedCellsAfter = report.invertedAfter;
  this->StopReason = static_cast<int>(report.stopReason);
  this->StopReasonText = meshopt::describeStop(report);
  this->NumberOfOperations = outcome.NumberOfOperations;
  this->NumberOfEvaluations = report.evaluations;
  this->EdgeLengthShare = outcome.Lengths.share;
  this->SurfaceDistance = outcome.SurfaceDistance;
  this->VolumeChange = outcome.VolumeChange();
  this->OptimizeSeconds = outcome.Seconds;
}

int vtkMeshOptimizeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const Ports ports{ vtkDataObject::GetData(inputVector[0]), vtkPolyData::GetData(inputVector[1]),
    vtkDataObject::GetData(outputVector, 0), vtkTable::GetData(outputVector, 1),
    CountPieces(outputVector->GetInformationObject(0)),
    CountGhostLevels(outputVector->GetInformationObject(0)) };
  // What all ranks know is told by the first.
  const bool isTold = HasRanks(this, ports) && this->Controller->GetLocalProcessId() > 0;
  Results results;
  std::string error;
  try
  {
    error = CheckPieces(this, ports);
    error = error.empty() ? OptimizeAll(this, ports, results.Outcome) : error;
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to optimize this mesh.";
  }
  const std::string& fault = results.Outcome.Fault; // the output is what was there before it
  this->ErrorCode = error.empty() && fault.empty() ? vtkErrorCode::NoError
                                                   : vtkErrorCode::UserError;
  if (!isTold && !(error.empty() && fault.empty()))
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< (error.empty() ? fault : error));
  }
  if (!error.empty())
  {
    ports.Output->Initialize();
    ports.History->Initialize();
    results = Results();
  }
  vtkMeshBridge::KeepOutputAfterAbort(this);
  this->StoreResults(results);
  if (isTold)
  {
    return 1;
  }
  bridge::Warn(this, results.Outcome);
  if (error.empty())
  {
    bridge::WarnOfNoEffect(this, ports.Input, ports.Geometry != nullptr, results.Outcome);
  }
  return 1;
}
