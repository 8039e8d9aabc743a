// SPDX-License-Identifier: BSD-3-Clause
/// @file Reporter.h
/// What the fast engine says of its run: the rows of the history, progress, and why it ends.
#ifndef meshopt_WorstFirst_Reporter_h
#define meshopt_WorstFirst_Reporter_h

#include "WorstFirst/GrowthBudget.h"
#include "WorstFirst/Workpiece.h"

#include <cstdio>

namespace meshopt
{
namespace worstfirst
{
/// Writes into the report of the run.
template <int D, class Shape>
class Reporter
{
public:
  /// `begin`: of the first pass, by the clock of the run. The workpiece must outlive this object.
  Reporter(Workpiece<D, Shape>& workpiece, double begin)
    : workpiece_(workpiece)
    , passBegin_(begin)
  {
  }

  /// The part of the work that is done, in [0, 1].
  void setDone(double part) { this->done_ = part; }
  /// Tells progress. False if the run has to end.
  bool goesOn(double target);
  /// Adds a row to the history. Returns how many cells are inverted.
  long record(const Task& task, const PassResult& result);
  /// Why the run ends, by what is left under the target.
  StopReason reason(const GrowthBudget& budget);

private:
  void noteWorst();

  Workpiece<D, Shape>& workpiece_;
  double done_ = 0.0;
  double passBegin_;
};

template <int D, class Shape>
bool Reporter<D, Shape>::goesOn(double target)
{
  const auto text = [&]
  {
    char line[96];
    std::snprintf(line, sizeof line, "worst element %.4f, working towards %.2f",
      this->workpiece_.worst(), target);
    return std::string(line);
  };
  return this->workpiece_.run().clock.goesOn(this->done_, text);
}

template <int D, class Shape>
long Reporter<D, Shape>::record(const Task& task, const PassResult& result)
{
  long inverted = 0;
  PassRecord row = this->workpiece_.summary(inverted);
  char name[32];
  std::snprintf(name, sizeof name,
    task.polishes() ? "polish towards %.2f" : "towards %.2f, pass %d", task.aim, task.number + 1);
  row.stage = name;
  row.tried = result.tried;
  row.done = result.done;
  row.surfaceTried = result.surface[0];
  row.surfaceDone = result.surface[1];
  const double now = this->workpiece_.run().clock.seconds();
  row.seconds = now - std::exchange(this->passBegin_, now);
  std::vector<PassRecord>& history = this->workpiece_.run().report.history;
  if (history.back().stage == row.stage) // the many short passes of one polish become one row
  {
    row.addWork(history.back());
    history.pop_back();
  }
  row.pass = static_cast<int>(history.size());
  history.push_back(row);
  return inverted;
}

/// Counts the nodes of the worst cell by their freedom.
template <int D, class Shape>
void Reporter<D, Shape>::noteWorst()
{
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  Index worst = None;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c) && (worst == None || mesh.quality(c) < mesh.quality(worst)))
    {
      worst = c;
    }
  }
  auto& nodes = this->workpiece_.run().report.worstNodes;
  nodes.fill(0);
  for (int i = 0; worst != None && i <= D; ++i)
  {
    ++nodes[static_cast<int>(mesh.freedom(mesh.nodes(worst)[i]))];
  }
}

template <int D, class Shape>
StopReason Reporter<D, Shape>::reason(const GrowthBudget& budget)
{
  const Run<D>& run = this->workpiece_.run();
  const SimplexMesh<D>& mesh = this->workpiece_.mesh();
  if (this->workpiece_.slides())
  {
    this->noteWorst();
  }
  long below = 0;
  long& capped = run.report.cappedCells;
  capped = 0; // an earlier run may have set it
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c) && mesh.quality(c) < run.options.targetQuality)
    {
      ++below;
      capped += this->workpiece_.caps().isCapped(mesh, c);
    }
  }
  if (run.clock.hasStopped())
  {
    return run.stopped();
  }
  return below == 0     ? StopReason::TargetReached
    : below == capped   ? StopReason::CappedBySurface
    : budget.isUsedUp() ? StopReason::GrowthLimit
                        : StopReason::NoFurtherGain;
}
}
}

#endif
