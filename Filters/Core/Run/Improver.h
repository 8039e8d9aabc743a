// SPDX-License-Identifier: BSD-3-Clause
/// @file Improver.h
/// What the fast engine does about one bad cell: tries each kind of change, keeps what helps.
#ifndef meshopt_Run_Improver_h
#define meshopt_Run_Improver_h

#include "Bound/ApexBound.h"
#include "Mesh/CavityFit.h"
#include "Bound/Caps.h"
#include "Operations/Operation.h"
#include "Run/Options.h"
#include "Operations/QualityModel.h"
#include "Operations/Cavity.h"
#include "Operations/EdgeChange.h"
#include "Operations/EdgeRemoval.h"
#include "Operations/FaceRemoval.h"
#include "Operations/SmallPolyhedron.h"
#include "Reposition/ClusterProblem.h"
#include "Base/GoldenSection.h"
#include "Reposition/StarProblem.h"

namespace meshopt
{
/// A change is kept if the worst of the new cells is better than the worst of the old ones by
/// gain(): the sorted vector of all qualities rises lexicographically, so that nothing cycles.
template <int D, class Shape>
class Improver
{
public:
  /// How far improve() goes. Each level includes those before it.
  enum Level
  {
    Topology = 0,  ///< edge and face removal, node motion
    Insertion = 1, ///< also removal and insertion of nodes
    LookAhead = 2, ///< also several changes that pay only together
    LongLookAhead = 3
  };

  /// `curves`: what the boundary may slide along (D = 2), or null: it is kept.
  Improver(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const Caps<D>& caps,
    const Options& options, const BoundaryCurves* curves = nullptr);

  /// Tries to improve the neighbourhood of cell t, whose quality is to rise. True if it did.
  bool improve(Index t, int level);

  /// Only changes of the connectivity: edge and face removal at cell t. True if one helped.
  bool swap(Index t)
  {
    this->changed_.clear();
    return this->reconnect(t);
  }

  /// Cells that the last successful improve() or swap() made or whose quality it changed; some may be dead.
  const std::vector<Index>& changed() const { return this->changed_; }

  /// Node motion stops a little above `quality`: what is more than enough is not paid for.
  /// Insertion must not make more bad cells than it removes: otherwise many cells that are hardly
  /// better come for one that is worst. A cell under `guard` counts once, under two thirds of it
  /// twice, under one third of it three times. -1: no such guard. guardsAll: no other change may do
  /// so, either, unless it takes an inverted cell out.
  void setTarget(double quality, double guard, bool guardsAll = false)
  {
    this->target_ = quality;
    this->guard_ = guard;
    this->guardsAll_ = guardsAll;
  }
  /// Least gain that makes a change worth it: this much, less where all is tiny.
  void setGain(double gain)
  {
    this->failuresSince_ = gain == this->gain_ ? this->failuresSince_ : this->editor_->clock();
    this->gain_ = gain;
  }
  /// Net number of cells that may still be added. Where cells go it rises; at `most` no more nodes
  /// are removed.
  void setGrowth(long cells, long most = std::numeric_limits<long>::max())
  {
    this->growth_ = cells;
    this->mostGrowth_ = most;
    this->isShort_ = false;
  }
  long growth() const { return this->growth_; }
  /// Whether something was left out since then for want of growth.
  bool isShortOfGrowth() const { return this->isShort_; }
  /// Guards against inputs whose cells overlap, where the usual geometric reasons do not hold:
  /// `tangled`, if they may; `inverted`, if some are inverted. `pinched`: see PinchedPoints.h.
  void setTangled(bool tangled, bool inverted, const std::vector<std::uint8_t>& pinched)
  {
    this->tangled_ = tangled;
    this->inverted_ = inverted;
    this->pinched_ = &pinched;
  }

  /// Whether `cells` may come for the cavity in a mesh whose cells overlap: see fillsCavity(); and none
  /// has an edge or a facet that is there already outside of the cavity. After setTangled().
  bool fits(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
    const KeptChange<D>* kept) const
  {
    return fillsCavity<D>(this->editor_->mesh(), cavity, cells, kept) &&
      !this->conflicts(cavity, cells);
  }

