// SPDX-License-Identifier: BSD-3-Clause
#include "Paper1996/Paper1996.h"

#include "Bound/Caps.h"
#include "Base/Progress.h"
#include "Run/Summary.h"
#include "Paper1996/Reconnection.h"
#include "Paper1996/GlobalAlgorithm.h"

#include <chrono>
#include <cmath>
#include <cstdio>

namespace meshopt
{
namespace
{
constexpr double LeastGain = 1e-3; // of the worst quality in one alternation, as a fraction
constexpr int LookAheads = 20;     // elements that get one, when nothing else gains

template <int D>
class Paper1996
{
public:
  Paper1996(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
    const Control& control, Report& report, long growth)
    : editor_(editor)
    , metric_(metric)
    , options_(options)
    , report_(report)
    , growth_(growth)
    , progress_(control)
  {
  }

  StopReason run();

private:
  using Counts = std::array<long, NumberOfOperations>;

  StopReason iterate();
  void countCapped();
  bool alternate(int lookAhead);
  void reconnectAll(int lookAhead);
  void repositionAll();
  void record(const char* stage, const Counts& tried, const Counts& done);
  void touchMoved(const std::vector<Vec<D>>& before);
  bool keepGoing(const char* stage, double worst);
  double worst() const { return this->report_.history.back().worst; }

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  const Options& options_;
  Report& report_;
  long growth_; // cells that may still come
  Progress progress_;
  ReconnectionMemory<D> memory_;
  bool limitReached_ = false;
  long steps_ = 0, expectedSteps_ = 1;
  std::chrono::steady_clock::time_point passBegin_ = std::chrono::steady_clock::now();
};

// How far the work is, is not known beforehand: the fraction approaches 1 as steps are made.
template <int D>
bool Paper1996<D>::keepGoing(const char* stage, double worst)
{
  ++this->steps_;
  const double ratio = static_cast<double>(this->steps_) /
    static_cast<double>(this->expectedSteps_);
  return this->progress_.report(1.0 - 1.0 / (1.0 + ratio),
    [&]
    {
      char text[96];
      std::snprintf(text, sizeof text, "%s %d: worst element %.4f", stage,
        static_cast<int>(this->report_.history.size() + 1) / 2, worst);
      return std::string(text);
    });
}

template <int D>
void Paper1996<D>::record(const char* stage, const Counts& tried, const Counts& done)
{
  PassRecord row = summarize(this->editor_.mesh(), this->options_.targetQuality);
  row.pass = static_cast<int>(this->report_.history.size());
  row.stage = stage;
  row.tried = tried;
  row.done = done;
  const auto now = std::chrono::steady_clock::now();
  row.seconds = std::chrono::duration<double>(now - this->passBegin_).count();
  this->passBegin_ = now;
  this->report_.history.push_back(row);
}

Operation operationOf(Filling kind)
{
  switch (kind)
  {
    case Filling::RingNode:
      return Operation::EdgeRemoval;
    case Filling::BoundaryNode:
      return Operation::EdgeContraction;
    case Filling::Centre:
      return Operation::NodeReplacement;
    case Filling::NewCentre:
    case Filling::Midpoint:
      return Operation::NodeInsertion;
    default:
      return Operation::FaceRemoval;
  }
}

template <int D>
void Paper1996<D>::reconnectAll(int lookAhead)
{
  const Options& o = this->options_;
  ReconnectionParameters parameters;
  parameters.target = o.targetQuality;
  parameters.naiveSearch = o.naiveSearch;
  parameters.growth = this->growth_;
  parameters.lookAhead = o.moveNodes && o.lookAhead ? lookAhead : 0;
  const auto allow = [&](Filling kind, bool on)
  { parameters.allowed[static_cast<int>(kind)] = on; };
  allow(Filling::RingNode, o.reconnect);
  allow(Filling::OpenRing, o.reconnect);
  allow(Filling::BoundaryNode, o.removeNodes);
  allow(Filling::Centre, o.moveNodes);
  allow(Filling::NewCentre, o.insertNodes);
  allow(Filling::Midpoint, o.insertNodes);

  const char* stage = lookAhead > 0 ? "look-ahead" : "reconnection";
  const ReconnectionResult result = reconnect<D>(this->editor_, this->metric_, o.measure, o.beta,
    parameters, this->memory_,
    [this, stage](double worst) { return this->keepGoing(stage, worst); });
  this->growth_ -= result.growth;
  Counts tried{}, done{};
  for (int k = 0; k < NumberOfFillings; ++k)
  {
    const int op = static_cast<int>(operationOf(static_cast<Filling>(k)));
    tried[op] += result.tried[k];
    done[op] += result.done[k];
  }
  tried[static_cast<int>(Operation::LookAhead)] = result.aheadTried;
  done[static_cast<int>(Operation::LookAhead)] = result.aheadDone;
  this->record(stage, tried, done);
}

// Elements around nodes that have moved are reconnected again.
template <int D>
void Paper1996<D>::touchMoved(const std::vector<Vec<D>>& before)
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->memory_.resize(mesh);
  ++this->memory_.time;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (!mesh.isAlive(c))
    {
      continue;
    }
    bool moved = false;
    for (Index p : mesh.nodes(c))
    {
      moved = moved || mesh.point(p) != before[p];
    }
    for (Index p : mesh.nodes(c))
    {
      if (moved)
      {
        this->memory_.touch(p);
      }
    }
  }
}

