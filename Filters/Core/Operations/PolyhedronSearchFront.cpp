// SPDX-License-Identifier: BSD-3-Clause
// The front of the search, that is the open facets, and what must not come any more: edges that
// would cross a facet, and facets that would cross an edge. All are sets of points, as bits.
#include "Operations/PolyhedronSearch.h"

#include "Base/Scramble.h"

#include <algorithm>

namespace meshopt
{
using namespace pointset;

// --- what crosses what

/// Blocks the edges that cross facet (i, j, k).
void PolyhedronSearch::blockEdges(State& s, int i, int j, int k) const
{
  const PointSigns& at = this->signs_;
  const Mask up = at.above(i, j, k), down = at.above(j, i, k);
  for (int a = 0; a < at.size(); ++a)
  {
    // The other end must lie on the other side of the facet, within the cone of a over the facet.
    const Mask other = has(up, a) ? down : has(down, a) ? up : 0;
    s.blocked[a] |= other &
      ((at.above(i, j, a) & at.above(j, k, a) & at.above(k, i, a)) |
        (at.above(j, i, a) & at.above(k, j, a) & at.above(i, k, a)));
  }
}

/// Whether all points lie on one side of some plane through edge (a, b): then it crosses no facet.
/// So it is with nearly all edges of a polyhedron.
bool PolyhedronSearch::isOutermost(int a, int b) const
{
  for (int i = 0; i < this->signs_.size(); ++i)
  {
    // Points on the line itself have nothing on either side.
    if ((this->signs_.above(a, b, i) == 0) != (this->signs_.above(b, a, i) == 0))
    {
      return true;
    }
  }
  return false;
}

/// Finds the facets that edge (a, b) crosses. Facets with an edge that is blocked from the start
/// are left out.
void PolyhedronSearch::findCrossing(int a, int b)
{
  const PointSigns& at = this->signs_;
  const Mask* blocked = this->states_[0].blocked;
  // Signs do not change when three points are rotated: all are read along rows of the table.
  const Mask *left = at.row(a, b), *right = at.row(b, a);
  Mask* row = &this->crossing_[pairOf(a, b) * choose2(at.size())];
  for (int j = 1; j < at.size(); row += j, ++j)
  {
    const Mask leftOf = left[j], rightOf = right[j];
    const Mask *aj = at.row(a, j), *ja = at.row(j, a), *bj = at.row(b, j), *jb = at.row(j, b);
    for (int i = 0; i < j; ++i)
    {
      // i, j and k lie around the line through a and b, in this order or the other way round
      const Mask isLeft = 0u - ((left[i] >> j) & 1u), isRight = 0u - ((right[i] >> j) & 1u);
      const Mask k = (isLeft & leftOf & right[i]) | (isRight & rightOf & left[i]);
      // and a and b lie on different sides of the facet
      const Mask isFree = ((blocked[i] >> j) & 1u) - 1u;
      row[i] = k & isFree & ((ja[i] & bj[i]) | (aj[i] & jb[i]));
    }
  }
}

/// Blocks the facets that edge (a, b) crosses.
void PolyhedronSearch::blockFacets(State& s, int a, int b)
{
  // On demand: most searches meet few of the possible edges.
  Crossing& state = this->crossingState_[pairOf(a, b)];
  if (state == Crossing::Unknown)
  {
    state = this->isOutermost(a, b) ? Crossing::None : Crossing::Some;
    if (state == Crossing::Some)
    {
      this->findCrossing(a, b);
    }
  }
  if (state == Crossing::None)
  {
    return;
  }
  const int pairs = choose2(this->signs_.size());
  const Mask* row = &this->crossing_[pairOf(a, b) * pairs];
  for (int k = 0; k < pairs; ++k)
  {
    s.third[k] |= row[k];
  }
}

// --- the front

void PolyhedronSearch::copy(const State& from, State& to) const
{
  // Only the parts in use: a State is large, and each step of the search copies one.
  const int n = this->signs_.size();
  to.facets = from.facets;
  to.used = from.used;
  to.dropped = from.dropped;
  to.hash = from.hash;
  std::copy_n(from.front, from.facets, to.front);
  std::copy_n(from.edges, n, to.edges);
  std::copy_n(from.blocked, n, to.blocked);
  std::copy_n(from.third, choose2(n), to.third);
  std::copy_n(from.open, n * n, to.open);
}

/// An edge that is there already blocks nothing new.
void PolyhedronSearch::addEdge(State& s, int a, int b)
{
  if (!has(s.edges[a], b))
  {
    s.edges[a] |= bit(b);
    s.edges[b] |= bit(a);
    this->blockFacets(s, a, b);
  }
}

/// Adds (a, b, c) to the front. The hash combines the facets in any order: equal fronts have equal
/// hashes, however they were reached.
void PolyhedronSearch::open(State& s, int a, int b, int c)
{
  const int n = this->signs_.size(), side = sideOf(a, b, c);
  s.front[s.facets++] = { std::uint8_t(a), std::uint8_t(b), std::uint8_t(c), std::uint16_t(side) };
  s.open[a * n + b] |= bit(c);
  s.open[b * n + c] |= bit(a);
  s.open[c * n + a] |= bit(b);
  // Exclusive or: the same once more takes the facet out of the hash.
  s.hash ^= scramble(side);
  this->blockEdges(s, a, b, c);
}

/// Removes (a, b, c) from the front; it must be there. It cannot become open again.
void PolyhedronSearch::close(State& s, int a, int b, int c) const
{
  const int n = this->signs_.size(), side = sideOf(a, b, c);
  int k = 0;
  while (s.front[k].side != side)
  {
    ++k;
  }
  s.front[k] = s.front[--s.facets];
  s.open[a * n + b] &= ~bit(c);
  s.open[b * n + c] &= ~bit(a);
  s.open[c * n + a] &= ~bit(b);
  s.third[pairOf(a, b)] |= bit(c);
  s.third[pairOf(b, c)] |= bit(a);
  s.third[pairOf(c, a)] |= bit(b);
  s.hash ^= scramble(side);
}

/// The front after tetrahedron (f, p) was placed.
void PolyhedronSearch::place(const Front& f, int p, const State& s, State& next)
{
  this->copy(s, next);
  next.used |= bit(p);
  // A point inside can belong to no cell any more.
  next.dropped |= this->signs_.inside(f.a, f.b, f.c, p);
  this->close(next, f.a, f.b, f.c);
  this->addEdge(next, f.a, p);
  this->addEdge(next, f.b, p);
  this->addEdge(next, f.c, p);
  const int n = this->signs_.size(), ring[4] = { f.a, f.b, f.c, f.a };
  for (int k = 0; k < 3; ++k)
  {
    // A facet that is open from the other side is now filled from both sides; otherwise it opens.
    const int a = ring[k], b = ring[k + 1];
    has(next.open[b * n + a], p) ? this->close(next, b, a, p) : this->open(next, a, b, p);
  }
}
}
