// SPDX-License-Identifier: BSD-3-Clause
/// @file PolyhedronSearch.h
/// The tetrahedralization of a small polyhedron, on given points, whose worst quality is largest:
/// branch and bound.
///
/// Reference: J. Liu, S. Sun, D. Wang, Optimal tetrahedralization for small polyhedron: a new local
/// transformation strategy for 3-D mesh generation and mesh improvement, CMES 14 (2006). What is
/// done in another way here:
///  - Positive tetrahedra whose facets cancel but for those of the polyhedron's boundary have, as a
///    chain, the boundary of the polyhedron; so they cover it once, and nothing else. Hence exact
///    signs of volumes and the matching of facets prove a filling. Tests of intersection only cut
///    branches that cannot end in one, and may leave out degenerate positions.
///  - These tests are bit sets, by edge and by facet, made from the signs of the volumes of all
///    quadruples of points and kept for each level of the search.
///  - Before the search, candidates that no other can join at a facet are struck out, again and
///    again. Most polyhedra without a good filling end there.
///  - The open facet that comes next is the one with the fewest apexes left; these are tried best
///    first. A front that could not be filled is remembered.
#ifndef meshopt_Operations_PolyhedronSearch_h
#define meshopt_Operations_PolyhedronSearch_h

#include "Operations/PointSigns.h"

#include <deque>
#include <limits>
#include <vector>

namespace meshopt
{
/// Use: clear(); addPoint() for each point; setBoundary(); findCandidates(); give each of the
/// candidates() its quality; search(); then cells(). More points may be added later, and another
/// boundary set: what is known of the points before is kept.
class PolyhedronSearch
{
public:
  static constexpr int MaximumPoints = PointSigns::Maximum;
  static constexpr int MaximumFacets = 126; ///< of the boundary, and of any front
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  /// Numbers of the nodes of a facet, ordered such that (facet, inner point) is positive.
  using Triangle = std::array<std::uint8_t, 3>;
  using Tetrahedron = std::array<std::uint8_t, 4>;

  /// A tetrahedron that fits into the polyhedron.
  struct Candidate
  {
    Tetrahedron nodes;                  ///< positive
    std::array<std::uint16_t, 4> sides; ///< sideOf() its facets, [i] opposite to node i
    double quality = 0.0;               ///< the caller's
  };

  /// Starts anew, without points.
  void clear();
  /// Adds a point, whose number is how many there were before; at most MaximumPoints. A point off
  /// the boundary that need not `stay` may be left out of the filling. O(n^3).
  void addPoint(const Vec<3>& x, bool stay);
  int numberOfPoints() const { return this->signs_.size(); }
  /// The boundary of the polyhedron: closed, each facet once. False if there are more than
  /// MaximumFacets of them.
  bool setBoundary(const std::vector<Triangle>& facets);

  /// Finds the tetrahedra that cross no edge or facet of the boundary, stand on no facet from
  /// outside, and have no point inside that must stay. O(n^4) at most.
  void findCandidates();
  std::vector<Candidate>& candidates() { return this->candidates_; }
  /// A number for the side of the facet {a, b, c} where (a, b, c, point) is positive; the number of
  /// the other side differs in the lowest bit. Below 2 C(32, 3) = 9920.
  static int sideOf(int a, int b, int c);
  static constexpr int NumberOfSides = MaximumPoints * (MaximumPoints - 1) * (MaximumPoints - 2) /
    3;
  /// A number for the points {a < b < c < d}, below C(32, 4) = 35960.
  static int quadrupleOf(int a, int b, int c, int d);

  /// Searches for the filling with the largest worst quality. Returns that if it is above `above`;
  /// if there is none, Never. After `steps` tetrahedra tried the best found by then counts.
  double search(double above, long steps);

  /// The filling that the last search() found; positive tetrahedra.
  const std::vector<Tetrahedron>& cells() const { return this->solution_; }
  /// If the last search() ended before its first step: a facet of the boundary (its place in
  /// setBoundary()) on which no candidate is left. Otherwise -1.
  int bareFacet() const { return this->bareFacet_; }
  /// Steps of the last search, and whether they were too few.
  long steps() const { return this->steps_; }
  bool ranOut() const { return this->ranOut_; }

private:
  using Mask = PointSigns::Mask;
  static constexpr int Pairs = MaximumPoints * (MaximumPoints - 1) / 2;
  static constexpr int MaximumDepth = 128;

  /// (a, b, c, p) is positive for points p on the side that is to be filled.
  struct Front
  {
    std::uint8_t a, b, c;
    std::uint16_t side;
  };
  /// What is left to fill.
  struct State
  {
    int facets = 0;
    Mask used = 0, dropped = 0;
    std::uint64_t hash = 0;
    Front front[MaximumFacets];
    Mask edges[MaximumPoints];   ///< edges[a] has b: there is an edge (a, b)
    Mask blocked[MaximumPoints]; ///< blocked[a] has b: an edge (a, b) would cross a facet
    Mask third[Pairs];           ///< third[ab] has c: a facet abc would cross an edge, or is closed
    Mask open[MaximumPoints * MaximumPoints]; ///< open[a n + b] has c: (a, b, c) is in the front
  };

  static int pairOf(int i, int j) { return i < j ? j * (j - 1) / 2 + i : i * (i - 1) / 2 + j; }
  void loadBoundary();
  void addCandidates(int i, int j, int k, Mask apexes);
  bool offer(double bound);
  bool strike();
  void blockEdges(State& s, int i, int j, int k) const;
  void blockFacets(State& s, int a, int b);
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
  Mask mustStay_ = 0, stay_ = 0; // as told, and with the boundary's points
  std::vector<Triangle> boundary_;
  std::vector<Mask> crossing_; // [ab][ij] has k: edge ab crosses facet ijk
  std::vector<std::uint8_t> crossingKnown_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint16_t> alive_;      // candidates that count in apex_
  std::vector<double> quality_;           // of candidates, by quadrupleOf()
  std::vector<Mask> apex_;                // by side: apexes of candidates better than bound_
  std::vector<std::uint8_t> facetOfSide_; // by side: 1 + facet of the boundary, or 0

  double bound_ = 0.0;
  int bareFacet_ = -1;
  long steps_ = 0, budget_ = 0;
  bool ranOut_ = false, finished_ = false;
  std::deque<State> states_; // by level; 0: the polyhedron
  std::vector<Tetrahedron> placed_, solution_;
  std::vector<std::uint64_t> deadEnds_;
  std::uint64_t salt_ = 0;
};
}

#endif
