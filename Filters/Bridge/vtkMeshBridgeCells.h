// SPDX-License-Identifier: BSD-3-Clause
/**
 * Classifies the cells of a grid for a filter that needs a mesh: the simplices that it works on,
 * and the others. Checks everything that later steps rely on, so that they need not check again.
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
 * The cells of a grid, classified.
 */
struct Cells
{
  /// 3: the tetrahedra are the mesh; 2: the triangles; 0: there is none. Triangles beside cells of
  /// dimension three are a surface, not a mesh.
  int Dimension = 0;

  /// All cells of the grid.
  vtkIdType NumberOfCells = 0;

  /// The grid's id of each simplex of the mesh, ascending. Ghost cells are not among them.
  std::vector<vtkIdType> Simplices;

  /// PointUseBits of each point of the grid.
  std::vector<std::uint8_t> PointUse;

  /// Ghost cells that would be simplices of the mesh.
  vtkIdType NumberOfGhostSimplices = 0;

  /// Number of triangles if Dimension is 0.
  vtkIdType NumberOfSurfaceTriangles = 0;

  /// Quadratic triangles or tetrahedra that would be simplices of the mesh if they were linear.
  vtkIdType NumberOfQuadraticSimplices = 0;

  /// True if the grid and the core have the same cell ids.
  bool IsIdentity() const
  {
    return static_cast<vtkIdType>(this->Simplices.size()) == this->NumberOfCells;
  }
};

/**
 * Whether a cell has dimension three. Types unknown to VTK count.
 */
bool HasVolumes(vtkUnstructuredGrid* grid);

/**
 * Cells::Dimension, by the types alone: nothing is checked. A tetrahedron near the front makes it
 * short.
 */
int FindDimension(vtkUnstructuredGrid* grid);

/**
 * Classifies the cells of `grid`. Returns an empty string, or a sentence about the first error: a
 * point id out of range, a simplex that uses a point twice, a coordinate of a simplex that is not
 * finite, an array of the wrong length, or more cells than the core can number.
 */
std::string ClassifyCells(vtkUnstructuredGrid* grid, Cells& cells);

/**
 * For filters whose result would be wrong if a part of the body were left out: a sentence about the
 * first cell of the mesh's dimension that is no linear simplex, or empty. Cells of lower dimension
 * are marks on the mesh; vertices and lines may lie beside any.
 */
std::string CheckOnlySimplices(vtkUnstructuredGrid* grid, const Cells& cells);

/**
 * What such a filter says if there are cells, but Cells::Dimension is 0.
 */
constexpr const char* NoSimplices = "The input has neither triangles nor tetrahedra.";

/**
 * A message of the core. If `cell` has another id in the grid, this id is added.
 */
std::string WithGridIds(const std::string& message, meshopt::Index cell, const Cells& cells);

} // namespace vtkMeshBridge

#endif
