// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeInsertion.h
/// Inserts a node into a cell: the best cavity around the node is emptied and filled from the node,
/// which is put at its best place there. Where the surface takes part, also into a facet or an edge
/// of the surface.
#ifndef meshopt_Operations_NodeInsertion_h
#define meshopt_Operations_NodeInsertion_h

#include "Base/SortUnique.h"
#include "Bound/ApexBound.h"
#include "Edit/Judge.h"
#include "Operations/Cavity.h"
#include "Operations/Level.h"
#include "Reposition/StarProblem.h"

namespace meshopt
{
/// One new point serves for all seeds: it moves from one to the next until one gains.
template <int D, class Shape>
class NodeInsertion
{
public:
  static constexpr int level = Level::Insertion;
  static constexpr bool addsCells = true;
  static bool isOn(const Switches& switches) { return switches.insertNodes; }

  /// Where a new node starts.
  struct Seed
  {
    Vec<D> x;
    Place place;                                ///< of a node on the surface
    typename Cavity<D, Shape>::Opening opening; ///< the same
    bool isOnSurface() const { return this->place.part != None; }
  };

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    std::vector<Seed> seeds;
    findAllSeeds(judge, t, judge.isThorough(), seeds);
    return this->improve(judge, t, seeds, usualLimits(judge));
  }

  /// The same from given seeds, with given limits of the cavity.
  bool improve(
    Judge<D, Shape>& judge, Index t, const std::vector<Seed>& seeds, const CavityLimits& limits)
  {
    this->seeds_ = seeds;
    this->limits_ = limits;
    const auto mark = judge.begin();
    const Index p = judge.editor().addPoint(this->seeds_[0].x);
    bool done = false;
    if (p != None)
    {
      this->rank(judge, t, p);
    }
    for (std::size_t k = 0; k < this->ranking_.size() && p != None && !done; ++k)
    {
      done = this->tryGain(judge, t, p, this->seeds_[this->ranking_[k].second]);
    }
    judge.count(Operation::NodeInsertion, done);
    return judge.end(mark, done);
  }

  /// Places where a new node of cell t may start: for each kept facet its best apex and the point
  /// half way there; the barycentre; the barycentres of the facets; the midpoints of the edges. The
  /// last two are pulled inwards by 10 %.
  static void findSeeds(const SimplexMesh<D>& mesh, Index t, std::vector<Vec<D>>& seeds);
  /// Those, then, if the surface takes part, the midpoints of the cell's edges and the barycentres
  /// of its facets there; with `narrow` these twice, the second time without a change of the
  /// surface (Opening::isNarrow).
  static void findAllSeeds(
    const Judge<D, Shape>& judge, Index t, bool narrow, std::vector<Seed>& seeds);

  /// Finds the cavity of point p (which no cell uses yet) if it starts at the seed, then moves it
  /// to its best place, which is returned in the seed. If `needsGain` and there is no gain, another
  /// round starts at the new place. Returns the worst quality of the new cells; Never if there is
  /// no cavity. Call it within a transaction.
  double find(Judge<D, Shape>& judge, Index t, Index p, Seed& seed, bool needsGain);
  void setUsualLimits(const Judge<D, Shape>& judge) { this->limits_ = usualLimits(judge); }
  /// The worst quality in the cavity of the last find().
  double oldWorst() const { return this->cavity_.oldWorst(); }
  /// Fills the cavity of the last find() from p at the seed's place, whether or not that gains.
  bool fill(Judge<D, Shape>& judge, Index p, const Seed& seed);

private:
  /// If no nodes may be removed, none may vanish inside the cavity either.
  static CavityLimits usualLimits(const Judge<D, Shape>& judge)
  {
    CavityLimits limits;
    limits.swallowed = judge.mayRemoveNodes() ? limits.swallowed : 0;
    return limits;
  }
  static void addSurfaceSeed(const Judge<D, Shape>& judge, const std::array<Index, 3>& ids,
    const std::vector<Index>& cells, bool narrow, std::vector<Seed>& seeds);
  double grow(Judge<D, Shape>& judge, Index t, Index p, const Seed& seed);
  void rank(Judge<D, Shape>& judge, Index t, Index p);
  bool tryGain(Judge<D, Shape>& judge, Index t, Index p, Seed& seed);
  double maximize(Judge<D, Shape>& judge, Seed& seed);
  void changeSurface(const SimplexMesh<D>& mesh, Index p, const Seed& seed);
  void loadCavity(const Judge<D, Shape>& judge, Index p);

  static constexpr double Hopeless = 0.5; ///< part of the old worst: below it, no second round
  static constexpr int Rounds = 2;
  /// Of the seeds, those are tried first whose cavity promises most before the node has moved. If
  /// not thoroughly, at most MostSeeds, with at least the part Promising of the old worst: on bad
  /// surfaces that finds nine of ten insertions that gain, and most cells have none.
  static constexpr std::size_t MostSeeds = 4;
  static constexpr double Promising = 0.3;

