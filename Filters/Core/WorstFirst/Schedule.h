// SPDX-License-Identifier: BSD-3-Clause
/// @file Schedule.h
/// One run of the fast engine for one shape measure: its stages and passes, and when it ends.
/// Included only by the few files that instantiate it.
#ifndef meshopt_WorstFirst_Schedule_h
#define meshopt_WorstFirst_Schedule_h

#include "Bound/Caps.h"
#include "Quality/Measures.h"
#include "Run/ChunkedPass.h"
#include "Run/Improver.h"
#include "Run/Run.h"
#include "WorstFirst/Constants.h"
#include "WorstFirst/CostModel.h"
#include "WorstFirst/GrowthBudget.h"
#include "WorstFirst/Parts.h"
#include "WorstFirst/Tangle.h"
#include "WorstFirst/Weights.h"

#include <cstdio>

namespace meshopt
{
namespace worstfirst
{
/// Stages (Stage.hxx) make passes (Pass.hxx), and a pass shares out its cells among chunks. At the
/// end of a stage the worst cells are polished (Polish.hxx). Report.hxx says what was done.
template <int D, class Shape>
class Schedule
{
public:
  explicit Schedule(Run<D>& run);
  void optimize();

private:
  using Entry = std::pair<double, Index>;

  /// Works on one chunk.
  struct Worker : ChunkWorker<D>
  {
    Improver<D, Shape> improver;
    Demand demand; // of this pass, at first
    std::int64_t evaluations = 0;
    long kept = 0, tries = 0; // in this pass
    long limit = 0;           // of the tries above the lowest level
    long looks = 0;           // the most look-aheads
    double most = 0.0;        // evaluations in this pass, beside those that it earns
    bool isPatient = true;    // insertion and look-ahead are still tried
    long lifted = 0;          // cells, in this pass
    long liftedBefore = 0;    // when watch() looked last
    bool creeps = false;
    int round = 0;              // of a pass that creeps
    std::vector<Index> changed; // cells for the next round

    Worker(const Run<D>& run, const QualityModel<D, Shape>& model, const Caps<D>& caps)
      : ChunkWorker<D>(run.editor)
      , improver(this->editor, model, run.options, run.surface, &caps)
      , demand(this->improver.judge().demand())
    {
    }
  };

  /// What a pass is to do.
  struct Task
  {
    double target;
    int level;
    long below; ///< cells under the target, including those not tried
  };

  long countFreeNodes() const;
  std::vector<double> stages() const;
  int levelOf(int pass) const;
  int passesThatRise() const { return this->options_.effort == Effort::Quick ? 1 : 2; }
  bool stage(double target);
  bool polishAndRepair(double target, bool isLast);
  bool weighedStage(double target);
  bool polish(double target, bool finely);
  double findWorst(double target, std::size_t wanted, std::vector<Entry>& worst) const;
  std::vector<Index> cellsAround(const std::vector<Entry>& cells, int layers) const;
  bool liftAround(const std::vector<Entry>& cells, int layers);
  long collect(double target, int level, std::vector<Index>& bad) const;
  void pass(const Task& task, const std::vector<Index>& bad);
  void drain(const Task& task, const std::vector<Index>& bad, int mostChunks);
  std::vector<Index> stillBad(double target) const;
  int numberOfChunks(std::size_t numberOfBadCells, int most) const;
  void instruct(const Task& task);
  double mostEvaluations() const;
  bool isSpent(const Worker& worker) const;
  void demand(Judge<D, Shape>& judge, const Task& task, bool creeps) const;
  void gather();
  void work(Worker& worker, const Task& task);
  int patientLevel(Worker& worker, const Task& task, int level) const;
  void watch(Worker& worker, const Task& task);
  bool hasNext(Worker& worker) const;
  long fewCells() const;
  /// Of polish(), up to the target; where there is hope: see isFarBelowBound().
  long mostLooks() const
  {
    return this->bound() < 1.0 || this->slides()
      ? std::max(FewestLooks, this->mesh().numberOfCellSlots() / CellsPerLook)
      : std::numeric_limits<long>::max();
  }
  bool hardlyAny(const std::vector<Index>& bad) const
  {
    return this->kept_ < std::max<long>(1, static_cast<long>(bad.size()) / HardlyAny);
  }
  bool worthTrying(Index c, int level) const;
  /// False where no bound is known, unless the surface takes part: then hardly anything is bound.
  bool isFarBelowBound() const
  {
    return (this->bound() < 1.0 || this->slides()) && this->worst() < NearBound * this->bound();
  }
  /// Whether cells at facets with tiny caps count. At the border of a part they do not.
  bool sparesTiny() const { return this->caps_.hasTiny() && this->bound() < Caps<D>::Tiny; }
  /// Whether the many bad cells are left as they are from now on: the last pass over them crept,
  /// and the surface, that holds most of such cells, is kept. Only the worst get more effort.
  /// `badBefore`: before the pass that made them `bad`, 0 before the first one.
  bool givesUpMany(double target, long bad, long badBefore) const
  {
    const double cells = static_cast<double>(this->mesh().countCells());
    const bool isQuick = this->options_.effort == Effort::Quick && target > Stages[0];
    return this->lifts() && this->creeps_ && !this->slides() &&
      ((isQuick && bad > ManyStuckQuick * cells) ||
        (badBefore > 0 && bad > HopelesslyMany * badBefore && bad > ManyStuck * cells));
  }
  /// Whether the cost model rules: where so many cells are bad that they cannot all be worth their
  /// tries. In a metric, and where the surface takes part, fewer are stuck for good.
  bool isThrifty(double target, long below) const
  {
    return this->lifts() && this->model_.plain && !this->slides() && !this->isPast(target) &&
      below > this->fewCells();
  }
  bool lifts() const { return this->phase_ == Phase::Lifting; }
  bool goesOn(double target);
  void record(double target, int pass);
  StopReason reason();

