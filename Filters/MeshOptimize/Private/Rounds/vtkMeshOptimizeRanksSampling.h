// SPDX-License-Identifier: BSD-3-Clause
/**
 * Point data on many ranks: each point that has moved or come is sampled once, from the input.
 */
#ifndef vtkMeshOptimizeRanksSampling_h
#define vtkMeshOptimizeRanksSampling_h

#include "Ranks/vtkMeshRanksPart.h"
#include "vtkMeshBridgeFrame.h"

#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Sets the data of all points of `part` that have a hint: what is interpolated in a piece, and
 * then again in a band, is not as exact as the input is. The rank whose input has the hint looks
 * for the place; if it is not there, all ranks whose box has it look, and the nearest counts (the
 * lowest rank if equal). `input` is the piece that this rank had at first, whose cells count from
 * firstCell[rank]. Points with ids under `firstNew` keep their pedigree ids. `plane`: of triangles.
 * Collective.
 */
void SampleOnce(const vtkMeshRanks::Ranks& ranks, vtkUnstructuredGrid* input,
  const std::vector<vtkIdType>& firstCell, const vtkMeshRanks::Schema& schema, vtkIdType firstNew,
  const vtkMeshBridge::Frame<2>& plane, vtkMeshRanks::Part& part);

} // namespace vtkMeshOptimizeBridge

#endif
