// SPDX-License-Identifier: BSD-3-Clause
// The search: candidates, what strikes them out, and branch and bound over open facets. What a
// placed tetrahedron does to the open facets, and what it blocks: PolyhedronSearchFront.cpp.
#include "Operations/PolyhedronSearch.h"

#include "Base/Scramble.h"

#include <algorithm>
#include <utility>

namespace meshopt
{
using namespace pointset;

namespace
{
constexpr std::size_t Memory = 4096; // fronts remembered; a new one replaces an older one

/// Sorts two numbers; returns 1 if they were exchanged, else 0: the parity of the permutation.
int sort(int& a, int& b)
{
  const int odd = a > b, low = std::min(a, b);
  b = std::max(a, b);
  a = low;
  return odd;
}
}

// The combinatorial number system: it numbers the sets {a < b < c < d} without a gap.
int PolyhedronSearch::quadrupleOf(int a, int b, int c, int d)
{
  return a + choose2(b) + choose3(c) + choose4(d);
}

int PolyhedronSearch::sideOf(int a, int b, int c)
{
  // The lowest bit is the orientation: side ^ 1 is the same facet seen from behind.
  int odd = sort(a, b);
  odd ^= sort(b, c);
  odd ^= sort(a, b);
  return 2 * (a + choose2(b) + choose3(c)) + odd;
}

void PolyhedronSearch::clear()
{
  this->signs_.clear();
  this->mustStay_ = 0;
  this->boundary_.clear();
  this->candidates_.clear();
  this->solution_.clear();
}

void PolyhedronSearch::addPoint(const Vec<3>& x, bool stay)
{
  this->mustStay_ |= stay ? bit(this->signs_.size()) : 0;
  this->signs_.add(x);
  this->isOpened_ = this->isBlocked_ = false;
}

bool PolyhedronSearch::setBoundary(const std::vector<Triangle>& facets)
{
  this->candidates_.clear();
  this->solution_.clear();
  this->boundary_.clear();
  if (facets.size() > MaximumFacets)
  {
    return false;
  }
  this->boundary_ = facets;
  this->isOpened_ = this->isBlocked_ = false;
  return true;
}

/// Makes the first state: the boundary as the front, with all that its facets block.
void PolyhedronSearch::openBoundary()
{
  if (std::exchange(this->isOpened_, true))
  {
    return;
  }
  const int n = this->signs_.size();
  const std::size_t pairs = choose2(n);
  // Memory is only added: thousands of searches follow each other.
  this->states_.resize(std::max<std::size_t>(1, this->states_.size()));
  this->deadEnds_.resize(Memory);
  this->crossing_.resize(std::max(this->crossing_.size(), pairs * pairs));
  this->quality_.resize(std::max<std::size_t>(this->quality_.size(), choose4(n)));
  this->crossingState_.assign(pairs, Crossing::Unknown);
  State& s = this->states_[0];
  s.facets = 0;
  s.used = s.dropped = 0;
  s.hash = 0;
  std::fill_n(s.edges, n, 0);
  std::fill_n(s.blocked, n, 0);
  std::fill_n(s.third, choose2(n), 0);
  std::fill_n(s.open, n * n, 0);
  this->facetOfSide_.assign(2 * choose3(n), 0);
  for (const Triangle& f : this->boundary_)
  {
    this->open(s, f[0], f[1], f[2]);
    // Its number plus one: 0 is no facet.
    this->facetOfSide_[s.front[s.facets - 1].side] = static_cast<std::uint8_t>(s.facets);
    s.used |= bit(f[0]) | bit(f[1]) | bit(f[2]);
  }
  this->stay_ = this->mustStay_ | s.used;
}

/// Adds what the edges of the boundary block. After its facets: findCrossing() leaves out those
/// with edges that are blocked.
void PolyhedronSearch::blockByEdges()
{
  if (std::exchange(this->isBlocked_, true))
  {
    return;
  }
  State& s = this->states_[0];
  for (const Triangle& f : this->boundary_)
  {
    this->addEdge(s, f[0], f[1]);
    this->addEdge(s, f[1], f[2]);
    this->addEdge(s, f[2], f[0]);
  }
}

/// Points that may be the apex on f.
PolyhedronSearch::Mask PolyhedronSearch::apexes(const State& s, const Front& f) const
{
  const int n = this->signs_.size();
  // What is open already from this side must not open again.
  return this->apex_[f.side] &
    ~(s.blocked[f.a] | s.blocked[f.b] | s.blocked[f.c] | s.third[pairOf(f.a, f.b)] |
      s.third[pairOf(f.b, f.c)] | s.third[pairOf(f.c, f.a)] | s.open[f.a * n + f.b] |
      s.open[f.b * n + f.c] | s.open[f.c * n + f.a] | s.dropped);
}

// --- candidates

/// Points that may be the apex on facet k of the boundary, as far as is known to be blocked.
PolyhedronSearch::Mask PolyhedronSearch::apexesOn(int k) const
{
  const State& s = this->states_[0];
  const auto [a, b, c, side] = s.front[k];
  const Mask ab = s.third[pairOf(a, b)], bc = s.third[pairOf(b, c)], ca = s.third[pairOf(c, a)];
  const bool isBlocked = has(s.blocked[a], b) || has(s.blocked[b], c) || has(s.blocked[c], a) ||
    has(ab, c);
  return isBlocked
    ? 0
    : this->signs_.above(a, b, c) & ~(s.blocked[a] | s.blocked[b] | s.blocked[c] | ab | bc | ca);
}

/// Whether point p, one of apexesOn(), makes a candidate on facet k of the boundary.
bool PolyhedronSearch::fitsOn(int k, int p, Candidate& t) const
{
  const Front& f = this->states_[0].front[k];
  std::array<int, 4> n{ f.a, f.b, f.c, p };
  std::sort(n.begin(), n.end());
  return this->fits(n[0], n[1], n[2], n[3], t);
}

/// Each triple once, in rising order, with all its fourth points at a time, as a set.
void PolyhedronSearch::findCandidates()
{
  this->openBoundary();
  this->blockByEdges();
  this->candidates_.clear();
  const State& s = this->states_[0];
  for (int k = 2; k < this->signs_.size(); ++k)
  {
    // Only greater numbers: each set of four points is met once.
    const Mask later = ~(bit(k) | (bit(k) - 1));
    for (int j = 1; j < k; ++j)
    {
      if (has(s.blocked[j], k))
      {
        continue;
      }
      const Mask fit = later & ~(s.blocked[j] | s.blocked[k] | s.third[pairOf(j, k)]);
      for (int i = 0; i < j; ++i)
      {
        if (!has(s.blocked[i] | s.third[pairOf(i, j)], k) && !has(s.blocked[i], j))
        {
          this->addCandidates(i, j, k,
            fit & ~(s.blocked[i] | s.third[pairOf(i, j)] | s.third[pairOf(i, k)]) &
              (this->signs_.above(i, j, k) | this->signs_.above(j, i, k)));
        }
      }
    }
  }
}

/// Makes the candidate {i < j < k < l}. False if a point is inside that must stay, or if it lies
/// outside of a boundary facet.
bool PolyhedronSearch::fits(int i, int j, int k, int l, Candidate& t) const
{
  // sideOf() for three numbers in rising order: the lowest bit is the orientation.
  const auto triple = [](int a, int b, int c) { return 2 * (a + choose2(b) + choose3(c)); };
  const int odd = has(this->signs_.above(j, i, k), l);
  const int a = odd ? j : i, b = odd ? i : j;
  const std::array<int, 4> sides{ triple(b, k, l) + 1, triple(a, k, l), triple(i, j, l) + !odd,
    triple(i, j, k) + odd };
  t.nodes = { std::uint8_t(a), std::uint8_t(b), std::uint8_t(k), std::uint8_t(l) };
  bool outside = false;
  for (int m = 0; m < 4; ++m)
  {
    t.sides[m] = static_cast<std::uint16_t>(sides[m]);
    outside |= this->facetOfSide_[sides[m] ^ 1] != 0;
  }
  return !outside && !(this->signs_.inside(a, b, k, l) & this->stay_);
}

/// Adds {i < j < k < l} for all l in `apexes` that fit.
void PolyhedronSearch::addCandidates(int i, int j, int k, Mask apexes)
{
  Candidate t;
  for (; apexes; apexes &= apexes - 1)
  {
    if (this->fits(i, j, k, lowest(apexes), t))
    {
      this->candidates_.push_back(t);
    }
  }
}

/// Makes the candidates better than `bound` available. False if a facet of the boundary has none.
bool PolyhedronSearch::offer(double bound)
{
  this->bound_ = bound;
  this->apex_.assign(2 * choose3(this->signs_.size()), 0);
  this->alive_.clear();
  for (std::size_t k = 0; k < this->candidates_.size(); ++k)
  {
    const Candidate& t = this->candidates_[k];
    if (t.quality > bound)
    {
      this->alive_.push_back(static_cast<std::uint16_t>(k));
      const int i = std::min(t.nodes[0], t.nodes[1]), j = std::max(t.nodes[0], t.nodes[1]);
      this->quality_[quadrupleOf(i, j, t.nodes[2], t.nodes[3])] = t.quality;
      for (int m = 0; m < 4; ++m)
      {
        // At each of its sides a candidate is known by the point opposite to it.
        this->apex_[t.sides[m]] |= bit(t.nodes[m]);
      }
    }
  }
  const State& s = this->states_[0];
  for (int k = 0; k < s.facets; ++k)
  {
    if (this->apex_[s.front[k].side] == 0)
    {
      this->bareFacet_ = k;
      return false;
    }
  }
  return this->strike();
}

/// Removes candidates that are not better than bound_, or that no other can join at a facet, until
/// no such candidate is left. False as soon as a facet of the boundary has none.
bool PolyhedronSearch::strike()
{
  bool changed = true;
  // The removal of one candidate can leave its neighbours without a partner: hence the outer loop.
  while (changed)
  {
    changed = false;
    std::size_t kept = 0;
    for (std::uint16_t k : this->alive_)
    {
      const Candidate& t = this->candidates_[k];
      bool good = t.quality > this->bound_;
      for (int m = 0; m < 4 && good; ++m)
      {
        // Behind a side there must be another candidate, or the boundary.
        good = this->apex_[t.sides[m] ^ 1] != 0 || this->facetOfSide_[t.sides[m]] != 0;
      }
      if (good)
      {
        this->alive_[kept++] = k;
        continue;
      }
      changed = true;
      for (int m = 0; m < 4; ++m)
      {
        this->apex_[t.sides[m]] &= ~bit(t.nodes[m]);
        if (this->apex_[t.sides[m]] == 0 && this->facetOfSide_[t.sides[m]] != 0)
        {
          this->bareFacet_ = this->facetOfSide_[t.sides[m]] - 1;
          return false;
        }
      }
    }
    this->alive_.resize(kept);
  }
  return true;
}

// --- branch and bound

/// Without steps, if offer() shows that a facet of the boundary cannot be filled.
double PolyhedronSearch::search(double above, long steps)
{
  this->solution_.clear();
  this->placed_.clear();
  this->bareFacet_ = -1;
  this->steps_ = 0;
  this->ranOut_ = this->finished_ = false;
  this->budget_ = steps;
  this->salt_ = scramble(this->salt_); // what was remembered before does not match any more
  if (!this->offer(above))
  {
    return Never;
  }
  this->descend(0, std::numeric_limits<double>::infinity());
  this->bareFacet_ = -1;
  return this->solution_.empty() ? Never : this->bound_;
}

/// The open facet with the fewest apexes left. False if one has none.
bool PolyhedronSearch::choose(const State& s, Front& f, Mask& apexes) const
{
  // Fewest choices first: dead ends show early. One choice, or none, cannot be undercut.
  int fewest = MaximumPoints + 1;
  for (int k = 0; k < s.facets && fewest > 1; ++k)
  {
    const Mask left = this->apexes(s, s.front[k]);
    const int n = count(left);
    if (n < fewest)
    {
      fewest = n;
      apexes = left;
      f = s.front[k];
    }
  }
  return fewest > 0;
}

/// Fills what the front of this level encloses; `worst` is the worst quality placed so far. Returns
/// true if all fillings better than bound_ have been examined.
bool PolyhedronSearch::descend(int level, double worst)
{
  const State& s = this->states_[level];
  if (s.facets == 0)
  {
    if ((this->stay_ & ~s.used) == 0)
    {
      this->solution_ = this->placed_;
      this->bound_ = worst;
      // From now on only better fillings count. If none is possible any more, the search is
      // finished.
      this->finished_ = !this->strike();
    }
    return true;
  }
  // If two fronts share a tag a filling may be missed; a wrong one cannot come of it.
  const std::uint64_t tag = s.hash ^ this->salt_;
  std::uint64_t& memory = this->deadEnds_[s.hash % Memory];
  Front f{};
  Mask apexes = 0;
  if (memory == tag || !this->choose(s, f, apexes))
  {
    return true;
  }
  const bool complete = this->branch(level, worst, f, apexes);
  // Only a complete examination makes a dead end: one that was cut short proves nothing.
  if (complete)
  {
    memory = tag;
  }
  return complete;
}

/// Tries all apexes on the open facet f, best first. Returns the same as descend().
bool PolyhedronSearch::branch(int level, double worst, const Front& f, Mask apexes)
{
  const State& s = this->states_[level];
  std::array<std::pair<double, int>, MaximumPoints> order;
  int n = 0;
  for (; apexes; apexes &= apexes - 1)
  {
    const int p = lowest(apexes);
    std::array<int, 4> t{ f.a, f.b, f.c, p };
    std::sort(t.begin(), t.end());
    order[n++] = { -this->quality_[quadrupleOf(t[0], t[1], t[2], t[3])], p };
  }
  // Equal qualities are tried in the order of their points: the same on every run.
  std::sort(order.begin(), order.begin() + n);
  for (int k = 0; k < n; ++k)
  {
    const double q = -order[k].first;
    const int p = order[k].second;
    // A tetrahedron must not contain a point that is already in use.
    if (!(q > this->bound_) || (this->signs_.inside(f.a, f.b, f.c, p) & s.used))
    {
      continue;
    }
    if (this->steps_ == this->budget_ || level == MaximumDepth || s.facets + 2 > MaximumFacets)
    {
      this->ranOut_ = true;
      return false;
    }
    ++this->steps_;
    if (level + 1 == static_cast<int>(this->states_.size()))
    {
      this->states_.emplace_back(); // a deque: references to the other states stay valid
    }
    this->place(f, p, s, this->states_[level + 1]);
    this->placed_.push_back({ f.a, f.b, f.c, static_cast<std::uint8_t>(p) });
    this->descend(level + 1, std::min(worst, q));
    this->placed_.pop_back();
    // What was placed before this level is no better than the filling just found. Other fillings of
    // this front are therefore skipped. After better tetrahedra they may help, so this is no dead
    // end.
    if (this->ranOut_ || this->finished_ || !(worst > this->bound_))
    {
      return false;
    }
  }
  return true;
}
}
