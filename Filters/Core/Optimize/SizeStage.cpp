// SPDX-License-Identifier: BSD-3-Clause
#include "Optimize/SizeStage.h"

#include "Optimize/EdgeLengths.h"
#include "Optimize/Improver.h"
#include "Optimize/Progress.h"
#include "Optimize/Statistics.h"
#include "Quality/Shape.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>

namespace meshopt
{
namespace
{
constexpr double Longest = 1.4142135623730951, Shortest = 1.0 / Longest;
constexpr int MaximumRounds = 12;
constexpr int Sweeps = 3; // of node motion, each round
/// A node is moved if the energy of its edges falls under this part of what it was.
constexpr double WorthMoving = 0.97;
/// A round that changes fewer edges than this part of the cells is the last.
constexpr double FewChanges = 0.005;
constexpr double CountTolerance = 0.03;
constexpr int MaximumCorrections = 3;
constexpr double GreatestScale = 1.25;
/// Edges are split so far from their middle, at random.
constexpr double Jitter = 0.1;
/// An edge is split if no cell at it has one that is longer than it by more than this factor.
constexpr double LongestFirst = 0.7;
/// No change may make a quality lower than both this and what was there.
constexpr double GoodEnough = 0.3;

/// Where an edge with the lengths la and lb by its ends is halved, from a on, as a part of the way; not too near to an end.
double metricMiddle(double la, double lb)
{
  const double r = std::log(lb / la);
  const double t = std::fabs(r) < 1e-4 ? 0.5 : std::log(0.5 * (1.0 + std::exp(r))) / r;
  return std::clamp(t, 0.25, 0.75);
}

/// A number in [-1, 1] that looks random, but is that of the edge.
double noise(Index a, Index b)
{
  std::uint64_t h = std::uint64_t(std::uint32_t(a)) << 32 | std::uint32_t(b);
  h = (h ^ h >> 31) * 0x9e3779b97f4a7c15ull;
  h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9ull;
  return static_cast<double>(h >> 33) / static_cast<double>(1ull << 30) - 1.0;
}

template <int D>
double lengthIn(const Tensor<D>& m, const Vec<D>& e)
{
  return std::sqrt(e.dot(m * e));
}

template <int D>
class SizeStage
{
public:
  SizeStage(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
    const Control& control, const BoundaryCurves* curves, Report& report);
  bool run();

private:
  using Shape = MeanEdgeShape<D>;

  struct Edge
  {
    double length;
    Index a, b, cell; // a < b
    bool operator<(const Edge& other) const // the greatest comes first
    {
      return std::tie(this->length, other.a, other.b, other.cell) <
        std::tie(other.length, this->a, this->b, this->cell);
    }
  };
  using Queue = std::priority_queue<Edge>;

  long split();
  long contract();
  void smooth();
  void swapWhatChanged();

  double longestEdge() const;
  bool isAboutLongest(const std::vector<Index>& cells, double length) const;
  bool splitEdge(const Edge& edge);
  bool contractEdge(Index v, Index u, double& above, EdgeChange<D>& best);
  bool moveNode(Index v);
  bool tryPlace(Index v, const Vec<D>& x, const CurvePlace<D>& place, double worst, double energy);
  template <class Push>
  void swapAround(Push&& push);
  void collectQueue(bool isLong);
  void push(Index c, bool isLong);
  bool measure(const std::vector<Simplex<D>>& cells, double least);
  double worstOf(const std::vector<Index>& cells) const;
  double energyAround(Index v);
  void sample(Index p, Index near);
  double length(Index a, Index b) const;
  void record(int round);
  bool keepGoing(int round);

  const SimplexMesh<D>& mesh() const { return this->editor_.mesh(); }

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  const Options& options_;
  const BoundaryCurves* curves_;
  Report& report_;
  Progress progress_;
  QualityModel<D, Shape> model_;
  Caps<D> caps_; // none: what is capped matters later
  Improver<D, Shape> improver_;
  EdgeChange<D> change_;

