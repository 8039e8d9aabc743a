// SPDX-License-Identifier: BSD-3-Clause
// From a bad cell to the longest edge nearby, which is divided; until the cell has gone.
#include "WorstFirst/LongEdges.h"

#include "Edit/Judge.h"
#include "Operations/EdgeSplit.h"
#include "Quality/Shape.h"

#include <queue>
#include <set>
#include <tuple>

namespace meshopt
{
namespace
{
/// A division may lower the worst quality around it to this part: halves are worse at first.
constexpr double WorstDivision = 0.2;
/// At most this many divisions follow each other at one place: for tetrahedra it is not proved that
/// divisions of longest edges end at good shapes.
constexpr int MostGenerations = 6;
constexpr int DivisionsPerLook = 64; ///< between two looks at the clock

class LongEdges
{
public:
  /// `below`: of the stored qualities, whatever their measure. From then on they are shapes.
  LongEdges(Run<3>& run, double below)
    : run_(run)
    , model_(run.mesh(), run.metric, 0.0)
    , judge_(run.editor, this->model_, run.options, run.surface)
  {
    this->judge_.growth.left = run.growth;
    std::vector<Index> bad;
    for (Index c = 0; c < run.mesh().numberOfCellSlots(); ++c)
    {
      if (run.mesh().isAlive(c) && run.mesh().quality(c) < below)
      {
        bad.push_back(c);
      }
    }
    // From here on `partsBelow` compares shapes, whatever the caller measures.
    computeQualities<3>(run.editor, run.metric, Measure::Shape, 0.0);
    this->worst_ = run.mesh().worstQuality(bad);
    for (Index c : bad)
    {
      this->push(c, 0);
    }
  }

  long divide(double partsBelow);
  void record(bool isRow);

private:
  using Shape = MeanEdgeShape<3>;

  /// The longest is the greatest; of equal lengths the one with the greatest ids.
  struct Edge
  {
    double length; ///< squared
    Index a, b;    ///< a < b
    bool operator<(const Edge& o) const
    {
      return std::tie(this->length, this->a, this->b) < std::tie(o.length, o.a, o.b);
    }
  };

  /// A cell that waits. Its id may be another cell's by now: the quality tells.
  struct Entry
  {
    double quality;
    Index cell;
    int generation;                      ///< divisions that it comes of
    bool operator<(const Entry& o) const // the worst comes first
    {
      return std::tie(o.quality, o.cell) < std::tie(this->quality, this->cell);
    }
  };

  const SimplexMesh<3>& mesh() const { return this->run_.mesh(); }
  bool waits(const Entry& entry) const
  {
    return this->mesh().isAlive(entry.cell) && this->mesh().quality(entry.cell) == entry.quality;
  }
  void push(Index c, int generation)
  {
    this->queue_.push({ this->mesh().quality(c), c, generation });
  }
  Edge longestOf(Index c) const;
  Edge longestNearby(Index c, Index& cell);
  bool divide(Index c, const Edge& edge);
  bool divideAt(Index c, const Edge& edge, const Vec<3>& x, const Place& place);
  bool findPatch(Index c, const Edge& edge, Index& patch, bool& isKept);

  Run<3>& run_;
  double worst_ = 0.0; ///< shape, at first
  QualityModel<3, Shape> model_;
  Judge<3, Shape> judge_;
  Proposal<3> proposal_;
  std::priority_queue<Entry> queue_;
  std::set<std::array<Index, 2>> refused_;
  std::vector<Index> ring_;
};

LongEdges::Edge LongEdges::longestOf(Index c) const
{
  Edge longest{ -1.0, None, None };
  for (const auto& e : Local<3>::edges)
  {
    const Index p = this->mesh().nodes(c)[e[0]], q = this->mesh().nodes(c)[e[1]];
    const double length = (this->mesh().point(p) - this->mesh().point(q)).squaredNorm();
    longest = std::max(longest, { length, std::min(p, q), std::max(p, q) });
  }
  return longest;
}

/// From cell c along ever longer edges to one that is the longest of all cells around it; `cell`:
/// one of them. It ends, since edges are in a total order and each step takes a greater one.
LongEdges::Edge LongEdges::longestNearby(Index c, Index& cell)
{
  Edge longest = this->longestOf(c);
  cell = c;
  for (bool isLongest = false; !isLongest;)
  {
    isLongest = true;
    this->mesh().ring(cell, longest.a, longest.b, true, this->ring_);
    for (Index other : this->ring_)
    {
      const Edge e = this->longestOf(other);
      if (longest < e)
      {
        longest = e;
        cell = other;
        isLongest = false;
      }
    }
  }
  return longest;
}

/// Whether the edge is in the surface, and on a patch of it or on a curve. False if it must stay.
bool LongEdges::findPatch(Index c, const Edge& edge, Index& patch, bool& isKept)
{
  patch = None;
  isKept = false;
  this->mesh().ring(c, edge.a, edge.b, true, this->ring_);
  for (Index other : this->ring_)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = this->mesh().facet(other, i);
      if (this->mesh().isKept(other, i) && hasId(f, edge.a) && hasId(f, edge.b))
      {
        // The least of its patches, so that it does not matter where the ring begins. None: locked.
        isKept = true;
        const Index p = this->mesh().patch(other, i);
        patch = patch == None ? p : std::min(patch, p);
      }
    }
  }
  return !isKept ||
    (patch != None && this->run_.surface &&
      this->run_.surface->mayDivide(this->mesh(), this->ring_, edge.a, edge.b));
}

