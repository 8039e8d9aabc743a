// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeFilter.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"
#include "vtkMeshOptimizeCurves.h"
#include "vtkMeshOptimizeHistory.h"
#include "vtkMeshOptimizeRun.h"

#include "vtkCompositeDataIterator.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
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

namespace bridge = vtkMeshOptimizeBridge;

//------------------------------------------------------------------------------
vtkMeshOptimizeFilter::vtkMeshOptimizeFilter()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkMeshOptimizeFilter::~vtkMeshOptimizeFilter() = default;

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
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfOperations: " << this->NumberOfOperations << "\n";
  os << indent << "OptimizeSeconds: " << this->OptimizeSeconds << "\n";
}

//------------------------------------------------------------------------------
void vtkMeshOptimizeFilter::SetRegionArray(const char* name)
{
  this->SetInputArrayToProcess(
    bridge::RegionArray, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, name ? name : "");
}

void vtkMeshOptimizeFilter::SetFixedPointArray(const char* name)
{
  this->SetInputArrayToProcess(
    bridge::FixedPointArray, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name ? name : "");
}

void vtkMeshOptimizeFilter::SetSizeArray(const char* name)
{
  this->SetInputArrayToProcess(
    bridge::SizeArray, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name ? name : "");
}

void vtkMeshOptimizeFilter::SetMetricArray(const char* name)
{
  this->SetInputArrayToProcess(
    bridge::MetricArray, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name ? name : "");
}

void vtkMeshOptimizeFilter::SetCornerArray(const char* name)
{
  this->SetInputArrayToProcess(
    bridge::CornerArray, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name ? name : "");
}

void vtkMeshOptimizeFilter::SetGeometryConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

void vtkMeshOptimizeFilter::SetGeometryData(vtkPolyData* geometry)
{
  this->SetInputData(1, geometry);
}

const char* vtkMeshOptimizeFilter::GetStopReasonAsString()
{
  return meshopt::toString(static_cast<meshopt::StopReason>(this->StopReason));
}

//------------------------------------------------------------------------------
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
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  return 1;
}

int vtkMeshOptimizeFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

/**
 * The mesh is of the type of the input, be it a grid or a tree of grids.
 */
int vtkMeshOptimizeFilter::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector, 0);
  // Without an input the executive says so later, in one error; a 0 from here would make it two.
  const char* type = input ? input->GetClassName() : "vtkUnstructuredGrid";
  if (!output || !output->IsA(type))
  {
    vtkSmartPointer<vtkDataObject> fresh = input
      ? vtkSmartPointer<vtkDataObject>::Take(input->NewInstance())
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkUnstructuredGrid>::New());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
  if (!vtkTable::GetData(outputVector, 1))
  {
    outputVector->GetInformationObject(1)->Set(
      vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkTable>::New());
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkMeshOptimizeBridge::Request vtkMeshOptimizeFilter::MakeRequest()
{
  bridge::Request request;
  request.Filter = this;
  meshopt::Options& o = request.Options;
  o.algorithm = static_cast<meshopt::Algorithm>(this->Algorithm);
  o.measure = static_cast<meshopt::Measure>(this->QualityMeasure);
  o.beta = this->Beta;
  o.desiredSize = this->DesiredSize;
  o.targetQuality = this->TargetQuality;
  o.moveNodes = this->MoveNodes;
  o.reconnect = this->Reconnect;
  o.insertNodes = this->InsertNodes;
  o.removeNodes = this->RemoveNodes;
  o.lookAhead = this->LookAhead;
  o.neighborhoodLevel = this->NeighborhoodLevel;
  o.maximumNumberOfIterations = this->MaximumNumberOfIterations;
  o.epsilon = this->Epsilon;
  o.armijo = this->ArmijoFactor;
  o.maximumNumberOfAlternations = this->MaximumNumberOfAlternations;
  o.effort = static_cast<meshopt::Effort>(this->Effort);
  o.numberOfThreads = bridge::ResolveNumberOfThreads(this->NumberOfThreads);
  o.growthBudget = this->GrowthBudget;
  o.timeLimit = this->TimeLimit;
  request.OptimizeBelow = this->OptimizeBelow;
  request.NumberOfLayers = this->NumberOfLayers;
  request.Slide = this->BoundaryMode == Slide;
  request.Curves.splines = this->BoundaryCurve == BSpline;
  request.Curves.cornerAngle = this->CornerAngle;
  return request;
}

namespace
{

/**
 * A grid to optimize and where to put it.
 */
struct Task
{
  vtkUnstructuredGrid* Input;
  vtkUnstructuredGrid* Output;
  int Block;
};

/**
 * The grids in `input`, with an output for each. Other leaves of a tree are handed over as they
 * are.
 */
std::vector<Task> ListTasks(vtkDataObject* input, vtkDataObject* output)
{
  std::vector<Task> tasks;
  if (auto grid = vtkUnstructuredGrid::SafeDownCast(input))
  {
    tasks.push_back({ grid, vtkUnstructuredGrid::SafeDownCast(output), 0 });
    return tasks;
  }
  auto tree = vtkDataObjectTree::SafeDownCast(input);
  auto copy = vtkDataObjectTree::SafeDownCast(output);
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
        static_cast<int>(leaf->GetCurrentFlatIndex()) });
    }
    else
    {
      fresh->ShallowCopy(object);
    }
  }
  return tasks;
}

