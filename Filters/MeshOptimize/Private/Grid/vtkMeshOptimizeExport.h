// SPDX-License-Identifier: BSD-3-Clause
/**
 * core -> grid: the points and cells of the output and their order, and the grid made of them.
 */
#ifndef vtkMeshOptimizeExport_h
#define vtkMeshOptimizeExport_h

#include "Grid/vtkMeshOptimizeModel.h"

#include <array>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * The origin of the points and cells of the output. First come the remaining ones of the input in
 * their old order, then the new ones in the order of the core's slots.
 */
struct OutputMap
{
  /// Core slot of each output point; slots below the number of input points are ids of the grid.
  std::vector<meshopt::Index> PointToSlot;
  /// Output point of each core slot, or -1.
  std::vector<vtkIdType> SlotToPoint;
  /// Number of output points that are points of the input.
  vtkIdType NumberOfOldPoints = 0;
  /// Output ids, ascending, of points that moved or are new: their data must be interpolated.
  std::vector<vtkIdType> SampledPoints;

  /// Cell of the grid whose data an output cell takes.
  std::vector<vtkIdType> CellToSource;
  /// Core slot of each output cell, or meshopt::None for cells that passed through.
  std::vector<meshopt::Index> CellToSlot;
  /// Number of output cells that are cells of the input.
  vtkIdType NumberOfOldCells = 0;
  /// The last cells of the output: new triangles on a surface that slides, then new lines, by core
  /// slots.
  std::vector<meshopt::Facet<3>> Triangles;
  std::vector<std::array<meshopt::Index, 2>> Lines;
};

/**
 * Decides which points and cells the output has. A simplex of the input remains if its slot has a
 * live cell with the same nodes.
 */
template <int D>
OutputMap MapOutput(const Model<D>& model);

/**
 * Points and cells of the output, without data arrays. Coordinates of points that have not moved
 * are copied bit for bit. Their type is that of the input if no point was moved or added; otherwise
 * double.
 */
template <int D>
void ExportMesh(const Model<D>& model, const OutputMap& map, vtkUnstructuredGrid* output);

} // namespace vtkMeshOptimizeBridge

#endif
