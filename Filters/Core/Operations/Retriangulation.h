// SPDX-License-Identifier: BSD-3-Clause
/// @file Retriangulation.h
/// A few cells around a bad one are taken out together and filled anew in the best way (D = 3).
#ifndef meshopt_Operations_Retriangulation_h
#define meshopt_Operations_Retriangulation_h

#include "Edit/Judge.h"
#include "Operations/Level.h"
#include "Operations/SmallPolyhedron.h"

namespace meshopt
{
template <int D, class Shape>
class Retriangulation
{
public:
  static constexpr int level = Level::LongLookAhead;
  static constexpr bool addsCells = false; // at first none; the judge sees to the rest
  static bool isOn(const Switches& switches) { return switches.reconnect; }

  bool improve([[maybe_unused]] Judge<D, Shape>& judge, [[maybe_unused]] Index t, int)
  {
    bool done = false;
    if constexpr (D == 3)
    {
      if (!judge.hasInverted())
      {
        Limits limits;
        done = this->refill(judge, t, limits);
        limits.newPoints = NewPoints;
        for (double height : Heights)
        {
          limits.height = height;
          done = done ||
            (judge.switches().insertNodes && judge.model().plain && this->refill(judge, t, limits));
        }
        judge.count(Operation::Retriangulation, done);
      }
    }
    return done;
  }

private:
  using Limits = typename SmallPolyhedron<Shape>::Limits;
  static constexpr int NewPoints = 4;               ///< places offered for new nodes
  static constexpr double Heights[] = { 0.5, 1.0 }; ///< of these: Limits::height, one after the other

  bool refill(Judge<D, Shape>& judge, Index t, Limits limits)
  {
    limits.mayDropPoints = judge.mayRemoveNodes();
    const SimplexMesh<3>& mesh = judge.mesh();
    const double above = judge.required(mesh.quality(t));
    const double q = this->polyhedron_.propose(judge.editor(), judge.model(), t, above, limits,
      [&](Index c, int i) { return judge.caps() ? judge.caps()->enough(mesh, c, i) : -1.0; });
    if (!(q > above))
    {
      return false;
    }
    const auto mark = judge.begin();
    const bool done = this->addPoints(judge, mesh.nodes(t)[0]) && this->offer(judge, q, above);
    if (done)
    {
      judge.commit(mark);
      return true;
    }
    judge.rollback(mark);
    judge.start();
    return false;
  }

  /// The new points of the polyhedron come into the mesh; false if there is no room.
  bool addPoints(Judge<D, Shape>& judge, Index near)
  {
    std::vector<Index> ids;
    for (const Vec<3>& x : this->polyhedron_.newPoints())
    {
      ids.push_back(judge.editor().addPoint(x));
      if (ids.back() == None)
      {
        return false;
      }
      judge.editor().movePoint(ids.back(), x, near);
    }
    this->polyhedron_.nameNewPoints(ids);
    return true;
  }

  /// A cell that has all that its kept facet allows does not count among the worst (Limits): the
  /// search has seen to the gain.
  bool offer(Judge<D, Shape>& judge, double q, double above)
  {
    this->proposal_.clear();
    this->proposal_.cavity = this->polyhedron_.cavity();
    this->proposal_.cells = this->polyhedron_.cells();
    this->proposal_.oldWorst = this->polyhedron_.oldWorst();
    this->proposal_.newWorst = q;
    this->proposal_.least = above;
    return judge.accept(this->proposal_);
  }

  SmallPolyhedron<Shape> polyhedron_;
  Proposal<D> proposal_;
};
}

#endif
