// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes figures readable: one set of figures for all ranks, tables, the worst cells as a grid.
 */
#ifndef vtkMeshQualityReport_h
#define vtkMeshQualityReport_h

#include "QualityMinMax/vtkMeshQualityMeasure.h"

#include <utility>
#include <vector>

class vtkDataArray;
class vtkMultiProcessController;
class vtkTable;
class vtkUnstructuredGrid;

namespace vtkMeshQualityBridge
{

/**
 * Merges the figures of all ranks in the order of the ranks, so that all get the same bits. Returns
 * false if a rank says that it failed. All ranks must call this, including those that failed. A
 * null controller means this rank only.
 */
bool Reduce(vtkMultiProcessController* controller, bool failed, std::size_t numberOfWorstCells,
  Figures& figures);

/**
 * Adds up the counts of all ranks.
 */
void Reduce(vtkMultiProcessController* controller, meshopt::QualityHistogram& histogram);

/**
 * The greatest possible value of the measure for the kinds of cells that occurred.
 */
double GreatestQuality(const Options& options, const Figures& figures);

/**
 * An empty histogram for these figures, from min(0, minimum) to max(greatest quality, maximum).
 */
meshopt::QualityHistogram MakeHistogram(
  const Options& options, const Figures& figures, int numberOfBins);

void FillSummary(const Options& options, const Figures& figures, vtkTable* table);
void FillHistogram(const meshopt::QualityHistogram& histogram, vtkTable* table);

/**
 * A grid and its number, which identifies its worst cells.
 */
struct Block
{
  std::int64_t Part;
  unsigned int FlatIndex;
  vtkUnstructuredGrid* Mesh;
  vtkMeshOptimizeBridge::InputArrays Arrays; ///< of Mesh
};

/**
 * Copies the worst cells that are in `blocks` to `output`, worst first. `isComposite`: adds an
 * array with the block of each cell.
 */
void FillWorstCells(const Options& options, const std::vector<meshopt::WorstElement>& worst,
  const std::vector<Block>& blocks, int rank, bool isComposite, vtkUnstructuredGrid* output);

} // namespace vtkMeshQualityBridge

#endif
