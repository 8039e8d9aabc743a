// SPDX-License-Identifier: BSD-3-Clause
// Properties and errors; the work is done in Private/SolutionMetric.
#include "vtkSolutionMetricFilter.h"

#include "Ranks/vtkMeshRanksBlocks.h"
#include "SolutionMetric/vtkSolutionMetricRanks.h"
#include "vtkMeshBridgeBlocks.h"

#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSolutionMetricFilter);
vtkCxxSetObjectMacro(vtkSolutionMetricFilter, Controller, vtkMultiProcessController);

namespace solution = vtkSolutionMetricBridge;

//------------------------------------------------------------------------------
vtkSolutionMetricFilter::vtkSolutionMetricFilter()
{
  this->SetSolutionArray(nullptr);
  this->SetErrorIndicatorArray(nullptr);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkSolutionMetricFilter::~vtkSolutionMetricFilter() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
void vtkSolutionMetricFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Criterion: " << this->Criterion << "\n";
  os << indent << "DesiredNumberOfElements: " << this->DesiredNumberOfElements << "\n";
  os << indent << "CountCorrection: " << this->CountCorrection << "\n";
  os << indent << "Recovery: " << this->Recovery << "\n";
  os << indent << "NormOrder: " << this->NormOrder << "\n";
  os << indent << "MinimumSize: " << this->MinimumSize << "\n";
  os << indent << "MaximumSize: " << this->MaximumSize << "\n";
  os << indent << "MaximumAnisotropy: " << this->MaximumAnisotropy << "\n";
  os << indent << "Gradation: " << this->Gradation << "\n";
  os << indent << "DesiredErrorFraction: " << this->DesiredErrorFraction << "\n";
  os << indent << "ConvergenceOrder: " << this->ConvergenceOrder << "\n";
  os << indent << "ComputeSizeTensor: " << this->ComputeSizeTensor << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "DesiredSize: " << this->DesiredSize << "\n";
  os << indent << "PredictedNumberOfElements: " << this->PredictedNumberOfElements << "\n";
  os << indent << "TotalError: " << this->TotalError << "\n";
}

//------------------------------------------------------------------------------
/**
 * Without a name: the active scalars, as all VTK filters have it.
 */
void vtkSolutionMetricFilter::SetSolutionArray(const char* name)
{
  if (name && *name)
  {
    this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
  }
  else
  {
    this->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  }
}

void vtkSolutionMetricFilter::SetErrorIndicatorArray(const char* name)
{
  if (name && *name)
  {
    this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, name);
  }
  else
  {
    this->SetInputArrayToProcess(
      1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataSetAttributes::SCALARS);
  }
}

//------------------------------------------------------------------------------
int vtkSolutionMetricFilter::FillInputPortInformation(int, vtkInformation* info)
{
  vtkMeshBridge::AcceptBlocks(info);
  return 1;
}

int vtkSolutionMetricFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

/**
 * The base class would always make a grid as output; the input may also be a tree.
 */
vtkTypeBool vtkSolutionMetricFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    vtkMeshBridge::MakeOutputLikeInput(input, output);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

