// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstFirstRun.h
/// One run of the fast engine for one shape measure: the schedule. Only included by the few files that
/// instantiate it, one for each family of measures, so that they compile side by side.
#ifndef meshopt_WorstFirst_WorstFirstRun_h
#define meshopt_WorstFirst_WorstFirstRun_h

#include "Surface/SurfaceFaults.h"
#include "Mesh/PinchedPoints.h"
#include "Bound/Caps.h"
#include "Run/Chunks.h"
#include "Run/Improver.h"
#include "Base/Progress.h"
#include "Run/Summary.h"
#include "WorstFirst/WorstFirst.h"
#include "WorstFirst/WorstFirstConstants.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <queue>

namespace meshopt
{
namespace worstfirst
{
template <int D, class Shape>
class WorstFirst
{
public:
  WorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
    const Control& control, Report& report, const BoundaryCurves* curves);
  void run();

private:
  using Entry = std::pair<double, Index>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

  /// Who works on one chunk.
  struct Worker
  {
    MeshEditor<D> editor;
    Improver<D, Shape> improver;
    Queue queue;
    std::vector<Index> heldUp; // cells that need cells of other chunks
    long kept = 0, tries = 0;  // in this pass
    long limit = 0;            // of such tries
    long bad = 0;              // cells at its begin
    bool isPatient = true;     // likewise

    Worker(MeshEditor<D>& root, const QualityModel<D, Shape>& model, const Caps<D>& caps,
      const Options& options, const BoundaryCurves* curves)
      : editor(root.mesh(), root.clock(), root.lastMark())
      , improver(this->editor, model, caps, options, curves)
    {
    }
  };

  std::vector<double> stages() const;
  int highestLevel() const;
  bool stage(double target);
  bool weighedStage(double target);
  void weigh(bool on);
  bool polish(double target, bool finely);
  double findWorst(double target, std::size_t wanted, std::vector<Entry>& worst) const;
  bool liftAround(const std::vector<Entry>& cells, int layers);
  void pass(double target, int level, const std::vector<Index>& bad, long below);
  void drain(double target, int level, const std::vector<Index>& bad, long below, int mostChunks);
  bool hardlyAny(const std::vector<Index>& bad) const
  {
    return this->kept_ < std::max<long>(1, static_cast<long>(bad.size()) / HardlyAny);
  }
  long collect(double target, int level, std::vector<Index>& bad) const;
  void distribute(
    double target, int level, const std::vector<Index>& bad, long below, int mostChunks);
  long fewCells() const;
  void work(Worker& worker, double target, int level);
  void gather();
  bool worthTrying(Index c, int level) const;
  /// How hard a try is: those without guard are the hardest.
  int rank(int level) const { return level + (this->guard_ ? 0 : 4); }
  bool keepGoing(double target);
  bool outOfTime() const;
  void setInverted(long cells);
  void record(double target, int pass);
  StopReason reason();

  const SimplexMesh<D>& mesh() const { return this->editor_.mesh(); }

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  const Options& options_;
  const Control& control_;
  Report& report_;
  const BoundaryCurves* curves_;
  QualityModel<D, Shape> model_;
  Progress progress_;
  Caps<D> caps_;
  Chunks<D> chunks_;
  std::vector<std::unique_ptr<Worker>> workers_;
  int numberOfChunks_ = 0;
  std::vector<Index> heldUp_; ///< cells that borders have kept from being tried, in this pass
  int variant_ = 0;
  bool guard_ = true;
  double usualGain_; ///< least gain of a change
  double gain_;
  double polishTarget_ = 0.0;
  bool tangled_ = true;               ///< cells may lie on each other
  bool inverted_ = true;              ///< some are inverted
  std::vector<std::uint8_t> pinched_; ///< see PinchedPoints.h
  std::optional<bool> overlaps_;      ///< see mayOverlap(): known once no cell is inverted
  long growth_ = 0, mostGrowth_ = 0, kept_ = 0;
  long allowed_ = 0;     ///< growth_ at first
  long reserve_ = 0;     ///< of the growth, for polish()
  bool isShort_ = false; ///< a change has been left out for want of it
  std::array<long, NumberOfOperations> tried_{}, done_{};
  double stageDone_ = 0.0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point passBegin_ = begin_;
};

template <int D, class Shape>
WorstFirst<D, Shape>::WorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric,
  const Options& options, const Control& control, Report& report, const BoundaryCurves* curves)
  : editor_(editor)
  , metric_(metric)
  , options_(options)
  , control_(control)
  , report_(report)
  , curves_(curves)
  , model_(editor.mesh(), metric, options.beta)
  , progress_(control)
  , usualGain_(this->model_.plain ? Gain : CoarseGain)
  , gain_(this->usualGain_)
{
}