template <int D>
void Paper1996<D>::repositionAll()
{
  const Options& o = this->options_;
  RepositionParameters parameters;
  parameters.neighborhoodLevel = o.neighborhoodLevel;
  parameters.maximumNumberOfIterations = o.maximumNumberOfIterations;
  parameters.target = o.targetQuality;
  parameters.naiveSearch = o.naiveSearch;
  parameters.local.epsilon = o.epsilon;
  parameters.local.armijo = o.armijo;

  const SimplexMesh<D>& mesh = this->editor_.mesh();
  std::vector<Vec<D>> before(mesh.numberOfPointSlots());
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    before[p] = mesh.point(p);
  }
  const RepositionResult result = reposition<D>(this->editor_, this->metric_, o.measure, o.beta,
    parameters, [this](double worst) { return this->keepGoing("repositioning", worst); });
  this->touchMoved(before);
  this->limitReached_ = this->limitReached_ || result.limitReached;
  Counts tried{}, done{};
  tried[static_cast<int>(Operation::NodeMotion)] = result.tried;
  done[static_cast<int>(Operation::NodeMotion)] = result.done;
  this->record("repositioning", tried, done);
}

// One alternation: reconnection, then repositioning. True if the worst quality has risen.
template <int D>
bool Paper1996<D>::alternate(int lookAhead)
{
  const Options& o = this->options_;
  const double before = this->worst();
  if (o.reconnect || o.removeNodes || o.insertNodes)
  {
    this->reconnectAll(lookAhead);
  }
  if (o.moveNodes && !this->progress_.cancelled() && this->worst() < o.targetQuality)
  {
    this->repositionAll();
  }
  return this->worst() > before + LeastGain * std::abs(before);
}

// The certified bound, and how many cells under the target are at their caps.
template <int D>
void Paper1996<D>::countCapped()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  const double target = this->options_.targetQuality;
  Caps<D> caps;
  caps.build(mesh, this->options_.measure, target, this->metric_.isTrivial());
  this->report_.bound = caps.bound();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    this->report_.cappedCells += mesh.isAlive(c) && mesh.quality(c) < target &&
        caps.isCapped(mesh, c)
      ? 1
      : 0;
  }
}

template <int D>
StopReason Paper1996<D>::run()
{
  StopReason reason = this->iterate();
  this->countCapped();
  const long below = this->report_.history.back().belowTarget;
  if (reason == StopReason::NoFurtherGain && below == this->report_.cappedCells)
  {
    reason = StopReason::CappedBySurface;
  }
  return reason;
}

template <int D>
StopReason Paper1996<D>::iterate()
{
  const Options& o = this->options_;
  this->expectedSteps_ = std::max(1L, 4 * this->report_.history.back().belowTarget);
  bool rises = true; // in the last alternation
  for (int k = 0; k < o.maximumNumberOfAlternations; ++k)
  {
    if (this->worst() >= o.targetQuality)
    {
      return StopReason::TargetReached;
    }
    const bool looksAhead = !rises;
    rises = this->alternate(looksAhead ? LookAheads : 0);
    if (this->progress_.cancelled())
    {
      return StopReason::Aborted;
    }
    if (looksAhead && !rises)
    {
      return this->limitReached_ ? StopReason::IterationLimit : StopReason::NoFurtherGain;
    }
  }
  return this->worst() >= o.targetQuality ? StopReason::TargetReached : StopReason::IterationLimit;
}
}

template <int D>
void optimizePaper1996(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, long growth)
{
  Paper1996<D> paper(editor, metric, options, control, report, growth);
  report.stopReason = paper.run();
}

template void optimizePaper1996<2>(
  MeshEditor<2>&, NodalMetric<2>&, const Options&, const Control&, Report&, long);
template void optimizePaper1996<3>(
  MeshEditor<3>&, NodalMetric<3>&, const Options&, const Control&, Report&, long);
}
