// SPDX-License-Identifier: BSD-3-Clause
/**
 * Triangles of the grid that are faces of its tetrahedra, and lines that are edges of its surface:
 * where that slides, they ride on it.
 */
#ifndef vtkMeshOptimizeRiding_h
#define vtkMeshOptimizeRiding_h

#include "Grid/vtkMeshOptimizeExport.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include "Surface/SlidingSurface.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{

/**
 * Calls f(cell, facet) for each kept facet of the mesh, from one of its sides.
 */
template <class F>
void ForKeptFacets(const meshopt::SimplexMesh<3>& mesh, F&& f)
{
  for (meshopt::Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i) && mesh.adjacent(c, i) < mesh.handle(c, i))
      {
        f(c, i);
      }
    }
  }
}

/**
 * The cells whose points no other one has, sorted; `all` is sorted, too.
 */
template <class Key>
std::vector<std::pair<Key, vtkIdType>> WithoutTwins(std::vector<std::pair<Key, vtkIdType>>& all)
{
  std::sort(all.begin(), all.end());
  std::vector<std::pair<Key, vtkIdType>> once;
  for (auto first = all.begin(), last = first; first != all.end(); first = last)
  {
    last = std::find_if(first, all.end(), [&](const auto& c) { return c.first != first->first; });
    if (last - first == 1)
    {
      once.push_back(*first);
    }
  }
  return once;
}

/**
 * Finds them, and notes them in the model. Their points are then used by tetrahedra only. A face
 * with two triangles has none that rides, an edge with two lines neither.
 */
void FindRiding(Model<3>& model);
void FindRiding(Model<2>& model);

/**
 * Numbers for the riding triangles, equal where they carry the same values: of the patch array, or
 * without one, of all cell arrays of one integer (global and pedigree ids excepted).
 */
std::vector<std::pair<meshopt::Facet<3>, meshopt::Index>> LabelRiding(const Model<3>& model);
/**
 * The same for the riding lines.
 */
std::vector<std::pair<std::array<meshopt::Index, 2>, meshopt::Index>> LabelRidingLines(
  const Model<3>& model);

/**
 * What rides on the optimized mesh, in the map: what is still there, and new triangles, each with
 * the data of the nearest of the same patch, and new lines, each with those of the line that its
 * middle lies on.
 */
void MapRiding(const Model<3>& model, const meshopt::SlidingSurface& surface, OutputMap& map);
void MapRiding(const Model<2>& model, const meshopt::BoundaryCurves& curves, OutputMap& map);

/**
 * Adds the point array BoundaryPlace: 0 inside, 1 on a patch, 2 on a curve, 3 a corner or fixed.
 */
void AddBoundaryPlace(const Model<3>& model, const OutputMap& map, vtkUnstructuredGrid* output);
void AddBoundaryPlace(const Model<2>& model, const OutputMap& map, vtkUnstructuredGrid* output);

} // namespace vtkMeshOptimizeBridge

#endif
