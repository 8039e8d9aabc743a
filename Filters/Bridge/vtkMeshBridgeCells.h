// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the cells of a grid are to the optimizer: the simplices that it works on, and the others
 * that pass through. Checks everything that later steps rely on, so that they need not look again.
 */
#ifndef vtkMeshBridgeCells_h
#define vtkMeshBridgeCells_h

#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Bits of Cells::PointUse.
 */
enum PointUseBits : std::uint8_t
{
  UsedBySimplex = 1,
  UsedByOther = 2
};

/**
 * The cells of a grid, sorted by what happens to them.
 */
struct Cells
{
  /// 3: tetrahedra are optimized; 2: triangles; 0: there is neither.
  int Dimension = 0;

  /// The grid's id of each simplex that is optimized, ascending. Ghost cells are not among them.
  std::vector<vtkIdType> Simplices;

  /// PointUseBits of each point of the grid.
  std::vector<std::uint8_t> PointUse;

  /// Quadratic triangles or tetrahedra that would be optimized if they were linear.
  vtkIdType NumberOfQuadraticSimplices = 0;

  /// True if cell ids of the grid and of the core are the same.
  bool IsIdentity(vtkIdType numberOfCells) const
  {
    return static_cast<vtkIdType>(this->Simplices.size()) == numberOfCells;
  }
};

/**
 * Sorts the cells of `grid`. Returns a sentence about the first thing that is wrong (a point id out
 * of range, a simplex that uses a point twice, a coordinate of a simplex that is not finite, an
 * array of the wrong length, more cells than the core can count), or an empty string.
 */
std::string ClassifyCells(vtkUnstructuredGrid* grid, Cells& cells);

/**
 * Takes simplices off the list: those that `isKept`, one value for each of them, does not name pass
 * through from now on, as ghost cells do.
 */
void KeepSimplices(vtkUnstructuredGrid* grid, const std::vector<char>& isKept, Cells& cells);

} // namespace vtkMeshOptimizeBridge

#endif
