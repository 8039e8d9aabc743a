// SPDX-License-Identifier: BSD-3-Clause
// Outcomes of several grids are added to one: what the user reads is about all of them.
#include "Request/vtkMeshOptimizeRequest.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{
namespace
{

/**
 * The stop reason that says more about several grids together: what was cut short comes before what
 * has come to its end.
 */
int Strength(meshopt::StopReason reason)
{
  using meshopt::StopReason;
  switch (reason)
  {
    case StopReason::Aborted:
      return 8;
    case StopReason::TimeLimit:
      return 7;
    case StopReason::IterationLimit:
      return 6;
    case StopReason::GrowthLimit:
      return 5;
    case StopReason::NoFurtherGain:
      return 4;
    case StopReason::CappedBySurface:
      return 3;
    case StopReason::TargetReached:
      return 2;
    case StopReason::NothingToDo:
      return 1;
    case StopReason::NotRun:
      break;
  }
  return 0;
}

double Mean(double a, vtkIdType countA, double b, vtkIdType countB)
{
  return (a * static_cast<double>(countA) + b * static_cast<double>(countB)) /
    // Without cells the sum is 0, and so is the mean.
    static_cast<double>(std::max<vtkIdType>(countA + countB, 1));
}

} // namespace

//------------------------------------------------------------------------------
void Outcome::Add(const Outcome& other)
{
  const bool isFirst = this->NumberOfCellsBefore == 0;
  meshopt::Report& mine = this->Report;
  const meshopt::Report& its = other.Report;
  // A grid without simplices has no qualities: its zeros must not count.
  if (other.NumberOfCellsBefore > 0)
  {
    mine.worstBefore = isFirst ? its.worstBefore : std::min(mine.worstBefore, its.worstBefore);
    mine.worstAfter = isFirst ? its.worstAfter : std::min(mine.worstAfter, its.worstAfter);
    mine.bound = isFirst ? its.bound : std::min(mine.bound, its.bound);
    mine.meanBefore = Mean(
      mine.meanBefore, this->NumberOfCellsBefore, its.meanBefore, other.NumberOfCellsBefore);
    mine.meanAfter = Mean(mine.meanAfter, this->NumberOfCells, its.meanAfter, other.NumberOfCells);
    mine.cappedCells += its.cappedCells;
    mine.invertedBefore += its.invertedBefore;
    mine.invertedAfter += its.invertedAfter;
  }
  if (Strength(its.stopReason) > Strength(mine.stopReason))
  {
    // Nodes of the worst cell belong to the grid whose reason is told.
    mine.stopReason = its.stopReason;
    mine.worstNodes = its.worstNodes;
  }
  this->NumberOfCells += other.NumberOfCells;
  this->NumberOfCellsBefore += other.NumberOfCellsBefore;
  this->NumberOfSimplices += other.NumberOfSimplices;
  this->NumberOfGhostSimplices += other.NumberOfGhostSimplices;
  this->NumberOfSurfaceTriangles += other.NumberOfSurfaceTriangles;
  this->NumberOfReorientedCells += other.NumberOfReorientedCells;
  this->NumberOfQuadraticSimplices += other.NumberOfQuadraticSimplices;
  this->NumberOfOperations += other.NumberOfOperations;
  mine.evaluations += its.evaluations;
  this->Seconds += other.Seconds;
  this->SurfaceDistance = std::max(this->SurfaceDistance, other.SurfaceDistance);
  this->HasSurfaceDistance |= other.HasSurfaceDistance;
  for (const auto& [region, volume] : other.Volumes)
  {
    this->Volumes[region][0] += volume[0];
    this->Volumes[region][1] += volume[1];
  }
  this->Lengths.add(other.Lengths);
  this->Twins = Joined(this->Twins, other.Twins);
  this->Overlap = Joined(this->Overlap, other.Overlap);
  this->Tangle = Joined(this->Tangle, other.Tangle);
  this->Sizes = Joined(this->Sizes, other.Sizes);
}

//------------------------------------------------------------------------------
double Outcome::VolumeChange() const
{
  double before = 0.0, after = 0.0;
  for (const auto& [region, volume] : this->Volumes)
  {
    before += volume[0];
    after += volume[1];
  }
  return before > 0.0 ? (after - before) / before : 0.0;
}

std::string Joined(const std::string& a, const std::string& b)
{
  return a + (a.empty() || b.empty() ? "" : " ") + b;
}

} // namespace vtkMeshOptimizeBridge