  std::vector<Tensor<D>> units_; // M / h*^2 at the points
  double scale_ = 1.0;                          // of h*
  double longest_ = Longest;                    // longer edges are split
  std::uint32_t swappedAt_ = 0;
  std::vector<std::uint32_t> failedAt_; // when a node could not be moved to advantage
  Queue queue_;
  std::vector<Index> star_, neighbours_, stack_;
  std::vector<double> qualities_;
  long splits_ = 0, contractions_ = 0, motions_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

template <int D>
SizeStage<D>::SizeStage(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, const BoundaryCurves* curves, Report& report)
  : editor_(editor)
  , metric_(metric)
  , options_(options)
  , curves_(curves)
  , report_(report)
  , progress_(control)
  , model_(editor.mesh(), metric, 0.0)
  , improver_(editor, this->model_, this->caps_, options)
{
  this->improver_.setGrowth(std::numeric_limits<long>::max() / 2);
  for (Index p = 0; p < this->mesh().numberOfPointSlots(); ++p)
  {
    if (this->mesh().isPointAlive(p))
    {
      this->sample(p, None);
    }
  }
}

/// Takes over the metric at p; `near`: a point whose neighbourhood p is in, if p is new or has moved.
template <int D>
void SizeStage<D>::sample(Index p, Index near)
{
  if (near != None)
  {
    this->metric_.resample(p, this->mesh().point(p), near);
  }
  if (static_cast<Index>(this->units_.size()) <= p)
  {
    this->units_.resize(this->mesh().numberOfPointSlots(), Tensor<D>::Identity());
  }
  this->units_[p] = this->metric_.unitTensor(p);
}

template <int D>
double SizeStage<D>::length(Index a, Index b) const
{
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  return logMeanLength(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) / this->scale_;
}

template <int D>
double SizeStage<D>::worstOf(const std::vector<Index>& cells) const
{
  double worst = std::numeric_limits<double>::infinity();
  for (Index c : cells)
  {
    worst = std::min(worst, this->mesh().quality(c));
  }
  return worst;
}

/// Whether all these cells are better than `least`; their qualities go to qualities_.
template <int D>
bool SizeStage<D>::measure(const std::vector<Simplex<D>>& cells, double least)
{
  this->qualities_.clear();
  for (const Simplex<D>& c : cells)
  {
    this->qualities_.push_back(this->model_(c));
    if (!(this->qualities_.back() > least))
    {
      return false;
    }
  }
  return true;
}

template <int D>
void SizeStage<D>::push(Index c, bool isLong)
{
  for (const auto& e : Local<D>::edges)
  {
    const Index p = this->mesh().nodes(c)[e[0]], q = this->mesh().nodes(c)[e[1]];
    const Index a = std::min(p, q), b = std::max(p, q);
    const double l = this->length(a, b);
    if (isLong ? l > this->longest_ : l < Shortest)
    {
      this->queue_.push({ isLong ? l : -l, a, b, c });
    }
  }
}

template <int D>
void SizeStage<D>::collectQueue(bool isLong)
{
  this->queue_ = Queue();
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    if (this->mesh().isAlive(c))
    {
      this->push(c, isLong);
    }
  }
}

/// After a replacement: swaps edges near the new cells as long as that helps.
template <int D>
template <class Push>
void SizeStage<D>::swapAround(Push&& push)
{
  this->stack_ = this->editor_.created();
  while (!this->stack_.empty())
  {
    const Index c = this->stack_.back();
    this->stack_.pop_back();
    if (!this->mesh().isAlive(c))
    {
      continue;
    }
    if (this->options_.reconnect && this->improver_.swap(c))
    {
      this->stack_.insert(this->stack_.end(), this->improver_.changed().begin(),
        this->improver_.changed().end());
    }
    else
    {
      push(c);
    }
  }
}

// --- edges that are too long

template <int D>
double SizeStage<D>::longestEdge() const
{
  double longest = 0.0;
  for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
  {
    for (int e = 0; this->mesh().isAlive(c) && e < Local<D>::numberOfEdges; ++e)
    {
      const Simplex<D>& nodes = this->mesh().nodes(c);
      longest = std::max(
        longest, this->length(nodes[Local<D>::edges[e][0]], nodes[Local<D>::edges[e][1]]));
    }
  }
  return longest;
}

/// No cell has an edge that is much longer: that comes first, and where it must stay (the surface is
/// kept) sizes can only grow finer from layer to layer.
template <int D>
bool SizeStage<D>::isAboutLongest(const std::vector<Index>& cells, double length) const
{
  for (Index c : cells)
  {
    for (const auto& e : Local<D>::edges)
    {
      if (LongestFirst * this->length(this->mesh().nodes(c)[e[0]], this->mesh().nodes(c)[e[1]]) >
        length)
      {
        return false;
      }
    }
  }
  return true;
}

template <int D>
long SizeStage<D>::split()
{
  long done = 0;
  this->collectQueue(true);
  while (!this->queue_.empty() && this->options_.insertNodes)
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    if (!this->mesh().isAlive(edge.cell) || this->mesh().localIndex(edge.cell, edge.a) < 0 ||
      this->mesh().localIndex(edge.cell, edge.b) < 0 || !this->splitEdge(edge))
    {
      continue;
    }
    ++done;
    this->swapAround([this](Index c) { this->push(c, true); });
    if (done % 256 == 0 && !this->keepGoing(0))
    {
      break;
    }
  }
  this->splits_ += done;
  return done;
}

template <int D>
bool SizeStage<D>::splitEdge(const Edge& edge)
{
  const Index a = edge.a, b = edge.b;
  const Vec<D> e = this->mesh().point(b) - this->mesh().point(a);
  // Exact halves would make a grid of equal triangles, half or twice the wanted size, in which
  // nothing gains.
  const double t = metricMiddle(lengthIn<D>(this->units_[a], e), lengthIn<D>(this->units_[b], e)) +
    Jitter * noise(a, b);
  Vec<D> x = this->mesh().point(a) + t * e;
  CurvePlace<D> place;
  if constexpr (D == 2)
  {
    const int i =
      3 - this->mesh().localIndex(edge.cell, a) - this->mesh().localIndex(edge.cell, b);
    const bool kept = this->mesh().isConstrained(edge.cell, i);
    const auto span =
      kept && this->curves_ ? this->curves_->span(this->mesh(), a, b) : std::nullopt;
    if (kept && !span)
    {
      return false;
    }
    if (span)
    {
      place.curve = span->piece;
      place.parameter = span->from + t * (span->to - span->from);
      x = this->curves_->at(place.curve, place.parameter);
    }
  }
  const Index p = this->editor_.addPoint(x);
  this->sample(p, a);
  if (this->change_.split(this->editor_, this->curves_, edge.cell, a, b, p) &&
    this->isAboutLongest(this->change_.cavity, edge.length))
  {
    const double worst = this->worstOf(this->change_.cavity);
    if (this->measure(this->change_.cells, std::min(0.3 * worst, GoodEnough)))
    {
      this->editor_.setCurvePlace(p, place);
      this->editor_.replace(this->change_.cavity, this->change_.cells, this->qualities_,
        this->change_.keptChange());
      return true;
    }
  }
  this->editor_.dropPoint(p);
  return false;
}

// --- edges that are too short

template <int D>
long SizeStage<D>::contract()
{
  long done = 0;
  this->collectQueue(false);
  EdgeChange<D> best;
  while (!this->queue_.empty() && this->options_.removeNodes)
  {
    const Edge edge = this->queue_.top();
    this->queue_.pop();
    if (!this->mesh().isAlive(edge.cell) || this->mesh().localIndex(edge.cell, edge.a) < 0 ||
      this->mesh().localIndex(edge.cell, edge.b) < 0)
    {
      continue;
    }
    double above = -std::numeric_limits<double>::infinity();
    const bool first = this->contractEdge(edge.a, edge.b, above, best);
    const bool second = this->contractEdge(edge.b, edge.a, above, best);
    if (!first && !second)
    {
      continue;
    }
    this->measure(best.cells, -std::numeric_limits<double>::infinity());
    this->editor_.replace(best.cavity, best.cells, this->qualities_, best.keptChange());
    ++done;
    this->swapAround([this](Index c) { this->push(c, false); });
    if (done % 256 == 0 && !this->keepGoing(0))
    {
      break;
    }
  }
  this->contractions_ += done;
  return done;
}

/// Whether v can go to u such that the worst cell is better than `above`, which then is that worst.
template <int D>
bool SizeStage<D>::contractEdge(Index v, Index u, double& above, EdgeChange<D>& best)
{
  if (!this->change_.contract(this->editor_, this->curves_, v, u))
  {
    return false;
  }
  if constexpr (D == 2)
  {
    if (this->change_.changesKept)
    {
      const std::array<Index, 2>& came = this->change_.kept.come[0];
      if (!keepsShape(*this->curves_, this->mesh(), v, came[0], came[1]))
      {
        return false;
      }
    }
  }
  const double least =
    std::max(above, std::max(0.0, std::min(this->worstOf(this->change_.cavity), GoodEnough)));
  if (!this->measure(this->change_.cells, least))
  {
    return false;
  }
  double longest = Longest;
  for (Index c : this->change_.cavity)
  {
    for (Index w : this->mesh().nodes(c))
    {
      longest = w != v ? std::max(longest, this->length(v, w)) : longest;
    }
  }
  for (const Simplex<D>& cell : this->change_.cells)
  {
    for (Index w : cell)
    {
      if (w != u && this->length(w, u) > longest)
      {
        return false;
      }
    }
  }
  above = *std::min_element(this->qualities_.begin(), this->qualities_.end());
  best = this->change_;
  return true;
}

// --- nodes

/// Sum of the squares of ln l over the edges at v, whose star is star_.
template <int D>
double SizeStage<D>::energyAround(Index v)
{
  double sum = 0.0;
  for (Index w : this->neighbours_)
  {
    const double l = std::log(this->length(v, w));
    sum += l * l;
  }
  return sum;
}

/// Puts v at x if its edges get nearer to the wanted length and no cell gets bad.
template <int D>
bool SizeStage<D>::tryPlace(
  Index v, const Vec<D>& x, const CurvePlace<D>& place, double worst, double energy)
{
  const std::size_t start = this->editor_.begin();
  const auto sampleBefore = this->metric_.sample(v);
  const Tensor<D> unit = this->units_[v];
  this->editor_.movePoint(v, x);
  this->editor_.setCurvePlace(v, place);
  this->sample(v, v);
  bool good = this->energyAround(v) < WorthMoving * energy;
  for (std::size_t k = 0; k < this->star_.size() && good; ++k)
  {
    const double q = this->model_(this->mesh().nodes(this->star_[k]));
    good = q > 0.0 && q >= std::min(worst, 2.0 * GoodEnough);
    this->editor_.setQuality(this->star_[k], q);
  }
  if (good)
  {
    this->editor_.commit(start);
  }
  else
  {
    this->editor_.rollback(start);
    this->metric_.setSample(v, sampleBefore);
    this->units_[v] = unit;
  }
  return good;
}

template <int D>
bool SizeStage<D>::moveNode(Index v)
{
  const auto& point = this->mesh().pointData(v);
  this->editor_.star(v, this->star_);
  this->neighbours_.clear();
  for (Index c : this->star_)
  {
    for (Index w : this->mesh().nodes(c))
    {
      if (w != v)
      {
        this->neighbours_.push_back(w);
      }
    }
  }
  std::sort(this->neighbours_.begin(), this->neighbours_.end());
  this->neighbours_.erase(
    std::unique(this->neighbours_.begin(), this->neighbours_.end()), this->neighbours_.end());
  if (static_cast<Index>(this->failedAt_.size()) <= v)
  {
    this->failedAt_.resize(this->mesh().numberOfPointSlots(), 0);
  }
  std::uint32_t latest = point.stamp;
  for (Index w : this->neighbours_)
  {
    latest = std::max(latest, this->mesh().pointData(w).stamp);
  }
  if (latest <= this->failedAt_[v])
  {
    return false; // nothing has changed since it failed
  }
  this->failedAt_[v] = this->editor_.clock();
  const double worst = this->worstOf(this->star_), energy = this->energyAround(v);
  const Vec<D> x = point.x;
  CurvePlace<D> place = point;
  if constexpr (D == 2)
  {
    if (this->mesh().isFixed(v))
    {
      const std::vector<Index> ends = neighboursOnPiece(this->mesh(), this->star_, v);
      if (ends.size() != 2)
      {
        return false;
      }
      const auto low = this->curves_->span(this->mesh(), v, ends[0]);
      const auto high = this->curves_->span(this->mesh(), v, ends[1]);
      if (!low || !high)
      {
        return false;
      }
      // towards the end that is farther away
      const double l0 = this->length(v, ends[0]), l1 = this->length(v, ends[1]);
      const double to = l0 > l1 ? low->to : high->to;
      const double s = place.parameter;
      for (double part : { 0.5, 0.25 })
      {
        place.parameter = s + part * std::fabs(l0 - l1) / std::max(l0, l1) * (to - s);
        if (this->tryPlace(
              v, this->curves_->at(place.curve, place.parameter), place, worst, energy))
        {
          return true;
        }
      }
      return false;
    }
  }
  // the mean of where each edge would put v to be of the wanted length
  Vec<D> target = Vec<D>::Zero();
  for (Index w : this->neighbours_)
  {
    const Vec<D>& y = this->mesh().point(w);
    target += y + (x - y) / this->length(v, w);
  }
  target /= static_cast<double>(this->neighbours_.size());
  for (double part : { 1.0, 0.5, 0.25 })
  {
    if (this->tryPlace(v, Vec<D>(x + part * (target - x)), place, worst, energy))
    {
      return true;
    }
  }
  return false;
}

template <int D>
void SizeStage<D>::smooth()
{
  for (int sweep = 0; sweep < Sweeps && this->options_.moveNodes; ++sweep)
  {
    for (Index v = 0; v < this->mesh().numberOfPointSlots(); ++v)
    {
      if (!this->mesh().isPointAlive(v))
      {
        continue;
      }
      bool mayMove = !this->mesh().isFixed(v);
      if constexpr (D == 2)
      {
        mayMove |= this->mesh().pointData(v).curve != None;
      }
      this->motions_ += mayMove && this->moveNode(v);
    }
    this->swapWhatChanged();
  }
}

/// Swaps edges of cells around which something has changed since the last call.
template <int D>
void SizeStage<D>::swapWhatChanged()
{
  const std::uint32_t since = std::exchange(this->swappedAt_, this->editor_.clock());
  for (Index c = 0; c < this->mesh().numberOfCellSlots() && this->options_.reconnect; ++c)
  {
    const auto isNew = [&](Index p) { return this->mesh().pointData(p).stamp > since; };
    while (this->mesh().isAlive(c) &&
      std::any_of(this->mesh().nodes(c).begin(), this->mesh().nodes(c).end(), isNew) &&
      this->improver_.swap(c))
    {
    }
  }
}

// --- the whole

template <int D>
bool SizeStage<D>::keepGoing(int round)
{
  const bool inTime = this->options_.timeLimit <= 0.0 ||
    std::chrono::duration<double>(std::chrono::steady_clock::now() - this->begin_).count() <
      this->options_.timeLimit;
  return inTime &&
    this->progress_.report(0.5 * round / MaximumRounds,
      [] { return std::string("making edges as long as wanted"); });
}

template <int D>
void SizeStage<D>::record(int round)
{
  // The history is about the quality that the caller wants.
  computeQualities<D>(this->editor_, this->metric_, this->options_.measure, this->options_.beta);
  PassRecord row = summarize(this->mesh(), this->options_.targetQuality);
  computeQualities<D>(this->editor_, this->metric_, Measure::Shape, 0.0);
  row.stage = "sizes, round " + std::to_string(round + 1);
  row.done = this->improver_.done;
  row.tried = this->improver_.tried;
  for (const auto& [op, count] :
    { std::pair{ Operation::NodeInsertion, this->splits_ },
      std::pair{ Operation::EdgeContraction, this->contractions_ },
      std::pair{ Operation::NodeMotion, this->motions_ } })
  {
    row.done[static_cast<int>(op)] += count;
    row.tried[static_cast<int>(op)] += count;
  }
  this->improver_.done.fill(0);
  this->improver_.tried.fill(0);
  this->splits_ = this->contractions_ = this->motions_ = 0;
  row.pass = static_cast<int>(this->report_.history.size());
  this->report_.history.push_back(row);
}

/// Edges are halved round by round: to split a long edge to the end at once would make its
/// neighbourhood fine in all directions, also where it is to be so in one only.
template <int D>
bool SizeStage<D>::run()
{
  const double predicted = this->metric_.predictedNumberOfElements(this->mesh());
  this->longest_ = std::max(Longest, 0.5 * this->longestEdge());
  int corrections = 0;
  for (int round = 0, last = MaximumRounds; round < last; ++round)
  {
    long changes = this->contract(); // first: what is too fine in one direction is split in another
    changes += this->split();
    changes += this->contract();
    this->smooth();
    this->record(round);
    if (!this->keepGoing(round))
    {
      return false;
    }
    if (this->longest_ > Longest)
    {
      this->longest_ = std::max(Longest, 0.5 * this->longest_);
      ++last; // these rounds do not count
      continue;
    }
    const double cells = static_cast<double>(this->report_.history.back().cells);
    if (static_cast<double>(changes) > FewChanges * cells)
    {
      continue;
    }
    const double ratio = cells / predicted;
    if (std::fabs(ratio - 1.0) < CountTolerance || corrections++ == MaximumCorrections)
    {
      break;
    }
    this->scale_ = std::clamp(
      this->scale_ * std::pow(ratio, 1.0 / D), 1.0 / GreatestScale, GreatestScale);
    this->failedAt_.clear();
  }
  return true;
}
}

template <int D>
bool followSizes(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, const BoundaryCurves* curves, Report& report)
{
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  return SizeStage<D>(editor, metric, options, control, curves, report).run();
}

template bool followSizes<2>(MeshEditor<2>&, NodalMetric<2>&, const Options&, const Control&,
  const BoundaryCurves*, Report&);
template bool followSizes<3>(MeshEditor<3>&, NodalMetric<3>&, const Options&, const Control&,
  const BoundaryCurves*, Report&);
}
