// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStageRun.h
/// One run of the size stage. Included only by SizeStage.cpp.
#ifndef meshopt_Sizes_SizeStageRun_h
#define meshopt_Sizes_SizeStageRun_h

#include "Base/SortUnique.h"
#include "Mesh/PinchedPoints.h"
#include "Metric/EdgeLengths.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeSplit.h"
#include "Quality/Shape.h"
#include "Run/Improver.h"
#include "Run/Run.h"
#include "Sizes/UnitTensors.h"
#include "Surface/SurfaceFaults.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

namespace meshopt
{
namespace sizes
{
// A factor of 2 in between: half of an edge that is too long is not too short.
constexpr double Longest = 1.4142135623730951, Shortest = 1.0 / Longest;
/// Rounds after the first ones, which halve the longest edges. Most runs end by themselves before:
/// see FewChanges and MaximumIdle.
constexpr int MaximumRounds = 12;
/// Sweeps of node motion in each round. In one sweep a length spreads from a node to its neighbours
/// only.
constexpr int Sweeps = 3;
/// A node moves only if the energy of its edges falls to less than this fraction.
constexpr double WorthMoving = 0.97;
/// A round that changes fewer edges than this fraction of the cells is the last one.
constexpr double FewChanges = 0.005;
/// A round with more than the part Settling of the changes of the one before does not settle.
/// MaximumIdle such rounds in a row end the stage, too: the same edges may be split and contracted
/// for ever.
constexpr double Settling = 0.8;
constexpr int MaximumIdle = 2;
/// If the number of cells differs from the predicted one by more than the part CountTolerance, h*
/// is corrected: at most MaximumCorrections times, by at most GreatestScale in all. Where edges
/// cannot follow, no h* gives the number, and lengths would only move away from those that are
/// wanted.
constexpr double CountTolerance = 0.03;
constexpr int MaximumCorrections = 3;
constexpr double GreatestScale = 1.25;
/// Splitting ends for good at this multiple of the predicted number of cells, or of the number at
/// the start if that is more, plus BrakeSlack. If edges can follow the lengths, their number stays
/// far below.
constexpr double BrakeFactor = 4.0;
constexpr long BrakeSlack = 1000;
constexpr double MostPredicted = 1e9; // more than ids can number
/// How far from its middle an edge is split at most: a pseudo-random fraction of its length.
constexpr double Jitter = 0.1;
constexpr long TriesPerLook = 1024; // edges and nodes between two looks at the clock
/// An edge is split only if its length is at least this fraction of every edge of the cells around
/// it.
constexpr double LongestFirst = 0.7;
/// A contraction makes no quality lower than GoodEnough, unless the worst one was lower before; for
/// a motion the limit is twice GoodEnough. A split may multiply the worst quality by WorstSplit,
/// since the halves of a cell are worse at first.
constexpr double GoodEnough = 0.3, WorstSplit = 0.3;
/// Cells as good as this are not reconnected: a swap that helps a ring is found from its worst
/// cell. In 2D all are tried, since swaps are cheap.
template <int D>
constexpr double SwapBelow = D == 2 ? std::numeric_limits<double>::infinity() : 0.7;

/// Lengths at the ends of an edge whose logarithms differ by less count as equal: the formula below
/// loses digits as they come closer, and at this difference 1/2 is wrong by 1e-5 only.
constexpr double EqualLengths = 1e-4;
/// No edge is split nearer to an end than this part of it. The lengths may differ by any factor,
/// but cells at a very short part would be bad, and the long part would be split again.
constexpr double NearestToEnd = 0.25;

/// Where to halve an edge with lengths la and lb at its ends, as a fraction of the way from a; not
/// too close to an end. With r = ln(lb / la) and ln l linear in between, both parts are equally
/// long if exp(r t) = (1 + exp(r)) / 2.
inline double metricMiddle(double la, double lb)
{
  const double r = std::log(lb / la);
  const double t = std::fabs(r) < EqualLengths ? 0.5 : std::log(0.5 * (1.0 + std::exp(r))) / r;
  return std::clamp(t, NearestToEnd, 1.0 - NearestToEnd);
}

/// A pseudo-random number in [-1, 1] that depends on the edge only, so that runs are reproducible.
/// The factors are those of splitmix64: ids that follow each other give unrelated numbers. With
/// scramble() the same meshes would have other nodes.
inline double noise(Index a, Index b)
{
  std::uint64_t h = std::uint64_t(std::uint32_t(a)) << 32 | std::uint32_t(b);
  h = (h ^ h >> 31) * 0x9e3779b97f4a7c15ull;
  h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9ull;
  return static_cast<double>(h >> 33) / static_cast<double>(1ull << 30) - 1.0;
}

template <int D>
class SizeStage
{
public:
  explicit SizeStage(Run<D>& run);
  /// The editor lives longer than the tensors that it keeps up to date.
  ~SizeStage() { this->editor_.detach(this->units_); }
  bool follow(double predicted);

private:
  /// Whatever the caller's measure: here it only keeps cells from becoming bad.
  using Shape = MeanEdgeShape<D>;

  struct Edge
  {
    double length;
    Index a, b, cell;                       // a < b
    bool operator<(const Edge& other) const // the greatest comes first
    {
      // Of equal lengths the lowest ids: the order must not depend on the queue.
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
  bool isThere(const Edge& edge) const;
  std::optional<Span> spanOf(const Edge& edge, bool& isKept) const;
  bool splitEdge(const Edge& edge);
  bool contractEdge(Index v, Index u, Proposal<D>& best);
  bool makesNoneLonger(const Proposal<D>& p, Index v, Index u) const;
  void moveNode(Index v);
  bool moveFreeNode(Index v, double worst, double energy);
  bool moveSlidingNode(Index v, double worst, double energy);
  bool tryPlace(Index v, const Vec<D>& x, const Place& place, double worst, double energy);
  template <class Push>
  void swapAround(Push&& push);
  void collectQueue(bool isLong);
  void push(Index c, bool isLong);
  double energyAround(Index v);
  double length(Index a, Index b) const;
  void record();
  bool goesOn();
  bool triesMore();

  const SimplexMesh<D>& mesh() const { return this->editor_.mesh(); }
  Judge<D, Shape>& judge() { return this->improver_.judge(); }

  Run<D>& run_;
  MeshEditor<D>& editor_;
  const Options& options_;
  QualityModel<D, Shape> model_;
  Improver<D, Shape> improver_;
  UnitTensors<D> units_;
  Proposal<D> proposal_;
  std::vector<std::uint8_t> pinched_; // see PinchedPoints.h
  bool tangled_;                      // cells may overlap

  int round_ = 0;
  long tries_ = 0;           // edges and nodes, of all rounds
  bool isStopped_ = false;   // by the caller, or out of time
  long mostCells_ = 0;       // the brake, see BrakeFactor
  double scale_ = 1.0;       // factor on h*, corrects the count
  double longest_ = Longest; // longer edges are split
  std::uint32_t swappedAt_ = 0;
  std::vector<std::uint32_t> failedAt_; // by node: clock at its last try
  Queue queue_;
  std::vector<Index> star_, neighbours_, stack_;
};
}
}

#include "Sizes/SizeStageEdges.hxx"
#include "Sizes/SizeStageNodes.hxx"

#endif
