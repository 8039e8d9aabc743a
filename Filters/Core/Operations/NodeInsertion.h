// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeInsertion.h
/// Inserts a node into a cell: the best cavity around the node is emptied and filled from the node,
/// which is put at its best place there.
#ifndef meshopt_Operations_NodeInsertion_h
#define meshopt_Operations_NodeInsertion_h

#include "Bound/ApexBound.h"
#include "Edit/Judge.h"
#include "Operations/Cavity.h"
#include "Operations/Level.h"
#include "Reposition/StarProblem.h"

namespace meshopt
{
template <int D, class Shape>
class NodeInsertion
{
public:
  static constexpr int level = Level::Insertion;
  static constexpr bool addsCells = true;
  static bool isOn(const Switches& switches) { return switches.insertNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    findSeeds(judge.mesh(), t, this->seeds_);
    const auto mark = judge.begin();
    const Index p = judge.editor().addPoint(this->seeds_[0]);
    bool done = false;
    for (std::size_t k = 0; k < this->seeds_.size() && p != None && !done; ++k)
    {
      done = this->tryGain(judge, t, p, this->seeds_[k], mark);
    }
    judge.count(Operation::NodeInsertion, done);
    done ? judge.commit(mark) : judge.rollback(mark);
    return done;
  }

  /// Places where a new node of cell t may start: for each kept facet its best apex and the point
  /// half way there; the barycentre; the barycentres of the facets; the midpoints of the edges. The
  /// last two are pulled inwards by 10 %.
  static void findSeeds(const SimplexMesh<D>& mesh, Index t, std::vector<Vec<D>>& seeds);

  /// Finds the cavity of point p (which no cell uses yet) if it starts at x, then moves it to its
  /// best place, which is returned in x. If `needsGain` and there is no gain, a second round starts
  /// at the new place. Returns the worst quality of the new cells; Never if there is no cavity.
  /// Call it within a transaction.
  double find(Judge<D, Shape>& judge, Index t, Index p, Vec<D>& x, bool needsGain);
  /// The worst quality in the cavity of the last find().
  double oldWorst() const { return this->cavity_.oldWorst(); }
  /// Fills the cavity of the last find() from p at x, whether or not that gains.
  bool fill(Judge<D, Shape>& judge, Index p, const Vec<D>& x);

private:
  bool tryGain(Judge<D, Shape>& judge, Index t, Index p, Vec<D>& x,
    const typename Judge<D, Shape>::Mark& start);
  void loadCavity(const Judge<D, Shape>& judge, Index p);

  static constexpr double Hopeless = 0.5; ///< part of the old worst: below it, no second round
  static constexpr int Rounds = 2;

  Proposal<D> proposal_;
  Cavity<D, Shape> cavity_;
  StarProblem<D, Shape> problem_;
  std::vector<Vec<D>> seeds_;
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
      if (mesh.isConstrained(t, i))
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

template <int D, class Shape>
double NodeInsertion<D, Shape>::find(
  Judge<D, Shape>& judge, Index t, Index p, Vec<D>& x, bool needsGain)
{
  double q = Proposal<D>::Never;
  for (int round = 0; round < Rounds; ++round)
  {
    judge.editor().movePoint(p, x, judge.mesh().nodes(t)[0]);
    typename Cavity<D, Shape>::Limits limits;
    // If no nodes may be removed, none may vanish inside the cavity either.
    limits.swallowed = judge.mayRemoveNodes() ? limits.swallowed : 0;
    q = this->cavity_.grow(judge.editor(), judge.model(), t, p, x, limits);
    if (!(q > 0.0))
    {
      return Proposal<D>::Never;
    }
    const double old = this->cavity_.oldWorst();
    this->loadCavity(judge, p);
    q = this->problem_.maximize(x, judge.enough(old), 0.5 * judge.gain(old));
    if (!needsGain || q > judge.required(old) || q < Hopeless * old)
    {
      break;
    }
  }
  return q;
}

template <int D, class Shape>
bool NodeInsertion<D, Shape>::fill(Judge<D, Shape>& judge, Index p, const Vec<D>& x)
{
  judge.editor().movePoint(p, x, this->cavity_.facets()[0][0]);
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
  return judge.accept(this->proposal_);
}

template <int D, class Shape>
bool NodeInsertion<D, Shape>::tryGain(
  Judge<D, Shape>& judge, Index t, Index p, Vec<D>& x, const typename Judge<D, Shape>::Mark& start)
{
  const double q = this->find(judge, t, p, x, true);
  const double required = judge.required(this->cavity_.oldWorst());
  if (!(q > required) || judge.badBalance(this->problem_.values(), this->cavity_.cells()) > 0)
  {
    return false;
  }
  // The search used the metric of the node's first place, and ignored the floor of the weights. So
  // the true qualities are checked after the change.
  const bool isExact = judge.model().plain && !judge.model().weights;
  const auto mark = judge.begin();
  const bool done = this->fill(judge, p, x) &&
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
