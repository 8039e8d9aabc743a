// SPDX-License-Identifier: BSD-3-Clause
/// @file Run.h
/// One run of the optimizer in one object: what it works on, its limits, and its report.
#ifndef meshopt_Run_Run_h
#define meshopt_Run_Run_h

#include "Base/Clock.h"
#include "Edit/Growth.h"
#include "Metric/AttachedMetric.h"
#include "Run/Options.h"
#include "Run/Report.h"
#include "Run/Summary.h"
#include "Surface/Surface.h"

#include <algorithm>

namespace meshopt
{
/// All that it refers to must outlive it.
template <int D>
struct Run
{
  MeshEditor<D>& editor;
  NodalMetric<D>& metric;
  const Surface<D>* surface; ///< what surface nodes may slide along; null: the surface is kept
  const Options& options;
  const Control& control;
  Clock& clock;
  Report& report;
  long growth = AnyGrowth;        ///< net number of cells that may still be added
  long mostCells = AnyGrowth;     ///< by the growth budget of the whole run
  Effort effort = options.effort; ///< of the stage at work: the first ones may take less
  bool polishesWidely = true;     ///< more than the few worst cells, if these are stuck
  bool dividesEdges = false;      ///< of the surface, past the first part of the run
  double bound = 1.0;             ///< of the worst quality, certified, where the surface takes part
  double target = options.targetQuality; ///< of the part at work: divisions aim at less
  /// The worst quality before a division, or 0: what follows begins just above it, and ends if that
  /// is out of reach.
  double toBeat = 0.0;

  const SimplexMesh<D>& mesh() const { return this->editor.mesh(); }

  /// Sets the growth to a part of what the stages so far have left.
  void limitGrowth(double part = 1.0)
  {
    const long left = std::max(0L, this->mostCells - this->report.history.back().cells);
    this->growth = static_cast<long>(part * static_cast<double>(left));
  }
  /// The stop reason of a run that the clock has stopped.
  StopReason stopped() const
  {
    return this->clock.isAborted() ? StopReason::Aborted : StopReason::TimeLimit;
  }
  /// Adds a row to the history with the present state of the mesh.
  PassRecord& record(const std::string& stage)
  {
    PassRecord row = summarize(this->mesh(), this->options.targetQuality);
    row.stage = stage;
    row.pass = static_cast<int>(this->report.history.size());
    this->report.history.push_back(row);
    return this->report.history.back();
  }
  /// The same with what a judge, or a pass, has tried and done.
  template <class Counted>
  PassRecord& record(const std::string& stage, const Counted& counted)
  {
    PassRecord& row = this->record(stage);
    row.tried = counted.tried;
    row.done = counted.done;
    return row;
  }
};

/// Attaches a metric to the points of a mesh for as long as this object lives: the metric then
/// follows when points move, come or go.
template <int D>
class FollowedMetric
{
public:
  FollowedMetric(MeshEditor<D>& editor, NodalMetric<D>& metric)
    : editor_(editor)
    , attached_(metric)
    , follows_(!metric.isTrivial())
  {
    if (this->follows_)
    {
      editor.attach(this->attached_);
    }
  }
  FollowedMetric(const FollowedMetric&) = delete;
  FollowedMetric& operator=(const FollowedMetric&) = delete;
  ~FollowedMetric()
  {
    if (this->follows_)
    {
      this->editor_.detach(this->attached_);
    }
  }

private:
  MeshEditor<D>& editor_;
  AttachedMetric<D> attached_;
  bool follows_;
};
}

#endif
