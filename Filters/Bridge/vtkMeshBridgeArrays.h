// SPDX-License-Identifier: BSD-3-Clause
/**
 * Input arrays that the caller of a filter chooses by vtkAlgorithm::SetInputArrayToProcess():
 * found, and checked for type and number of components. Errors are sentences for the user.
 */
#ifndef vtkMeshBridgeArrays_h
#define vtkMeshBridgeArrays_h

#include <array>
#include <string>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace vtkMeshBridge
{

/**
 * What an array is for, and what it must look like.
 */
struct ArrayRole
{
  const char* Noun;              ///< "size array"
  const char* DefaultName;       ///< looked for if none is chosen; nullptr: none then
  bool OnCells;                  ///< else on points
  bool IsInteger;                ///< else any number
  std::array<int, 2> Components; ///< one or the other; 0: no other; { 0, 0 }: any
};

/**
 * Did the caller of `filter` ask for the array of this index? ParaView's "None" counts as no.
 */
bool IsWanted(vtkAlgorithm* filter, int index);

/**
 * The array of this index that the caller of `filter` wants, or the default one; nullptr if it is
 * not there.
 */
vtkAbstractArray* FindArray(
  vtkAlgorithm* filter, vtkUnstructuredGrid* grid, int index, const ArrayRole& role);

/**
 * A sentence if `array` cannot be used as what it is for.
 */
std::string CheckArray(vtkAbstractArray* array, const ArrayRole& role);

/**
 * The sentence about an array that is wanted and not there. `name` may be nullptr.
 */
std::string DescribeMissing(const char* name, const ArrayRole& role);

} // namespace vtkMeshBridge

#endif