//------------------------------------------------------------------------------
namespace
{

/**
 * Fills in both criteria, whichever is chosen: the options of the other one are not read.
 */
solution::Request MakeRequest(vtkSolutionMetricFilter* filter)
{
  // Both criteria have the same limits.
  meshopt::SizeLimits limits;
  limits.minimumSize = filter->GetMinimumSize();
  limits.maximumSize = filter->GetMaximumSize();
  limits.maximumAnisotropy = filter->GetMaximumAnisotropy();
  limits.gradation = filter->GetGradation();
  solution::Request request;
  request.UseErrors = filter->GetCriterion() == vtkSolutionMetricFilter::ErrorIndicator;
  request.ComputeSizeTensor = filter->GetComputeSizeTensor();
  meshopt::SolutionMetricOptions& metric = request.Metric;
  metric.recovery = static_cast<meshopt::Recovery>(filter->GetRecovery());
  metric.desiredCount = filter->GetDesiredNumberOfElements();
  metric.normOrder = filter->GetNormOrder();
  metric.limits = limits;
  metric.countCorrection = filter->GetCountCorrection();
  meshopt::ErrorIndicatorOptions& errors = request.Errors;
  errors.desiredCount = filter->GetDesiredNumberOfElements();
  errors.desiredErrorFraction = filter->GetDesiredErrorFraction();
  errors.convergenceOrder = filter->GetConvergenceOrder();
  errors.limits = limits;
  errors.countCorrection = filter->GetCountCorrection();
  return request;
}

/**
 * Adds the arrays to a grid; with a controller to the mesh of which it is this rank's piece.
 */
std::string Compute(vtkSolutionMetricFilter* filter, vtkMultiProcessController* controller,
  vtkUnstructuredGrid* grid, solution::Outcome& outcome)
{
  solution::Request request = MakeRequest(filter);
  if (controller)
  {
    return solution::AddArraysOnRanks(controller, filter, grid, request, outcome);
  }
  try
  {
    const std::string error = solution::FindArray(filter, grid, request);
    return error.empty() ? solution::AddArrays(grid, request, outcome) : error;
  }
  catch (const std::bad_alloc&)
  {
    return "Not enough memory to compute the metric of this mesh.";
  }
}

/**
 * What is no error, but hardly what the caller wanted.
 */
void Warn(
  vtkSolutionMetricFilter* filter, const std::string& title, const solution::Outcome& outcome)
{
  if (outcome.IsEven)
  {
    const bool isMetric = filter->GetCriterion() == vtkSolutionMetricFilter::Hessian;
    vtkWarningWithObjectMacro(filter,
      << title
      << (isMetric ? "The solution is linear to within its precision: there is nothing to adapt "
                     "to. The metric is the Euclidean one."
                   : "The error is 0 in all cells: there is nothing to adapt to. The size is the "
                     "same everywhere."));
  }
  if (!outcome.IsCountReached)
  {
    vtkWarningWithObjectMacro(
      filter, << title << "The limits on the size do not allow the wanted number of elements. "
              << "There will be about " << std::round(outcome.PredictedCount) << ".");
  }
}

/**
 * The blocks that some rank has, in the same order on all ranks: those that are not here get an
 * empty grid. Returns an error, the same on all ranks.
 */
std::string CompleteBlocks(vtkMultiProcessController* controller, vtkDataObject* input,
  std::vector<vtkMeshBridge::Block>& blocks)
{
  auto tree = vtkDataObjectTree::SafeDownCast(input);
  std::vector<int> here, all;
  for (const vtkMeshBridge::Block& block : blocks)
  {
    here.push_back(block.Index);
  }
  const std::vector<int> places = tree ? vtkMeshBridge::ListPlaces(tree) : here;
  if (!vtkMeshRanks::ListBlocks(controller, here, places, all))
  {
    return "The blocks of the ranks differ. Give all ranks the same blocks, empty where a rank has "
           "no part of one; or bring the mesh together first (in ParaView: the filter Aggregate "
           "Dataset).";
  }
  std::vector<vtkMeshBridge::Block> complete;
  for (const int index : all)
  {
    const auto mine = std::find_if(blocks.begin(), blocks.end(),
      [index](const vtkMeshBridge::Block& block) { return block.Index == index; });
    complete.push_back(mine != blocks.end()
        ? *mine
        : vtkMeshBridge::Block{ nullptr, vtkSmartPointer<vtkUnstructuredGrid>::New(), index });
  }
  blocks.swap(complete);
  return {};
}

} // namespace

//------------------------------------------------------------------------------
int vtkSolutionMetricFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  std::vector<vtkMeshBridge::Block> blocks = vtkMeshBridge::ListBlocks(
    this, input, vtkDataObject::GetData(outputVector, 0));
  const int processes = this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
  const bool areMany = vtkMeshBridge::AsksForPieces(
    outputVector->GetInformationObject(0), processes);
  // What all ranks know is told by the first.
  const bool isTold = areMany && this->Controller->GetLocalProcessId() > 0;
  std::string error = areMany ? CompleteBlocks(this->Controller, input, blocks) : std::string();
  this->SetErrorCode(error.empty() ? vtkErrorCode::NoError : vtkErrorCode::UserError);
  if (!error.empty() && !isTold)
  {
    vtkErrorMacro(<< error);
  }
  solution::Outcome outcome;
  for (std::size_t i = 0; i < blocks.size() && error.empty(); ++i)
  {
    const vtkMeshBridge::Block& block = blocks[i];
    // The output shares mesh and arrays with the input; new arrays are added to it alone.
    if (block.Input)
    {
      block.Output->ShallowCopy(block.Input);
    }
    outcome = solution::Outcome();
    const std::string title = vtkMeshBridge::TitleOf(input, block);
    const std::string problem = Compute(
      this, areMany ? this->Controller : nullptr, block.Output, outcome);
    if (!problem.empty())
    {
      // Returning 0 would make the executive add an error of its own.
      this->SetErrorCode(vtkErrorCode::UserError);
      if (!isTold)
      {
        vtkErrorMacro(<< title << problem);
      }
      vtkMeshBridge::MakeEmpty(block.Output);
      outcome = solution::Outcome();
    }
    if (!isTold)
    {
      Warn(this, title, outcome);
    }
  }
  this->DesiredSize = outcome.DesiredSize;
  this->PredictedNumberOfElements = outcome.PredictedCount;
  this->TotalError = outcome.TotalError;
  return 1;
}
