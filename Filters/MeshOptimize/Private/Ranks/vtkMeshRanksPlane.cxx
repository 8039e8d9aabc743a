// SPDX-License-Identifier: BSD-3-Clause
// The plane of triangles that are divided among ranks, found by the same steps as on one rank:
// facts are gathered, merged in the order of the ranks, and each rank draws the same conclusion.
#include "Ranks/vtkMeshRanksPlane.h"

#include <algorithm>
#include <array>

namespace vtkMeshRanks
{

using meshopt::Vec;
using vtkMeshBridge::PlaneFacts;

namespace
{

/**
 * Merges the facts of all ranks in their order.
 */
PlaneFacts MergeAll(const Ranks& ranks, const PlaneFacts& mine)
{
  Bytes bytes;
  PutFacts(bytes, mine);
  PlaneFacts all;
  for (const Bytes& theirs : ranks.Gather(bytes))
  {
    Reader reader(theirs);
    all.Merge(TakeFacts(reader));
  }
  return all;
}

} // namespace

void PutFacts(Bytes& bytes, const PlaneFacts& facts)
{
  for (const Vec<3>* x : { &facts.Bounds.Low, &facts.Bounds.High, &facts.Largest, &facts.Point,
         &facts.Sum, &facts.Turned })
  {
    Put(bytes, std::array<double, 3>{ { (*x)[0], (*x)[1], (*x)[2] } });
  }
  Put(bytes, facts.Precision);
}

PlaneFacts TakeFacts(Reader& reader)
{
  PlaneFacts facts;
  for (Vec<3>* x : { &facts.Bounds.Low, &facts.Bounds.High, &facts.Largest, &facts.Point,
         &facts.Sum, &facts.Turned })
  {
    const auto values = reader.Take<std::array<double, 3>>();
    *x = Vec<3>(values[0], values[1], values[2]);
  }
  facts.Precision = reader.Take<double>();
  return facts;
}

vtkMeshBridge::Plane FindPlane(const Ranks& ranks, const vtkMeshBridge::GridView& grid,
  const std::vector<vtkIdType>& triangles, vtkMeshBridge::Box& box)
{
  // Two rounds: the direction of the largest triangle decides which way the others are counted.
  PlaneFacts mine = vtkMeshBridge::FindPlaneFacts(grid, triangles);
  PlaneFacts all = MergeAll(ranks, mine);
  mine.Largest = all.Largest;
  vtkMeshBridge::AddAreas(grid, triangles, mine);
  all = MergeAll(ranks, mine);
  box = all.Bounds;
  vtkMeshBridge::Plane plane = vtkMeshBridge::MakePlane(all);
  vtkMeshBridge::FindFarthest(grid, triangles, plane);
  // Each rank has seen its own triangles only.
  const std::vector<double> farthest = ranks.Gather(plane.Farthest);
  plane.Farthest = *std::max_element(farthest.begin(), farthest.end());
  return plane;
}

} // namespace vtkMeshRanks
