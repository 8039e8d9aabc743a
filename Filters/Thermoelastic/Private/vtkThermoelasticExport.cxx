// SPDX-License-Identifier: BSD-3-Clause
// The solution as arrays of the grid. Vectors and stresses of plane meshes are turned back into
// space.
#include "vtkThermoelasticExport.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>

#include <limits>

namespace vtkThermoelasticBridge
{

using meshopt::Index;
using meshopt::Tensor;
using meshopt::Vec;
using meshopt::fem::Solution;
using meshopt::fem::Stress;
using vtkMeshBridge::Frame;
using vtkMeshBridge::UsedBySimplex;

namespace
{

// For points and cells that have no value: 0 would look like a result.
const double NaN = std::numeric_limits<double>::quiet_NaN();

Vec<3> VectorToGrid(const Frame<3>&, const Vec<3>& u) { return u; }
Vec<3> VectorToGrid(const Frame<2>& frame, const Vec<2>& u)
{
  return u[0] * frame.Axes[0] + u[1] * frame.Axes[1];
}

Tensor<3> StressToGrid(const Frame<3>&, const Stress<3>& s) { return meshopt::fem::toTensor<3>(s); }
/**
 * From the axes of the plane and its normal to those of the grid.
 */
Tensor<3> StressToGrid(const Frame<2>& frame, const Stress<2>& s)
{
  Tensor<3> axes;
  axes.col(0) = frame.Axes[0];
  axes.col(1) = frame.Axes[1];
  // The third axis is the normal: out of the plane there may be stress, too. The axes are
  // orthonormal, so that the inverse of the change of axes is its transpose.
  axes.col(2) = frame.Axes[0].cross(frame.Axes[1]);
  return axes * meshopt::fem::toTensor<2>(s) * axes.transpose();
}

/**
 * A new array with this many tuples of one value; it replaces any array of the same name.
 */
vtkDoubleArray* AddArray(vtkDataSetAttributes* attributes, const char* name, int components,
  vtkIdType tuples, double value, const char* const* componentNames = nullptr)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  // With names the user chooses components by XX or XY, not by numbers.
  for (int i = 0; i < components && componentNames; ++i)
  {
    array->SetComponentName(i, componentNames[i]);
  }
  array->SetNumberOfTuples(tuples);
  array->Fill(value);
  attributes->AddArray(array);
  return array;
}

const char* const StressNames[] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
const char* const PrincipalNames[] = { "1", "2", "3" };

// In VTK's order of symmetric tensors, which its filters know.
void SetStress(vtkDoubleArray* array, vtkIdType tuple, const Tensor<3>& s)
{
  const double components[6] = { s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2) };
  array->SetTypedTuple(tuple, components);
}

template <int D>
void ExportVectors(const Model<D>& model, const std::vector<Vec<D>>& vectors, const char* name,
  vtkUnstructuredGrid* output)
{
  const vtkIdType n = output->GetNumberOfPoints();
  // 0, not NaN, where no element is: such points can still be warped.
  vtkDoubleArray* array = AddArray(output->GetPointData(), name, 3, n, 0.0);
  for (vtkIdType p = 0; p < n; ++p)
  {
    if (model.Cells.PointUse[p] & UsedBySimplex)
    {
      array->SetTypedTuple(p, VectorToGrid(model.Frame, vectors[p]).data());
    }
  }
}

template <int D>
void ExportPointStress(
  const Model<D>& model, const std::vector<Stress<D>>& stress, vtkUnstructuredGrid* output)
{
  const vtkIdType n = output->GetNumberOfPoints();
  vtkPointData* data = output->GetPointData();
  vtkDoubleArray* tensors = AddArray(data, "Stress", 6, n, NaN, StressNames);
  vtkDoubleArray* equivalent = AddArray(data, "VonMises", 1, n, NaN);
  vtkDoubleArray* principal = AddArray(data, "PrincipalStress", 3, n, NaN, PrincipalNames);
  for (vtkIdType p = 0; p < n; ++p)
  {
    // A point that only ghost cells use is not part of the mesh.
    if (model.Mesh.isPointAlive(static_cast<Index>(p)))
    {
      SetStress(tensors, p, StressToGrid(model.Frame, stress[p]));
      equivalent->SetValue(p, meshopt::fem::vonMises<D>(stress[p]));
      principal->SetTypedTuple(p, meshopt::fem::principalStresses<D>(stress[p]).data());
    }
  }
}

