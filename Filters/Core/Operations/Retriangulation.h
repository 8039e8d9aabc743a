// SPDX-License-Identifier: BSD-3-Clause
/// @file Retriangulation.h
/// Removes a few cells around a bad one together, and fills the hole in the best way (D = 3).
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
  static constexpr bool addsCells = false; // not at first; else the judge asks the budget
  static bool isOn(const Switches& switches) { return switches.reconnect; }

  bool improve([[maybe_unused]] Judge<D, Shape>& judge, [[maybe_unused]] Index t, int)
  {
    bool done = false;
    if constexpr (D == 3)
    {
      // With inverted cells the cavity may be no polyhedron.
      if (!judge.hasInverted())
      {
        // First with the given points, which is cheaper and keeps their number.
        PolyhedronLimits limits;
        done = this->refill(judge, t, limits);
        limits.newPoints = NewPoints;
        done = done ||
          (judge.switches().insertNodes && judge.model().plain && this->refill(judge, t, limits));
        judge.count(Operation::Retriangulation, done);
      }
    }
    return done;
  }

private:
  static constexpr int NewPoints = 4; ///< most places offered for new nodes

  /// Searches for a better filling around cell t. New points go again if the judge refuses it.
  bool refill(Judge<D, Shape>& judge, Index t, PolyhedronLimits limits)
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
    const bool done = judge.end(
      mark, this->addPoints(judge, mesh.nodes(t)[0]) && this->offer(judge, q, mesh.quality(t)));
    if (!done)
    {
      judge.start();
    }
    return done;
  }

  /// Adds the new points of the polyhedron to the mesh; false if no free slot is left.
  bool addPoints(Judge<D, Shape>& judge, Index near)
  {
    std::vector<Index> ids;
    for (const Vec<3>& x : this->polyhedron_.newPoints())
    {
      ids.push_back(judge.editor().addPoint(x, near));
      if (ids.back() == None)
      {
        return false;
      }
    }
    this->polyhedron_.nameNewPoints(ids);
    return true;
  }

  /// Offers the refilling to the judge. A cell that has all that its kept facet allows does not
  /// count among the worst (see SmallPolyhedron::propose()): `old` is the quality of the cell that
  /// is to be improved.
  bool offer(Judge<D, Shape>& judge, double q, double old)
  {
    this->proposal_.clear();
    this->proposal_.cavity = this->polyhedron_.cavity();
    this->proposal_.cells = this->polyhedron_.cells();
    this->proposal_.oldWorst = this->polyhedron_.oldWorst();
    this->proposal_.newWorst = q;
    judge.demand(this->proposal_, old);
    return judge.accept(this->proposal_);
  }

  SmallPolyhedron<Shape> polyhedron_;
  Proposal<D> proposal_;
};
}

#endif