/// The stages below the target and the target itself; with the best effort also those above it.
template <int D, class Shape>
std::vector<double> WorstFirst<D, Shape>::stages() const
{
  std::vector<double> result;
  for (double s : Stages)
  {
    if (s < this->options_.targetQuality - 1e-9)
    {
      result.push_back(s);
    }
  }
  result.push_back(this->options_.targetQuality);
  const double bound = this->report_.bound;
  for (double s : Stages)
  {
    if (this->options_.effort == Effort::Best && s > this->options_.targetQuality + 1e-9 &&
      result.back() < bound)
    {
      result.push_back(std::min(s, bound));
    }
  }
  return result;
}

template <int D, class Shape>
int WorstFirst<D, Shape>::highestLevel() const
{
  using I = Improver<D, Shape>;
  if (!this->guard_)
  {
    return I::LongLookAhead;
  }
  return this->options_.effort == Effort::Quick ? I::Insertion : I::LookAhead;
}

template <int D, class Shape>
void WorstFirst<D, Shape>::run()
{
  this->growth_ = std::lround(
    this->options_.growthBudget * static_cast<double>(this->mesh().countCells()));
  this->allowed_ = this->growth_;
  this->reserve_ = this->growth_ / 10;
  this->mostGrowth_ = this->model_.plain
    ? this->growth_ + static_cast<long>(ShrinkBudget * this->mesh().countCells())
    : std::numeric_limits<long>::max();
  this->tangled_ = this->report_.invertedBefore > 0;
  if (this->tangled_ || (D == 2 && this->mesh().countCells() < CellsPerChunk)) // else it costs time
  {
    this->pinched_ = pinchedPoints<D>(this->mesh());
    this->tangled_ = this->tangled_ || !this->pinched_.empty();
  }
  long inverted = 0;
  if (this->tangled_)
  {
    summarize(this->mesh(), this->options_.targetQuality, &inverted);
  }
  this->setInverted(inverted);
  const double highest = this->options_.effort == Effort::Best
    ? std::max(*(std::end(Stages) - 1), this->options_.targetQuality)
    : this->options_.targetQuality;
  this->caps_.build(
    this->mesh(), this->options_.measure, highest, this->metric_.isTrivial() && !this->curves_);
  this->caps_.setFull(this->options_.targetQuality / TinyReached);
  this->report_.bound = this->caps_.bound();
  const std::vector<double> stages = this->stages();
  bool more = true;
  int idle = 0;
  for (std::size_t k = 0; k < stages.size() && more && idle < 2; ++k)
  {
    const bool past = stages[k] > this->options_.targetQuality + 1e-9;
    this->stageDone_ = static_cast<double>(k) / static_cast<double>(stages.size());
    const double before = this->report_.history.back().worst;
    more = this->weighedStage(stages[k]);
    if (more && (k == 0 || past || stages[k] == this->options_.targetQuality))
    {
      more = this->polish(stages[k], false);
      // What the worst cells cost others is made good where it can be.
      if (more && !past)
      {
        this->reserve_ = k + 1 < stages.size() ? this->reserve_ : 0;
        more = this->weighedStage(stages[k]);
      }
    }
    // Past the target, two stages that did not lift the worst cell are the end.
    const bool stuck = this->report_.history.back().worst < before + Gain;
    idle = past && stuck ? idle + 1 : 0;
  }
  if (more && this->options_.effort == Effort::Best && this->polish(stages.back(), true))
  {
    this->weighedStage(this->options_.targetQuality);
  }
  this->report_.stopReason = this->reason();
}

