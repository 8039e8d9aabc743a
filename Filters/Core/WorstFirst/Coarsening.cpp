// SPDX-License-Identifier: BSD-3-Clause
// Node by node, in the order of their numbers: into the neighbour beside which the worst new cell
// is best.
#include "WorstFirst/Coarsening.h"

#include "Base/SortUnique.h"
#include "Edit/Judge.h"
#include "Operations/EdgeContraction.h"
#include "Quality/Shape.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace meshopt
{
namespace
{
constexpr int NodesPerLook = 256; ///< between two looks at the clock

class Coarsening
{
public:
  /// Stored qualities are shapes from then on, whatever the caller measures.
  explicit Coarsening(Run<3>& run)
    : run_(run)
    , model_(run.mesh(), run.metric, 0.0)
    , judge_(run.editor, this->model_, run.options, run.surface)
    , stays_(run.mesh().numberOfPointSlots(), 0)
  {
    computeQualities<3>(run.editor, run.metric, Measure::Shape, 0.0);
  }

  long remove(double above, long most);
  void record(bool isRow);

private:
  using Shape = MeanEdgeShape<3>;

  const SimplexMesh<3>& mesh() const { return this->run_.mesh(); }
  bool mayVanish(Index v) const
  {
    const Freedom freedom = this->mesh().freedom(v);
    return !this->stays_[v] && this->mesh().isPointAlive(v) &&
      this->mesh().cellOfPoint(v) != None && freedom != Freedom::Fixed &&
      freedom != Freedom::Corner;
  }
  void collectNeighbours(Index v);
  bool propose(Index v, Index u, double floor);
  bool removeNode(Index v, double floor);

  Run<3>& run_;
  QualityModel<3, Shape> model_;
  Judge<3, Shape> judge_;
  std::vector<char> stays_; ///< by point: a neighbour has vanished
  Proposal<3> proposal_;
  std::vector<Index> star_, neighbours_;
  std::vector<std::pair<double, Index>> ways_; ///< worst new cell, negative; neighbour
};

void Coarsening::collectNeighbours(Index v)
{
  this->neighbours_.clear();
  for (Index c : this->star_)
  {
    const Simplex<3>& nodes = this->mesh().nodes(c);
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(this->neighbours_),
      [&](Index u) { return u != v; });
  }
  sortUnique(this->neighbours_);
}

bool Coarsening::propose(Index v, Index u, double floor)
{
  Proposal<3>& p = this->proposal_;
  if (!proposeContraction(this->run_.editor, this->run_.surface, v, u, p))
  {
    return false;
  }
  p.least = floor;
  return this->judge_.measure(p);
}

/// The best way first: the surface, whose answer is expensive, may forbid it.
bool Coarsening::removeNode(Index v, double floor)
{
  this->run_.editor.star(v, this->star_);
  this->collectNeighbours(v);
  this->ways_.clear();
  for (Index u : this->neighbours_)
  {
    if (this->propose(v, u, floor))
    {
      this->ways_.emplace_back(-this->proposal_.newWorst, u);
    }
  }
  std::sort(this->ways_.begin(), this->ways_.end());
  for (const auto& [negative, u] : this->ways_)
  {
    this->judge_.start();
    if (this->propose(v, u, floor) && this->judge_.accept(this->proposal_))
    {
      return true;
    }
  }
  return false;
}

/// Those that stay are so many that a second look at all nodes would find little.
long Coarsening::remove(double above, long most)
{
  const double worst = summarize(this->mesh(), 0.0).worst;
  const double floor = std::min(this->run_.options.targetQuality, above * worst);
  const auto gone = [&] { return this->judge_.growth.left - AnyGrowth; };
  for (Index v = 0; v < this->mesh().numberOfPointSlots() && gone() < most; ++v)
  {
    if (v % NodesPerLook == 0 &&
      !this->run_.clock.goesOn(0.0, [] { return std::string("removing nodes"); }))
    {
      break;
    }
    if (this->mayVanish(v))
    {
      const bool done = this->removeNode(v, floor);
      this->judge_.count(Operation::EdgeContraction, done);
      for (std::size_t k = 0; k < this->neighbours_.size() && done; ++k)
      {
        this->stays_[this->neighbours_[k]] = 1;
      }
    }
  }
  return gone();
}

/// Computes the qualities in the caller's measure again.
void Coarsening::record(bool isRow)
{
  const Options& o = this->run_.options;
  computeQualities<3>(this->run_.editor, this->run_.metric, o.measure, o.beta);
  if (isRow)
  {
    this->run_.record("coarsened", this->judge_);
  }
}
}

long coarsen(Run<3>& run, double above, long most)
{
  Coarsening coarsening(run);
  const long gone = coarsening.remove(above, most);
  coarsening.record(gone > 0);
  return gone;
}
}
