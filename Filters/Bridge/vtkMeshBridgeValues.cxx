// SPDX-License-Identifier: BSD-3-Clause
// Values at points and cells in the core's form: regions as 32-bit numbers, sizes, and tensors in
// the core's coordinates. What is unusable becomes NaN, and whoever uses it says where.
#include "vtkMeshBridgeValues.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkMeshBridge
{

using meshopt::Index;
using meshopt::Tensor;

namespace
{

/// Components that should be equal may differ by this fraction of the largest component.
constexpr double Skew = 1e-6;

bool FitsIntoIndex(const std::vector<long long>& values)
{
  const auto range = std::minmax_element(values.begin(), values.end());
  return values.empty() ||
    (*range.first >= std::numeric_limits<Index>::min() &&
      *range.second <= std::numeric_limits<Index>::max());
}

/**
 * The values of the simplices alone; none if there is no array.
 */
std::vector<long long> ReadSimplices(vtkDataArray* array, const Cells& cells)
{
  std::vector<long long> values;
  if (array)
  {
    const std::vector<long long> all = ReadIntegers(array);
    values.reserve(cells.Simplices.size());
    for (vtkIdType cell : cells.Simplices)
    {
      values.push_back(all[cell]);
    }
  }
  return values;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<long long> ReadIntegers(vtkDataArray* array)
{
  const vtkIdType n = array->GetNumberOfTuples();
  std::vector<long long> values(static_cast<std::size_t>(n));
  // 64-bit integers are read as such: a double has 53 bits.
  auto wide = vtkAOSDataArrayTemplate<vtkTypeInt64>::SafeDownCast(array);
  // A double represents all values of the smaller types exactly.
  const bool isSmall = array->GetDataTypeSize() < 8;
  for (vtkIdType i = 0; i < n; ++i)
  {
    values[i] = wide ? static_cast<long long>(wide->GetValue(i))
      : isSmall      ? static_cast<long long>(array->GetComponent(i, 0))
                     : array->GetVariantValue(i).ToLongLong();
  }
  return values;
}

std::vector<long long> FindDistinct(std::vector<long long> values)
{
  values.erase(
    std::unique(values.begin(), values.end()), values.end()); // equal values often lie together
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

int FindRank(const std::vector<long long>& distinct, long long value)
{
  return static_cast<int>(
    std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin());
}

std::vector<Index> ReadRegions(vtkDataArray* array, const Cells& cells)
{
  const std::vector<long long> values = ReadSimplices(array, cells);
  if (FitsIntoIndex(values))
  {
    // The usual case: numbers stay as they are, and so they do in messages.
    return std::vector<Index>(values.begin(), values.end());
  }
  // Numbers that do not fit become their ranks: the core only compares regions.
  const std::vector<long long> distinct = FindDistinct(values);
  std::vector<Index> regions(values.size());
  std::transform(values.begin(), values.end(), regions.begin(),
    [&](long long value) { return FindRank(distinct, value); });
  return regions;
}

std::vector<long long> FindReplacedRegions(vtkDataArray* array, const Cells& cells)
{
  const std::vector<long long> values = ReadSimplices(array, cells);
  return FitsIntoIndex(values) ? std::vector<long long>() : FindDistinct(values);
}

//------------------------------------------------------------------------------
std::vector<double> ReadSizes(vtkDataArray* array)
{
  std::vector<double> sizes(array ? array->GetNumberOfTuples() : 0);
  for (std::size_t p = 0; p < sizes.size(); ++p)
  {
    sizes[p] = array->GetComponent(static_cast<vtkIdType>(p), 0);
  }
  return sizes;
}

double LogOfSize(double size)
{
  return size > 0.0 && std::isfinite(size) ? std::log(size)
                                           : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
template <int D>
Tensor<D> ReadTensor(vtkDataArray* array, vtkIdType point, const Frame<D>& frame)
{
  double t[9];
  array->GetTuple(point, t);
  Tensor<3> m;
  if (array->GetNumberOfComponents() == 6)
  {
    // VTK's order of six: XX YY ZZ XY YZ XZ.
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    return frame.ToCore(m); // in 2D NaN and infinity anywhere make NaN; in 3D they stay
  }
  m << t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8];
  const Tensor<3> difference = m - m.transpose();
  if (difference.cwiseAbs().maxCoeff() > Skew * m.cwiseAbs().maxCoeff())
  {
    // Not symmetric: NaN makes whoever checks the tensors name the point.
    return Tensor<D>::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  // Rounding is shared out to both sides.
  const Tensor<3> symmetric = 0.5 * (m + m.transpose());
  return frame.ToCore(symmetric);
}

template <int D>
std::vector<Tensor<D>> ReadTensors(vtkDataArray* array, const Frame<D>& frame)
{
  std::vector<Tensor<D>> tensors(array ? array->GetNumberOfTuples() : 0);
  for (std::size_t p = 0; p < tensors.size(); ++p)
  {
    tensors[p] = ReadTensor(array, static_cast<vtkIdType>(p), frame);
  }
  return tensors;
}

template Tensor<2> ReadTensor<2>(vtkDataArray*, vtkIdType, const Frame<2>&);
template Tensor<3> ReadTensor<3>(vtkDataArray*, vtkIdType, const Frame<3>&);
template std::vector<Tensor<2>> ReadTensors<2>(vtkDataArray*, const Frame<2>&);
template std::vector<Tensor<3>> ReadTensors<3>(vtkDataArray*, const Frame<3>&);

} // namespace vtkMeshBridge