  const SimplexMesh<D>& mesh() const { return this->run_.mesh(); }
  bool slides() const { return this->run_.surface && this->run_.surface->judgesChanges(); }
  void noteWorst();
  bool isPast(double target) const { return target > this->options_.targetQuality + SameTarget; }
  /// Of all cells; in a part of a mesh of those that are not left to other runs.
  double worst() const
  {
    return this->mesh().hasBorder() ? this->worstInside_ : this->run_.report.history.back().worst;
  }
  double findWorstInside() const;
  /// Whether the cell is at the border of a part, and better off in another run.
  bool isLeft(Index c) const
  {
    const Simplex<D>& nodes = this->mesh().nodes(c);
    return this->mesh().hasBorder() &&
      std::any_of(nodes.begin(), nodes.end(), [&](Index p) { return this->mesh().isAtBorder(p); });
  }
  /// What no cell can exceed, or need not.
  double bound() const
  {
    const double most = this->options_.mostQuality;
    return most >= 0.0 ? most : this->caps_.bound();
  }

  Run<D>& run_;
  const Options& options_;
  QualityModel<D, Shape> model_;
  Caps<D> caps_;
  Weights<D, Shape> weights_;
  ChunkedPass<D, Worker> chunks_;
  int variant_ = 0; ///< which of Shifts is next
  Phase phase_ = Phase::Lifting;
  double usualGain_; ///< least gain of a change
  double gain_;
  double polishTarget_ = 0.0;
  Tangle<D> tangle_;
  // If sizes are followed, any number of cells may vanish.
  GrowthBudget budget_;
  long kept_ = 0;            ///< accepted changes of the pass
  std::int64_t spent_ = 0;   ///< evaluations of the pass
  bool creeps_ = false;      ///< the pass: see watch()
  bool leavesMany_ = false;  ///< see givesUpMany()
  double worstInside_ = 0.0; ///< see worst()
  CostModel costs_;
  FailureMemory failures_;
  long looks_ = 0; ///< look-aheads of polish() up to now
  std::array<long, NumberOfOperations> tried_{}, done_{};
  std::array<long, 2> surface_{}; ///< the same for changes of the surface
  double stageDone_ = 0.0;
  double passBegin_; ///< by the clock
};

template <int D, class Shape>
Schedule<D, Shape>::Schedule(Run<D>& run)
  : run_(run)
  , options_(run.options)
  , model_(run.mesh(), run.metric, run.options.beta)
  , weights_(run.editor, this->model_, this->caps_)
  , chunks_(run.editor,
      [this] { return std::make_unique<Worker>(this->run_, this->model_, this->caps_); })
  , usualGain_(this->model_.plain ? Gain : CoarseGain)
  , gain_(this->usualGain_)
  , tangle_(run.mesh(), run.report.invertedBefore > 0)
  , budget_(run.options, run.growth, run.mesh().countCells(), !this->model_.plain)
  , costs_(run.options.effort)
  , passBegin_(run.clock.seconds())
{
}

/// Only those that some cell has.
template <int D, class Shape>
long Schedule<D, Shape>::countFreeNodes() const
{
  long n = 0;
  for (Index p = 0; p < this->mesh().numberOfPointSlots(); ++p)
  {
    n += this->mesh().isFree(p) && this->mesh().cellOfPoint(p) != None;
  }
  return n;
}

/// The stages below the target, then the target. With the best effort also those above it, up to
/// the certified bound.
template <int D, class Shape>
std::vector<double> Schedule<D, Shape>::stages() const
{
  std::vector<double> result;
  for (double s : Stages)
  {
    // A little below the target, so that a stage equal to it is not run twice.
    if (s < this->options_.targetQuality - SameTarget)
    {
      result.push_back(s);
    }
  }
  result.push_back(this->options_.targetQuality);
  const double bound = this->bound();
  for (double s : Stages)
  {
    if (this->options_.effort == Effort::Best && this->isPast(s) && result.back() < bound)
    {
      result.push_back(std::min(s, bound));
    }
  }
  for (double s : StagesOfSliding)
  {
    if (this->options_.effort == Effort::Best && this->isPast(s) && this->slides())
    {
      result.push_back(s);
    }
  }
  return result;
}

/// The level of a stage's passes: it rises.
template <int D, class Shape>
int Schedule<D, Shape>::levelOf(int pass) const
{
  constexpr int levels[] = { Level::Topology, Level::Insertion, Level::LookAhead };
  // Polishing is for a few cells that all cheaper levels have failed on.
  return this->lifts() ? levels[std::min(pass, this->passesThatRise())] : Level::LongLookAhead;
}

/// Stage after stage up to the target, or beyond it. Polishes after the first stage, at the target,
/// and after each stage above it.
template <int D, class Shape>
void Schedule<D, Shape>::optimize()
{
  // Caps are needed up to the highest target of any stage: a cell above that is never tried.
  const double highest = this->options_.effort == Effort::Best
    ? std::max(*(std::end(Stages) - 1), this->options_.targetQuality)
    : this->options_.targetQuality;
  // No cap is certified if the metric varies or if the surface itself can change.
  this->caps_.build(this->mesh(), this->options_.measure, highest,
    this->run_.metric.isTrivial() && !this->run_.surface);
  this->caps_.setFull(this->options_.targetQuality / TinyReached);
  this->run_.report.bound = this->caps_.bound();
  this->costs_.open(this->mesh().countCells(), this->countFreeNodes());
  this->worstInside_ = this->findWorstInside();
  const std::vector<double> stages = this->stages();
  // The worst of a part may be held by the border nearby. It must not stop the others: other runs
  // take up what is left, and these must be few.
  const int mostIdle = this->mesh().hasBorder() ? MostIdleOfPart : MostIdle;
  bool more = true;
  int idle = 0;
  for (std::size_t k = 0; k < stages.size() && more && idle < mostIdle; ++k)
  {
    if (this->leavesMany_ && stages[k] < this->options_.targetQuality)
    {
      continue;
    }
    const bool past = this->isPast(stages[k]);
    if (past)
    {
      this->costs_.endLimits(); // what is made bad here must be repaired at any price
    }
    this->stageDone_ = static_cast<double>(k) / static_cast<double>(stages.size());
    const double before = this->worst();
    more = this->weighedStage(stages[k]);
    if (more && (k == 0 || past || stages[k] == this->options_.targetQuality))
    {
      // Nothing comes after the last stage: it may use the reserve.
      more = this->polishAndRepair(stages[k], k + 1 == stages.size());
    }
    // Past the target the run ends after some stages that did not lift the worst cell.
    const bool stuck = this->worst() < before + Gain;
    idle = past && stuck ? idle + 1 : 0;
  }
  // The fine polish also makes other cells worse. Bring those that can be repaired back to the
  // target.
  if (more && this->options_.effort == Effort::Best)
  {
    this->costs_.endLimits();
    if (this->polish(stages.back(), true))
    {
      this->weighedStage(this->options_.targetQuality);
    }
  }
  this->run_.report.stopReason = this->reason();
}

template <int D, class Shape>
bool Schedule<D, Shape>::goesOn(double target)
{
  const auto text = [&]
  {
    char line[96];
    std::snprintf(
      line, sizeof line, "worst element %.4f, working towards %.2f", this->worst(), target);
    return std::string(line);
  };
  return this->run_.clock.goesOn(this->stageDone_, text);
}
}
}

#include "WorstFirst/Pass.hxx"
#include "WorstFirst/Polish.hxx"
#include "WorstFirst/Report.hxx"
#include "WorstFirst/Stage.hxx"

namespace meshopt
{
namespace worstfirst
{
/// Runs row K of the table of measures, if this part has it and the run wants it.
template <int D, int Part, std::size_t K>
bool runRow(Run<D>& run)
{
  using Row = measures::Row<K>;
  if constexpr (Row::isOptimizable && K % NumberOfParts == Part)
  {
    if (run.options.measure == Row::id)
    {
      Schedule<D, typename Row::template Shape<D>>(run).optimize();
      return true;
    }
  }
  return false;
}

template <int D, int Part, std::size_t... K>
bool runRows(Run<D>& run, std::index_sequence<K...>)
{
  return (runRow<D, Part, K>(run) || ...);
}
}

template <int D, int Part>
bool runPart(Run<D>& run)
{
  return worstfirst::runRows<D, Part>(
    run, std::make_index_sequence<std::tuple_size_v<MeasureTable>>());
}
}

#endif
