// SPDX-License-Identifier: BSD-3-Clause
/// @file PolyhedronSearch.h
/// Branch and bound search for the tetrahedralization of a small polyhedron, on given points, whose
/// worst quality is largest.
///
/// Reference: J. Liu, S. Sun, D. Wang, Optimal tetrahedralization for small polyhedron: a new local
/// transformation strategy for 3-D mesh generation and mesh improvement, CMES 14 (2006).
/// Differences to it:
///  - Take positive tetrahedra whose facets cancel, except those on the boundary of the polyhedron.
///    As a chain they have the same boundary as the polyhedron. So they cover it exactly once, and
///    nothing else. Exact signs of volumes and the matching of facets therefore prove a filling.
///    Tests of intersection only cut branches that cannot end in a filling; they may ignore
///    degenerate positions.
///  - These tests are bit sets, by edge and by facet. They are made from the signs of the volumes
///    of all quadruples of points, and are kept for each level of the search.
///  - Before the search, candidates that no other can join at a facet are removed repeatedly. Most
///    polyhedra without a good filling are refused there.
///  - The next open facet is the one with the fewest apexes left. Its apexes are tried best first.
///    A front that could not be filled is remembered.
#ifndef meshopt_Operations_PolyhedronSearch_h
#define meshopt_Operations_PolyhedronSearch_h

#include "Operations/PointSigns.h"

#include <deque>
#include <limits>
#include <vector>

namespace meshopt
{
/// Use: clear(); addPoint() for each point; setBoundary(); findBareFacet(); if there is none,
/// findCandidates(); set the quality of each of the candidates(); search(); then cells(). Points
/// may be added later and another boundary set: what is known about the earlier points is kept.
class PolyhedronSearch
{
public:
  static constexpr int MaximumPoints = PointSigns::Maximum;
  /// Of the boundary, and of any front. A sphere with the most points has 60 facets; a front may
  /// consist of several parts.
  static constexpr int MaximumFacets = 126;
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  /// Numbers of the nodes of a facet. The tetrahedron (facet, inner point) is positive.
  using Triangle = std::array<std::uint8_t, 3>;
  using Tetrahedron = std::array<std::uint8_t, 4>;

  /// A tetrahedron that fits into the polyhedron.
  struct Candidate
  {
    Tetrahedron nodes;                  ///< positive
    std::array<std::uint16_t, 4> sides; ///< sideOf() its facets, [i] opposite to node i
    double quality = 0.0;               ///< set by the caller
  };

  /// Starts again without points.
  void clear();
  /// Adds a point; its number is the number of points before. At most MaximumPoints. A point that
  /// is not on the boundary may be left out of the filling, unless it has to `stay`. O(n^3).
  void addPoint(const Vec<3>& x, bool stay);
  int numberOfPoints() const { return this->signs_.size(); }
  /// Sets the boundary of the polyhedron: closed, each facet once. False if it has more than
  /// MaximumFacets facets.
  bool setBoundary(const std::vector<Triangle>& facets);

  /// The first facet of the boundary on which no candidate is good enough, or -1. The same as
  /// search() would find, at a small part of the cost: most polyhedra are refused here.
  /// `isEnough(candidate)`: whether its quality, which is not set, is enough.
  template <class IsEnough>
  int findBareFacet(IsEnough&& isEnough)
  {
    this->openBoundary();
    // Cheapest first: mostly it is the first facet, and nothing but its edges tells.
    if (this->apexesOn(0) == 0)
    {
      return 0;
    }
    this->blockByEdges();
    for (int k = 0; k < this->states_[0].facets; ++k)
    {
      Candidate t;
      bool isBare = true;
      for (Mask rest = this->apexesOn(k); rest && isBare; rest &= rest - 1)
      {
        isBare = !(this->fitsOn(k, pointset::lowest(rest), t) && isEnough(t));
      }
      if (isBare)
      {
        return k;
      }
    }
    return -1;
  }
  /// Finds the tetrahedra that cross no edge or facet of the boundary, do not lie outside of a
  /// boundary facet, and contain no point that must stay. At most O(n^4).
  void findCandidates();
  std::vector<Candidate>& candidates() { return this->candidates_; }
  /// A number for the side of the facet {a, b, c} on which (a, b, c, point) is positive. The number
  /// of the other side differs in the lowest bit. Below 2 C(32, 3) = 9920.
  static int sideOf(int a, int b, int c);
  static constexpr int NumberOfSides = MaximumPoints * (MaximumPoints - 1) * (MaximumPoints - 2) /
    3;
  /// A number for the four points {a < b < c < d}, below C(32, 4) = 35960.
  static int quadrupleOf(int a, int b, int c, int d);

