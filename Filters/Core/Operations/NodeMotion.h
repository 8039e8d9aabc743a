// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeMotion.h
/// Moves each free node of a cell to its best place in its star, and each node on a patch of the
/// surface to its best place there.
#ifndef meshopt_Operations_NodeMotion_h
#define meshopt_Operations_NodeMotion_h

#include "Edit/Judge.h"
#include "Operations/Level.h"
#include "Reposition/StarProblem.h"

namespace meshopt
{
/// Sets up the problem of placing node v; `star` are all cells at v.
template <int D, class Shape>
void loadStar(const Judge<D, Shape>& judge, const std::vector<Index>& star, Index v,
  StarProblem<D, Shape>& problem)
{
  const SimplexMesh<D>& mesh = judge.mesh();
  const QualityModel<D, Shape>& model = judge.model();
  problem.clear(model.quality, model.plain);
  for (Index c : star)
  {
    const Facet<D> f = mesh.facet(c, mesh.localIndex(c, v));
    std::array<int, D> local;
    for (int k = 0; k < D; ++k)
    {
      local[k] = problem.addPoint(f[k], mesh.point(f[k]));
    }
    problem.addFacet(local, model.weight(f));
    if (!model.plain)
    {
      problem.addFacetMetric(model.metric->element(mesh.nodes(c)));
    }
  }
}

/// Parts of the way to a better place that are tried, since the surface may refuse the whole: all
/// of it, a half, a quarter.
inline constexpr int PartsOfTheWay = 3;

template <int D, class Shape>
class NodeMotion
{
public:
  static constexpr int level = Level::Topology;
  static constexpr bool addsCells = false;
  static bool isOn(const Switches& switches) { return switches.moveNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    bool moved = false;
    const Simplex<D> nodes = judge.mesh().nodes(t);
    for (Index v : nodes)
    {
      // All nodes of the cell are tried even if the first one helps: each gains for its own star.
      moved |= this->mayMove(judge, v) && this->move(judge, v);
    }
    return moved;
  }

private:
  /// Nodes on curves are those of BoundaryChange.
  bool mayMove(const Judge<D, Shape>& judge, Index v) const
  {
    return judge.mesh().isFree(v) || (judge.slides() && judge.mesh().freedom(v) == Freedom::Patch);
  }

  /// Moves v to the best place in its star, unless nothing has changed since that last failed.
  bool move(Judge<D, Shape>& judge, Index v)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const auto& data = mesh.pointData(v);
    this->proposal_.clear();
    std::vector<Index>& star = this->proposal_.cavity;
    if (judge.failsAgain(data.moveFailed, data.stamp) || !judge.editor().star(v, star))
    {
      return false;
    }
    const double old = mesh.worstQuality(star);
    loadStar(judge, star, v, this->problem_);
    if (!mesh.isFree(v))
    {
      return this->slide(judge, v);
    }
    Vec<D> x = mesh.point(v);
    const double now = this->problem_.maximize(x, judge.goal(old, judge.steps()));
    // Cells may be inverted before the motion: a quality that is not positive proves nothing, so
    // the node must also lie among its neighbours.
    const bool isProven = now > 0.0 || this->problem_.isAmidPoints(x);
    this->proposal_.moves.push_back({ v, x, {} });
    this->proposal_.oldWorst = old;
    this->proposal_.newWorst = now;
    judge.demand(this->proposal_);
    const bool done = isProven && judge.accept(this->proposal_);
    judge.count(Operation::NodeMotion, done);
    if (!done)
    {
      judge.noteMoveFailed(v);
    }
    return done;
  }

  /// Moves a node of the surface in its tangent plane; if that goes too far for the surface, in the
  /// direction in which it bends least.
  bool slide(Judge<D, Shape>& judge, Index v)
  {
    Directions<D> directions;
    directions.count = judge.surface()->tangents(
      judge.mesh(), this->proposal_.cavity, v, directions.basis);
    bool done = false;
    for (; directions.count > 0 && !done; --directions.count)
    {
      done = this->slideAlong(judge, v, directions);
    }
    judge.count(Operation::NodeMotion, done);
    if (!done)
    {
      judge.noteMoveFailed(v);
    }
    return done;
  }

  /// Then to the surface; if that goes too far, half of the way, or a quarter.
  bool slideAlong(Judge<D, Shape>& judge, Index v, const Directions<D>& directions)
  {
    const double old = judge.mesh().worstQuality(this->proposal_.cavity);
    const Vec<D> from = judge.mesh().point(v);
    Vec<D> to = from;
    this->problem_.restrict(directions);
    // No part of the way is worth a try if the whole of it would not be.
    const bool mayGain = this->problem_.maximize(to, judge.goal(old)) > judge.required(old);
    double part = 1.0;
    bool done = false;
    for (int k = 0; k < PartsOfTheWay && mayGain && !done; ++k, part *= 0.5)
    {
      Vec<D> x = from + part * (to - from);
      const Place place = judge.surface()->project(judge.mesh().place(v), x, x);
      this->proposal_.moves.assign(1, { v, x, place });
      this->proposal_.oldWorst = old;
      this->proposal_.newWorst = this->problem_.evaluate(x);
      judge.demand(this->proposal_);
      done = judge.accept(this->proposal_);
    }
    return done;
  }

  Proposal<D> proposal_;
  StarProblem<D, Shape> problem_;
};
}

#endif
