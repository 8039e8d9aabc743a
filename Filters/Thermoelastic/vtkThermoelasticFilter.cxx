// SPDX-License-Identifier: BSD-3-Clause
// Properties, ports and errors; the work is done in Private.
#include "vtkThermoelasticFilter.h"

#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"
#include "vtkThermoelasticArrays.h"
#include "vtkThermoelasticRun.h"

#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <new>
#include <string>

vtkStandardNewMacro(vtkThermoelasticFilter);
vtkCxxSetObjectMacro(vtkThermoelasticFilter, Controller, vtkMultiProcessController);

namespace bridge = vtkThermoelasticBridge;

//------------------------------------------------------------------------------
vtkThermoelasticFilter::vtkThermoelasticFilter()
{
  this->SetNumberOfOutputPorts(2);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkThermoelasticFilter::~vtkThermoelasticFilter() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
void vtkThermoelasticFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TemperatureMode: " << this->TemperatureMode << "\n";
  os << indent << "UniformTemperature: " << this->UniformTemperature << "\n";
  os << indent << "AxisTemperature: " << this->AxisTemperature << "\n";
  os << indent << "RadialCoefficient: " << this->RadialCoefficient << "\n";
  os << indent << "ReferenceTemperature: " << this->ReferenceTemperature << "\n";
  os << indent << "YoungsModulus: " << this->YoungsModulus << "\n";
  os << indent << "PoissonsRatio: " << this->PoissonsRatio << "\n";
  os << indent << "ThermalExpansion: " << this->ThermalExpansion << "\n";
  os << indent << "PlaneState: " << this->PlaneState << "\n";
  os << indent << "GeneralizedPlaneStrain: " << this->GeneralizedPlaneStrain << "\n";
  os << indent << "Axis: " << this->Axis << "\n";
  os << indent << "AxialStrainMode: " << this->AxialStrainMode << "\n";
  os << indent << "AxialStrain: " << this->AxialStrain << "\n";
  os << indent << "RigidMotion: " << this->RigidMotion << "\n";
  os << indent << "SurfacePressure: " << this->SurfacePressure << "\n";
  os << indent << "StressRecovery: " << this->StressRecovery << "\n";
  os << indent << "Solver: " << this->Solver << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfUnknowns: " << this->NumberOfUnknowns << "\n";
  os << indent << "NumberOfSolverIterations: " << this->NumberOfSolverIterations << "\n";
  os << indent << "RelativeResidual: " << this->RelativeResidual << "\n";
  os << indent << "StrainEnergy: " << this->StrainEnergy << "\n";
  os << indent << "ErrorEstimate: " << this->ErrorEstimate << "\n";
  os << indent << "RelativeErrorEstimate: " << this->RelativeErrorEstimate << "\n";
  os << indent << "PrescribedAxialStrain: " << this->PrescribedAxialStrain << "\n";
  os << indent << "AssemblySeconds: " << this->AssemblySeconds << "\n";
  os << indent << "SolveSeconds: " << this->SolveSeconds << "\n";
  os << indent << "RecoverySeconds: " << this->RecoverySeconds << "\n";
}

//------------------------------------------------------------------------------
// Names may be missing: nullptr and "" both mean that nothing is chosen.
void vtkThermoelasticFilter::ChooseArray(int index, bool onCells, const char* name)
{
  this->SetInputArrayToProcess(index, 0, 0,
    onCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    name ? name : "");
}

void vtkThermoelasticFilter::SetTemperatureArray(const char* name)
{
  this->ChooseArray(bridge::TemperatureArray, false, name);
}

void vtkThermoelasticFilter::SetYoungsModulusArray(const char* name)
{
  this->ChooseArray(bridge::YoungsModulusArray, true, name);
}

void vtkThermoelasticFilter::SetPoissonsRatioArray(const char* name)
{
  this->ChooseArray(bridge::PoissonsRatioArray, true, name);
}

void vtkThermoelasticFilter::SetThermalExpansionArray(const char* name)
{
  this->ChooseArray(bridge::ThermalExpansionArray, true, name);
}

void vtkThermoelasticFilter::SetRegionArray(const char* name)
{
  this->ChooseArray(bridge::RegionArray, true, name);
}

void vtkThermoelasticFilter::SetConstraintArray(const char* name)
{
  this->ChooseArray(bridge::ConstraintArray, false, name);
}

void vtkThermoelasticFilter::SetPrescribedDisplacementArray(const char* name)
{
  this->ChooseArray(bridge::PrescribedDisplacementArray, false, name);
}

void vtkThermoelasticFilter::SetTractionArray(const char* name)
{
  this->ChooseArray(bridge::TractionArray, false, name);
}

void vtkThermoelasticFilter::SetFacetTractionArray(const char* name)
{
  this->ChooseArray(bridge::FacetTractionArray, true, name);
}

const char* vtkThermoelasticFilter::GetStopReasonAsString()
{
  switch (this->StopReason)
  {
    case Converged:
      return "Converged";
    case IterationLimit:
      return "Tolerance not reached";
    case Breakdown:
      return "Solver broke down";
    case Aborted:
      return "Aborted";
    case NothingToDo:
      return "Nothing to do";
    default:
      return "Not run";
  }
}

//------------------------------------------------------------------------------
int vtkThermoelasticFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  // One grid, not a composite: the executive calls the filter for each block.
  return 1;
}

int vtkThermoelasticFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

