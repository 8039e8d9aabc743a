// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeInsertion.h
/// Inserts a node into a cell: the best cavity around the node is emptied and filled from the node,
/// which is put at its best place there. Where the surface takes part, also into a facet or an edge
/// of the surface.
#ifndef meshopt_Operations_NodeInsertion_h
#define meshopt_Operations_NodeInsertion_h

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
  bool improve(Judge<D, Shape>& judge, Index t, const std::vector<Seed>& seeds,
    const typename Cavity<D, Shape>::Limits& limits)
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
      done = this->tryGain(judge, t, p, this->seeds_[this->ranking_[k].second], mark);
    }
    judge.count(Operation::NodeInsertion, done);
    done ? judge.commit(mark) : judge.rollback(mark);
    return done;
  }

  /// Places where a new node of cell t may start: for each kept facet its best apex and the point
  /// half way there; the barycentre; the barycentres of the facets; the midpoints of the edges. The
  /// last two are pulled inwards by 10 %.
  static void findSeeds(const SimplexMesh<D>& mesh, Index t, std::vector<Vec<D>>& seeds);
  /// Those, then, if the surface takes part, the midpoints of the cell's edges and the barycentres
  /// of its facets there.
  /// `narrow`: those also as they are now (Opening::isNarrow).
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
  static typename Cavity<D, Shape>::Limits usualLimits(const Judge<D, Shape>& judge)
  {
    typename Cavity<D, Shape>::Limits limits;
    limits.swallowed = judge.mayRemoveNodes() ? limits.swallowed : 0;
    return limits;
  }
  static void addSurfaceSeed(const Judge<D, Shape>& judge, const std::array<Index, 3>& ids,
    const std::vector<Index>& cells, bool narrow, std::vector<Seed>& seeds);
  double grow(Judge<D, Shape>& judge, Index t, Index p, const Seed& seed);
  void rank(Judge<D, Shape>& judge, Index t, Index p);
  bool tryGain(Judge<D, Shape>& judge, Index t, Index p, Seed& seed,
    const typename Judge<D, Shape>::Mark& start);
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
  typename Cavity<D, Shape>::Limits limits_;
  StarProblem<D, Shape> problem_;
  std::vector<Seed> seeds_;
  std::vector<std::pair<double, std::size_t>> ranking_; ///< of the seeds: (-promise, number)
};

template <int D, class Shape>
void NodeInsertion<D, Shape>::findSeeds(
  const SimplexMesh<D>& mesh, Index t, std::vector<Vec<D>>& seeds)
{
  constexpr double inwards = 0.1;
  const Corners<D> c = mesh.corners(t);
  Vec<D> centre = c[0];
  for (int i = 1; i <= D; ++i)
  {
    centre += c[i];
  }
  centre /= D + 1;
  seeds.clear();
  if constexpr (D == 3)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(t, i))
      {
        const Facet<3> f = mesh.facet(t, i);
        Vec<3> apex;
        facetCap(mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]),
          std::numeric_limits<double>::infinity(), &apex);
        seeds.push_back(apex);
        seeds.push_back(0.5 * (apex + c[i]));
      }
    }
  }
  seeds.push_back(centre);
  for (int i = 0; D == 3 && i <= D; ++i)
  {
    const Vec<D> f = (Vec<D>(centre * (D + 1)) - c[i]) / D;
    seeds.push_back(f + inwards * (centre - f));
  }
  for (const auto& e : Local<D>::edges)
  {
    const Vec<D> m = 0.5 * (c[e[0]] + c[e[1]]);
    seeds.push_back(m + inwards * (centre - m));
  }
}

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

