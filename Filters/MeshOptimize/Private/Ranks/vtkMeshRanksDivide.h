// SPDX-License-Identifier: BSD-3-Clause
/**
 * The first division of a mesh that lies on one rank, or in very uneven pieces.
 */
#ifndef vtkMeshRanksDivide_h
#define vtkMeshRanksDivide_h

#include "Ranks/vtkMeshRanksExchange.h"
#include "Ranks/vtkMeshRanksPart.h"
#include "vtkMeshBridgeFrame.h"

#include "Quality/Measure.h"

#include <vector>

namespace vtkMeshRanks
{

/**
 * How much work each cell is likely to be, in that of a cell that is good enough already: those
 * under `target` are more, as far as memory allows, which follows the number of cells. `plane`: of
 * triangles. Collective.
 */
std::vector<double> PredictWork(const Ranks& ranks, const Part& part, meshopt::Measure measure,
  double target, const vtkMeshBridge::Frame<2>& plane);

/**
 * A number below `count` for each cell, so that all have about as much work: the centres of the
 * cells are cut across the longest side of their box, again and again. Any count will do. Equal
 * centres go by id. Linear for each cut.
 */
std::vector<int> Divide(const Part& part, const std::vector<double>& work, int count);

/**
 * The same for a mesh that is in pieces already, a number for each cell of this rank. The cuts go
 * through samples of all ranks' cells, so that the parts differ by a few percent. Collective.
 */
std::vector<int> DivideAnew(const Ranks& ranks, const Part& part, const std::vector<double>& work);

} // namespace vtkMeshRanks

#endif
