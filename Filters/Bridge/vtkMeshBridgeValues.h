// SPDX-License-Identifier: BSD-3-Clause
/**
 * The meaning of values in input arrays: regions, sizes, tensors.
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
 * All values of an array of integers, exactly: as doubles, large ones could not be told apart.
 */
std::vector<long long> ReadIntegers(vtkDataArray* array);

/**
 * The distinct values, ascending.
 */
std::vector<long long> FindDistinct(std::vector<long long> values);

/**
 * The position of `value` in the result of FindDistinct(), which must contain it.
 */
int FindRank(const std::vector<long long>& distinct, long long value);

/**
 * Region of each simplex; empty without an array. If some numbers do not fit into the core's 32
 * bits, all are replaced by their ranks.
 */
std::vector<meshopt::Index> ReadRegions(vtkDataArray* array, const Cells& cells);

/**
 * The numbers, in ascending order, if ReadRegions() has replaced them by their ranks; else none.
 */
std::vector<long long> FindReplacedRegions(vtkDataArray* array, const Cells& cells);

/**
 * Sizes at all points; empty without an array.
 */
std::vector<double> ReadSizes(vtkDataArray* array);

/**
 * ln h*; NaN if h* is not positive or not finite.
 */
double LogOfSize(double size);

/**
 * The tensor at a point, in the frame; for triangles its part in their plane. Of 9 components the
 * symmetric part is used, since single precision and previous computations leave tensors symmetric
 * only to 1e-6. A tensor that is less symmetric, or not finite, is no metric: the result is then
 * not finite, so that the check of the values reports its point.
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
