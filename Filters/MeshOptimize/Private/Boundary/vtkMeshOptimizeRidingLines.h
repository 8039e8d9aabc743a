// SPDX-License-Identifier: BSD-3-Clause
/**
 * Lines of the grid that are edges of the surface of its tetrahedra: where that slides, they ride
 * on the curves that they make. Parts of vtkMeshOptimizeRiding.h.
 */
#ifndef vtkMeshOptimizeRidingLines_h
#define vtkMeshOptimizeRidingLines_h

#include "Grid/vtkMeshOptimizeModel.h"

#include "Surface/SlidingSurface.h"

#include <array>
#include <utility>
#include <vector>

namespace vtkMeshOptimizeBridge
{

/**
 * Lines of two points that are an edge of an outer face, of a face between two regions, or of a
 * riding triangle (which must have been found), and no other line is: sorted points, and cell of
 * the grid; in ascending order.
 */
std::vector<std::pair<std::array<meshopt::Index, 2>, vtkIdType>> FindRidingLines(
  const Model<3>& model);

/**
 * A line of the output.
 */
struct NewLine
{
  std::array<meshopt::Index, 2> Points; ///< slots of the core, in the direction of its source
  vtkIdType Source;                     ///< cell of the grid whose data it has
};

/**
 * The edges of the optimized mesh that lie on riding lines, but for those that are such a line
 * themselves, and lie on it. Marks the riding lines that are not, by cell of the grid, in `isGone`.
 */
std::vector<NewLine> FindNewLines(
  const Model<3>& model, const meshopt::SlidingSurface& surface, std::vector<char>& isGone);

} // namespace vtkMeshOptimizeBridge

#endif
