// SPDX-License-Identifier: BSD-3-Clause
// The loop around both halves of the paper, with what it leaves open: when to stop, and when
// look-ahead is worth its price.
#include "Paper1996/Paper1996.h"

#include "Base/Raised.h"
#include "Bound/Caps.h"
#include "Paper1996/GlobalAlgorithm.h"
#include "Paper1996/Reconnection.h"

#include <cstdio>
#include <utility>

namespace meshopt
{
namespace
{
constexpr double LeastGain = 1e-3; // in the worst quality of one alternation, as a fraction
constexpr int LookAheads = 20;     // worst elements with look-ahead when nothing else gains

template <int D>
class Paper1996
{
public:
  Paper1996(Run<D>& run, double target, bool lookAhead)
    : run_(run)
    , editor_(run.editor)
    , options_(run.options)
    , target_(target)
    , lookAhead_(lookAhead)
    , passBegin_(run.clock.seconds())
  {
  }

  StopReason optimize();

private:
  using Counts = std::array<long, NumberOfOperations>;

  StopReason iterate();
  void countCapped();
  bool alternate(int lookAhead);
  void reconnectAll(int lookAhead);
  void repositionAll();
  void record(const char* stage, const Counts& tried, const Counts& done);
  void touchMoved(const std::vector<Vec<D>>& before);
  bool goesOn(const char* stage, double worst);
  double worst() const { return this->run_.report.history.back().worst; }

  Run<D>& run_;
  MeshEditor<D>& editor_;
  const Options& options_;
  const double target_;
  const bool lookAhead_; ///< whether elements may get one
  /// Of all alternations: what has failed is not tried again until something around it changes.
  ReconnectionMemory<D> memory_;
  bool limitReached_ = false; ///< of iterations, in some repositioning
  long steps_ = 0, expectedSteps_ = 1;
  double passBegin_; // by the clock
};

// The amount of work is not known beforehand: the fraction approaches 1 as steps are made. At the
// expected number of steps it is one half.
template <int D>
bool Paper1996<D>::goesOn(const char* stage, double worst)
{
  ++this->steps_;
  const double ratio = static_cast<double>(this->steps_) /
    static_cast<double>(this->expectedSteps_);
  return this->run_.clock.goesOn(1.0 - 1.0 / (1.0 + ratio),
    [&]
    {
      // The history begins with the input; an alternation mostly adds two rows.
      char text[96];
      std::snprintf(text, sizeof text, "%s %d: worst element %.4f", stage,
        static_cast<int>(this->run_.report.history.size() + 1) / 2, worst);
      return std::string(text);
    });
}

/// The time of a row is the time since the row before.
template <int D>
void Paper1996<D>::record(const char* stage, const Counts& tried, const Counts& done)
{
  PassRecord& row = this->run_.record(stage);
  row.tried = tried;
  row.done = done;
  const double now = this->run_.clock.seconds();
  row.seconds = now - std::exchange(this->passBegin_, now);
}

/// What the history calls the fillings of the paper: the names of today's operations.
Operation operationOf(Filling kind)
{
  switch (kind)
  {
    case Filling::RingNode:
      return Operation::EdgeRemoval;
    case Filling::BoundaryNode:
      return Operation::EdgeContraction;
    // The node moves, but not to an optimum: to the mean that section 2.3 gives.
    case Filling::Centre:
      return Operation::NodeReplacement;
    case Filling::NewCentre:
    case Filling::Midpoint:
      return Operation::NodeInsertion;
    // OpenRing: such clusters include the exchange of two elements for three.
    default:
      return Operation::FaceRemoval;
  }
}

/// Section 2.3 once over the mesh, as far as the caller's switches allow it.
template <int D>
void Paper1996<D>::reconnectAll(int lookAhead)
{
  const Options& o = this->options_;
  ReconnectionParameters parameters;
  parameters.target = this->target_;
  parameters.growth = this->run_.growth;
  // A look-ahead moves nodes: it needs that switch, too.
  parameters.lookAhead = o.moveNodes && this->lookAhead_ ? lookAhead : 0;
  // Each filling by the switch of what it does: a node vanishes, moves or comes, or all stay.
  const auto allow = [&](Filling kind, bool on)
  { parameters.allowed[static_cast<int>(kind)] = on; };
  allow(Filling::RingNode, o.reconnect);
  allow(Filling::OpenRing, o.reconnect);
  allow(Filling::BoundaryNode, o.removeNodes);
  allow(Filling::Centre, o.moveNodes);
  allow(Filling::NewCentre, o.insertNodes);
  allow(Filling::Midpoint, o.insertNodes);

  const char* stage = lookAhead > 0 ? "look-ahead" : "reconnection";
  const ReconnectionResult result = reconnect<D>(
    { this->editor_, this->run_.metric, o.measure, o.beta }, parameters, this->memory_,
    [this, stage](double worst) { return this->goesOn(stage, worst); });
  // What one reconnection has used up is missing for the next.
  this->run_.growth -= result.growth;
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

// Marks the elements around moved nodes: they are reconnected again.
template <int D>
void Paper1996<D>::touchMoved(const std::vector<Vec<D>>& before)
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->memory_.resize(mesh);
  // Later than any failure so far.
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
    // The cell has another quality. It is in the star of each of its nodes, moved or not.
    for (Index p : mesh.nodes(c))
    {
      if (moved)
      {
        this->memory_.touch(p);
      }
    }
  }
}

/// Section 2.2 once over the mesh.
template <int D>
void Paper1996<D>::repositionAll()
{
  const Options& o = this->options_;
  RepositionParameters parameters;
  parameters.neighborhoodLevel = o.neighborhoodLevel;
  parameters.maximumNumberOfIterations = o.maximumNumberOfIterations;
  parameters.target = this->target_;
  // Of the active set (2.8), and alpha of Armijo's rule (2.7).
  parameters.local.epsilon = o.epsilon;
  parameters.local.armijo = o.armijo;

  const SimplexMesh<D>& mesh = this->editor_.mesh();
  // The editor tells nobody which nodes have moved: places before and after are compared.
  std::vector<Vec<D>> before(mesh.numberOfPointSlots());
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    before[p] = mesh.point(p);
  }
  const RepositionResult result = reposition<D>(
    { this->editor_, this->run_.metric, o.measure, o.beta }, parameters,
    [this](double worst) { return this->goesOn("repositioning", worst); });
  this->touchMoved(before);
  this->limitReached_ = this->limitReached_ || result.limitReached;
  Counts tried{}, done{};
  tried[static_cast<int>(Operation::NodeMotion)] = result.tried;
  done[static_cast<int>(Operation::NodeMotion)] = result.done;
  this->record("repositioning", tried, done);
}