//------------------------------------------------------------------------------
namespace
{

bridge::Request MakeRequest(vtkThermoelasticFilter* filter)
{
  // A struct of plain values: below it nothing asks the filter, except which arrays are chosen.
  bridge::Request request;
  request.Filter = filter;
  request.TemperatureMode = filter->GetTemperatureMode();
  request.UniformTemperature = filter->GetUniformTemperature();
  request.AxisTemperature = filter->GetAxisTemperature();
  request.RadialCoefficient = filter->GetRadialCoefficient();
  request.ReferenceTemperature = filter->GetReferenceTemperature();
  request.Material = { filter->GetYoungsModulus(), filter->GetPoissonsRatio(),
    filter->GetThermalExpansion() };
  request.PlaneState = static_cast<meshopt::fem::PlaneState>(filter->GetPlaneState());
  request.GeneralizedPlaneStrain = filter->GetGeneralizedPlaneStrain();
  request.Axis = filter->GetAxis();
  request.IsAxialStrainGiven = filter->GetAxialStrainMode() == vtkThermoelasticFilter::Given;
  request.AxialStrain = filter->GetAxialStrain();
  request.SurfacePressure = filter->GetSurfacePressure();
  request.RigidMotion = static_cast<meshopt::fem::RigidMotion>(filter->GetRigidMotion());
  request.Options.solver.solver = static_cast<meshopt::fem::Solver>(filter->GetSolver());
  request.Options.solver.tolerance = filter->GetTolerance();
  request.Options.solver.maximumNumberOfIterations = filter->GetMaximumNumberOfIterations();
  request.Options.recovery = static_cast<meshopt::fem::StressRecovery>(filter->GetStressRecovery());
  return request;
}

/**
 * All processes of the controller must call this.
 */
std::string CheckDistribution(vtkMultiProcessController* controller, bool hasCells)
{
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return {};
  }
  // Collective: a process that left before this call would make the others wait for ever.
  const int mine = hasCells ? 1 : 0;
  int all = 0;
  controller->AllReduce(&mine, &all, 1, vtkCommunicator::SUM_OP);
  // Only ranks with cells have an error: the others have nothing to solve, and nothing to say.
  return all <= 1 || !hasCells ? std::string()
                               : "The mesh is spread over " + std::to_string(all) +
      " processes, but the equations are solved on one. Bring it together first (in ParaView: the "
      "filter Aggregate Dataset).";
}

} // namespace

// Keeps the bridge's types out of the public header.
struct vtkThermoelasticFilter::Results
{
  bridge::Outcome Outcome;
};

/**
 * After an error these are the results of a run that has solved nothing.
 */
void vtkThermoelasticFilter::StoreResults(const Results& results)
{
  const bridge::Outcome& outcome = results.Outcome;
  this->NumberOfUnknowns = outcome.NumberOfUnknowns;
  this->NumberOfSolverIterations = outcome.Solver.iterations;
  this->RelativeResidual = outcome.Solver.relativeResidual;
  this->StrainEnergy = outcome.StrainEnergy;
  this->ErrorEstimate = outcome.ErrorEstimate;
  this->RelativeErrorEstimate = outcome.RelativeErrorEstimate;
  this->PrescribedAxialStrain = outcome.AxialStrain;
  this->AssemblySeconds = outcome.AssemblySeconds;
  this->SolveSeconds = outcome.SolveSeconds;
  this->RecoverySeconds = outcome.RecoverySeconds;
  this->StopReason = static_cast<int>(outcome.Solver.status);
}

int vtkThermoelasticFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector, 0);
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  if (!input) // a block of another type: the executive does not check it
  {
    vtkWarningMacro(<< "A block of type " << vtkDataObject::GetData(inputVector[0])->GetClassName()
                    << " was skipped: it is not a vtkUnstructuredGrid.");
    output->Initialize();
    history->Initialize();
    return 1;
  }
  bridge::Request request = MakeRequest(this);
  Results results;
  bridge::Outcome& outcome = results.Outcome;
  const int threads = vtkMeshBridge::ResolveNumberOfThreads(this->NumberOfThreads);
  request.Control = vtkMeshBridge::MakeControl(this, threads, 0.0, 1.0);
  // Before anything that could fail on one process only.
  std::string error = CheckDistribution(this->Controller, input->GetNumberOfCells() > 0);
  try
  {
    if (error.empty())
    {
      error = bridge::SolveGrid(input, request, output, history, outcome);
    }
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to solve on this mesh.";
  }
  this->ErrorCode = error.empty() ? vtkErrorCode::NoError : vtkErrorCode::UserError;
  if (!error.empty())
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< error);
    output->Initialize();
    history->Initialize();
    // Results of an earlier run must not stay beside an error.
    outcome = bridge::Outcome();
  }
  this->StoreResults(results);
  // No cells, as on a process without a piece: no fault.
  if (error.empty() && !outcome.HasSolved)
  {
    this->StopReason = NothingToDo;
  }
  // A warning, not an error: what has been found so far is in the output.
  if (this->StopReason == IterationLimit || this->StopReason == Breakdown)
  {
    vtkWarningMacro(<< "The solver has not converged: after " << this->NumberOfSolverIterations
                    << " steps the relative residual is " << this->RelativeResidual
                    << ", wanted was " << this->Tolerance
                    << ". Very flat elements are the usual reason.");
  }
  return 1;
}
