// SPDX-License-Identifier: BSD-3-Clause
/**
 * core -> grid: which points and cells the output has, in which order, and the grid made of them.
 */
#ifndef vtkMeshOptimizeExport_h
#define vtkMeshOptimizeExport_h

#include "vtkMeshOptimizeModel.h"

#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * Where the points and cells of the output come from. First those of the input that are still
 * there, in their old order, then the new ones in the order of the core's slots.
 */
struct OutputMap
{
  /// Core slot of each output point; slots under the number of input points are ids of the grid.
  std::vector<meshopt::Index> PointToSlot;
  /// Output point of each core slot, or -1.
  std::vector<vtkIdType> SlotToPoint;
  /// How many of the output's points are points of the input.
  vtkIdType NumberOfOldPoints = 0;
  /// Output ids, ascending, of points that were moved or are new: their data must be interpolated.
  std::vector<vtkIdType> SampledPoints;

  /// Cell of the grid whose data an output cell takes.
  std::vector<vtkIdType> CellToSource;
  /// Core slot of each output cell, or meshopt::None for cells that passed through.
  std::vector<meshopt::Index> CellToSlot;
  /// How many of the output's cells are cells of the input.
  vtkIdType NumberOfOldCells = 0;
};

/**
 * Decides what the output consists of. A simplex is still there if a live cell with the same nodes
 * stands in its slot.
 */
template <int D>
OutputMap MapOutput(const Model<D>& model);

/**
 * Points and cells of the output, without data arrays. Coordinates of points that have not moved
 * are copied bit for bit; their type is that of the input if no point was moved or added, else
 * double.
 */
template <int D>
void ExportMesh(const Model<D>& model, const OutputMap& map, vtkUnstructuredGrid* output);

} // namespace vtkMeshOptimizeBridge

#endif