// One alternation, in the order of the paper (opening of section 2): connectivity, then the best
// places of the nodes in it. True if the worst quality has risen.
template <int D>
bool Paper1996<D>::alternate(int lookAhead)
{
  const Options& o = this->options_;
  const double before = this->worst();
  if (o.reconnect || o.removeNodes || o.insertNodes)
  {
    this->reconnectAll(lookAhead);
  }
  // Reconnection alone may have reached the target.
  if (o.moveNodes && !this->run_.clock.hasStopped() && this->worst() < this->target_)
  {
    this->repositionAll();
  }
  // A smaller gain counts as none: the loop would go on for hardly anything. Relative to the
  // magnitude, since the worst quality of a tangled mesh is negative.
  return this->worst() > raised(before, LeastGain);
}

// Sets the certified bound, and counts the cells under the target that are at their caps.
template <int D>
void Paper1996<D>::countCapped()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  const double target = this->target_;
  Caps<D> caps;
  // In a metric that varies no cap can be certified: then nothing counts as capped.
  caps.build(mesh, this->options_.measure, target, this->run_.metric.isTrivial());
  this->run_.report.bound = caps.bound();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    this->run_.report.cappedCells += mesh.isAlive(c) && mesh.quality(c) < target &&
        caps.isCapped(mesh, c)
      ? 1
      : 0;
  }
}

/// All cells under the target are held by the surface: that is why nothing gained any more.
template <int D>
StopReason Paper1996<D>::optimize()
{
  StopReason reason = this->iterate();
  this->countCapped();
  const long below = this->run_.report.history.back().belowTarget;
  if (reason == StopReason::NoFurtherGain && below == this->run_.report.cappedCells)
  {
    reason = StopReason::CappedBySurface;
  }
  return reason;
}

template <int D>
StopReason Paper1996<D>::iterate()
{
  const Options& o = this->options_;
  // A guess, which only progress needs.
  this->expectedSteps_ = std::max(1L, 4 * this->run_.report.history.back().belowTarget);
  bool rises = true; // in the last alternation; the first one is made without look-ahead
  for (int k = 0; k < o.maximumNumberOfAlternations; ++k)
  {
    if (this->worst() >= this->target_)
    {
      return StopReason::TargetReached;
    }
    // Look-ahead is expensive: only after an alternation without gain, and it ends if it fails,
    // too.
    const bool looksAhead = !rises;
    rises = this->alternate(looksAhead ? LookAheads : 0);
    if (this->run_.clock.hasStopped())
    {
      return this->run_.stopped();
    }
    if (looksAhead && !rises)
    {
      // If a repositioning was cut short, another run with more iterations might still gain.
      return this->limitReached_ ? StopReason::IterationLimit : StopReason::NoFurtherGain;
    }
  }
  return this->worst() >= this->target_ ? StopReason::TargetReached : StopReason::IterationLimit;
}
}

template <int D>
void optimizePaper1996(Run<D>& run, double target, bool lookAhead)
{
  run.report.stopReason = Paper1996<D>(run, target, lookAhead).optimize();
}

template void optimizePaper1996<2>(Run<2>&, double, bool);
template void optimizePaper1996<3>(Run<3>&, double, bool);
}
