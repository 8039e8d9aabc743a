// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the cells of a grid are to a filter that needs a mesh: the simplices that it works on, and
 * the others. Checks everything that later steps rely on, so that they need not look again.
 */
#ifndef vtkMeshBridgeCells_h
#define vtkMeshBridgeCells_h

#include "Mesh/Types.h"

#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshBridge
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
  /// 3: the tetrahedra are the mesh; 2: the triangles; 0: there is none. Triangles beside cells of
  /// dimension three are the surface of something.
  int Dimension = 0;

  /// All cells of the grid.
  vtkIdType NumberOfCells = 0;

  /// The grid's id of each simplex of the mesh, ascending. Ghost cells are not among them.
  std::vector<vtkIdType> Simplices;

  /// PointUseBits of each point of the grid.
  std::vector<std::uint8_t> PointUse;

  /// Ghost cells that would be simplices of the mesh.
  vtkIdType NumberOfGhostSimplices = 0;

  /// Triangles where the dimension is 0.
  vtkIdType NumberOfSurfaceTriangles = 0;

  /// Quadratic triangles or tetrahedra that would be simplices of the mesh if they were linear.
  vtkIdType NumberOfQuadraticSimplices = 0;

  /// True if cell ids of the grid and of the core are the same.
  bool IsIdentity() const
  {
    return static_cast<vtkIdType>(this->Simplices.size()) == this->NumberOfCells;
  }
};

/**
 * Sorts the cells of `grid`. Returns a sentence about the first thing that is wrong (a point id out
 * of range, a simplex that uses a point twice, a coordinate of a simplex that is not finite, an
 * array of the wrong length, more cells than the core can count), or an empty string.
 */
std::string ClassifyCells(vtkUnstructuredGrid* grid, Cells& cells);

/**
 * A message of the core, and which cell of the grid its `cell` is, if that is another one there.
 */
std::string WithGridIds(const std::string& message, meshopt::Index cell, const Cells& cells);

} // namespace vtkMeshBridge

#endif