std::string CheckRequest(const bridge::Request& request, const std::vector<Task>& tasks)
{
  std::vector<vtkUnstructuredGrid*> grids;
  bridge::InputArrays arrays;
  bool hasSizes = false;
  for (const Task& task : tasks)
  {
    grids.push_back(task.Input);
    const std::string error = bridge::FindInputArrays(request.Filter, task.Input, arrays);
    if (!error.empty())
    {
      return error;
    }
    hasSizes |= arrays.Size != nullptr;
  }
  if (!(request.OptimizeBelow >= 0.0))
  {
    return "OptimizeBelow, the quality under which cells may change, must be a number.";
  }
  if (request.Slide && request.OptimizeBelow > 0.0)
  {
    return "The boundary mode Slide works on the whole mesh; it cannot be used with OptimizeBelow.";
  }
  if (request.Slide && request.Options.algorithm != meshopt::Algorithm::WorstFirst)
  {
    return "The boundary mode Slide needs the algorithm WorstFirst.";
  }
  const bool inGeometry = bridge::HasCornerArray(request.Filter, request.Geometry);
  const std::string error = bridge::CheckArraysAreThere(
    request.Filter, grids, inGeometry ? bridge::CornerArray : -1);
  return error.empty() ? request.Options.check(hasSizes) : error;
}

} // namespace

//------------------------------------------------------------------------------
std::string vtkMeshOptimizeFilter::OptimizeAll(vtkDataObject* input, vtkPolyData* geometry,
  vtkDataObject* output, vtkTable* history, bridge::Outcome& outcome)
{
  const std::vector<Task> tasks = ListTasks(input, output);
  const bool isComposite = vtkDataObjectTree::SafeDownCast(input) != nullptr;
  bridge::Request request = this->MakeRequest();
  request.Geometry = geometry;
  std::string error = CheckRequest(request, tasks);
  if (!error.empty())
  {
    return error;
  }
  bridge::StartHistory(history, isComposite);
  bridge::Deadline deadline(this->TimeLimit);
  request.TimeLimit = &deadline;
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const double first = static_cast<double>(i) / static_cast<double>(tasks.size());
    const double last = static_cast<double>(i + 1) / static_cast<double>(tasks.size());
    request.Control = bridge::MakeControl(
      this, request.Options.numberOfThreads, first, last, deadline);
    bridge::Outcome one;
    error = bridge::OptimizeGrid(tasks[i].Input, request, tasks[i].Output, one);
    if (!error.empty())
    {
      return isComposite ? "Block " + std::to_string(tasks[i].Block) + ": " + error : error;
    }
    bridge::AppendHistory(one.Report, tasks[i].Block, history);
    for (std::string* text : { &one.Tangle, &one.Sizes })
    {
      if (isComposite && !text->empty())
      {
        *text = "Block " + std::to_string(tasks[i].Block) + ": " + *text;
      }
    }
    outcome.Add(one);
  }
  return {};
}

