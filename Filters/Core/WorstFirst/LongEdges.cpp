// SPDX-License-Identifier: BSD-3-Clause
// From a bad cell to the longest edge nearby, which is divided; until the cell has gone.
#include "WorstFirst/LongEdges.h"

#include "WorstFirst/EdgeDivider.h"

#include <queue>
#include <set>
#include <tuple>

namespace meshopt
{
namespace
{
/// At most this many divisions follow each other at one place: for tetrahedra it is not proved that
/// divisions of longest edges end at good shapes.
constexpr int MostGenerations = 6;
constexpr int DivisionsPerLook = 64; ///< between two looks at the clock

class LongEdges
{
public:
  LongEdges(Run<3>& run, EdgeDivider& divider)
    : run_(run)
    , divider_(divider)
    , worst_(run.mesh().worstQuality(divider.bad()))
  {
    for (Index c : divider.bad())
    {
      this->push(c, 0);
    }
  }

  long divide(double partsBelow);

private:
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

  Run<3>& run_;
  EdgeDivider& divider_;
  double worst_; ///< shape, at first
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

/// The growth ends it: each division adds at least one cell. A cell that waits stays in the queue
/// until it has gone: the edge that is divided for it may be far away.
long LongEdges::divide(double partsBelow)
{
  Judge<3, EdgeDivider::Shape>& judge = this->divider_.judge();
  long done = 0;
  while (!this->queue_.empty() && !judge.growth.isShort)
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
    if (this->divider_.divide(cell, edge.a, edge.b, EdgeDivider::Where::Surface) == None)
    {
      this->refused_.insert({ edge.a, edge.b });
      continue;
    }
    for (Index c : judge.changed())
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
}

long divideLongEdges(Run<3>& run, double below, double partsBelow)
{
  EdgeDivider divider(run, below);
  const long done = LongEdges(run, divider).divide(partsBelow);
  divider.record("long edges divided", done > 0);
  return done;
}
}
