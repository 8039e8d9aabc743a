// SPDX-License-Identifier: BSD-3-Clause
// One grid from input to output.
#include "vtkThermoelasticRun.h"

#include "vtkMeshBridgeImport.h"
#include "vtkMeshBridgeValues.h"
#include "vtkThermoelasticExport.h"
#include "vtkThermoelasticFilter.h"
#include "vtkThermoelasticProblem.h"

#include "vtkUnstructuredGrid.h"

namespace vtkThermoelasticBridge
{

namespace bridge = vtkMeshBridge;
using meshopt::fem::Solution;
using meshopt::fem::SolverStatus;

namespace
{

/**
 * Triangles are turned into their plane: the core computes in two coordinates.
 */
template <int D>
std::string BuildMesh(Model<D>& model)
{
  std::string error = bridge::FindFrame(model.Grid, model.Cells, model.Frame);
  if (!error.empty())
  {
    return error;
  }
  // Regions matter for the recovery of stress, which may jump between them.
  meshopt::MeshInput<D> input = bridge::ImportGeometry(
    model.Grid, model.Cells.Simplices, model.Frame);
  input.regions = bridge::ReadRegions(model.Arrays[RegionArray], model.Cells);
  const auto fault = meshopt::SimplexMesh<D>::build(input, model.Mesh);
  return fault ? bridge::WithGridIds(fault->message, fault->cell, model.Cells) : std::string();
}

/**
 * Also of a run that has not converged or was aborted: they say how far it came.
 */
template <int D>
void KeepFigures(const Solution<D>& solution, Outcome& outcome)
{
  outcome.HasSolved = true;
  outcome.Solver = solution.solver;
  outcome.NumberOfUnknowns = solution.numberOfUnknowns;
  outcome.StrainEnergy = solution.strainEnergy;
  outcome.ErrorEstimate = solution.totalErrorEstimate;
  outcome.RelativeErrorEstimate = solution.relativeErrorEstimate;
  outcome.AssemblySeconds = solution.assemblySeconds;
  outcome.SolveSeconds = solution.solveSeconds;
  outcome.RecoverySeconds = solution.recoverySeconds;
}

template <int D>
std::string Solve(const bridge::Cells& cells, const InputArrays& arrays, vtkUnstructuredGrid* input,
  const Request& request, vtkUnstructuredGrid* output, vtkTable* history, Outcome& outcome)
{
  Model<D> model;
  model.Grid = input;
  model.Cells = cells;
  model.Arrays = arrays;
  std::string error = BuildMesh(model);
  if (error.empty())
  {
    error = MakeProblem(request, model, outcome.AxialStrain);
  }
  if (!error.empty())
  {
    return error;
  }
  Solution<D> solution;
  const auto fault = meshopt::fem::analyse(
    model.Mesh, model.Problem, request.Options, request.Control, solution);
  if (fault)
  {
    // The core counts simplices only. The sentence names the cell of the grid.
    return bridge::WithGridIds(fault->message, fault->cell, model.Cells);
  }
  // After an abort the output stays empty: half a solution would look like one.
  KeepFigures(solution, outcome);
  if (solution.solver.status != SolverStatus::Cancelled)
  {
    // Results are added to the copy. The arrays of the input are shared.
    output->ShallowCopy(input);
    // A temperature by formula is shown, too; one from an array is there already.
    if (request.TemperatureMode != vtkThermoelasticFilter::PointArray)
    {
      ExportTemperature(model.Problem.temperature, output);
    }
    ExportSolution(model, solution, output);
    ExportFigures(outcome, output);
    ExportHistory(solution.solver.history, history);
  }
  return {};
}

} // namespace

std::string SolveGrid(vtkUnstructuredGrid* input, const Request& request,
  vtkUnstructuredGrid* output, vtkTable* history, Outcome& outcome)
{
  // A process without a piece: its output is empty, and nothing is wrong.
  if (input->GetNumberOfCells() == 0)
  {
    output->ShallowCopy(input);
    return {};
  }
  bridge::Cells cells;
  std::string error = bridge::ClassifyCells(input, cells);
  if (error.empty())
  {
    // With a cell left out it would be another body.
    error = bridge::CheckOnlySimplices(input, cells);
  }
  if (error.empty() && cells.Dimension == 0)
  {
    error = bridge::NoSimplices;
  }
  // Arrays last: whether the mesh can be solved on at all does not depend on them.
  InputArrays arrays;
  if (error.empty())
  {
    error = FindInputArrays(request.Filter, input, arrays);
  }
  if (!error.empty())
  {
    return error;
  }
  return cells.Dimension == 3 ? Solve<3>(cells, arrays, input, request, output, history, outcome)
                              : Solve<2>(cells, arrays, input, request, output, history, outcome);
}

} // namespace vtkThermoelasticBridge