  Proposal<D> proposal_;
  Cavity<D, Shape> cavity_;
  CavityLimits limits_;
  StarProblem<D, Shape> problem_;
  std::vector<Seed> seeds_;
  std::vector<std::pair<double, std::size_t>> ranking_; ///< of the seeds: (-promise, number)
};

/// The place of the node as a problem: the facets of the cavity, seen from inside.
template <int D, class Shape>
void NodeInsertion<D, Shape>::loadCavity(const Judge<D, Shape>& judge, Index p)
{
  const QualityModel<D, Shape>& model = judge.model();
  this->problem_.clear(model.quality, model.plain);
  for (const Facet<D>& f : this->cavity_.facets())
  {
    std::array<int, D> local;
    for (int k = 0; k < D; ++k)
    {
      local[k] = this->problem_.addPoint(f[k], judge.mesh().point(f[k]));
    }
    this->problem_.addFacet(local, model.weight(f));
    if (!model.plain)
    {
      Simplex<D> cell;
      std::copy(f.begin(), f.end(), cell.begin());
      cell[D] = p;
      this->problem_.addFacetMetric(model.metric->element(cell));
    }
  }
}

/// Moves the seed to the best place in its cavity; one of the surface, to the best place there.
template <int D, class Shape>
double NodeInsertion<D, Shape>::maximize(Judge<D, Shape>& judge, Seed& seed)
{
  const double old = this->cavity_.oldWorst();
  if (!seed.isOnSurface())
  {
    return this->problem_.maximize(seed.x, judge.goal(old));
  }
  if (seed.opening.isNarrow)
  {
    return this->problem_.evaluate(seed.x);
  }
  Directions<D> directions;
  if constexpr (D == 3)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const auto& ids = seed.opening.ids;
    if (seed.place.freedom == Freedom::Curve)
    {
      directions.count = 1;
      directions.basis[0] = (mesh.point(ids[1]) - mesh.point(ids[0])).normalized();
    }
    else
    {
      Vec<3> normal = Vec<3>::Zero();
      for (const auto& o : this->cavity_.opened())
      {
        const Vec<3>& a = mesh.point(o.nodes[0]);
        const Vec<3> n = (mesh.point(o.nodes[1]) - a).cross(mesh.point(o.nodes[2]) - a);
        normal += n.dot(normal) < 0.0 ? Vec<3>(-n) : n; // sorted ids tell no side
      }
      int axis = 0;
      normal.cwiseAbs().minCoeff(&axis);
      directions.count = 2;
      directions.basis[0] = normal.cross(Vec<3>(Vec<3>::Unit(axis))).normalized();
      directions.basis[1] = normal.cross(directions.basis[0]).normalized();
    }
  }
  this->problem_.restrict(directions);
  this->problem_.maximize(seed.x, judge.goal(old));
  seed.place = judge.surface()->project(seed.place, seed.x, seed.x);
  return this->problem_.evaluate(seed.x);
}

/// Finds the cavity of point p at the seed. Returns the worst quality of its cells.
template <int D, class Shape>
double NodeInsertion<D, Shape>::grow(Judge<D, Shape>& judge, Index t, Index p, const Seed& seed)
{
  judge.editor().movePoint(p, seed.x, judge.mesh().nodes(t)[0]);
  return this->cavity_.grow(judge.editor(), judge.model(), t,
    { p, seed.x, seed.isOnSurface() ? &seed.opening : nullptr }, this->limits_);
}

/// Orders the seeds by their promise: the worst quality of the new cells, relative to the old one.
template <int D, class Shape>
void NodeInsertion<D, Shape>::rank(Judge<D, Shape>& judge, Index t, Index p)
{
  constexpr double tiny = 1e-12; // cells may be inverted
  this->ranking_.clear();
  for (std::size_t k = 0; k < this->seeds_.size(); ++k)
  {
    const double q = this->grow(judge, t, p, this->seeds_[k]);
    const double promise = q / std::max(this->cavity_.oldWorst(), tiny);
    if (q > this->limits_.hopeless && promise > (judge.isThorough() ? 0.0 : Promising))
    {
      this->ranking_.push_back({ -promise, k });
    }
  }
  const std::size_t all = this->ranking_.size();
  const std::size_t most = judge.isThorough() ? all : std::min(MostSeeds, all);
  std::partial_sort(this->ranking_.begin(), this->ranking_.begin() + most, this->ranking_.end());
  this->ranking_.resize(most);
}

