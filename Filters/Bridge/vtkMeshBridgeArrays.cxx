// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace vtkMeshOptimizeBridge
{
namespace
{

struct ArrayRole
{
  const char* Noun;
  bool OnCells;
  bool IsInteger;
  bool IsTensor;
};

constexpr ArrayRole Roles[NumberOfInputArrays] = {
  { "region array", true, true, false },
  { "fixed point array", false, false, false },
  { "size array", false, false, false },
  { "metric array", false, false, true },
  { "corner array", false, false, false },
};

std::string Title(const ArrayRole& role, vtkAbstractArray* array)
{
  const char* name = array->GetName();
  return std::string("The ") + role.Noun + " '" + (name ? name : "(no name)") + "'";
}

bool IsInteger(vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

std::string CheckArray(const ArrayRole& role, vtkAbstractArray* found)
{
  vtkDataArray* array = vtkDataArray::SafeDownCast(found);
  if (!array || (role.IsInteger && !IsInteger(array)))
  {
    return Title(role, found) + " has values of type " + found->GetDataTypeAsString() + "; " +
      (role.IsInteger ? "integers are needed." : "numbers are needed.");
  }
  const int n = array->GetNumberOfComponents();
  if (role.IsTensor ? n != 6 && n != 9 : n != 1)
  {
    return Title(role, found) + " has " + std::to_string(n) + " components; " +
      (role.IsTensor ? "6 (XX YY ZZ XY YZ XZ) or 9 are needed." : "one is needed.");
  }
  return {};
}

vtkAbstractArray* FindArray(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, int index)
{
  vtkDataSetAttributes* attributes = grid->GetPointData();
  if (Roles[index].OnCells)
  {
    attributes = grid->GetCellData();
  }
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    return attributes->GetAbstractArray(wanted->Get(vtkDataObject::FIELD_NAME()));
  }
  return attributes->GetAbstractAttribute(wanted->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
}

double SymmetricPart(const double* t, int i, int j) { return 0.5 * (t[3 * i + j] + t[3 * j + i]); }

/**
 * A tensor of 9 components that is not symmetric is no metric: it is made unusable here (NaN), so
 * that the check of the values names its point.
 */
meshopt::Tensor<3> MakeTensor(const double* t, int numberOfComponents)
{
  meshopt::Tensor<3> m;
  if (numberOfComponents == 6)
  {
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    return m;
  }
  double largest = 0.0, skew = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      m(i, j) = SymmetricPart(t, i, j);
      largest = std::max(largest, std::abs(t[3 * i + j]));
      skew = std::max(skew, std::abs(t[3 * i + j] - t[3 * j + i]));
    }
  }
  if (skew > 1e-6 * largest)
  {
    m.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return m;
}

} // namespace

bool IsWanted(vtkAlgorithm* filter, int index)
{
  vtkInformation* wanted = filter->GetInputArrayInformation(index);
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
    return name && *name && std::strcmp(name, "None") != 0;
  }
  return wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()) != 0;
}

std::string FindInputArrays(vtkAlgorithm* filter, vtkUnstructuredGrid* grid, InputArrays& arrays)
{
  vtkDataArray** targets[NumberOfInputArrays] = { &arrays.Region, &arrays.FixedPoints, &arrays.Size,
    &arrays.Metric, &arrays.Corners };
  arrays = InputArrays();
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    vtkAbstractArray* found = IsWanted(filter, i) ? FindArray(filter, grid, i) : nullptr;
    if (found)
    {
      const std::string error = CheckArray(Roles[i], found);
      if (!error.empty())
      {
        return error;
      }
      *targets[i] = vtkDataArray::SafeDownCast(found);
    }
  }
  return {};
}

std::string CheckArraysAreThere(
  vtkAlgorithm* filter, const std::vector<vtkUnstructuredGrid*>& grids, int elsewhere)
{
  for (int i = 0; i < NumberOfInputArrays; ++i)
  {
    bool isThere = i == elsewhere, hasCells = false;
    for (vtkUnstructuredGrid* grid : grids)
    {
      hasCells |= grid->GetNumberOfCells() > 0;
      isThere |= IsWanted(filter, i) && FindArray(filter, grid, i) != nullptr;
    }
    if (IsWanted(filter, i) && hasCells && !isThere)
    {
      const char* name = filter->GetInputArrayInformation(i)->Get(vtkDataObject::FIELD_NAME());
      return std::string("The ") + Roles[i].Noun + (name ? " '" + std::string(name) + "'" : "") +
        " is not there: the input has no such " + (Roles[i].OnCells ? "cell" : "point") + " array.";
    }
  }
  return {};
}

std::vector<meshopt::Index> ReadRegions(vtkDataArray* array, const Cells& cells)
{
  using meshopt::Index;
  if (!array)
  {
    return {};
  }
  // Doubles hold every value of the smaller types; the 64-bit ones take the slow road.
  const bool isSmall = array->GetDataTypeSize() < 8;
  std::vector<long long> values;
  values.reserve(cells.Simplices.size());
  for (vtkIdType cell : cells.Simplices)
  {
    values.push_back(isSmall ? static_cast<long long>(array->GetComponent(cell, 0))
                             : array->GetVariantValue(cell).ToLongLong());
  }
  std::vector<Index> regions(values.size());
  const auto range = std::minmax_element(values.begin(), values.end());
  if (values.empty() ||
    (*range.first >= std::numeric_limits<Index>::min() &&
      *range.second <= std::numeric_limits<Index>::max()))
  {
    std::copy(values.begin(), values.end(), regions.begin());
    return regions;
  }
  std::vector<long long> distinct(values);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::transform(values.begin(), values.end(), regions.begin(),
    [&](long long value)
    {
      return static_cast<Index>(
        std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin());
    });
  return regions;
}

std::vector<double> ReadSizes(vtkDataArray* array, const Cells& cells)
{
  std::vector<double> sizes;
  if (array)
  {
    sizes.assign(cells.PointUse.size(), 1.0);
    for (std::size_t p = 0; p < sizes.size(); ++p)
    {
      if (cells.PointUse[p] & UsedBySimplex)
      {
        sizes[p] = array->GetComponent(static_cast<vtkIdType>(p), 0);
      }
    }
  }
  return sizes;
}

template <int D>
std::vector<meshopt::Tensor<D>> ReadMetric(
  vtkDataArray* array, const Cells& cells, const Frame<D>& frame)
{
  std::vector<meshopt::Tensor<D>> tensors;
  if (array)
  {
    tensors.assign(cells.PointUse.size(), meshopt::Tensor<D>::Identity());
    for (std::size_t p = 0; p < tensors.size(); ++p)
    {
      if (cells.PointUse[p] & UsedBySimplex)
      {
        double t[9];
        array->GetTuple(static_cast<vtkIdType>(p), t);
        tensors[p] = frame.ToCore(MakeTensor(t, array->GetNumberOfComponents()));
      }
    }
  }
  return tensors;
}

template std::vector<meshopt::Tensor<2>> ReadMetric<2>(
  vtkDataArray*, const Cells&, const Frame<2>&);
template std::vector<meshopt::Tensor<3>> ReadMetric<3>(
  vtkDataArray*, const Cells&, const Frame<3>&);

} // namespace vtkMeshOptimizeBridge
