// SPDX-License-Identifier: BSD-3-Clause
// The loop of section 2.3: the worst cell and those around it, each with its clusters. A cell that
// fails is set aside until something changes at one of its nodes.
#include "Paper1996/Reconnection.h"

#include "Base/Raised.h"
#include "Mesh/PinchedPoints.h"
#include "Paper1996/FillingLookAhead.h"
#include "Paper1996/FillingTrial.h"
#include "Paper1996/WorstQueue.h"
#include "Run/Run.h"

#include <algorithm>
#include <tuple>

namespace meshopt
{
namespace
{
template <int D, class Shape>
class Reconnection
{
public:
  Reconnection(const MeasuredMesh<D>& mesh, const Shape& shape,
    const ReconnectionParameters& parameters, ReconnectionMemory<D>& memory)
    : editor_(mesh.editor)
    , mesh_(mesh.editor.mesh())
    , parameters_(parameters)
    , memory_(memory)
    , queue_(this->mesh_, parameters.target)
    , model_(this->mesh_, mesh.metric, mesh.beta, shape)
    , pinched_(pinchedPoints<D>(this->mesh_))
    , judge_(mesh.editor, this->model_, this->switches_)
    , aheadJudge_(mesh.editor, this->model_, this->switches_)
    , trial_(this->judge_)
    , ahead_(this->aheadJudge_, parameters.leastGain)
  {
    // A fan may cross what surrounds its cluster: topology is always checked.
    for (Judge<D, Shape>* judge : { &this->judge_, &this->aheadJudge_ })
    {
      judge->setTangled(true, true, this->pinched_);
      judge->setStampsStars(false);
    }
    this->judge_.growth.left = parameters.growth;
  }

  ReconnectionResult run(const std::function<bool(double)>& keepGoing);

private:
  bool iterate(const std::function<bool(double)>& keepGoing);
  void improveAround(Index worst);
  void collectCandidates(Index worst);
  bool improveCell(Index c);
  void listWorst();
  bool lookAhead(const std::function<bool(double)>& keepGoing);
  bool lookAheadAt(Index c);
  void touch(const std::vector<Index>& cells, const std::vector<Index>& points);

  bool isAllowed(Filling kind) const { return this->parameters_.allowed[static_cast<int>(kind)]; }
  bool isFresh(Index c) const
  {
    return this->memory_.hasChanged(this->mesh_, c, this->memory_.failed[c]);
  }

