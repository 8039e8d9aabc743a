// SPDX-License-Identifier: BSD-3-Clause
// One run on a piece or a band: what it may use, and what need not be held meanwhile.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "OneGrid/vtkMeshOptimizeRun.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeControl.h"

#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;
using meshopt::StopReason;

namespace
{

// Whether a point is fixed travels as a flag of the part, not as an array.
vtkSmartPointer<vtkUnsignedCharArray> MaskOf(const Part& part, int flags)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetNumberOfValues(part.GetNumberOfPoints());
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    mask->SetValue(p, (part.Flags[p] & flags) != 0);
  }
  return mask;
}

// Downwards: the shares of all ranks together must not exceed the whole.
long Portion(long all, double share)
{
  return static_cast<long>(std::floor(static_cast<double>(all) * share));
}

} // namespace

//------------------------------------------------------------------------------
/**
 * A part as a grid for a run. What the run makes anew, what the input has, too, and what is the
 * same for all cells needs no memory meanwhile. `home`: of all cells, if the part has lost theirs.
 */
vtkSmartPointer<vtkUnstructuredGrid> Rounds::Lend(Part& part, int& home) const
{
  std::vector<double>().swap(part.Quality);
  std::vector<char>().swap(part.Kept);
  home = part.Home.front();
  if (std::all_of(part.Home.begin(), part.Home.end(), [&](int h) { return h == home; }))
  {
    std::vector<int>().swap(part.Home);
  }
  // In the first run, unless the mesh was divided anew or has ghosts.
  if (HasSameCells(this->Input, part))
  {
    std::vector<meshopt::Index>().swap(part.Cells);
    return BorrowGrid(part, this->Points, this->Cells, this->Input->GetCells());
  }
  return BorrowGrid(part, this->Points, this->Cells);
}

/**
 * Runs the optimizer on a part. Of what all ranks may still grow or shrink it may use `weight`
 * times `share`; the weights of all ranks have the sum 1 at most.
 */
void Rounds::Optimize(Part& part, double weight, double share, Outcome& outcome)
{
  // What has grown on all ranks so far, also in rounds before.
  const bool isFirst = this->Result.Report.history.empty();
  const vtkIdType now = isFirst ? this->CellsAtFirst : this->Result.NumberOfCells;
  const long gained = static_cast<long>(now - this->CellsAtFirst);
  Request request = this->Wanted;
  request.Options.mostGrowth = Portion(std::max(0L, this->Growth - gained), weight * share);
  request.Options.mostShrink = Portion(std::max(0L, this->Shrink - std::max(0L, -gained)), weight);
  request.Options.mostQuality = this->IsBest() ? this->Most : -1.0;
  request.Control = vtkMeshBridge::MakeControl(
    request.Filter, request.NumberOfThreads, this->First, this->Last, request.Control.deadline);
  std::string error;
  std::vector<Part> parts(1); // the zone, and what is outside of it, if there is one
  if (this->HasZone)
  {
    const std::vector<int> target(part.Kept.begin(), part.Kept.end());
    parts = Split(std::move(part), target, 2, 0);
  }
  else
  {
    parts[0] = std::move(part);
  }
  Part& zone = parts[0];
  const auto hull = this->Wanted.Slide ? HashesOfHull(zone) : std::vector<std::uint64_t>();
  meshopt::PartOfBoundary boundary = this->ReadBoundary(zone);
  request.BoundaryOfPart = &boundary;
  if (!zone.CellIds.empty())
  {
    int home = -1;
    auto grid = this->Lend(zone, home);
    InputArrays arrays;
    error = FindInputArrays(request.Filter, grid, arrays);
    // A mask of the part as it is now: at moved points an interpolated array has fractions.
    // A part of a boundary that slides may not move where other parts have it, too.
    const auto mask = MaskOf(zone, this->Wanted.Slide ? PointFlag::Fixed | Hull : PointFlag::Fixed);
    arrays.FixedPoints = mask;
    // With less effort no run goes on after the target, and all cells up to it get their tries.
    const auto border = MaskOf(zone, Border);
    arrays.BorderPoints = this->IsBest() ? border : nullptr;
    vtkNew<vtkUnstructuredGrid> after;
    error = error.empty() ? OptimizeGrid(grid, arrays, request, after, outcome) : error;
    if (error.empty())
    {
      grid = nullptr;
      ForgetCells(zone); // only points are still asked for
      // After the first run data have been interpolated once already.
      zone = ReadGrid(after, zone, this->First > 0.0);
      zone.Home.resize(zone.CellIds.size(), home); // if it was let go of
    }
  }
  // Also ranks without cells: they wait for the errors of the others.
  this->All.Agree(error);
  this->FinishBoundary(zone, hull, boundary);
  this->NumberNew(zone);
  if (this->HasZone)
  {
    this->All.Agree(Join(std::move(parts), part));
  }
  else
  {
    part = std::move(zone);
  }
  this->IsShort = this->All.IsAny(outcome.Report.stopReason == StopReason::GrowthLimit);
}

} // namespace vtkMeshOptimizeBridge
