// SPDX-License-Identifier: BSD-3-Clause
// Which points wait for another round on many ranks.
#include "vtkMeshOptimizeRounds.h"

#include <algorithm>

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

} // namespace

//------------------------------------------------------------------------------
/**
 * The quality up to which cells at borders are worth another round.
 */
double Rounds::GetGoal() const
{
  return this->Wanted.Options.effort == meshopt::Effort::Best ? 1.0
                                                              : this->Wanted.Options.targetQuality;
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
    const vtkIdType* ids = this->Mine.GetCell(c);
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
  const double target = this->Wanted.Options.targetQuality;
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
  const std::vector<meshopt::PassRecord>& rows = this->Result.Report.history;
  // There are two rows at least: of the input and of the pieces.
  const meshopt::PassRecord &now = rows.back(), &before = rows[rows.size() - 2];
  const bool isWorthIt = worst < NearBound * this->Surface.Bound ||
    now.worst > before.worst + LeastGain || (areFew && now.belowTarget < before.belowTarget);
  const bool mayGrow = !this->IsShort || !this->MayTakeAll;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells() && isWorthIt && mayGrow; ++c)
  {
    if (isStuck(c, most))
    {
      const vtkIdType* ids = this->Mine.GetCell(c);
      std::for_each(
        ids, ids + this->Mine.Corners, [&](vtkIdType p) { this->Mine.Flags[p] |= Waiting; });
    }
  }
}

} // namespace vtkMeshOptimizeBridge
