// SPDX-License-Identifier: BSD-3-Clause
/**
 * The results of a run: the history table and the figures in the field data.
 */
#ifndef vtkMeshOptimizeHistory_h
#define vtkMeshOptimizeHistory_h

#include "Request/vtkMeshOptimizeRequest.h"

class vtkDataObject;
class vtkTable;

namespace vtkMeshOptimizeBridge
{

/**
 * Adds the columns to an empty table; the first one is Block if `isComposite`. `slides`: the
 * surface of tetrahedra takes part, and its changes are counted.
 */
void StartHistory(vtkTable* table, bool isComposite, bool slides);

/**
 * Adds the rows of one grid. `block` is its flat index; it is ignored without a Block column.
 */
void AppendHistory(const meshopt::Report& report, int block, vtkTable* table);

/**
 * Figures before and after, bound, counts, and stop reason as field data of the output. No times:
 * the same input must give the same output, bit for bit.
 */
void AddFigures(const Outcome& outcome, vtkDataObject* output);

} // namespace vtkMeshOptimizeBridge

#endif