bool LongEdges::divide(Index c, const Edge& edge)
{
  Index patch = None;
  bool isKept = false;
  if (!this->findPatch(c, edge, patch, isKept))
  {
    return false;
  }
  const Vec<3> middle = 0.5 * (this->mesh().point(edge.a) + this->mesh().point(edge.b));
  if (!isKept)
  {
    return this->divideAt(c, edge, middle, {});
  }
  // In the surface that the edge stands for; if that is too far, where the edge is.
  const auto span = this->run_.surface->span(this->mesh(), edge.a, edge.b);
  Place place = span ? Place{ Freedom::Curve, span->part, 0.5 * (span->from + span->to) }
                     : Place{ Freedom::Patch, patch, 0.0 };
  Vec<3> x = middle;
  if (span)
  {
    x = this->run_.surface->at(span->part, place.parameter);
  }
  else
  {
    place = this->run_.surface->project(place, middle, x);
  }
  if (this->divideAt(c, edge, x, place))
  {
    return true;
  }
  place = this->run_.surface->placeNear(place, middle, x);
  return this->divideAt(c, edge, x, place);
}

bool LongEdges::divideAt(Index c, const Edge& edge, const Vec<3>& x, const Place& place)
{
  MeshEditor<3>& editor = this->run_.editor;
  const auto mark = this->judge_.begin();
  const Index p = editor.addPoint(x, edge.a, place);
  bool done = p != None &&
    proposeSplit(editor, this->run_.surface, { c, edge.a, edge.b, p }, this->proposal_);
  if (done)
  {
    this->proposal_.least = WorstDivision * this->proposal_.oldWorst;
    this->judge_.start();
    done = this->judge_.measure(this->proposal_) && this->judge_.accept(this->proposal_);
  }
  this->judge_.end(mark, done);
  this->judge_.count(Operation::NodeInsertion, done);
  return done;
}

/// The growth ends it: each division adds at least one cell. A cell that waits stays in the queue
/// until it has gone: the edge that is divided for it may be far away.
long LongEdges::divide(double partsBelow)
{
  long done = 0;
  while (!this->queue_.empty() && !this->judge_.growth.isShort)
  {
    const Entry entry = this->queue_.top();
    Index cell = None;
    const bool waits = this->waits(entry);
    const Edge edge = waits ? this->longestNearby(entry.cell, cell) : Edge{};
    if (!waits || this->refused_.count({ edge.a, edge.b }) > 0)
    {
      this->queue_.pop();
      continue;
    }
    // The next look at the waiting cell leads here again, and gives it up.
    if (!this->divide(cell, edge))
    {
      this->refused_.insert({ edge.a, edge.b });
      continue;
    }
    for (Index c : this->judge_.changed())
    {
      if (this->mesh().quality(c) < partsBelow * this->worst_ && entry.generation < MostGenerations)
      {
        this->push(c, entry.generation + 1);
      }
    }
    if (++done % DivisionsPerLook == 0 &&
      !this->run_.clock.goesOn(0.0, [] { return std::string("dividing long edges"); }))
    {
      break;
    }
  }
  return done;
}

/// Computes the qualities in the caller's measure again.
void LongEdges::record(bool isRow)
{
  const Options& o = this->run_.options;
  computeQualities<3>(this->run_.editor, this->run_.metric, o.measure, o.beta);
  if (isRow)
  {
    this->run_.record("long edges divided", this->judge_);
  }
}
}

long divideLongEdges(Run<3>& run, double below, double partsBelow)
{
  LongEdges edges(run, below);
  const long done = edges.divide(partsBelow);
  edges.record(done > 0);
  return done;
}
}
