// SPDX-License-Identifier: BSD-3-Clause
/**
 * Node sets: point arrays that hold boundary conditions (0 where there is none). Where the surface
 * slides, the part of it that such an array holds or loads must neither grow nor shrink.
 */
#ifndef vtkMeshOptimizeSets_h
#define vtkMeshOptimizeSets_h

#include "Grid/vtkMeshOptimizeExport.h"

#include "Surface/BoundaryCurves.h"
#include "Surface/SlidingSurface.h"

#include <cstdint>
#include <vector>

class vtkDataSetAttributes;

namespace vtkMeshOptimizeBridge
{

/**
 * For each kept facet all of whose points have the same value of the patch array at points: its
 * sorted points and a number, from 0, for the value; in ascending order. Integers: equal values,
 * not 0. Others: all values that are not 0 count as one. Empty if the patch array is not at points.
 */
std::vector<std::pair<meshopt::Facet<3>, meshopt::Index>> LabelByPoints(const Model<3>& model);

/**
 * Makes those points corners that have a value of the patch array at points, but no facet there
 * does: lines, and single points, stay. `corners`: one per point, or empty.
 */
void KeepLonePoints(const Model<3>& model,
  const std::vector<std::pair<meshopt::Facet<3>, meshopt::Index>>& labels,
  std::vector<std::uint8_t>& corners);

/**
 * The node sets of all point arrays, as bits of each point: one for each array and value of an
 * integer array with few values, one for all values that are not 0 of another. Empty if there are
 * none. Arrays that are 0 nowhere on the surface, or everywhere, are not among them, nor ids.
 */
std::vector<std::uint32_t> FindNodeSets(Model<3>& model);

/**
 * Sets, in the arrays of node sets which are sets of patches, the values of points of the surface
 * that moved or are new: from the facets of the input in the same patch, or 0 outside of the set.
 */
void TransferNodeSets(const Model<3>& model, const meshopt::SlidingSurface& surface,
  const OutputMap& map, vtkDataSetAttributes* output);
void TransferNodeSets(const Model<2>& model, const meshopt::BoundaryCurves& curves,
  const OutputMap& map, vtkDataSetAttributes* output);

} // namespace vtkMeshOptimizeBridge

#endif
