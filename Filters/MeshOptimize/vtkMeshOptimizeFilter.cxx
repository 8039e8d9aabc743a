// SPDX-License-Identifier: BSD-3-Clause
// Properties, ports and errors. The work is done by the functions of Private, one grid at a time.
#include "vtkMeshOptimizeFilter.h"

#include "Boundary/vtkMeshOptimizeGeometry.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "Tasks/vtkMeshOptimizeTasks.h"
#include "Tasks/vtkMeshOptimizeWarnings.h"
#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <new>
#include <string>

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
  request.NumberOfThreads = filter->GetNumberOfThreads();
  o.growthBudget = filter->GetGrowthBudget();
  // It includes reading the grid, and all grids of the input.
  request.TimeLimit = filter->GetTimeLimit();
  request.Control.deadline = meshopt::deadlineIn(request.TimeLimit);
  request.OptimizeBelow = filter->GetOptimizeBelow();
  request.NumberOfLayers = filter->GetNumberOfLayers();
  request.NumberOfGhostLevels = filter->GetNumberOfGhostLevels();
  request.Slide = filter->GetBoundaryMode() == vtkMeshOptimizeFilter::Slide;
  request.Curves.splines = filter->GetBoundaryCurve() == vtkMeshOptimizeFilter::BSpline;
  request.Curves.cornerAngle = filter->GetCornerAngle();
  request.Surface.cornerAngle = filter->GetCornerAngle();
  // A facet cannot stand for both sides of an edge that turns by much more. Right angles stay.
  constexpr double least = 80.0;
  request.Surface.featureAngle = filter->GetFeatureAngle();
  request.Surface.releaseAngle = filter->GetKeepFeatures() ? 0.0 : least;
  request.Surface.tolerance = filter->GetSurfaceTolerance();
  request.ToleranceIsAbsolute = filter->GetToleranceIsAbsolute();
  request.Geometry = geometry;
  request.HasGeometryCorners = bridge::HasCornerArray(filter, geometry);
  return request;
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
  this->QualityBound = outcome.QualityBound();
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
  const bridge::Ports ports{ vtkDataObject::GetData(inputVector[0]),
    vtkPolyData::GetData(inputVector[1]), vtkDataObject::GetData(outputVector, 0),
    vtkTable::GetData(outputVector, 1), this->Controller, this->OptimizeBorders,
    CountPieces(outputVector->GetInformationObject(0)),
    CountGhostLevels(outputVector->GetInformationObject(0)) };
  // What all ranks know is told by the first.
  const bool isTold = bridge::HasPieces(ports) && this->Controller->GetLocalProcessId() > 0;
  Results results;
  bridge::Request request;
  std::string error;
  try
  {
    request = MakeRequest(this, ports.Geometry);
    error = bridge::OptimizeAll(ports, request, results.Outcome);
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
    vtkMeshBridge::MakeEmpty(ports.Output);
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
    bridge::WarnOfNoEffect(request, ports.Input, results.Outcome);
  }
  return 1;
}
