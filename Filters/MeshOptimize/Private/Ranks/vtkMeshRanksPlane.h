// SPDX-License-Identifier: BSD-3-Clause
/**
 * The plane of triangles that lie on several ranks.
 */
#ifndef vtkMeshRanksPlane_h
#define vtkMeshRanksPlane_h

#include "Ranks/vtkMeshRanksExchange.h"
#include "vtkMeshBridgeFrame.h"

#include <vector>

namespace vtkMeshRanks
{

void PutFacts(Bytes& bytes, const vtkMeshBridge::PlaneFacts& facts);
vtkMeshBridge::PlaneFacts TakeFacts(Reader& reader);

/**
 * The plane of all triangles, and their box; the same bits on all ranks, except for FarthestPoint,
 * which is that of this rank. Some rank must have triangles. Collective.
 */
vtkMeshBridge::Plane FindPlane(const Ranks& ranks, const vtkMeshBridge::GridView& grid,
  const std::vector<vtkIdType>& triangles, vtkMeshBridge::Box& box);

} // namespace vtkMeshRanks

#endif