/// From now on qualities are weighed, see Caps::weight(), but never such that one gets worse than the
/// worst is now; or as they are again.
template <int D, class Shape>
void WorstFirst<D, Shape>::weigh(bool on)
{
  if (!this->caps_.hasTiny() || (!on && !this->model_.weights))
  {
    return;
  }
  const auto update = [&](const Caps<D>* weights)
  {
    this->model_.weights = weights;
    double worst = 1.0;
    for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
    {
      if (this->mesh().isAlive(c))
      {
        const Simplex<D>& nodes = this->mesh().nodes(c);
        if (this->caps_.weight(this->mesh(), nodes) > 1.0)
        {
          this->editor_.setQuality(c, this->model_(nodes));
        }
        worst = std::min(worst, this->mesh().quality(c));
      }
    }
    return worst;
  };
  this->model_.floor = std::max(0.0, update(nullptr));
  if (on)
  {
    update(&this->caps_);
  }
  this->caps_.setWeighed(on);
}

/// A stage with qualities weighed; without tiny facets a stage like any other.
template <int D, class Shape>
bool WorstFirst<D, Shape>::weighedStage(double target)
{
  this->weigh(true);
  const bool more = this->stage(target);
  this->weigh(false);
  return more;
}

template <int D, class Shape>
bool WorstFirst<D, Shape>::stage(double target)
{
  std::vector<Index> bad;
  const int highest = this->highestLevel();
  long below = 0;
  bool raised = false;
  for (int pass = this->guard_ ? 0 : highest; pass < MaximumPasses; ++pass)
  {
    const int level = std::min(pass, highest);
    const long belowBefore = std::exchange(below, this->collect(target, level, bad));
    const bool idle = this->guard_ && pass > highest && !raised && below > this->fewCells() &&
      below > HardlyFewer * belowBefore;
    if ((bad.empty() && level == highest) || idle)
    {
      break;
    }
    const double before = this->report_.history.back().worst;
    if (bad.empty())
    {
      continue;
    }
    this->pass(target, level, bad, below);
    this->record(target, pass);
    if (!this->keepGoing(target))
    {
      return false;
    }
    raised = this->report_.history.back().worst > before + this->gain_;
    if (level == highest && !raised && (this->hardlyAny(bad) || this->gain_ < Gain))
    {
      break;
    }
  }
  return true;
}

template <int D, class Shape>
bool WorstFirst<D, Shape>::worthTrying(Index c, int level) const
{
  const auto& data = this->mesh().cellData(c);
  if (data.stamp == 0 || data.level < this->rank(level))
  {
    return true;
  }
  for (Index p : this->mesh().nodes(c))
  {
    if (this->mesh().pointData(p).stamp > data.stamp)
    {
      return true;
    }
  }
  return false;
}

template <int D, class Shape>
long WorstFirst<D, Shape>::collect(double target, int level, std::vector<Index>& bad) const
{
  bad.clear();
  long below = 0;
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().quality(c) < target && this->mesh().isAlive(c) &&
      !this->caps_.isCapped(this->mesh(), c))
    {
      ++below;
      if (this->worthTrying(c, level))
      {
        bad.push_back(c);
      }
    }
  }
  return below;
}

template <int D, class Shape>
bool WorstFirst<D, Shape>::outOfTime() const
{
  return this->options_.timeLimit > 0.0 &&
    std::chrono::duration<double>(std::chrono::steady_clock::now() - this->begin_).count() >
    this->options_.timeLimit;
}

