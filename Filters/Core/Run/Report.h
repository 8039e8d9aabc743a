// SPDX-License-Identifier: BSD-3-Clause
/// @file Report.h
/// What a run reports: why it stopped, what it reached, and one row for each of its passes.
#ifndef meshopt_Run_Report_h
#define meshopt_Run_Report_h

#include "Edit/Operation.h"
#include "Mesh/Place.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace meshopt
{
enum class StopReason
{
  NotRun = 0,
  TargetReached,   ///< the worst quality is at least the target
  CappedBySurface, ///< what is under the target cannot get better while the surface is kept
  NoFurtherGain,   ///< no operation improves the worst cells any more
  IterationLimit,
  TimeLimit,
  Aborted,     ///< by the caller; the mesh is valid, with all improvements made until then
  NothingToDo, ///< no triangles or tetrahedra
  GrowthLimit  ///< changes that would help need more cells than growthBudget allows
};

/// One row of the history.
struct PassRecord
{
  int pass = 0;
  std::string stage; ///< the name of the step: "input", "untangling", "reconnection", ...
  std::array<long, NumberOfOperations> tried{}, done{};
  long surfaceTried = 0, surfaceDone = 0; ///< changes of a surface that takes part in space
  double worst = 0.0, mean = 0.0;         ///< after the pass
  long belowTarget = 0;                   ///< cells under targetQuality after the pass
  long cells = 0, points = 0;             ///< live ones after the pass
  double seconds = 0.0;                   ///< of the pass; not part of any output array

  /// Adds the work of another row; for rows that are merged.
  void addWork(const PassRecord& other)
  {
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      this->tried[op] += other.tried[op];
      this->done[op] += other.done[op];
    }
    this->surfaceTried += other.surfaceTried;
    this->surfaceDone += other.surfaceDone;
    this->seconds += other.seconds;
  }
};

/// How well the wanted sizes were followed; all 0 if they were not followed.
struct SizeReport
{
  double predictedCells = 0.0; ///< number of elements predicted from the sizes (5.3)
  /// Number of cells at which splitting was stopped because it was several times the predicted
  /// number. This happens where the wanted lengths change faster than edges can follow. 0: not
  /// stopped.
  long cellsAtBrake = 0;
  /// In 2D: the longest edge that had to stay, in units of the length wanted there.
  double longestKept = 0.0;
  bool isGivenUp = false;      ///< all was undone, since the worst quality would have fallen
  double worstWithSizes = 0.0; ///< the worst quality with the sizes followed; only if given up
};

struct Report
{
  StopReason stopReason = StopReason::NotRun;
  double worstBefore = 0.0, worstAfter = 0.0;
  double meanBefore = 0.0, meanAfter = 0.0;
  /// Certified upper bound on the worst quality while the surface is kept (1 where unknown).
  double bound = 1.0;
  long cappedCells = 0; ///< cells under the target at the end that are held there by their own cap
  long invertedBefore = 0, invertedAfter = 0;
  /// Nodes of the worst cell at the end, by Freedom; only if the surface takes part in space.
  std::array<int, NumberOfFreedoms> worstNodes{};
  SizeReport sizes;
  std::vector<PassRecord> history; ///< first row: the input
  /// Qualities and gradients computed by the passes: what the run cost, whatever the machine. The
  /// same for any number of threads.
  std::int64_t evaluations = 0;
  double seconds = 0.0;
};

/// Why the run stopped, as a sentence for the user; also what the kept surface allows, if the worst
/// cell is near that, and where that cell is if the surface takes part in space.
std::string describeStop(const Report& report);
}

#endif
