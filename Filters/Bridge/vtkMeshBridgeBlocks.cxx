// SPDX-License-Identifier: BSD-3-Clause
// The grids of a tree, and their outputs in a tree of the same class.
#include "vtkMeshBridgeBlocks.h"

#include "vtkAlgorithm.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace vtkMeshBridge
{

void AcceptBlocks(vtkInformation* info)
{
  // The tree is named, too: the executive would otherwise call the filter block by block.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
}

void MakeOutputLikeInput(vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector, 0);
  // Without an input the executive reports one error later; a second one would only confuse.
  const char* type = input ? input->GetClassName() : "vtkUnstructuredGrid";
  // An output that fits stays: others may hold it already.
  if (!output || !output->IsA(type))
  {
    vtkSmartPointer<vtkDataObject> fresh = input
      ? vtkSmartPointer<vtkDataObject>::Take(input->NewInstance())
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkUnstructuredGrid>::New());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
}

std::vector<Block> ListBlocks(
  vtkAlgorithm* filter, vtkDataObject* input, vtkDataObject* output, OtherLeaves others)
{
  std::vector<Block> blocks;
  if (auto grid = vtkUnstructuredGrid::SafeDownCast(input))
  {
    blocks.push_back({ grid, vtkUnstructuredGrid::SafeDownCast(output), 0 });
    return blocks;
  }
  auto tree = vtkDataObjectTree::SafeDownCast(input);
  auto copy = vtkDataObjectTree::SafeDownCast(output);
  // The same tree with leaves of its own: those of the input must not change.
  // Field data are no part of the structure.
  copy->CopyStructure(tree);
  copy->GetFieldData()->DeepCopy(tree->GetFieldData());
  // This iterator skips empty leaves. They stay empty in the output, like those that are skipped
  // with a warning: the places of all others remain what they were.
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* object = leaf->GetCurrentDataObject();
    auto grid = vtkUnstructuredGrid::SafeDownCast(object);
    if (!grid && others == OtherLeaves::Skip)
    {
      vtkWarningWithObjectMacro(filter, << "A block of type " << object->GetClassName()
                                        << " was skipped: it is not a vtkUnstructuredGrid.");
      continue;
    }
    auto fresh = vtkSmartPointer<vtkDataObject>::Take(object->NewInstance());
    copy->SetDataSet(leaf, fresh);
    if (grid)
    {
      blocks.push_back({ grid, vtkUnstructuredGrid::SafeDownCast(fresh),
        static_cast<int>(leaf->GetCurrentFlatIndex()) });
    }
    else
    {
      fresh->ShallowCopy(object);
    }
  }
  return blocks;
}

std::vector<int> ListPlaces(vtkDataObjectTree* tree)
{
  std::vector<int> places;
  auto leaf = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  // Also empty leaves: another rank may have a grid there.
  leaf->SkipEmptyNodesOff();
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* object = leaf->GetCurrentDataObject();
    if (!object || vtkUnstructuredGrid::SafeDownCast(object))
    {
      places.push_back(static_cast<int>(leaf->GetCurrentFlatIndex()));
    }
  }
  return places;
}

void SetLeaf(vtkDataObjectTree* tree, int index, vtkDataObject* object)
{
  auto leaf = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  // The leaf to be set may be empty on this rank.
  leaf->SkipEmptyNodesOff();
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    if (static_cast<int>(leaf->GetCurrentFlatIndex()) == index)
    {
      tree->SetDataSet(leaf, object);
      return;
    }
  }
}

bool AsksForPieces(vtkInformation* outInfo, int processes)
{
  // Update() on one process asks for a single piece: to wait for the others would be for ever.
  const auto pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return processes > 1 && outInfo->Has(pieces) && outInfo->Get(pieces) == processes;
}

std::string TitleOf(vtkDataObject* input, const Block& block)
{
  return vtkDataObjectTree::SafeDownCast(input) ? "Block " + std::to_string(block.Index) + ": "
                                                : std::string();
}

void MakeEmpty(vtkDataObject* output)
{
  output->Initialize();
  if (auto grid = vtkUnstructuredGrid::SafeDownCast(output))
  {
    grid->AllocateExact(0, 0);
  }
}

} // namespace vtkMeshBridge