template <int D, class Shape>
bool WorstFirst<D, Shape>::keepGoing(double target)
{
  const auto text = [&]
  {
    char line[96];
    std::snprintf(line, sizeof line, "worst element %.4f, working towards %.2f",
      this->report_.history.back().worst, target);
    return std::string(line);
  };
  return this->progress_.report(this->stageDone_, text) && !this->outOfTime();
}

/// So many cells are inverted; where none is any more, cells may lie on each other all the same.
template <int D, class Shape>
void WorstFirst<D, Shape>::setInverted(long cells)
{
  this->inverted_ = cells > 0;
  if (this->tangled_ && !this->inverted_)
  {
    if (!this->overlaps_)
    {
      this->overlaps_ = mayOverlap<D>(this->mesh(), this->pinched_);
    }
    this->tangled_ = *this->overlaps_;
  }
}

template <int D, class Shape>
void WorstFirst<D, Shape>::record(double target, int pass)
{
  long inverted = 0;
  const bool weighed = this->model_.weights;
  this->weigh(false);
  PassRecord row = summarize(this->mesh(), this->options_.targetQuality, &inverted);
  this->weigh(weighed);
  this->setInverted(inverted);
  char name[32];
  std::snprintf(name, sizeof name, this->guard_ ? "towards %.2f, pass %d" : "polish towards %.2f",
    this->guard_ ? target : this->polishTarget_, pass + 1);
  row.stage = name;
  row.tried = this->tried_;
  row.done = this->done_;
  const auto now = std::chrono::steady_clock::now();
  row.seconds = std::chrono::duration<double>(now - this->passBegin_).count();
  this->passBegin_ = now;
  std::vector<PassRecord>& history = this->report_.history;
  if (history.back().stage == row.stage) // the many short passes of one polish make one row
  {
    row.addWork(history.back());
    history.pop_back();
  }
  row.pass = static_cast<int>(history.size());
  history.push_back(row);
}

template <int D, class Shape>
StopReason WorstFirst<D, Shape>::reason()
{
  long below = 0;
  this->report_.cappedCells = 0; // there may have been a run before
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().isAlive(c) && this->mesh().quality(c) < this->options_.targetQuality)
    {
      ++below;
      this->report_.cappedCells += this->caps_.isCapped(this->mesh(), c);
    }
  }
  if (this->progress_.cancelled())
  {
    return StopReason::Aborted;
  }
  if (this->outOfTime())
  {
    return StopReason::TimeLimit;
  }
  const double nothing = UsedUp * static_cast<double>(this->allowed_) + OneNode;
  const bool isUsedUp = this->isShort_ && static_cast<double>(this->growth_) <= nothing;
  return below == 0                      ? StopReason::TargetReached
    : below == this->report_.cappedCells ? StopReason::CappedBySurface
    : isUsedUp                           ? StopReason::GrowthLimit
                                         : StopReason::NoFurtherGain;
}
}

template <int D, class Shape>
void runWorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, const BoundaryCurves* curves)
{
  worstfirst::WorstFirst<D, Shape>(editor, metric, options, control, report, curves).run();
}
}

#include "WorstFirst/WorstFirstChunks.hxx"
#include "WorstFirst/WorstFirstPolish.hxx"

/// Instantiates the engine for a measure in both dimensions.
#define MESHOPT_INSTANTIATE_WORST_FIRST(Shape)                                              \
  template void runWorstFirst<2, Shape<2>>(MeshEditor<2>&, NodalMetric<2>&, const Options&, \
    const Control&, Report&, const BoundaryCurves*);                                        \
  template void runWorstFirst<3, Shape<3>>(MeshEditor<3>&, NodalMetric<3>&, const Options&, \
    const Control&, Report&, const BoundaryCurves*);

#endif