  std::array<long, NumberOfOperations> tried{}, done{};

private:
  static constexpr double Never = -std::numeric_limits<double>::infinity();
  static constexpr int SearchSteps = 14; ///< along a curve: to a thousandth of the range

  double gain(double q) const
  {
    return std::min(this->gain_, std::max(1e-4 * this->gain_, 2 * this->gain_ * std::fabs(q)));
  }

  /// A place to go back to.
  struct Place
  {
    std::size_t journal, samples;
    long growth, bad;
  };
  Place begin();
  void commit(const Place& place);
  void rollback(const Place& place);
  void place(Index p, const Vec<D>& x, Index near);

  bool reconnect(Index t);
  bool move(Index t);
  bool moveNode(Index v);
  /// Whether a try that failed at that time would fail again: nothing has changed since `stamp`.
  bool failedAsItIs(std::uint32_t failed, std::uint32_t stamp) const
  {
    return failed >= stamp && failed > this->failuresSince_;
  }
  bool settleStar(double old);
  bool moveCluster(Index t);
  bool mayRemoveNodes() const
  {
    return this->options_->removeNodes && this->growth_ < this->mostGrowth_;
  }
  bool removeNodes(Index t);
  bool removeNode(Index v);
  bool changeBoundary(Index t, int level);
  bool slideNode(Index v);
  bool removeSlidingNode(Index v);
  bool splitBoundary(Index t, int i);
  bool replaceKept(const EdgeChange<D>& change);
  bool insert(Index t);
  bool retriangulate(Index t);
  bool retriangulate(Index t, const typename SmallPolyhedron<Shape>::Limits& limits);
  bool lookAhead(Index t, int operations);
  bool settle(std::vector<Index>& affected, double goal, int operations);

  double tryInsertion(Index t, Index p, Vec<D>& x, bool needGain);
  void seeds(Index t, std::vector<Vec<D>>& x) const;
  long badBalance() const;
  bool insertHere(Index p, const Vec<D>& x);
  bool replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
    const KeptChange<D>* kept = nullptr);
  bool conflicts(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells) const;
  void loadStar(Index v);
  double enough() const { return this->target_ + 0.02; }
  int badness(double q) const
  {
    return this->guard_ < 0.0
      ? 0
      : (q < this->guard_) + (q < this->guard_ * (2.0 / 3.0)) + (q < this->guard_ * (1.0 / 3.0));
  }
  void count(Operation op, bool success)
  {
    ++this->tried[static_cast<int>(op)];
    this->done[static_cast<int>(op)] += success;
  }

  MeshEditor<D>* editor_;
  const QualityModel<D, Shape>* model_;
  const Caps<D>* caps_;
  const Options* options_;
  const BoundaryCurves* curves_;
  double target_ = 1.0;
  double guard_ = -1.0;
  bool guardsAll_ = false;
  double gain_ = 1e-3;
  std::uint32_t failuresSince_ = 0; ///< failures at a node before that were with another gain
  long bad_ = 0;                    ///< badness() of all cells made, less that of those removed
  long growth_ = 0, mostGrowth_ = 0;
  bool isShort_ = false;
  bool tangled_ = false, inverted_ = false;
  const std::vector<std::uint8_t>* pinched_ = nullptr; // where tangled_

  std::vector<std::pair<Index, typename NodalMetric<D>::Sample>> samples_; ///< before the moves
  std::vector<Index> changed_, star_;
  std::vector<Simplex<D>> cells_, bestCells_;
  std::vector<Index> bestCavity_;
  std::vector<double> qualities_;
  EdgeRemoval<D, Shape> edgeRemoval_;
  FaceRemoval<Shape> faceRemoval_;
  SmallPolyhedron<Shape> smallPolyhedron_;
  Cavity<D, Shape> cavity_;
  EdgeChange<D> edgeChange_;
  StarProblem<D, Shape> problem_;
  ClusterProblem<D, Shape> clusterProblem_;
  Cluster<D> moving_;
  ClusterGatherer<D> gatherer_;
};
}

#include "Run/Improver.hxx"
#include "Run/ImproverBoundary.hxx"
#include "Run/ImproverCluster.hxx"
#include "Run/ImproverInsert.hxx"

#endif
