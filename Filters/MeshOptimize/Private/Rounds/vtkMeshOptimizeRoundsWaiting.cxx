// SPDX-License-Identifier: BSD-3-Clause
// Which points wait for another round on many ranks.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "Ranks/vtkMeshRanksBound.h"

#include "WorstFirst/Constants.h"

#include <algorithm>
#include <iterator>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

/// Bad cells are few up to FewStuck and one of CellsPerStuck. Of many only those wait that are
/// better than the worst by less than this part of what it lacks to the target.
constexpr vtkIdType FewStuck = 16, CellsPerStuck = 2000;
constexpr double NearWorst = 0.1;
/// If the worst is not far from the bound of the surface, they wait only after a round that has
/// lifted it by more than this, or left fewer of few.
constexpr double NearBound = 0.98;
constexpr double LeastGain = 0.002;
/// Bands go so far past the worst cell outside of them: next to that a crowd of cells would hide
/// which ones hold it back.
constexpr double AboveOthers = 0.02;
/// Layers of cells around those at the border that pieces leave to the first round.
constexpr int LayersLeft = 1;

} // namespace

//------------------------------------------------------------------------------
/**
 * The quality up to which cells at borders are worth another round: that of the last stage.
 */
double Rounds::GetGoal() const
{
  const double target = this->Wanted.Options.targetQuality;
  return this->IsBest() ? std::max(target, *(std::end(meshopt::worstfirst::Stages) - 1)) : target;
}

/**
 * Marks the points of the part that runs now, the cells that have moved or all, which cells outside
 * of it use, too. Fixed points would not be free in another run either.
 */
void Rounds::MarkBorder(const Shared& shared, const std::vector<char>& isMoved)
{
  std::vector<char> stays(this->Mine.PointIds.size(), 0), runs(stays);
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells() && !isMoved.empty(); ++c)
  {
    for (int i = 0; i < this->Mine.Corners; ++i)
    {
      (isMoved[c] ? runs : stays)[this->Mine.GetCell(c)[i]] = 1;
    }
  }
  for (vtkIdType p = 0; p < this->Mine.GetNumberOfPoints(); ++p)
  {
    const bool isBetween = shared.Has(p) || (stays[p] && runs[p]);
    std::uint8_t& flags = this->Mine.Flags[p];
    flags = static_cast<std::uint8_t>(flags & ~(Border | Hull));
    flags |= isBetween ? Hull : 0;
    flags |= isBetween && !(flags & PointFlag::Fixed) ? Border : 0;
  }
}

/**
 * Marks also the points of this number of layers of cells around the border.
 */
void Rounds::WidenBorder(int layers)
{
  for (int layer = 0; layer < layers; ++layer)
  {
    std::vector<std::uint8_t> next = this->Mine.Flags;
    for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
    {
      const meshopt::Index* ids = this->Mine.GetCell(c);
      if (std::any_of(ids, ids + this->Mine.Corners,
            [&](vtkIdType p) { return (this->Mine.Flags[p] & Border) != 0; }))
      {
        std::for_each(ids, ids + this->Mine.Corners, [&](vtkIdType p) { next[p] |= Border; });
      }
    }
    this->Mine.Flags.swap(next);
  }
}

/**
 * The pieces go up to the bound of the surface of all, not of their own, which borders are part of.
 */
void Rounds::FindGoalOfPieces()
{
  const Shared shared = FindShared(this->All, this->Mine);
  this->MarkBorder(shared, {});
  this->WidenBorder(LayersLeft);
  if (!this->HasZone && !this->IsTangled)
  {
    // Not measured yet, but positive: on which side of its facets a cell lies is certain.
    this->Mine.Quality.assign(this->Mine.CellIds.size(), 1.0);
  }
  this->FindCaps(shared);
  this->Most = this->Surface.Bound;
}

/**
 * Bands need not be much better than the worst cell that stays outside of all of them. `target`:
 * where cells of the part move; those that stay have none.
 */
void Rounds::FindGoalOfBands(const Part& part, const std::vector<int>& target)
{
  double worst = this->Surface.Bound;
  for (std::size_t c = 0; c < target.size(); ++c)
  {
    const bool counts = target[c] < 0 && !this->Surface.IsCapped[c] && !part.Kept[c];
    worst = counts ? std::min(worst, part.Quality[c]) : worst;
  }
  const std::vector<double> all = this->All.Gather(worst);
  worst = *std::min_element(all.begin(), all.end());
  this->Most = std::min(this->Surface.Bound, worst + AboveOthers);
}

/**
 * Whether no cell that should get better has a waiting point.
 */
bool Rounds::IsDone()
{
  // Ranks without cells ask, too: the answer is one for all.
  bool isWaiting = false;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
  {
    const meshopt::Index* ids = this->Mine.GetCell(c);
    isWaiting = isWaiting ||
      (this->Mine.Quality[c] < this->GetGoal() && !this->Surface.IsCapped[c] &&
        !this->Mine.Kept[c] &&
        std::any_of(ids, ids + this->Mine.Corners,
          [&](vtkIdType p) { return (this->Mine.Flags[p] & Waiting) != 0; }));
  }
  return !this->All.IsAny(isWaiting);
}

/**
 * In each run so far nodes of some border or hull were kept. A cell that is still bad waits for
 * another round, in which it lies in the middle. If what may grow is used up, none would help; if
 * many are bad, borders are not the reason, and only the worst wait.
 */
void Rounds::WaitWhereStuck()
{
  const std::vector<meshopt::PassRecord>& rows = this->Result.Report.history;
  // There are two rows at least: of the input and of the pieces.
  const meshopt::PassRecord &now = rows.back(), &before = rows[rows.size() - 2];
  // Past the target, which the best effort goes once nothing is under it but what is capped.
  const bool isPast = this->IsBest() &&
    now.belowTarget - this->BelowOutside <= this->Result.Report.cappedCells;
  const double target = isPast ? std::min(this->GetGoal(), this->Surface.Bound)
                               : this->Wanted.Options.targetQuality;
  const auto isStuck = [&](vtkIdType c, double most)
  { return this->Mine.Quality[c] < most && !this->Surface.IsCapped[c] && !this->Mine.Kept[c]; };
  // Of what is stuck; the target, if nothing is.
  vtkIdType stuck = 0;
  double worst = target;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
  {
    stuck += isStuck(c, target);
    worst = isStuck(c, worst) ? this->Mine.Quality[c] : worst;
  }
  const std::vector<double> all = this->All.Gather(worst);
  worst = *std::min_element(all.begin(), all.end());
  const bool areFew = this->All.Sum(stuck) <= FewStuck + this->Result.NumberOfCells / CellsPerStuck;
  const double most = areFew ? target : worst + NearWorst * (target - worst);
  const bool isFar = !isPast && worst < NearBound * this->Surface.Bound;
  const bool isFirst = rows.size() == 3; // input, pieces, the first round at the borders
  const bool isWorthIt = isFar || (isPast && isFirst) || now.worst > before.worst + LeastGain ||
    (areFew && now.belowTarget < before.belowTarget);
  const bool mayGrow = !this->IsShort || !this->MayTakeAll;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells() && isWorthIt && mayGrow; ++c)
  {
    if (isStuck(c, most))
    {
      const meshopt::Index* ids = this->Mine.GetCell(c);
      std::for_each(
        ids, ids + this->Mine.Corners, [&](vtkIdType p) { this->Mine.Flags[p] |= Waiting; });
    }
  }
}

} // namespace vtkMeshOptimizeBridge
