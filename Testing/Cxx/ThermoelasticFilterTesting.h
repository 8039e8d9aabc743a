// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of vtkThermoelasticFilter share.
 */
#ifndef ThermoelasticFilterTesting_h
#define ThermoelasticFilterTesting_h

#include "FilterTesting.h"

#include "vtkThermoelasticFilter.h"

#include <stdexcept>

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
    throw std::runtime_error(std::string("no point array ") + name); // the case fails
  }
  return array;
}

inline vtkDataArray* CellArray(vtkThermoelasticFilter* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutput(0)->GetCellData()->GetArray(name);
  if (!array)
  {
    throw std::runtime_error(std::string("no cell array ") + name); // the case fails
  }
  return array;
}

/**
 * Every tuple that is not NaN is `expected`, to `tolerance`; and there is one.
 */
inline testing::AssertionResult IsUniform(
  vtkDataArray* array, const std::vector<double>& expected, double tolerance = 1e-10)
{
  if (array->GetNumberOfComponents() != static_cast<int>(expected.size()))
  {
    return testing::AssertionFailure() << array->GetNumberOfComponents() << " components";
  }
  bool any = false;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const double value = array->GetComponent(i, k);
      any |= !std::isnan(value);
      if (std::abs(value - expected[k]) > tolerance)
      {
        return testing::AssertionFailure() << "component " << k << " of tuple " << i << " is "
                                           << value << " instead of " << expected[k];
      }
    }
  }
  return (any ? testing::AssertionSuccess() : testing::AssertionFailure())
    << "no value is a number";
}

/**
 * Updates it: no message, and it converges.
 */
inline Filter Solve(Filter filter)
{
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  EXPECT_EQ(filter->GetStopReason(), vtkThermoelasticFilter::Converged);
  return filter;
}

} // namespace Testing

#endif
