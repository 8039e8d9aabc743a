// SPDX-License-Identifier: BSD-3-Clause
/// @file Report.h
/// What a run has to tell: why it stopped, what it reached, and a row for each of its passes.
#ifndef meshopt_Run_Report_h
#define meshopt_Run_Report_h

#include "Edit/Operation.h"

#include <array>
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
  Aborted,     ///< by the caller; the mesh is valid, and as good as it was by then
  NothingToDo, ///< no triangles or tetrahedra
  GrowthLimit  ///< what would help needs more cells than growthBudget allows
};

/// A sentence for the user.
const char* toString(StopReason reason);

/// One row of the history.
struct PassRecord
{
  int pass = 0;
  std::string stage; ///< what was done in it: "input", "untangling", "reconnection", ...
  std::array<long, NumberOfOperations> tried{}, done{};
  double worst = 0.0, mean = 0.0; ///< after the pass
  long belowTarget = 0;           ///< cells under targetQuality after the pass
  long cells = 0, points = 0;     ///< live ones after the pass
  double seconds = 0.0;           ///< not part of any output array

  /// Takes over the work of another row, where the two become one.
  void addWork(const PassRecord& other)
  {
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      this->tried[op] += other.tried[op];
      this->done[op] += other.done[op];
    }
    this->seconds += other.seconds;
  }
};

/// What became of the wanted sizes; all 0 where they were not followed.
struct SizeReport
{
  double predictedCells = 0.0; ///< as many elements as the sizes ask for (5.3)
  /// Cells when splitting was stopped: several times as many as predicted, as where the wanted lengths
  /// change faster than edges can follow. 0: it was not.
  long cellsAtBrake = 0;
  /// In the plane: the longest of the edges that had to stay, in the length that is wanted there.
  double longestKept = 0.0;
  bool isGivenUp = false;      ///< all has been undone: the worst would have been lower than before
  double worstWithSizes = 0.0; ///< the worst quality that it would have been; where given up
};

struct Report
{
  StopReason stopReason = StopReason::NotRun;
  double worstBefore = 0.0, worstAfter = 0.0;
  double meanBefore = 0.0, meanAfter = 0.0;
  /// Certified upper bound on the worst quality while the surface is kept (1 where unknown).
  double bound = 1.0;
  long cappedCells = 0; ///< cells under the target at the end that their own cap keeps there
  long invertedBefore = 0, invertedAfter = 0;
  SizeReport sizes;
  std::vector<PassRecord> history; ///< first row: the input
  double seconds = 0.0;
};
}

#endif
