// SPDX-License-Identifier: BSD-3-Clause
// Properties and errors; the work is done in Private/vtkSolutionMetricRun.
#include "vtkSolutionMetricFilter.h"

#include "vtkSolutionMetricRun.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <new>
#include <string>

vtkStandardNewMacro(vtkSolutionMetricFilter);

namespace bridge = vtkSolutionMetricBridge;

//------------------------------------------------------------------------------
vtkSolutionMetricFilter::vtkSolutionMetricFilter()
{
  this->SetSolutionArray(nullptr);
  this->SetErrorIndicatorArray(nullptr);
}

vtkSolutionMetricFilter::~vtkSolutionMetricFilter() = default;

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
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
namespace
{

/**
 * Fills in both criteria, whichever is chosen: the options of the other one are not read.
 */
bridge::Request MakeRequest(vtkSolutionMetricFilter* filter)
{
  // Both criteria have the same limits.
  meshopt::SizeLimits limits;
  limits.minimumSize = filter->GetMinimumSize();
  limits.maximumSize = filter->GetMaximumSize();
  limits.maximumAnisotropy = filter->GetMaximumAnisotropy();
  limits.gradation = filter->GetGradation();
  bridge::Request request;
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

std::string Compute(
  vtkSolutionMetricFilter* filter, vtkUnstructuredGrid* grid, bridge::Outcome& outcome)
{
  bridge::Request request = MakeRequest(filter);
  const std::string error = bridge::FindArray(filter, grid, request);
  return error.empty() ? bridge::AddArrays(grid, request, outcome) : error;
}

/**
 * What is no error, but hardly what the caller wanted.
 */
void Warn(vtkSolutionMetricFilter* filter, const bridge::Outcome& outcome)
{
  if (outcome.IsEven)
  {
    const bool isMetric = filter->GetCriterion() == vtkSolutionMetricFilter::Hessian;
    vtkWarningWithObjectMacro(
      filter, << (isMetric
                  ? "The solution is linear to within its precision: there is nothing to adapt to. "
                    "The metric is the Euclidean one."
                  : "The error is 0 in all cells: there is nothing to adapt to. The size is the "
                    "same everywhere."));
  }
  if (!outcome.IsCountReached)
  {
    vtkWarningWithObjectMacro(
      filter, << "The limits on the size do not allow the wanted number of elements. There will "
              << "be about " << std::round(outcome.PredictedCount) << ".");
  }
}

// Not asked of the other processes whether they have cells: blocks of composite data come one by
// one, and not as many on each process.
void WarnOfPieces(vtkSolutionMetricFilter* filter, vtkInformation* outInfo)
{
  const auto pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  if (outInfo->Has(pieces) && outInfo->Get(pieces) > 1)
  {
    vtkWarningWithObjectMacro(filter, << "This process works by itself, as one of "
                                      << outInfo->Get(pieces)
                                      << ". If others have cells of the mesh, too, the metric near "
                                         "the borders of the pieces is not that of the whole, and "
                                         "each piece gets the wanted number of elements. Bring the "
                                         "mesh together first (in ParaView: the filter Aggregate "
                                         "Dataset).");
  }
}

} // namespace

//------------------------------------------------------------------------------
int vtkSolutionMetricFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  if (!input) // a block of another type in a composite data set: the executive does not check it
  {
    vtkWarningMacro(<< "A block of type " << vtkDataObject::GetData(inputVector[0])->GetClassName()
                    << " was skipped: it is not a vtkUnstructuredGrid.");
    output->Initialize();
    return 1;
  }
  // The output shares mesh and arrays with the input; new arrays are added to it alone.
  output->ShallowCopy(input);
  bridge::Outcome outcome;
  std::string error;
  try
  {
    error = Compute(this, output, outcome);
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to compute the metric of this mesh.";
  }
  this->SetErrorCode(error.empty() ? vtkErrorCode::NoError : vtkErrorCode::UserError);
  if (!error.empty())
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< error);
    output->Initialize();
    outcome = bridge::Outcome();
  }
  this->DesiredSize = outcome.DesiredSize;
  this->PredictedNumberOfElements = outcome.PredictedCount;
  this->TotalError = outcome.TotalError;
  Warn(this, outcome);
  if (error.empty() && input->GetNumberOfCells() > 0)
  {
    WarnOfPieces(this, outputVector->GetInformationObject(0));
  }
  return 1;
}
