// SPDX-License-Identifier: BSD-3-Clause
/// @file Reconnect.h
/// Changes of topology that keep the points: of all edges and faces of a cell, the one is removed
/// whose removal gains most.
#ifndef meshopt_Operations_Reconnect_h
#define meshopt_Operations_Reconnect_h

#include "Edit/Judge.h"
#include "Operations/EdgeRemoval.h"
#include "Operations/FaceRemoval.h"
#include "Operations/Level.h"

namespace meshopt
{
template <int D, class Shape>
class Reconnect
{
public:
  static constexpr int level = Level::Topology;
  static constexpr bool addsCells = false; // few cells, and the judge asks the budget
  static bool isOn(const Switches& switches) { return switches.reconnect; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    this->best_.cells.clear();
    // Every proposal has to exceed the best so far, so that each search is pruned by the ones
    // before.
    this->best_.newWorst = judge.required(judge.mesh().quality(t));
    this->removeEdges(judge, t);
    bool isFace = false;
    if constexpr (D == 3)
    {
      isFace = this->removeFaces(judge, t);
    }
    judge.demand(this->best_);
    const bool done = !this->best_.cells.empty() && judge.accept(this->best_);
    judge.count(Operation::EdgeRemoval, done && !isFace);
    if (D == 3)
    {
      judge.count(Operation::FaceRemoval, done && isFace);
    }
    return done;
  }

private:
  void removeEdges(Judge<D, Shape>& judge, Index t)
  {
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const double q = this->edgeRemoval_.propose(
        judge.editor(), judge.model(), t, e, this->best_.newWorst, judge.surface());
      if (this->isBest(judge, q, this->edgeRemoval_.ringWorst()))
      {
        this->edgeRemoval_.fill(this->best_, judge.mesh());
      }
    }
  }

  /// Whether the removal of a face is the best so far.
  bool removeFaces(Judge<D, Shape>& judge, Index t)
  {
    bool found = false;
    for (int i = 0; i < 4; ++i)
    {
      const double q = this->faceRemoval_.propose(
        judge.editor(), judge.model(), t, i, this->best_.newWorst);
      if (this->isBest(judge, q, this->faceRemoval_.oldWorst()))
      {
        this->best_.cells = this->faceRemoval_.cells();
        this->best_.cavity = this->faceRemoval_.cavity();
        this->best_.oldWorst = this->faceRemoval_.oldWorst();
        this->best_.changesKept = false;
        found = true;
      }
    }
    return found;
  }

  /// Whether a refilling with the worst quality q is the best so far, and gains for its own cavity,
  /// with the worst quality `old`. If so, its quality is noted as the best.
  bool isBest(const Judge<D, Shape>& judge, double q, double old)
  {
    const bool isBest = q > this->best_.newWorst && q > judge.required(old);
    this->best_.newWorst = isBest ? q : this->best_.newWorst;
    return isBest;
  }

  Proposal<D> best_;
  EdgeRemoval<D, Shape> edgeRemoval_;
  FaceRemoval<Shape> faceRemoval_;
};
}

#endif