  /// Searches for the filling with the largest worst quality. Returns this quality if it is above
  /// `above`; Never if there is no such filling. After `steps` tetrahedra tried, the best filling
  /// so far is the result.
  double search(double above, long steps);

  /// The filling found by the last search(): positive tetrahedra.
  const std::vector<Tetrahedron>& cells() const { return this->solution_; }
  /// If the last search() ended before its first step: a facet of the boundary (by its place in
  /// setBoundary()) with no candidate left. Otherwise -1.
  int bareFacet() const { return this->bareFacet_; }
  /// Steps of the last search.
  long steps() const { return this->steps_; }
  /// Whether the limit stopped it: a better filling may then exist. Only tests ask; without it they
  /// could not tell a search that proves its result from one that does not.
  bool ranOut() const { return this->ranOut_; }

private:
  using Mask = PointSigns::Mask;
  static constexpr int Pairs = MaximumPoints * (MaximumPoints - 1) / 2;
  /// Tetrahedra of a filling: one State is kept for each. A search that needs more ends there.
  static constexpr int MaximumDepth = 128;

  /// What is known of an edge: nothing yet, that it crosses no facet, or which ones.
  enum class Crossing : std::uint8_t
  {
    Unknown,
    None,
    Some
  };
  /// An open facet: (a, b, c, p) is positive for points p on the side still to be filled.
  struct Front
  {
    std::uint8_t a, b, c;
    std::uint16_t side;
  };
  /// The part of the polyhedron still to be filled.
  struct State
  {
    int facets = 0;
    Mask used = 0, dropped = 0;
    std::uint64_t hash = 0;
    Front front[MaximumFacets];
    Mask edges[MaximumPoints];   ///< edges[a] contains b: there is an edge (a, b)
    Mask blocked[MaximumPoints]; ///< blocked[a] contains b: edge (a, b) would cross a facet
    Mask third[Pairs];           ///< third[ab] contains c: abc would cross an edge, or is closed
    Mask open[MaximumPoints * MaximumPoints]; ///< open[a n + b] contains c: (a, b, c) is open
  };

  // Binomial coefficients: the numbers of pairs, triples and quadruples of n points.
  static constexpr int choose2(int n) { return n * (n - 1) / 2; }
  static constexpr int choose3(int n) { return n * (n - 1) * (n - 2) / 6; }
  static constexpr int choose4(int n) { return n * (n - 1) * (n - 2) / 2 * (n - 3) / 12; }
  static int pairOf(int i, int j) { return i < j ? j * (j - 1) / 2 + i : i * (i - 1) / 2 + j; }
  void openBoundary();
  void blockByEdges();
  Mask apexesOn(int k) const;
  bool fitsOn(int k, int p, Candidate& t) const;
  bool fits(int i, int j, int k, int l, Candidate& t) const;
  void addCandidates(int i, int j, int k, Mask apexes);
  bool offer(double bound);
  bool strike();
  void blockEdges(State& s, int i, int j, int k) const;
  void blockFacets(State& s, int a, int b);
  bool isOutermost(int a, int b) const;
  void findCrossing(int a, int b);
  void addEdge(State& s, int a, int b);
  void open(State& s, int a, int b, int c);
  void close(State& s, int a, int b, int c) const;
  void copy(const State& from, State& to) const;
  void place(const Front& f, int p, const State& s, State& next);
  Mask apexes(const State& s, const Front& f) const;
  bool choose(const State& s, Front& f, Mask& apexes) const;
  bool descend(int level, double worst);
  bool branch(int level, double worst, const Front& f, Mask apexes);

  PointSigns signs_;
  Mask mustStay_ = 0, stay_ = 0; // as given; with the points of the boundary
  std::vector<Triangle> boundary_;
  std::vector<Mask> crossing_;          // [ab][ij] contains k: edge ab crosses facet ijk
  std::vector<Crossing> crossingState_; // [ab]: whether the row of crossing_ is needed and filled
  std::vector<Candidate> candidates_;
  std::vector<std::uint16_t> alive_;      // candidates still counted in apex_
  std::vector<double> quality_;           // of candidates, by quadrupleOf()
  std::vector<Mask> apex_;                // by side: apexes of candidates better than bound_
  std::vector<std::uint8_t> facetOfSide_; // by side: 1 + facet of the boundary, or 0

  double bound_ = 0.0;
  int bareFacet_ = -1;
  long steps_ = 0, budget_ = 0;
  bool ranOut_ = false, finished_ = false;
  std::deque<State> states_;                  // by level; 0: the polyhedron
  bool isOpened_ = false, isBlocked_ = false; // what of it is done for this boundary
  std::vector<Tetrahedron> placed_, solution_;
  std::vector<std::uint64_t> deadEnds_;
  std::uint64_t salt_ = 0;
};
}

#endif
