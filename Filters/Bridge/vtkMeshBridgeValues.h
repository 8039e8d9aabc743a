// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the values of input arrays mean: regions, sizes, tensors.
 */
#ifndef vtkMeshBridgeValues_h
#define vtkMeshBridgeValues_h

#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"

#include "Mesh/Types.h"

#include <vector>

class vtkDataArray;

namespace vtkMeshBridge
{

/**
 * All values of an array of integers, exactly: a double would not tell large ones apart.
 */
std::vector<long long> ReadIntegers(vtkDataArray* array);

/**
 * The values that occur, ascending.
 */
std::vector<long long> FindDistinct(std::vector<long long> values);

/**
 * Place of `value` among those of FindDistinct(), which has it.
 */
int FindRank(const std::vector<long long>& distinct, long long value);

/**
 * Region of each simplex; empty without an array. Numbers that do not fit into the core's 32 bits
 * are replaced by their ranks.
 */
std::vector<meshopt::Index> ReadRegions(vtkDataArray* array, const Cells& cells);

/**
 * Sizes at all points; empty without an array.
 */
std::vector<double> ReadSizes(vtkDataArray* array);

/**
 * ln h*; NaN if h* is no size: not positive, or not finite.
 */
double LogOfSize(double size);

/**
 * The tensor at a point, in the frame: of triangles its part in their plane. Of 9 components the
 * symmetric part counts: single precision, and whatever computed them, leave them symmetric to 1e-6
 * only. What is less symmetric than that, or not finite, is no metric: it has NaN in it, so that
 * the check of the values names its point.
 */
template <int D>
meshopt::Tensor<D> ReadTensor(vtkDataArray* array, vtkIdType point, const Frame<D>& frame);

/**
 * The same at all points; empty without an array.
 */
template <int D>
std::vector<meshopt::Tensor<D>> ReadTensors(vtkDataArray* array, const Frame<D>& frame);

} // namespace vtkMeshBridge

#endif
