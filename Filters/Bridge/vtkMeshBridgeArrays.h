// SPDX-License-Identifier: BSD-3-Clause
/**
 * Input arrays that the caller of a filter chooses by vtkAlgorithm::SetInputArrayToProcess():
 * found, and checked for type and number of components. Errors are sentences for the user.
 */
#ifndef vtkMeshBridgeArrays_h
#define vtkMeshBridgeArrays_h

#include "vtkType.h"

#include <array>
#include <string>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkUnstructuredGrid;

namespace vtkMeshBridge
{

/**
 * The role of an array, and the form that it must have.
 */
struct ArrayRole
{
  const char* Noun;              ///< "size array"
  const char* DefaultName;       ///< used if none is chosen; nullptr: no default
  bool OnCells;                  ///< otherwise on points
  bool IsInteger;                ///< otherwise any number
  std::array<int, 2> Components; ///< either number; second 0: only the first; { 0, 0 }: any
};

/**
 * Whether values have no fractions. Characters and bits count as integers, too.
 */
bool HoldsIntegers(vtkDataArray* array);

/**
 * Whether array `i` names points or cells (global or pedigree ids), rather than telling about them.
 */
bool HoldsIds(vtkDataSetAttributes* data, int i);

/**
 * Whether this array of cells is what a run, or vtkMeshQualityMinMax, has added: the qualities of
 * cells that are others now.
 */
bool IsOfEarlierRun(vtkAbstractArray* array);

/**
 * Adds an array also if there is one of its name, which VTK would replace. Returns its index.
 */
int AddBesideOthers(vtkAbstractArray* array, vtkDataSetAttributes* data);

/**
 * Whether the caller of `filter` asked for the array of this index. ParaView's "None" means no.
 */
bool IsWanted(vtkAlgorithm* filter, int index);

/**
 * The array of this index that the caller of `filter` chose, or the default one; nullptr if there
 * is no such array.
 */
vtkAbstractArray* FindArray(
  vtkAlgorithm* filter, vtkUnstructuredGrid* grid, int index, const ArrayRole& role);

/**
 * A sentence if `array` cannot be used in this role; otherwise empty.
 */
std::string CheckArray(vtkAbstractArray* array, const ArrayRole& role);

/**
 * A sentence if `array` does not have one value for each of the `wanted` points or cells; `kind`:
 * "point" or "cell". A broken grid may have such arrays.
 */
std::string CheckLength(vtkAbstractArray* array, vtkIdType wanted, const char* kind);

/**
 * The sentence about a chosen array that does not exist. `name` may be nullptr.
 */
std::string DescribeMissing(const char* name, const ArrayRole& role);

} // namespace vtkMeshBridge

#endif
