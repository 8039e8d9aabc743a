// SPDX-License-Identifier: BSD-3-Clause
// The planes of triangles whose pieces lie on many ranks.
#include "QualityMinMax/vtkMeshQualityRanks.h"

#include "Ranks/vtkMeshRanksPlane.h"
#include "vtkMeshBridgeValues.h"

#include <algorithm>

namespace vtkMeshQualityBridge
{

using namespace vtkMeshRanks;
using vtkMeshBridge::PlaneFacts;

namespace
{

/**
 * A block as all ranks together know it.
 */
struct PlaneBlock
{
  bool HasTetrahedra = false;
  PlaneFacts Facts;
  double Farthest = 0.0;
};

using PlaneBlocks = std::map<unsigned int, PlaneBlock>;

/**
 * Merges what the ranks know, in their order.
 */
PlaneBlocks MergeAll(const Ranks& ranks, const PlaneBlocks& mine)
{
  Bytes bytes;
  for (const auto& [block, one] : mine)
  {
    Put(bytes, block);
    Put(bytes, one.HasTetrahedra);
    Put(bytes, one.Farthest);
    PutFacts(bytes, one.Facts);
  }
  PlaneBlocks all;
  for (const Bytes& theirs : ranks.Gather(bytes))
  {
    for (Reader reader(theirs); !reader.IsAtEnd();)
    {
      PlaneBlock& one = all[reader.Take<unsigned int>()];
      one.HasTetrahedra |= reader.Take<bool>();
      one.Farthest = std::max(one.Farthest, reader.Take<double>());
      one.Facts.Merge(TakeFacts(reader));
    }
  }
  return all;
}

} // namespace

//------------------------------------------------------------------------------
std::map<unsigned int, Planarity> FindPlanes(const Ranks& ranks, const std::vector<Block>& blocks)
{
  // By the flat index of the block, which all ranks know.
  PlaneBlocks mine;
  bool isWanted = false;
  for (const Block& block : blocks)
  {
    const Grid grid(block.Mesh);
    PlaneBlock& one = mine[block.FlatIndex];
    one.HasTetrahedra = grid.HasTetrahedra();
    one.Facts = vtkMeshBridge::FindPlaneFacts(grid.GetView(), grid.ListTriangles(false));
    // Cells that some rank measures; ranks without any take part all the same.
    isWanted = isWanted || !one.Facts.IsEmpty();
  }
  std::map<unsigned int, Planarity> result;
  if (!ranks.IsAny(isWanted)) // no triangles at all
  {
    return result;
  }
  // The same three steps as for a mesh to optimize (FindPlane of vtkMeshRanksPlane.h), for all
  // blocks at once: each step costs all ranks one message, however many blocks there are.
  PlaneBlocks all = MergeAll(ranks, mine);
  for (const Block& block : blocks)
  {
    const Grid grid(block.Mesh);
    PlaneFacts& facts = mine[block.FlatIndex].Facts;
    facts.Largest = all[block.FlatIndex].Facts.Largest;
    vtkMeshBridge::AddAreas(grid.GetView(), grid.ListTriangles(false), facts);
  }
  all = MergeAll(ranks, mine);
  std::map<unsigned int, vtkMeshBridge::Plane> planes;
  for (const auto& [block, one] : all)
  {
    if (!one.HasTetrahedra && !one.Facts.IsEmpty())
    {
      planes[block] = vtkMeshBridge::MakePlane(one.Facts);
    }
  }
  for (const Block& block : blocks)
  {
    const auto plane = planes.find(block.FlatIndex);
    if (plane != planes.end())
    {
      const Grid grid(block.Mesh);
      vtkMeshBridge::Plane measured = plane->second; // all ranks go on from the same one
      for (const bool areGhosts : { false, true })
      {
        vtkMeshBridge::FindFarthest(grid.GetView(), grid.ListTriangles(areGhosts), measured);
      }
      mine[block.FlatIndex].Farthest = measured.Farthest;
    }
  }
  all = MergeAll(ranks, mine);
  for (auto& [block, plane] : planes)
  {
    plane.Farthest = all[block].Farthest;
    result[block] = { plane.HasAll(), plane.Frame };
  }
  return result;
}

} // namespace vtkMeshQualityBridge
