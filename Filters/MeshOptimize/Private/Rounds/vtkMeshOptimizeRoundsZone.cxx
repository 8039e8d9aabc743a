// SPDX-License-Identifier: BSD-3-Clause
// Where only cells under a quality may change, and layers around them: the zone is found once, in
// the input, over all ranks. Cells outside of it never take part in a run; they travel with the
// bands, and what they share with the zone is its hull.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "WorstFirst/Constants.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

/**
 * Marks the points of the cells that are chosen, on all ranks that have them.
 */
std::vector<char> MarkPoints(
  const Ranks& ranks, const Part& part, const Shared& shared, const std::vector<char>& chosen)
{
  std::vector<char> marks(part.PointIds.size(), 0);
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    for (int i = 0; i < part.Corners; ++i)
    {
      marks[part.GetCell(c)[i]] |= chosen[c];
    }
  }
  return AnyOf(ranks, shared, marks);
}

} // namespace

//------------------------------------------------------------------------------
/**
 * Without a threshold all cells are the zone, and nothing has to be measured.
 */
void Rounds::FindZone()
{
  const double threshold = this->Wanted.OptimizeBelow;
  this->CellsInZone = this->CellsAtFirst;
  this->HasZone = threshold > 0.0;
  if (!this->HasZone)
  {
    return;
  }
  this->Wanted.OptimizeBelow = 0.0; // the runs get the zone alone
  const std::vector<meshopt::Index> cells = this->Mine.Cells;
  this->RunIdle(this->Mine, this->AtFirst); // leaves all cells in their order
  const Shared shared = FindShared(this->All, this->Mine);
  std::vector<char> isInside(this->Mine.CellIds.size());
  for (std::size_t c = 0; c < isInside.size(); ++c)
  {
    // As on one rank: what is outside stays as the input numbers it.
    const auto first = cells.begin() + static_cast<std::ptrdiff_t>(c) * this->Mine.Corners;
    const bool isRenumbered = !std::equal(
      first, first + this->Mine.Corners, this->Mine.GetCell(static_cast<vtkIdType>(c)));
    isInside[c] = this->Mine.Quality[c] < threshold || isRenumbered;
  }
  for (int layer = 0; layer < this->Wanted.NumberOfLayers; ++layer)
  {
    const std::vector<char> marks = MarkPoints(this->All, this->Mine, shared, isInside);
    for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
    {
      const meshopt::Index* ids = this->Mine.GetCell(c);
      isInside[c] = std::any_of(
        ids, ids + this->Mine.Corners, [&](vtkIdType p) { return marks[p] != 0; });
    }
  }
  vtkIdType below = 0;
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < isInside.size(); ++c)
  {
    this->Mine.Kept[c] = !isInside[c];
    below += !isInside[c] && this->Mine.Quality[c] < this->Wanted.Options.targetQuality;
    worst = isInside[c] ? worst : std::min(worst, this->Mine.Quality[c]);
  }
  const std::vector<char> inZone = MarkPoints(this->All, this->Mine, shared, isInside);
  const std::vector<char> outside = MarkPoints(this->All, this->Mine, shared, this->Mine.Kept);
  for (std::size_t p = 0; p < inZone.size(); ++p)
  {
    std::uint8_t& flags = this->Mine.Flags[p];
    // Cells outside use it: it stays. No cell of the zone does: no round would change anything.
    flags |= outside[p] ? PointFlag::Fixed : 0;
    flags = inZone[p] ? flags : static_cast<std::uint8_t>(flags & ~Waiting);
  }
  const std::vector<double> all = this->All.Gather(worst);
  this->WorstOutside = *std::min_element(all.begin(), all.end());
  this->BelowOutside = this->All.Sum(below);
  this->CellsInZone = this->All.Sum(std::count(isInside.begin(), isInside.end(), 1));
  this->ShareGrowth();
}

/**
 * A run that may do nothing: it measures the qualities, and takes no growth.
 */
void Rounds::RunIdle(Part& part, Outcome& idle)
{
  const Request wanted = this->Wanted;
  meshopt::Options& options = this->Wanted.Options;
  options.moveNodes = options.reconnect = options.insertNodes = options.removeNodes = false;
  this->Optimize(part, 0.0, 0.0, idle);
  this->Wanted = wanted;
}

/**
 * By the whole zone: pieces share what it may grow.
 */
void Rounds::ShareGrowth()
{
  this->Growth = meshopt::growthOf(
    this->Wanted.Options, static_cast<long>(this->CellsInZone), this->Mine.Corners - 1);
  this->Shrink = static_cast<long>(
    meshopt::worstfirst::ShrinkBudget * static_cast<double>(this->CellsInZone));
}

} // namespace vtkMeshOptimizeBridge
