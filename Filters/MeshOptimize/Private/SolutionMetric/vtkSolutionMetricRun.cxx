// SPDX-License-Identifier: BSD-3-Clause
// From a solution or an error indicator of a grid to arrays that Mesh Optimize reads.
#include "SolutionMetric/vtkSolutionMetricRun.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"
#include "vtkMeshBridgeImport.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace vtkSolutionMetricBridge
{

namespace bridge = vtkMeshBridge;

using meshopt::SymmetricEigen;
using meshopt::Tensor;
using meshopt::Vec;

//------------------------------------------------------------------------------
namespace
{

constexpr bridge::ArrayRole SolutionRole = { "solution array", nullptr, false, false,
  { { 0, 0 } } };
constexpr bridge::ArrayRole ErrorRole = { "error indicator array", nullptr, true, false,
  { { 1, 0 } } };

/**
 * `name` is the chosen name: nullptr or "" means the active scalars.
 */
std::string DescribeMissing(
  const bridge::ArrayRole& role, const char* name, vtkDataSetAttributes* others)
{
  const std::string kind = role.OnCells ? "cell" : "point", other = role.OnCells ? "point" : "cell";
  const bool isDefault = !name || !*name;
  if (isDefault || std::strcmp(name, "None") == 0)
  {
    return std::string("No ") + role.Noun + " is chosen" +
      (isDefault ? ", and the input has no active " + kind + " scalars." : ".");
  }
  std::string text = bridge::DescribeMissing(name, role);
  // The usual mistake: point and cell data are told apart in VTK, not by their names.
  if (others->HasArray(name))
  {
    text += " There is a " + other + " array of that name; convert it to " + kind + " data first.";
  }
  return text;
}

} // namespace

std::string FindArray(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, Request& request)
{
  const bridge::ArrayRole& role = request.UseErrors ? ErrorRole : SolutionRole;
  vtkDataSetAttributes *attributes = grid->GetPointData(), *others = grid->GetCellData();
  if (role.OnCells)
  {
    std::swap(attributes, others);
  }
  // An empty name, as ParaView gives until one is chosen, means the active scalars.
  vtkInformation* wanted = filter->GetInputArrayInformation(request.UseErrors ? 1 : 0);
  const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
  const int attribute = wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
    ? wanted->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
    : static_cast<int>(vtkDataSetAttributes::SCALARS);
  vtkAbstractArray* found = name && *name ? attributes->GetAbstractArray(name)
                                          : attributes->GetAbstractAttribute(attribute);
  if (grid->GetNumberOfCells() == 0)
  {
    return {}; // a process without a piece: nothing to do
  }
  if (!found)
  {
    return DescribeMissing(role, name, others);
  }
  request.Values = vtkDataArray::SafeDownCast(found);
  return bridge::CheckArray(found, role);
}

//------------------------------------------------------------------------------
namespace
{

std::string ReadSolution(
  vtkDataArray* array, const bridge::Cells& cells, std::vector<double>& values)
{
  const int components = array->GetNumberOfComponents();
  values.assign(cells.PointUse.size() * components, 0.0);
  for (std::size_t p = 0; p < cells.PointUse.size(); ++p)
  {
    double* tuple = &values[p * components];
    // Elsewhere the solution may have any value.
    if (!(cells.PointUse[p] & bridge::UsedBySimplex))
    {
      continue;
    }
    array->GetTuple(static_cast<vtkIdType>(p), tuple);
    for (int i = 0; i < components; ++i)
    {
      if (!std::isfinite(tuple[i]))
      {
        std::ostringstream text;
        text << "The solution '" << (array->GetName() ? array->GetName() : "(no name)")
             << "' is not finite at point " << p << ": " << tuple[i]
             << (components > 1 ? " in component " + std::to_string(i) : std::string()) << ".";
        return text.str();
      }
    }
  }
  return {};
}

/**
 * In the order of the simplices, as the core numbers its cells.
 */
std::string ReadErrors(vtkDataArray* array, const bridge::Cells& cells, std::vector<double>& values)
{
  for (vtkIdType cell : cells.Simplices)
  {
    // Squares of errors are summed: a negative one would not show.
    const double error = array->GetComponent(cell, 0);
    if (!(error >= 0.0) || !std::isfinite(error))
    {
      std::ostringstream text;
      text << "The error indicator '" << (array->GetName() ? array->GetName() : "(no name)")
           << "' of cell " << cell << " is " << error
           << "; it must be a finite number that is not negative.";
      return text.str();
    }
    values.push_back(error);
  }
  return {};
}

/**
 * The solution is known to this precision only: what is smaller is no curvature.
 */
double RelativePrecision(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT
    ? static_cast<double>(std::numeric_limits<float>::epsilon())
    : std::numeric_limits<double>::epsilon();
}

//------------------------------------------------------------------------------
Tensor<3> ToGrid(const Tensor<3>& m, const bridge::Frame<3>&) { return m; }

/**
 * Across the plane it has the geometric mean of the eigenvalues in the plane.
 */
Tensor<3> ToGrid(const Tensor<2>& m, const bridge::Frame<2>& frame)
{
  const Vec<3> u = frame.Axes[0], v = frame.Axes[1];
  const Vec<3> n = u.cross(v);
  // Out of the plane nothing is known. The mean keeps the tensor positive definite and in scale; of
  // the scaled tensor, since the determinant itself may not fit into a double.
  const double scale = m.cwiseAbs().maxCoeff();
  const double mean = scale > 0.0 ? scale * std::sqrt(Tensor<2>(m / scale).determinant()) : 0.0;
  return m(0, 0) * u * u.transpose() + m(1, 1) * v * v.transpose() +
    m(0, 1) * (u * v.transpose() + v * u.transpose()) + mean * n * n.transpose();
}

/**
 * From 1 / length^2 to lengths.
 */
template <int D>
Tensor<D> InverseRoot(const Tensor<D>& m)
{
  SymmetricEigen<D> e = SymmetricEigen<D>::of(m);
  // As lengths, tensors can be drawn as ellipsoids (Tensor Glyph).
  e.values = e.values.cwiseSqrt().cwiseInverse();
  return e.compose();
}

/**
 * A symmetric tensor per point, with VTK's order of components.
 */
template <class F>
vtkSmartPointer<vtkDoubleArray> MakeTensors(const char* name, vtkIdType n, F&& tensor)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(6);
  array->SetNumberOfTuples(n);
  const char* components[6] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
  for (int i = 0; i < 6; ++i)
  {
    array->SetComponentName(i, components[i]);
  }
  for (vtkIdType p = 0; p < n; ++p)
  {
    const Tensor<3> m = tensor(p);
    const double six[6] = { m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2) };
    array->SetTypedTuple(p, six);
  }
  return array;
}