template <int D, class Shape>
double NodeInsertion<D, Shape>::find(
  Judge<D, Shape>& judge, Index t, Index p, Seed& seed, bool needsGain)
{
  double q = Proposal<D>::Never;
  for (int round = 0; round < Rounds; ++round)
  {
    q = this->grow(judge, t, p, seed);
    if (!(q > 0.0))
    {
      return Proposal<D>::Never;
    }
    const double old = this->cavity_.oldWorst();
    this->loadCavity(judge, p);
    q = this->maximize(judge, seed);
    if (!needsGain || q > judge.required(old) || q < Hopeless * old)
    {
      break;
    }
  }
  return q;
}

/// The facets and edges of the surface that the new node divides.
template <int D, class Shape>
void NodeInsertion<D, Shape>::changeSurface(const SimplexMesh<D>& mesh, Index p, const Seed& seed)
{
  if constexpr (D == 3)
  {
    KeptChange<3>& kept = this->proposal_.kept;
    this->proposal_.changesKept = true;
    const bool isOnCurve = seed.place.freedom == Freedom::Curve;
    const auto& ids = seed.opening.ids;
    const auto isSeed = [&](Index a, Index b)
    { return isOnCurve && sortedIds(a, b) == sortedIds(ids[0], ids[1]); };
    struct Side
    {
      Index patch;
      std::array<Index, 2> edge;
      bool operator<(const Side& o) const
      {
        return this->patch != o.patch ? this->patch < o.patch : this->edge < o.edge;
      }
      bool operator==(const Side& o) const
      {
        return this->patch == o.patch && this->edge == o.edge;
      }
    };
    std::vector<Side> sides;
    for (const auto& o : this->cavity_.opened())
    {
      kept.gone.push_back(o.nodes);
      for (int i = 0; i < 3; ++i)
      {
        sides.push_back({ o.patch, sortedIds(o.nodes[i], o.nodes[(i + 1) % 3]) });
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t k = 0; k < sides.size(); ++k)
    {
      // An edge between two open facets vanishes; the others are joined to the node.
      const bool isInside = (k > 0 && sides[k - 1] == sides[k]) ||
        (k + 1 < sides.size() && sides[k + 1] == sides[k]);
      const auto [a, b] = sides[k].edge;
      if (!isInside && !isSeed(a, b))
      {
        kept.come.push_back({ a, b, p });
        kept.patches.push_back(sides[k].patch);
      }
    }
    if (isOnCurve)
    {
      kept.goneEdges.push_back({ ids[0], ids[1] });
      kept.comeEdges.push_back({ ids[0], p });
      kept.comeEdges.push_back({ p, ids[1] });
    }
    for (Index c : this->cavity_.behind())
    {
      kept.regions.push_back(mesh.region(c));
    }
  }
}

template <int D, class Shape>
bool NodeInsertion<D, Shape>::fill(Judge<D, Shape>& judge, Index p, const Seed& seed)
{
  judge.editor().movePoint(p, seed.x, this->cavity_.facets()[0][0]);
  this->proposal_.clear();
  this->proposal_.cavity = this->cavity_.cells();
  this->proposal_.oldWorst = this->cavity_.oldWorst();
  for (const Facet<D>& f : this->cavity_.facets())
  {
    Simplex<D> cell;
    std::copy(f.begin(), f.end(), cell.begin());
    cell[D] = p;
    this->proposal_.cells.push_back(cell);
  }
  if (seed.isOnSurface())
  {
    judge.editor().setPlace(p, seed.place);
    this->changeSurface(judge.mesh(), p, seed);
    // The judge compares the worst with nothing here, but the surface must not fold.
    return judge.measure(this->proposal_) && judge.accept(this->proposal_);
  }
  return judge.accept(this->proposal_);
}

/// Makes the insertion at one seed, if it gains. fill() asks the judge for no gain, since
/// look-ahead needs none: it is asked for here, before the change.
template <int D, class Shape>
bool NodeInsertion<D, Shape>::tryGain(Judge<D, Shape>& judge, Index t, Index p, Seed& seed)
{
  const double q = this->find(judge, t, p, seed, true);
  const double old = this->cavity_.oldWorst();
  if (!judge.mayInsert(old, q, this->problem_.values(), this->cavity_.cells()))
  {
    return false;
  }
  const auto mark = judge.begin();
  bool done = this->fill(judge, p, seed);
  if (judge.model().plain && !judge.model().weights)
  {
    done = judge.end(mark, done);
  }
  else
  {
    // The search used the metric of the node's first place, and ignored the floor of the weights.
    // So the true qualities are checked after the change.
    const auto worst = [&] { return judge.mesh().worstQuality(judge.editor().created()); };
    done = judge.endGuarded(mark, done && worst() > judge.required(old));
  }
  if (!done)
  {
    judge.start();
  }
  return done;
}
}

#include "Operations/NodeInsertionSeeds.hxx"

#endif