  MeshEditor<D>& editor_;
  const SimplexMesh<D>& mesh_;
  ReconnectionParameters parameters_;
  ReconnectionMemory<D>& memory_;
  WorstQueue<D> queue_;
  Switches switches_;
  QualityModel<D, Shape> model_;
  std::vector<std::uint8_t> pinched_;  // see PinchedPoints.h
  Judge<D, Shape> judge_, aheadJudge_; // growth is limited only for the first
  FillingTrial<D, Shape> trial_;
  FillingLookAhead<D, Shape> ahead_;
  ElementClusters<D> clusters_;
  ReconnectionResult result_;
  std::vector<Index> star_, candidates_;
};

// To be called after a change of `cells` and around `points`: queues what is around them again.
template <int D, class Shape>
void Reconnection<D, Shape>::touch(
  const std::vector<Index>& cells, const std::vector<Index>& points)
{
  this->memory_.resize(this->mesh_);
  // A new time: what failed before is fresh again around these points.
  const std::uint32_t now = ++this->memory_.time;
  const auto touchPoint = [&](Index p)
  {
    // Each point once, though many of the cells share it.
    if (this->memory_.changed[p] != now && this->mesh_.isPointAlive(p))
    {
      this->memory_.touch(p);
      this->editor_.star(p, this->star_);
      for (Index c : this->star_)
      {
        this->queue_.push(c);
      }
    }
  };
  for (Index p : points)
  {
    touchPoint(p);
  }
  for (Index c : cells)
  {
    for (Index p : this->mesh_.nodes(c))
    {
      touchPoint(p);
    }
  }
}

template <int D, class Shape>
bool Reconnection<D, Shape>::improveCell(Index c)
{
  // Only clusters that have changed since this cell last failed.
  this->clusters_.gather(this->editor_, c, this->memory_, this->memory_.failed[c]);
  return this->clusters_.forEach(this->mesh_,
    [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
    {
      if (!this->isAllowed(kind))
      {
        return false;
      }
      ++this->result_.tried[static_cast<int>(kind)];
      // A filling must lift the worst cell of its cluster by the least gain, as a fraction.
      const double worst = around.cluster.worst;
      if (!this->trial_.make(around, apex, raised(worst, this->parameters_.leastGain)))
      {
        return false;
      }
      this->touch(this->trial_.made(), around.cluster.points);
      ++this->result_.done[static_cast<int>(kind)];
      return true;
    });
}

// Collects the elements that share an edge with the worst one, then those that share a node, if
// they are under the target and have not failed since something changed around them.
template <int D, class Shape>
void Reconnection<D, Shape>::collectCandidates(Index worst)
{
  this->candidates_.clear();
  for (Index p : this->mesh_.nodes(worst))
  {
    this->editor_.star(p, this->star_);
    for (Index c : this->star_)
    {
      if (this->mesh_.quality(c) < this->parameters_.target && this->isFresh(c))
      {
        this->candidates_.push_back(c);
      }
    }
  }
  const auto rank = [&](Index c)
  {
    // Sharing an edge means to share two nodes or more.
    int shared = 0;
    for (Index p : this->mesh_.nodes(c))
    {
      shared += this->mesh_.localIndex(worst, p) >= 0 ? 1 : 0;
    }
    return std::make_tuple(shared >= 2 ? 0 : 1, this->mesh_.quality(c), c);
  };
  // A cell comes once for each node that it shares: sorted, these stand together.
  std::sort(this->candidates_.begin(), this->candidates_.end(),
    [&](Index a, Index b) { return rank(a) < rank(b); });
  this->candidates_.erase(
    std::unique(this->candidates_.begin(), this->candidates_.end()), this->candidates_.end());
}

/// The first filling that gains ends the turn: after it another cell may be the worst.
template <int D, class Shape>
void Reconnection<D, Shape>::improveAround(Index worst)
{
  if (this->improveCell(worst))
  {
    return;
  }
  // Not fresh any more, until something changes around it.
  this->memory_.failed[worst] = this->memory_.time;
  this->collectCandidates(worst);
  for (Index c : this->candidates_)
  {
    if (this->improveCell(c))
    {
      return;
    }
    this->memory_.failed[c] = this->memory_.time;
  }
}

// ---- look-ahead ---------------------------------------------------------------------------------

// Lists the worst elements of the mesh under the target, worst first.
template <int D, class Shape>
void Reconnection<D, Shape>::listWorst()
{
  this->candidates_.clear();
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    if (this->mesh_.isAlive(c) && this->mesh_.quality(c) < this->parameters_.target)
    {
      this->candidates_.push_back(c);
    }
  }
  const auto count = std::min<std::size_t>(this->parameters_.lookAhead, this->candidates_.size());
  std::partial_sort(this->candidates_.begin(), this->candidates_.begin() + count,
    this->candidates_.end(),
    [&](Index a, Index b) {
      return std::make_pair(this->mesh_.quality(a), a) < std::make_pair(this->mesh_.quality(b), b);
    });
  this->candidates_.resize(count);
}

template <int D, class Shape>
bool Reconnection<D, Shape>::lookAheadAt(Index c)
{
  // 0: all clusters, whenever they changed: what failed alone may gain with a look-ahead.
  this->clusters_.gather(this->editor_, c, this->memory_, 0);
  return this->clusters_.forEach(this->mesh_,
    [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
    {
      // Moving a node to the centre first does not help the repositioning that follows.
      if (!this->isAllowed(kind) || kind == Filling::Centre)
      {
        return false;
      }
      ++this->result_.aheadTried;
      if (!this->ahead_.improve(around, apex))
      {
        return false;
      }
      ++this->result_.aheadDone;
      this->touch(this->ahead_.changed(), around.cluster.points);
      return true;
    });
}

// True as soon as one of the worst elements has been improved.
template <int D, class Shape>
bool Reconnection<D, Shape>::lookAhead(const std::function<bool(double)>& keepGoing)
{
  this->listWorst();
  for (Index c : this->candidates_)
  {
    // Also a failed look-ahead is repeated only after a change around the cell.
    if (!this->memory_.hasChanged(this->mesh_, c, this->memory_.ahead[c]))
    {
      continue;
    }
    if (keepGoing && !keepGoing(this->mesh_.quality(c)))
    {
      return false;
    }
    if (this->lookAheadAt(c))
    {
      return true;
    }
    this->memory_.ahead[c] = this->memory_.time;
  }
  return false;
}

// ---- the iteration ------------------------------------------------------------------------------

// Runs until all elements under the target are set aside; false if cancelled.
template <int D, class Shape>
bool Reconnection<D, Shape>::iterate(const std::function<bool(double)>& keepGoing)
{
  for (;;)
  {
    // Cells that are not fresh leave the queue. touch() puts them back when something changes
    // around them.
    const Index worst = this->queue_.worst([&](Index c) { return this->isFresh(c); });
    if (worst == None)
    {
      return true;
    }
    if (keepGoing && !keepGoing(this->mesh_.quality(worst)))
    {
      return false;
    }
    this->improveAround(worst);
  }
}

template <int D, class Shape>
ReconnectionResult Reconnection<D, Shape>::run(const std::function<bool(double)>& keepGoing)
{
  this->memory_.resize(this->mesh_);
  this->queue_.fill();
  // A successful look-ahead makes ordinary reconnection worth trying again, which is cheaper.
  while (this->iterate(keepGoing) && this->parameters_.lookAhead > 0 && this->lookAhead(keepGoing))
  {
  }
  // May be negative: fillings can also take cells away.
  this->result_.growth = this->parameters_.growth - this->judge_.growth.left;
  return this->result_;
}
}

template <int D>
ReconnectionResult reconnect(const MeasuredMesh<D>& mesh, const ReconnectionParameters& parameters,
  ReconnectionMemory<D>& memory, const std::function<bool(double)>& keepGoing)
{
  const FollowedMetric<D> follows(mesh.editor, mesh.metric);
  Reconnection<D, AnyShape<D>> reconnection(mesh, anyShape<D>(mesh.measure), parameters, memory);
  return reconnection.run(keepGoing);
}

template ReconnectionResult reconnect<2>(const MeasuredMesh<2>&, const ReconnectionParameters&,
  ReconnectionMemory<2>&, const std::function<bool(double)>&);
template ReconnectionResult reconnect<3>(const MeasuredMesh<3>&, const ReconnectionParameters&,
  ReconnectionMemory<3>&, const std::function<bool(double)>&);
}