template <class F>
void AddSizes(vtkUnstructuredGrid* grid, F&& size)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("DesiredSize");
  array->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    array->SetValue(p, size(p));
  }
  grid->GetPointData()->AddArray(array);
}

//------------------------------------------------------------------------------
template <int D>
std::string AddMetric(vtkUnstructuredGrid* grid, const bridge::Cells& cells,
  const bridge::Frame<D>& frame, const meshopt::SimplexMesh<D>& mesh, const Request& request,
  Outcome& outcome)
{
  std::vector<double> values;
  std::string error = ReadSolution(request.Values, cells, values);
  if (!error.empty())
  {
    return error;
  }
  meshopt::SolutionMetricOptions options = request.Metric;
  // Floats are less precise than the doubles that they become here: their noise is no curvature.
  options.precision = RelativePrecision(request.Values);
  if (options.desiredCount == 0.0)
  {
    options.desiredCount = static_cast<double>(cells.Simplices.size());
  }
  meshopt::SolutionMetric<D> metric;
  error = meshopt::solutionMetric(
    mesh, values, request.Values->GetNumberOfComponents(), options, metric);
  if (!error.empty())
  {
    return error;
  }
  outcome.DesiredSize = metric.desiredSize;
  outcome.PredictedCount = metric.predictedCount;
  outcome.IsCountReached = metric.isCountReached;
  outcome.IsEven = metric.isLinear;
  // Points that no cell uses get values, too: an array of the grid has one for each.
  const vtkIdType n = grid->GetNumberOfPoints();
  grid->GetPointData()->AddArray(
    MakeTensors("Metric", n, [&](vtkIdType p) { return ToGrid(metric.tensors[p], frame); }));
  // One size for all points: the metric has all that differs.
  AddSizes(grid, [&metric](vtkIdType) { return metric.desiredSize; });
  if (request.ComputeSizeTensor)
  {
    grid->GetPointData()->AddArray(MakeTensors("SizeTensor", n,
      [&](vtkIdType p)
      {
        const Tensor<D> sizes = metric.desiredSize * InverseRoot<D>(metric.tensors[p]);
        return ToGrid(sizes, frame);
      }));
  }
  return {};
}

