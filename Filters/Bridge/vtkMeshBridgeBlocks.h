// SPDX-License-Identifier: BSD-3-Clause
/**
 * Composite data as input of a filter that works on grids. The filter gets the whole tree, not one
 * block after another from the executive: on many ranks those calls differ in number, and a rank
 * that waits for the others in one of them would wait for ever.
 */
#ifndef vtkMeshBridgeBlocks_h
#define vtkMeshBridgeBlocks_h

#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkDataObjectTree;
class vtkInformation;
class vtkInformationVector;

namespace vtkMeshBridge
{

struct Block
{
  vtkUnstructuredGrid* Input;
  vtkSmartPointer<vtkUnstructuredGrid> Output;
  int Index; ///< flat index in the tree; 0 for a grid
};

/**
 * What an output is after an error. VTK's writer of binary files ends the process at a grid that
 * has no array of cell types, as Initialize() alone leaves it.
 */
void MakeEmpty(vtkDataObject* output);

/**
 * For FillInputPortInformation(): a grid, or a tree of grids.
 */
void AcceptBlocks(vtkInformation* info);

/**
 * For RequestDataObject(): the output of port 0 is of the class of the input.
 */
void MakeOutputLikeInput(vtkInformationVector** input, vtkInformationVector* output);

/**
 * What becomes of leaves that are no grids: they are left out, with a warning of the filter each,
 * or passed on unchanged.
 */
enum class OtherLeaves
{
  Skip,
  Pass
};

/**
 * The grids of `input` with new outputs, which are already leaves of `output`.
 */
std::vector<Block> ListBlocks(vtkAlgorithm* filter, vtkDataObject* input, vtkDataObject* output,
  OtherLeaves others = OtherLeaves::Skip);

/**
 * The leaves of a tree that are grids or nothing yet, by flat index.
 */
std::vector<int> ListPlaces(vtkDataObjectTree* tree);

void SetLeaf(vtkDataObjectTree* tree, int index, vtkDataObject* object);

/**
 * Whether the executive has asked all processes for their pieces of one mesh. Then, and only then,
 * all are here and may wait for each other.
 */
bool AsksForPieces(vtkInformation* outInfo, int processes);

/**
 * "Block 3: " for a block of a tree, empty for a grid.
 */
std::string TitleOf(vtkDataObject* input, const Block& block);

} // namespace vtkMeshBridge

#endif
