// SPDX-License-Identifier: BSD-3-Clause
// Properties, ports and errors; the work is done in Private.
#include "vtkThermoelasticFilter.h"

#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"
#include "vtkThermoelasticArrays.h"
#include "vtkThermoelasticRun.h"

#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkThermoelasticFilter);
vtkCxxSetObjectMacro(vtkThermoelasticFilter, Controller, vtkMultiProcessController);

namespace bridge = vtkThermoelasticBridge;

//------------------------------------------------------------------------------
vtkThermoelasticFilter::vtkThermoelasticFilter()
{
  // The solution, and the history of the solver.
  this->SetNumberOfOutputPorts(2);
  // Null unless the application has one: then there is one process.
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
  vtkMeshBridge::AcceptBlocks(info);
  return 1;
}

int vtkThermoelasticFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  // The class follows that of the input: ProcessRequest() makes the object.
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

/**
 * A grid and a table; for a tree of grids a tree like it, and one of tables.
 */
vtkTypeBool vtkThermoelasticFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, input, output);
  }
  // Not the superclass: its output would be a grid, whatever the input is.
  vtkMeshBridge::MakeOutputLikeInput(input, output);
  const bool isTree = vtkDataObjectTree::GetData(input[0]) != nullptr;
  vtkDataObject* history = vtkDataObject::GetData(output, 1);
  if (!history || !history->IsA(isTree ? "vtkMultiBlockDataSet" : "vtkTable"))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    if (isTree)
    {
      fresh = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    }
    else
    {
      fresh = vtkSmartPointer<vtkTable>::New();
    }
    output->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
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
  // Casts are safe: vtkThermoelasticEnums.cxx holds the numbers equal at compile time.
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
 * Whether some block has cells on several processes: then an error, the same on all. All processes
 * of the controller must call this.
 */
std::string CheckDistribution(
  vtkMultiProcessController* controller, const std::vector<vtkMeshBridge::Block>& blocks)
{
  // Blocks may not be the same ones on all processes; flat indices are what they have in common.
  int mine = 0, most = 0;
  for (const vtkMeshBridge::Block& block : blocks)
  {
    mine = std::max(mine, block.Index);
  }
  controller->AllReduce(&mine, &most, 1, vtkCommunicator::MAX_OP);
  // Of each index 1 or 0: the sum is the number of processes that have cells of the block.
  std::vector<int> here(most + 1, 0), all(most + 1, 0);
  for (const vtkMeshBridge::Block& block : blocks)
  {
    here[block.Index] = block.Input->GetNumberOfCells() > 0 ? 1 : 0;
  }
  controller->AllReduce(
    here.data(), all.data(), static_cast<vtkIdType>(all.size()), vtkCommunicator::SUM_OP);
  // Different blocks may well be on different processes: each is a body of its own.
  const int processes = *std::max_element(all.begin(), all.end());
  return processes <= 1 ? std::string()
                        : "The mesh is spread over " + std::to_string(processes) +
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
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  const std::vector<vtkMeshBridge::Block> blocks = vtkMeshBridge::ListBlocks(
    this, input, vtkDataObject::GetData(outputVector, 0));
  auto histories = vtkMultiBlockDataSet::GetData(outputVector, 1);
  // Tables of an earlier run must not stay: there may be fewer blocks now.
  if (histories)
  {
    histories->Initialize();
  }
  const int processes = this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
  const bool areMany = vtkMeshBridge::AsksForPieces(
    outputVector->GetInformationObject(0), processes);
  // Before anything that could fail on one process only.
  const std::string error = areMany ? CheckDistribution(this->Controller, blocks) : std::string();
  this->ErrorCode = error.empty() ? vtkErrorCode::NoError : vtkErrorCode::UserError;
  // What all processes know is told by the first.
  if (!error.empty() && this->Controller->GetLocalProcessId() == 0)
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< error);
  }
  // Without any block, too, figures of an earlier run must be gone.
  this->StoreResults(Results());
  for (const vtkMeshBridge::Block& block : blocks)
  {
    vtkSmartPointer<vtkTable> history = vtkTable::GetData(outputVector, 1);
    if (histories)
    {
      history = vtkSmartPointer<vtkTable>::New();
      histories->SetBlock(histories->GetNumberOfBlocks(), history);
    }
    // All processes have the same error or none, so that all skip or all solve.
    if (error.empty())
    {
      this->Solve(vtkMeshBridge::TitleOf(input, block), block.Input, block.Output, history);
    }
    else
    {
      vtkMeshBridge::MakeEmpty(block.Output);
      history->Initialize();
    }
  }
  return 1;
}

/**
 * Solves on one grid. What it stores are the results of this grid: after several blocks those of
 * the last one stay. An error of one block does not keep the others from being solved.
 */
void vtkThermoelasticFilter::Solve(const std::string& title, vtkUnstructuredGrid* input,
  vtkUnstructuredGrid* output, vtkTable* history)
{
  bridge::Request request = MakeRequest(this);
  Results results;
  bridge::Outcome& outcome = results.Outcome;
  const int threads = vtkMeshBridge::ResolveNumberOfThreads(this->NumberOfThreads);
  request.Control = vtkMeshBridge::MakeControl(this, threads, 0.0, 1.0);
  std::string error;
  // A factorization can need far more memory than the mesh: that must not end the application.
  try
  {
    error = bridge::SolveGrid(input, request, output, history, outcome);
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to solve on this mesh.";
  }
  if (!error.empty())
  {
    this->ErrorCode = vtkErrorCode::UserError;
    vtkErrorMacro(<< title << error);
    vtkMeshBridge::MakeEmpty(output);
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
    vtkWarningMacro(<< title << "The solver has not converged: after "
                    << this->NumberOfSolverIterations << " steps the relative residual is "
                    << this->RelativeResidual << ", wanted was " << this->Tolerance
                    << ". Very flat elements are the usual reason.");
  }
}