template <int D>
std::string AddIndicatorSizes(vtkUnstructuredGrid* grid, const bridge::Cells& cells,
  const meshopt::SimplexMesh<D>& mesh, const Request& request, Outcome& outcome)
{
  std::vector<double> errors;
  std::string error = ReadErrors(request.Values, cells, errors);
  if (!error.empty())
  {
    return error;
  }
  meshopt::ErrorIndicatorOptions options = request.Errors;
  if (options.desiredCount == 0.0)
  {
    options.desiredCount = static_cast<double>(cells.Simplices.size());
  }
  meshopt::ErrorIndicatorSizes sizes;
  error = meshopt::sizesFromErrors(mesh, errors, options, sizes);
  if (!error.empty())
  {
    return error;
  }
  outcome.PredictedCount = sizes.predictedCount;
  outcome.IsCountReached = sizes.isCountReached;
  outcome.IsEven = sizes.isZero;
  // Errors of cells are norms: their squares add up.
  double sum = 0.0;
  for (double e : errors)
  {
    sum += e * e;
  }
  outcome.TotalError = std::sqrt(sum);
  AddSizes(grid, [&sizes](vtkIdType p) { return sizes.sizes[p]; });
  return {};
}

template <int D>
std::string AddArraysIn(
  vtkUnstructuredGrid* grid, const bridge::Cells& cells, const Request& request, Outcome& outcome)
{
  bridge::Frame<D> frame;
  std::string error = bridge::FindFrame(grid, cells, frame);
  if (!error.empty())
  {
    return error;
  }
  // Nothing is kept: regions and lines are no boundaries of the solution.
  meshopt::SimplexMesh<D> mesh;
  const auto problem = meshopt::SimplexMesh<D>::build(
    bridge::ImportGeometry(grid, cells.Simplices, frame), mesh);
  if (problem)
  {
    return bridge::WithGridIds(problem->message, problem->cell, cells);
  }
  return request.UseErrors ? AddIndicatorSizes(grid, cells, mesh, request, outcome)
                           : AddMetric(grid, cells, frame, mesh, request, outcome);
}

} // namespace

std::string CheckInput(vtkUnstructuredGrid* grid, const Request& request, bridge::Cells& cells)
{
  std::string error = bridge::ClassifyCells(grid, cells);
  if (error.empty())
  {
    // A function cannot be differentiated across cells that are ignored.
    error = bridge::CheckOnlySimplices(grid, cells);
  }
  if (!error.empty() || cells.Simplices.empty())
  {
    return error;
  }
  std::vector<double> values;
  return request.UseErrors ? ReadErrors(request.Values, cells, values)
                           : ReadSolution(request.Values, cells, values);
}

std::string AddArrays(vtkUnstructuredGrid* grid, const Request& request, Outcome& outcome)
{
  bridge::Cells cells;
  const std::string error = CheckInput(grid, request, cells);
  if (!error.empty() || grid->GetNumberOfCells() == 0 || cells.Dimension == 0)
  {
    return error.empty() && grid->GetNumberOfCells() > 0 ? bridge::NoSimplices : error;
  }
  if (cells.Simplices.empty())
  {
    return {}; // ghosts alone
  }
  return cells.Dimension == 3 ? AddArraysIn<3>(grid, cells, request, outcome)
                              : AddArraysIn<2>(grid, cells, request, outcome);
}

} // namespace vtkSolutionMetricBridge