void vtkMeshOptimizeFilter::StoreResults(const bridge::Outcome& outcome)
{
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
  this->NumberOfOperations = outcome.NumberOfOperations;
  this->EdgeLengthShare = outcome.Lengths.share;
  this->OptimizeSeconds = outcome.Seconds;
}

void vtkMeshOptimizeFilter::Warn(const bridge::Outcome& outcome)
{
  if (outcome.NumberOfQuadraticSimplices > 0)
  {
    vtkWarningMacro(<< outcome.NumberOfQuadraticSimplices
                    << " quadratic triangles or tetrahedra passed through as they are: only linear "
                       "ones can be optimized.");
  }
  if (outcome.NumberOfReorientedCells > 0)
  {
    vtkWarningMacro(<< outcome.NumberOfReorientedCells
                    << " cells were numbered the wrong way round (negative volume); they have been "
                       "renumbered.");
  }
  for (const std::string& text : { outcome.Tangle, outcome.Sizes })
  {
    if (!text.empty())
    {
      vtkWarningMacro(<< text);
    }
  }
}

/**
 * Settings and input that have no effect: a newcomer wonders why nothing happens.
 */
void vtkMeshOptimizeFilter::WarnOfNoEffect(
  vtkDataObject* input, vtkPolyData* geometry, const bridge::Outcome& outcome)
{
  const vtkIdType numberOfCells = input->GetNumberOfElements(vtkDataObject::CELL);
  if (numberOfCells > 0 && outcome.NumberOfSimplices + outcome.NumberOfQuadraticSimplices == 0)
  {
    vtkWarningMacro(<< "Nothing to optimize: none of the " << numberOfCells
                    << " cells is a triangle or a tetrahedron of an unstructured grid. They have "
                       "passed through as they are. (In ParaView, Tetrahedralize splits other "
                       "cells, and Append Datasets makes a grid of polygonal data.)");
  }
  const bool hasSizes = this->DesiredSize > 0.0 || bridge::IsWanted(this, bridge::SizeArray);
  if (hasSizes && this->Beta == 0.0 && this->BoundaryMode == Fixed)
  {
    vtkWarningMacro(<< "Beta is 0, so only the shape counts: the wanted size has no effect.");
  }
  if (geometry && this->BoundaryMode == Fixed)
  {
    vtkWarningMacro(
      << "The boundary mode is Fixed, so the geometry on input port 1 has no effect.");
  }
}

/**
 * The border of a piece is no boundary.
 */
std::string vtkMeshOptimizeFilter::CheckPieces(vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const auto pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return this->BoundaryMode == Slide && info->Has(pieces) && info->Get(pieces) > 1
    ? "The boundary mode Slide needs the whole mesh in one piece; it cannot work on distributed "
      "data."
    : "";
}

int vtkMeshOptimizeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* output = vtkDataObject::GetData(outputVector, 0);
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  bridge::Outcome outcome;
  std::string error;
  try
  {
    error = this->CheckPieces(outputVector);
    if (error.empty())
    {
      error = this->OptimizeAll(vtkDataObject::GetData(inputVector[0]),
        vtkPolyData::GetData(inputVector[1]), output, history, outcome);
    }
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to optimize this mesh.";
  }
  this->ErrorCode = error.empty() ? vtkErrorCode::NoError : vtkErrorCode::UserError;
  if (!error.empty())
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< error);
    output->Initialize();
    history->Initialize();
    outcome = bridge::Outcome();
  }
  vtkMeshOptimizeCompat::KeepOutputAfterAbort(this);
  this->StoreResults(outcome);
  this->Warn(outcome);
  if (error.empty())
  {
    this->WarnOfNoEffect(
      vtkDataObject::GetData(inputVector[0]), vtkPolyData::GetData(inputVector[1]), outcome);
  }
  return 1;
}
