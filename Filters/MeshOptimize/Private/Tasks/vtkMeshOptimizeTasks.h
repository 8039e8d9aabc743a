// SPDX-License-Identifier: BSD-3-Clause
/**
 * All grids that a filter is given, one after the other, or as one mesh of many ranks.
 */
#ifndef vtkMeshOptimizeTasks_h
#define vtkMeshOptimizeTasks_h

#include "Request/vtkMeshOptimizeRequest.h"

#include <string>

class vtkDataObject;
class vtkMultiProcessController;
class vtkPolyData;
class vtkTable;

namespace vtkMeshOptimizeBridge
{

/**
 * The data on all ports, and how the ranks share them.
 */
struct Ports
{
  vtkDataObject* Input;
  vtkPolyData* Geometry;
  vtkDataObject* Output;
  vtkTable* History;
  vtkMultiProcessController* Controller; ///< of the ranks, or nullptr
  bool OptimizeBorders;                  ///< whether the borders of the ranks' pieces take part
  int NumberOfPieces, NumberOfGhostLevels;
};

/**
 * Whether all ranks have been asked for their pieces of one mesh. Errors and results are then those
 * of all.
 */
bool HasPieces(const Ports& ports);

/**
 * Optimizes all grids. Returns an empty string, or a sentence about the first unusable thing.
 */
std::string OptimizeAll(const Ports& ports, Request request, Outcome& outcome);

} // namespace vtkMeshOptimizeBridge

#endif
