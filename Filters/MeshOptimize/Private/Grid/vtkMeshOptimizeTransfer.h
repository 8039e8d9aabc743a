// SPDX-License-Identifier: BSD-3-Clause
/**
 * Data arrays of the output: point data interpolated, cell data from the parent, field data kept.
 */
#ifndef vtkMeshOptimizeTransfer_h
#define vtkMeshOptimizeTransfer_h

#include "Grid/vtkMeshOptimizeSampling.h"

#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;

namespace vtkMeshOptimizeBridge
{

/**
 * Point data of the output. `samples` belong to map.SampledPoints.
 */
void TransferPointData(vtkDataSetAttributes* input, const OutputMap& map,
  const std::vector<Sample>& samples, vtkDataSetAttributes* output);

/**
 * Sets tuple `id` of `array` to the value of `source` at a place: interpolated if floating, else
 * that of the nearest corner.
 */
void SetSample(vtkDataArray* source, const Sample& sample, vtkDataArray* array, vtkIdType id);

/**
 * Cell data of the output, without the array `MeshQuality` of an earlier run.
 */
void TransferCellData(
  vtkDataSetAttributes* input, const OutputMap& map, vtkDataSetAttributes* output);

} // namespace vtkMeshOptimizeBridge

#endif
