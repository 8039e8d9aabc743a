// SPDX-License-Identifier: BSD-3-Clause
// Data of points and cells. Floating values are interpolated, all others are taken from the nearest
// point: a mean of two ids is no id.
#include "Grid/vtkMeshOptimizeTransfer.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeTuples.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace vtkMeshOptimizeBridge
{
namespace
{

bool IsFloating(vtkAbstractArray* array)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  return numbers && !vtkMeshBridge::HoldsIntegers(numbers);
}

bool IsNamed(vtkAbstractArray* array, const char* name)
{
  return array->GetName() && std::strcmp(array->GetName(), name) == 0;
}

/**
 * v = v0 + sum w_i (v_i - v0), with v0 the value of the greatest weight: constants are exact.
 */
double Interpolate(vtkDataArray* source, int component, const Sample& sample)
{
  const std::size_t base = std::max_element(sample.Weights.begin(), sample.Weights.end()) -
    sample.Weights.begin();
  const double v0 = source->GetComponent(sample.Corners[base], component);
  double value = v0;
  for (std::size_t i = 0; i < sample.Corners.size(); ++i)
  {
    if (i != base && sample.Weights[i] != 0.0) // a NaN with weight 0 must not spread
    {
      value += sample.Weights[i] * (source->GetComponent(sample.Corners[i], component) - v0);
    }
  }
  return value;
}

/**
 * Sets the new tuples [first, end) to one value: they are not copies of any tuple.
 */
void FillNew(vtkAbstractArray* abstract, vtkIdType first, double value)
{
  vtkDataArray* array = vtkDataArray::SafeDownCast(abstract);
  for (vtkIdType i = first; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      array->SetComponent(i, component, value);
    }
  }
}

/**
 * Adds `array`, behind all others also if one of them has its name, and makes it the active
 * scalars, vectors, ... if array `index` of the input is that. Except for the active global ids:
 * these must be unique over all blocks and processes, and new points and cells have none.
 */
void AddArray(
  vtkDataSetAttributes* input, int index, vtkAbstractArray* array, vtkDataSetAttributes* output)
{
  const int place = vtkMeshBridge::AddBesideOthers(array, output);
  const int attribute = input->IsArrayAnAttribute(index);
  if (attribute >= 0 && attribute != vtkDataSetAttributes::GLOBALIDS)
  {
    output->SetActiveAttribute(place, attribute);
  }
}

/**
 * For each output point, an input point whose data it takes: itself if it has not moved, otherwise
 * the nearest one.
 */
void ListSources(const OutputMap& map, const std::vector<Sample>& samples, bool movedKeepTheirOwn,
  vtkIdList* sources)
{
  sources->SetNumberOfIds(static_cast<vtkIdType>(map.PointToSlot.size()));
  // What has not moved is copied tuple by tuple, bit for bit, whatever its type.
  for (vtkIdType id = 0; id < map.NumberOfOldPoints; ++id)
  {
    sources->SetId(id, map.PointToSlot[id]);
  }
  // New points without a sample get the value of new ones afterwards, whatever is copied here.
  std::fill(sources->begin() + map.NumberOfOldPoints, sources->end(), 0);
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const vtkIdType id = map.SampledPoints[k];
    if (!movedKeepTheirOwn || id >= map.NumberOfOldPoints)
    {
      sources->SetId(id, samples[k].Nearest);
    }
  }
}

} // namespace

/**
 * Ids belong to a point, values to its place: a point that has moved keeps the first and gets
 * others of the second. (vtkDataSetAttributes::CopyData() drops global ids or makes them active
 * again, and points need more than copies.)
 */
void TransferPointData(vtkDataSetAttributes* input, const OutputMap& map,
  const std::vector<Sample>& samples, vtkDataSetAttributes* output)
{
  vtkNew<vtkIdList> byPlace, byIdentity;
  ListSources(map, samples, false, byPlace);
  ListSources(map, samples, true, byIdentity);
  for (int i = 0; i < input->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* source = input->GetAbstractArray(i);
    const bool isIdentity = vtkMeshBridge::HoldsIds(input, i);
    vtkSmartPointer<vtkAbstractArray> array = vtkMeshBridge::Select(
      source, isIdentity ? byIdentity : byPlace);
    if (IsFloating(source) && !isIdentity)
    {
      for (std::size_t k = 0; k < samples.size(); ++k)
      {
        SetSample(vtkDataArray::SafeDownCast(source), samples[k], vtkDataArray::SafeDownCast(array),
          map.SampledPoints[k]);
      }
    }
    if (input->IsArrayAnAttribute(i) == vtkDataSetAttributes::GLOBALIDS)
    {
      FillNew(array, map.NumberOfOldPoints, -1.0);
    }
    if (IsNamed(source, vtkDataSetAttributes::GhostArrayName()))
    {
      // A new point is no ghost, whatever it was made from.
      FillNew(array, map.NumberOfOldPoints, 0.0);
    }
    AddArray(input, i, array, output);
  }
}

void SetSample(vtkDataArray* source, const Sample& sample, vtkDataArray* array, vtkIdType id)
{
  if (!IsFloating(source))
  {
    array->SetTuple(id, sample.Nearest, source);
    return;
  }
  for (int i = 0; i < source->GetNumberOfComponents(); ++i)
  {
    array->SetComponent(id, i, Interpolate(source, i, sample));
  }
}

void TransferCellData(
  vtkDataSetAttributes* input, const OutputMap& map, vtkDataSetAttributes* output)
{
  vtkNew<vtkIdList> sources;
  sources->SetNumberOfIds(static_cast<vtkIdType>(map.CellToSource.size()));
  std::copy(map.CellToSource.begin(), map.CellToSource.end(), sources->begin());
  for (int i = 0; i < input->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* source = input->GetAbstractArray(i);
    // Those of the input's cells, which are others; the filter adds new ones.
    if (vtkMeshBridge::IsOfEarlierRun(source))
    {
      continue;
    }
    vtkSmartPointer<vtkAbstractArray> array = vtkMeshBridge::Select(source, sources);
    if (input->IsArrayAnAttribute(i) == vtkDataSetAttributes::GLOBALIDS)
    {
      FillNew(array, map.NumberOfOldCells, -1.0);
    }
    AddArray(input, i, array, output);
  }
}

} // namespace vtkMeshOptimizeBridge
