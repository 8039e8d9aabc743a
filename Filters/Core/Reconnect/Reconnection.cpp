// SPDX-License-Identifier: BSD-3-Clause
#include "Reconnect/Reconnection.h"

#include "Mesh/WorstQueue.h"
#include "Reconnect/Fan.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meshopt
{
template <int D>
void ReconnectionMemory<D>::resize(const SimplexMesh<D>& mesh)
{
  this->time = std::max<std::uint32_t>(this->time, 1);
  this->failed.resize(mesh.numberOfCellSlots(), 0);
  this->changed.resize(mesh.numberOfPointSlots(), 1);
}

template <int D>
bool ReconnectionMemory<D>::isFresh(const SimplexMesh<D>& mesh, Index c) const
{
  for (Index p : mesh.nodes(c))
  {
    if (this->changed[p] > this->failed[c])
    {
      return true;
    }
  }
  return false;
}

namespace
{
template <int D, class Shape>
class Reconnection
{
public:
  Reconnection(MeshEditor<D>& editor, NodalMetric<D>& metric,
    const ElementQuality<D, Shape>& quality, const ReconnectionParameters& parameters,
    ReconnectionMemory<D>& memory)
    : editor_(editor)
    , mesh_(editor.mesh())
    , metric_(metric)
    , quality_(quality)
    , parameters_(parameters)
    , memory_(memory)
    , queue_(editor.mesh(), parameters.target, parameters.naiveSearch)
    , trivial_(metric.isTrivial())
  {
  }

  ReconnectionResult run(
    const std::function<bool(double)>& keepGoing, std::vector<Index>* sequence);

private:
  static constexpr int Edges = Local<D>::numberOfEdges;
  struct Part // a cluster of the candidate at hand
  {
    FanCluster<D> cluster;
    std::array<Index, 2> core{ None, None };
    bool usable = false;
  };

  void improveAround(Index worst);
  void collectCandidates(Index worst);
  bool improveCell(Index c);
  void gatherParts(Index c);
  bool tryBoundaryPoints(const Part& part);
  bool tryCentre(const Part& part);
  bool tryNewPoint(const Part& part, Filling kind, const Vec<D>& x);

  bool isAllowed(Filling kind) const
  {
    return this->parameters_.allowed[static_cast<int>(kind)];
  }
  bool fill(const Part& part, const Apex<D>& apex);
  bool isKeepable(const Part& part, const Apex<D>& apex);
  void replace(const Part& part, Filling kind);
  void moveToCentre(const Part& part, const Vec<D>& x);
  void touch(const FanCluster<D>& cluster);

  MeshEditor<D>& editor_;
  const SimplexMesh<D>& mesh_;
  NodalMetric<D>& metric_;
  ElementQuality<D, Shape> quality_;
  ReconnectionParameters parameters_;
  ReconnectionMemory<D>& memory_;
  WorstQueue<D> queue_;
  ReconnectionResult result_;
  bool trivial_; // the metric is the same for all elements
  ElementMetric<D> common_;

  std::array<Part, Edges> edges_;
  std::array<Part, D + 1> nodes_;
  Fan<D> fan_;
  std::vector<Index> star_, candidates_;
  std::vector<Simplex<D>> outside_;
  std::vector<std::array<Index, 2>> keptEdges_;
};

// ---- one filling --------------------------------------------------------------------------------

template <int D, class Shape>
bool Reconnection<D, Shape>::fill(const Part& part, const Apex<D>& apex)
{
  const double worst = part.cluster.worst;
  const double required = worst + this->parameters_.leastGain * std::abs(worst);
  const auto qualityOf = [&](const Simplex<D>& nodes, const Corners<D>& x)
  {
    return this->quality_.value(x, this->trivial_ ? this->common_ : this->metric_.element(nodes));
  };
  return fillFromApex<D>(part.cluster, apex, required, qualityOf, this->fan_) &&
    this->isKeepable(part, apex);
}

// What geometry does not tell: the fan meets the rest of the mesh in the cluster's boundary only,
// and has the kept edges.
template <int D, class Shape>
bool Reconnection<D, Shape>::isKeepable(const Part& part, const Apex<D>& apex)
{
  if (apex.local >= 0)
  {
    this->editor_.star(apex.id, this->star_);
    const std::uint32_t mark = this->editor_.newMark();
    for (Index c : part.cluster.cells)
    {
      this->editor_.setMark(c, mark);
    }
    this->outside_.clear();
    for (Index c : this->star_)
    {
      if (!this->editor_.isMarked(c, mark))
      {
        this->outside_.push_back(this->mesh_.nodes(c));
      }
    }
    if (!isFanSafe<D>(part.cluster, apex, this->outside_))
    {
      return false;
    }
  }
  if (!this->mesh_.hasConstrainedEdges())
  {
    return true;
  }
  this->keptEdges_.clear();
  for (Index c : part.cluster.cells)
  {
    for (int e = 0; e < Edges; ++e)
    {
      if (this->mesh_.isEdgeConstrained(c, e))
      {
        const auto& local = Local<D>::edges[e];
        this->keptEdges_.push_back(
          { this->mesh_.nodes(c)[local[0]], this->mesh_.nodes(c)[local[1]] });
      }
    }
  }
  return fanHasEdges<D>(this->fan_, this->keptEdges_);
}

// After a change: what is around the cluster's points is tried again.
template <int D, class Shape>
void Reconnection<D, Shape>::touch(const FanCluster<D>& cluster)
{
  this->memory_.resize(this->mesh_);
  ++this->memory_.time;
  for (Index p : cluster.points)
  {
    this->memory_.touch(p);
  }
}

template <int D, class Shape>
void Reconnection<D, Shape>::replace(const Part& part, Filling kind)
{
  this->editor_.replace(part.cluster.cells, this->fan_.cells, this->fan_.quality);
  this->touch(part.cluster);
  for (Index c : this->editor_.created())
  {
    for (Index p : this->mesh_.nodes(c))
    {
      this->memory_.touch(p); // a new apex is no point of the cluster's boundary
    }
  }
  for (Index p : part.cluster.points)
  {
    this->editor_.star(p, this->star_);
    for (Index c : this->star_)
    {
      this->queue_.push(c);
    }
  }
  ++this->result_.done[static_cast<int>(kind)];
}

template <int D, class Shape>
void Reconnection<D, Shape>::moveToCentre(const Part& part, const Vec<D>& x)
{
  const Index p = part.core[0];
  this->editor_.movePoint(p, x);
  // The node is interior: facet k of the cluster belongs to its cell k.
  for (std::size_t k = 0; k < part.cluster.cells.size(); ++k)
  {
    this->editor_.setQuality(part.cluster.cells[k], this->fan_.quality[k]);
  }
  this->touch(part.cluster);
  this->memory_.touch(p);
  for (Index q : part.cluster.points)
  {
    this->editor_.star(q, this->star_);
    for (Index c : this->star_)
    {
      this->queue_.push(c);
    }
  }
  ++this->result_.done[static_cast<int>(Filling::Centre)];
}

// ---- one cluster --------------------------------------------------------------------------------

// The facets joined to one of the points that bound the cluster.
template <int D, class Shape>
bool Reconnection<D, Shape>::tryBoundaryPoints(const Part& part)
{
  const FanCluster<D>& cluster = part.cluster;
  const bool isEdge = part.core[1] != None;
  Filling kind = Filling::OpenRing;
  if (isEdge && cluster.closed)
  {
    kind = Filling::RingNode;
  }
  else if (cluster.coreInside)
  {
    kind = Filling::BoundaryNode;
  }
  if (!part.usable || !this->isAllowed(kind) ||
    (kind == Filling::BoundaryNode && this->mesh_.isFixed(part.core[0])))
  {
    return false;
  }
  ++this->result_.tried[static_cast<int>(kind)];
  for (std::size_t k = 0; k < cluster.points.size(); ++k)
  {
    const Apex<D> apex{ static_cast<int>(k), cluster.points[k], cluster.x[k] };
    // A fan from the core itself is the cluster as it is.
    if (apex.id != part.core[0] && apex.id != part.core[1] && this->fill(part, apex))
    {
      this->replace(part, kind);
      return true;
    }
  }
  return false;
}

template <int D, class Shape>
bool Reconnection<D, Shape>::tryNewPoint(const Part& part, Filling kind, const Vec<D>& x)
{
  if (!part.usable || !this->isAllowed(kind))
  {
    return false;
  }
  ++this->result_.tried[static_cast<int>(kind)];
  const Index p = this->editor_.addPoint(x);
  if (p == None)
  {
    return false;
  }
  this->metric_.resample(p, x);
  if (!this->fill(part, Apex<D>{ -1, p, x }))
  {
    this->editor_.dropPoint(p);
    return false;
  }
  this->replace(part, kind);
  return true;
}

// The facets of a node cluster joined to its centre.
template <int D, class Shape>
bool Reconnection<D, Shape>::tryCentre(const Part& part)
{
  const Vec<D> x = clusterCentre<D>(part.cluster);
  if (!part.cluster.coreInside)
  {
    return this->tryNewPoint(part, Filling::NewCentre, x);
  }
  const Index p = part.core[0];
  if (!part.usable || !this->isAllowed(Filling::Centre) || this->mesh_.isFixed(p))
  {
    return false;
  }
  ++this->result_.tried[static_cast<int>(Filling::Centre)];
  const Vec<D> old = this->mesh_.point(p);
  this->metric_.resample(p, x);
  if (!this->fill(part, Apex<D>{ -1, p, x }))
  {
    this->metric_.resample(p, old);
    return false;
  }
  this->moveToCentre(part, x);
  return true;
}

// ---- one candidate ------------------------------------------------------------------------------

// The clusters of a candidate, as far as they have changed since it was tried in vain. A change in
// the cells around a node is remembered at the node, one around an edge at both of its nodes.
template <int D, class Shape>
void Reconnection<D, Shape>::gatherParts(Index c)
{
  const Simplex<D>& nodes = this->mesh_.nodes(c);
  const auto isChanged = [&](Index p)
  { return this->memory_.changed[p] > this->memory_.failed[c]; };
  for (int e = 0; e < Edges; ++e)
  {
    Part& part = this->edges_[e];
    part.core = { nodes[Local<D>::edges[e][0]], nodes[Local<D>::edges[e][1]] };
    part.usable = isChanged(part.core[0]) && isChanged(part.core[1]) &&
      gatherFanCluster<D>(this->editor_, c, part.core.data(), 2, part.cluster);
  }
  for (int i = 0; i <= D; ++i)
  {
    Part& part = this->nodes_[i];
    part.core = { nodes[i], None };
    part.usable = isChanged(nodes[i]) &&
      gatherFanCluster<D>(this->editor_, c, part.core.data(), 1, part.cluster);
  }
}

template <int D, class Shape>
bool Reconnection<D, Shape>::improveCell(Index c)
{
  this->gatherParts(c);
  for (const Part& part : this->edges_)
  {
    if (this->tryBoundaryPoints(part))
    {
      return true;
    }
  }
  for (const Part& part : this->nodes_)
  {
    if (this->tryBoundaryPoints(part))
    {
      return true;
    }
  }
  for (const Part& part : this->nodes_)
  {
    if (this->tryCentre(part))
    {
      return true;
    }
  }
  for (const Part& part : this->edges_)
  {
    const Vec<D> middle =
      0.5 * (this->mesh_.point(part.core[0]) + this->mesh_.point(part.core[1]));
    if (part.cluster.closed && this->tryNewPoint(part, Filling::Midpoint, middle))
    {
      return true;
    }
  }
  return false;
}

// ---- the iteration ------------------------------------------------------------------------------

// The worst element, then those that share an edge with it, then those that share a node: as far as they
// are under the target and not yet tried in vain.
template <int D, class Shape>
void Reconnection<D, Shape>::collectCandidates(Index worst)
{
  this->candidates_.clear();
  for (Index p : this->mesh_.nodes(worst))
  {
    this->editor_.star(p, this->star_);
    for (Index c : this->star_)
    {
      if (this->mesh_.quality(c) < this->parameters_.target &&
        this->memory_.isFresh(this->mesh_, c))
      {
        this->candidates_.push_back(c);
      }
    }
  }
  const auto rank = [&](Index c)
  {
    int shared = 0;
    for (Index p : this->mesh_.nodes(c))
    {
      shared += this->mesh_.localIndex(worst, p) >= 0 ? 1 : 0;
    }
    return c == worst ? 0 : (shared >= 2 ? 1 : 2);
  };
  const auto before = [&](Index a, Index b)
  {
    return std::make_tuple(rank(a), this->mesh_.quality(a), a) <
      std::make_tuple(rank(b), this->mesh_.quality(b), b);
  };
  std::sort(this->candidates_.begin(), this->candidates_.end(), before);
  this->candidates_.erase(
    std::unique(this->candidates_.begin(), this->candidates_.end()), this->candidates_.end());
}

template <int D, class Shape>
void Reconnection<D, Shape>::improveAround(Index worst)
{
  if (this->improveCell(worst))
  {
    return;
  }
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

template <int D, class Shape>
ReconnectionResult Reconnection<D, Shape>::run(
  const std::function<bool(double)>& keepGoing, std::vector<Index>* sequence)
{
  this->memory_.resize(this->mesh_);
  if (this->trivial_)
  {
    this->common_ = this->metric_.element(Simplex<D>{});
  }
  this->queue_.fill();
  for (;;)
  {
    const Index worst =
      this->queue_.worst([&](Index c) { return this->memory_.isFresh(this->mesh_, c); });
    if (worst == None)
    {
      return this->result_;
    }
    if (keepGoing && !keepGoing(this->mesh_.quality(worst)))
    {
      this->result_.cancelled = true;
      return this->result_;
    }
    if (sequence)
    {
      sequence->push_back(worst);
    }
    this->improveAround(worst);
  }
}
}

template <int D>
ReconnectionResult reconnect(MeshEditor<D>& editor, NodalMetric<D>& metric, Measure measure,
  double beta, const ReconnectionParameters& parameters, ReconnectionMemory<D>& memory,
  const std::function<bool(double)>& keepGoing, std::vector<Index>* sequence)
{
  return dispatch<D>(measure,
    [&](auto shape)
    {
      using Shape = decltype(shape);
      const ElementQuality<D, Shape> quality{ beta };
      Reconnection<D, Shape> reconnection(editor, metric, quality, parameters, memory);
      return reconnection.run(keepGoing, sequence);
    });
}

template struct ReconnectionMemory<2>;
template struct ReconnectionMemory<3>;
template ReconnectionResult reconnect<2>(MeshEditor<2>&, NodalMetric<2>&, Measure, double,
  const ReconnectionParameters&, ReconnectionMemory<2>&, const std::function<bool(double)>&,
  std::vector<Index>*);
template ReconnectionResult reconnect<3>(MeshEditor<3>&, NodalMetric<3>&, Measure, double,
  const ReconnectionParameters&, ReconnectionMemory<3>&, const std::function<bool(double)>&,
  std::vector<Index>*);
}
