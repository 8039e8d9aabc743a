// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceMotion.h
/// Moves the nodes of a cell that are on the surface away from it, as far as the tolerance allows.
#ifndef meshopt_Operations_SurfaceMotion_h
#define meshopt_Operations_SurfaceMotion_h

#include "Operations/NodeMotion.h"

namespace meshopt
{
/// For cells that nodes sliding on the surface could not help: flat ones between two ridges, or
/// with a short edge between two corners.
template <int D, class Shape>
class SurfaceMotion
{
public:
  static constexpr int level = Level::LookAhead;
  static constexpr bool addsCells = false;
  static bool isOn(const Switches& switches) { return switches.moveNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    bool moved = false;
    const Simplex<D> nodes = judge.mesh().nodes(t);
    for (Index v : nodes)
    {
      const Freedom freedom = judge.mesh().freedom(v);
      const bool mayMove = freedom != Freedom::Free && freedom != Freedom::Fixed;
      moved |= judge.slides() && mayMove && this->move(judge, v);
    }
    return moved;
  }

private:
  /// To the best place; if that goes too far for the surface, half of the way, or a quarter.
  bool move(Judge<D, Shape>& judge, Index v)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    this->proposal_.clear();
    std::vector<Index>& star = this->proposal_.cavity;
    if (!judge.editor().star(v, star))
    {
      return false;
    }
    const double old = mesh.worstQuality(star);
    loadStar(judge, star, v, this->problem_);
    const Vec<D> from = mesh.point(v);
    Vec<D> to = from;
    const bool mayGain = this->problem_.maximize(to, judge.goal(old)) > judge.required(old);
    bool done = false;
    double part = 1.0;
    // Parts of the way that the tolerance allows: parts of a longer way could all end at the same
    // place, which has no tolerance left for the edges there.
    if (mayGain)
    {
      judge.surface()->placeNear(mesh.place(v), to, to);
    }
    for (int k = 0; k < PartsOfTheWay && mayGain && !done; ++k, part *= 0.5)
    {
      Vec<D> x = from + part * (to - from);
      const Place place = judge.surface()->placeNear(mesh.place(v), x, x);
      this->proposal_.moves.assign(1, { v, x, place });
      this->proposal_.oldWorst = old;
      this->proposal_.newWorst = this->problem_.evaluate(x);
      judge.demand(this->proposal_);
      done = judge.accept(this->proposal_);
    }
    judge.count(Operation::NodeMotion, done);
    return done;
  }

  Proposal<D> proposal_;
  StarProblem<D, Shape> problem_;
};
}

#endif