/// Adds the middle of an edge (the last id is None) or of a facet of the surface, if nodes may be
/// added there. `cells`: all that have it.
template <int D, class Shape>
void NodeInsertion<D, Shape>::addSurfaceSeed(const Judge<D, Shape>& judge,
  const std::array<Index, 3>& ids, const std::vector<Index>& cells, bool narrow,
  std::vector<Seed>& seeds)
{
  const SimplexMesh<D>& mesh = judge.mesh();
  Seed seed;
  seed.opening.ids = ids;
  const auto has = [&](const Facet<D>& f) {
    return std::all_of(ids.begin(), ids.end(), [&](Index p) { return p == None || hasId(f, p); });
  };
  for (Index c : cells)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(c, i) && has(mesh.facet(c, i)))
      {
        seed.opening.patches.push_back(mesh.patch(c, i));
      }
    }
  }
  std::vector<Index>& patches = seed.opening.patches;
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  if (patches.empty() || patches[0] == None)
  {
    return;
  }
  const Vec<D>&a = mesh.point(ids[0]), &b = mesh.point(ids[1]);
  seed.place = { Freedom::Patch, patches[0], 0.0 };
  Vec<D> now = 0.5 * (a + b); // on the surface of the mesh
  if (ids[2] != None)
  {
    now = (a + b + mesh.point(ids[2])) / 3.0;
    judge.surface()->project(seed.place, now, seed.x);
  }
  else
  {
    if (!judge.surface()->mayDivide(mesh, cells, ids[0], ids[1]))
    {
      return;
    }
    const auto span = judge.surface()->span(mesh, ids[0], ids[1]);
    bool isKept = false;
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const Simplex<D>& t = mesh.nodes(cells[0]);
      const Index p = t[Local<D>::edges[e][0]], q = t[Local<D>::edges[e][1]];
      isKept |= mesh.isEdgeKept(cells[0], e) &&
        ((p == ids[0] && q == ids[1]) || (p == ids[1] && q == ids[0]));
    }
    if (isKept)
    {
      seed.place = { Freedom::Curve, span->part, 0.5 * (span->from + span->to) };
      seed.x = judge.surface()->at(span->part, seed.place.parameter);
    }
    else
    {
      judge.surface()->project(seed.place, now, seed.x);
    }
  }
  seeds.push_back(seed);
  // What changes the surface may be too far for it. The same without: the node stays where it is.
  if (narrow)
  {
    seed.opening.isNarrow = true;
    seed.place = judge.surface()->placeNear(seed.place, now, seed.x);
    seeds.push_back(seed);
  }
}

template <int D, class Shape>
void NodeInsertion<D, Shape>::findAllSeeds(
  const Judge<D, Shape>& judge, Index t, bool narrow, std::vector<Seed>& seeds)
{
  const SimplexMesh<D>& mesh = judge.mesh();
  std::vector<Vec<D>> inside;
  findSeeds(mesh, t, inside);
  for (const Vec<D>& x : inside)
  {
    seeds.push_back({ x, {}, {} });
  }
  if constexpr (D == 3)
  {
    if (!judge.slides())
    {
      return;
    }
    std::vector<Index> cells;
    for (const auto& e : Local<3>::edges)
    {
      const Index a = mesh.nodes(t)[e[0]], b = mesh.nodes(t)[e[1]];
      if (mesh.isBoundary(a) && mesh.isBoundary(b) && !mesh.ring(t, a, b, false, cells))
      {
        mesh.ring(t, a, b, true, cells);
        addSurfaceSeed(judge, { a, b, None }, cells, narrow, seeds);
      }
    }
    for (int i = 0; i < 4; ++i)
    {
      if (mesh.isKept(t, i))
      {
        addSurfaceSeed(judge, mesh.facet(t, i), { t }, narrow, seeds);
      }
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
    return this->problem_.maximize(seed.x, judge.enough(old), 0.5 * judge.gain(old));
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
  this->problem_.maximize(seed.x, judge.enough(old), 0.5 * judge.gain(old));
  seed.place = judge.surface()->project(seed.place, seed.x, seed.x);
  return this->problem_.evaluate(seed.x);
}

/// Finds the cavity of point p at the seed. Returns the worst quality of its cells.
template <int D, class Shape>
double NodeInsertion<D, Shape>::grow(Judge<D, Shape>& judge, Index t, Index p, const Seed& seed)
{
  judge.editor().movePoint(p, seed.x, judge.mesh().nodes(t)[0]);
  return this->cavity_.grow(judge.editor(), judge.model(), t, p, seed.x, this->limits_,
    seed.isOnSurface() ? &seed.opening : nullptr);
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
    if (promise > (judge.isThorough() ? 0.0 : Promising))
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

/// Makes the insertion at one seed, if it gains.
template <int D, class Shape>
bool NodeInsertion<D, Shape>::tryGain(
  Judge<D, Shape>& judge, Index t, Index p, Seed& seed, const typename Judge<D, Shape>::Mark& start)
{
  const double q = this->find(judge, t, p, seed, true);
  const double required = judge.required(this->cavity_.oldWorst());
  if (!(q > required) || judge.badBalance(this->problem_.values(), this->cavity_.cells()) > 0)
  {
    return false;
  }
  // The search used the metric of the node's first place, and ignored the floor of the weights. So
  // the true qualities are checked after the change.
  const bool isExact = judge.model().plain && !judge.model().weights;
  const auto mark = judge.begin();
  const bool done = this->fill(judge, p, seed) &&
    (isExact ||
      (judge.mesh().worstQuality(judge.editor().created()) > required && judge.keepsGuard(start)));
  done ? judge.commit(mark) : judge.rollback(mark);
  if (!done)
  {
    judge.start();
  }
  return done;
}
}

#endif