/**
 * The solution counts simplices; other cells of the grid have no value.
 */
template <int D>
void ExportCellValues(const Model<D>& model, const std::vector<double>& values, const char* name,
  vtkUnstructuredGrid* output)
{
  vtkDoubleArray* array = AddArray(output->GetCellData(), name, 1, output->GetNumberOfCells(), NaN);
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    array->SetValue(model.Cells.Simplices[c], values[c]);
  }
}

template <class Array, class Value>
void AddFigure(vtkUnstructuredGrid* output, const char* name, const Value& value)
{
  vtkNew<Array> figure;
  figure->SetName(name);
  figure->InsertNextValue(value);
  output->GetFieldData()->AddArray(figure);
}

} // namespace

template <int D>
void ExportSolution(const Model<D>& model, const Solution<D>& solution, vtkUnstructuredGrid* output)
{
  ExportVectors(model, solution.displacement, "Displacement", output);
  ExportVectors(model, solution.reaction, "Reaction", output);
  vtkDoubleArray* elementStress = AddArray(
    output->GetCellData(), "ElementStress", 6, output->GetNumberOfCells(), NaN, StressNames);
  for (std::size_t c = 0; c < solution.elementStress.size(); ++c)
  {
    SetStress(elementStress, model.Cells.Simplices[c],
      StressToGrid(model.Frame, solution.elementStress[c]));
  }
  ExportCellValues(model, solution.strainEnergyDensity, "StrainEnergyDensity", output);
  // Without recovery there are no nodal stresses, and no estimate that needs them.
  if (!solution.stress.empty())
  {
    ExportPointStress(model, solution.stress, output);
    ExportCellValues(model, solution.errorEstimate, "ErrorEstimate", output);
  }
}

/**
 * Under the name that is looked for by default: the output can be the input of another run.
 */
void ExportTemperature(const std::vector<double>& temperature, vtkUnstructuredGrid* output)
{
  vtkDoubleArray* array = AddArray(
    output->GetPointData(), DefaultName(TemperatureArray), 1, output->GetNumberOfPoints(), 0.0);
  for (std::size_t p = 0; p < temperature.size(); ++p)
  {
    array->SetValue(static_cast<vtkIdType>(p), temperature[p]);
  }
}

void ExportFigures(const Outcome& outcome, vtkUnstructuredGrid* output)
{
  // No times: the same input must give the same output, bit for bit.
  AddFigure<vtkIdTypeArray>(output, "NumberOfUnknowns", outcome.NumberOfUnknowns);
  AddFigure<vtkIdTypeArray>(
    output, "NumberOfSolverIterations", static_cast<vtkIdType>(outcome.Solver.iterations));
  AddFigure<vtkDoubleArray>(output, "RelativeResidual", outcome.Solver.relativeResidual);
  AddFigure<vtkDoubleArray>(output, "StrainEnergy", outcome.StrainEnergy);
  AddFigure<vtkDoubleArray>(output, "TotalErrorEstimate", outcome.ErrorEstimate);
  AddFigure<vtkDoubleArray>(output, "RelativeErrorEstimate", outcome.RelativeErrorEstimate);
}

void ExportHistory(const std::vector<double>& history, vtkTable* table)
{
  vtkNew<vtkIdTypeArray> iteration;
  iteration->SetName("Iteration");
  vtkNew<vtkDoubleArray> residual;
  residual->SetName("RelativeResidual");
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    // Row 0 is the residual before the first step.
    iteration->InsertNextValue(static_cast<vtkIdType>(i));
    residual->InsertNextValue(history[i]);
  }
  table->AddColumn(iteration);
  table->AddColumn(residual);
}

template void ExportSolution<2>(const Model<2>&, const Solution<2>&, vtkUnstructuredGrid*);
template void ExportSolution<3>(const Model<3>&, const Solution<3>&, vtkUnstructuredGrid*);

} // namespace vtkThermoelasticBridge
