// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of vtkThermoelasticFilter share.
 */
#ifndef ThermoelasticFilterTesting_h
#define ThermoelasticFilterTesting_h

#include "MeshOptimizeFilterTesting.h"

#include "vtkThermoelasticFilter.h"

namespace Testing
{

using Filter = vtkSmartPointer<vtkThermoelasticFilter>;

/**
 * Adds an array whose values are function(point) or function(centre of the cell).
 */
template <class Array = vtkDoubleArray>
void AddArray(vtkUnstructuredGrid* grid, bool onCells, const char* name, int components,
  const std::function<Point(const Point&)>& function)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const vtkIdType n = onCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
  for (vtkIdType i = 0; i < n; ++i)
  {
    Point x{ { 0.0, 0.0, 0.0 } };
    const std::vector<vtkIdType> ids = onCells ? CellPoints(grid, i) : std::vector<vtkIdType>{ i };
    for (vtkIdType p : ids)
    {
      for (int k = 0; k < 3; ++k)
      {
        x[k] += GetPoint(grid, p)[k] / static_cast<double>(ids.size());
      }
    }
    const Point value = function(x);
    for (int k = 0; k < components; ++k)
    {
      array->InsertNextValue(static_cast<typename Array::ValueType>(value[k]));
    }
  }
  vtkDataSetAttributes* attributes = grid->GetPointData();
  if (onCells)
  {
    attributes = grid->GetCellData();
  }
  attributes->AddArray(array);
}

/**
 * Without temperature; E = 1, nu = 0.25.
 */
inline Filter MakeFilter(vtkUnstructuredGrid* grid)
{
  Filter filter = Filter::New();
  filter->SetInputData(grid);
  filter->SetTemperatureModeToUniform();
  filter->SetYoungsModulus(1.0);
  filter->SetPoissonsRatio(0.25);
  filter->SetThermalExpansion(1e-2);
  filter->SetTolerance(1e-13);
  return filter;
}

inline vtkDataArray* PointArray(vtkThermoelasticFilter* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutput(0)->GetPointData()->GetArray(name);
  if (!array)
  {
    std::cerr << "no point array " << name << "\n";
    ++Failures;
    std::exit(EXIT_FAILURE);
  }
  return array;
}

inline vtkDataArray* CellArray(vtkThermoelasticFilter* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutput(0)->GetCellData()->GetArray(name);
  if (!array)
  {
    std::cerr << "no cell array " << name << "\n";
    ++Failures;
    std::exit(EXIT_FAILURE);
  }
  return array;
}

/**
 * Every tuple that is not NaN is `expected`, to `tolerance`; and there is one.
 */
inline bool IsUniform(
  vtkDataArray* array, const std::vector<double>& expected, double tolerance = 1e-10)
{
  bool same = array->GetNumberOfComponents() == static_cast<int>(expected.size());
  bool any = false;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples() && same; ++i)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const double value = array->GetComponent(i, k);
      any |= !std::isnan(value);
      same = same && !(std::abs(value - expected[k]) > tolerance);
    }
  }
  return same && any;
}

inline Filter Run(Filter filter)
{
  Messages messages(filter);
  filter->Update();
  for (const std::string& text : messages.Errors)
  {
    std::cerr << text << "\n";
  }
  for (const std::string& text : messages.Warnings)
  {
    std::cerr << text << "\n";
  }
  CHECK(messages.Errors.empty() && messages.Warnings.empty());
  CHECK(filter->GetErrorCode() == 0);
  CHECK(filter->GetStopReason() == vtkThermoelasticFilter::Converged);
  return filter;
}

} // namespace Testing

#endif
