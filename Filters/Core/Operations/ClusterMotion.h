// SPDX-License-Identifier: BSD-3-Clause
/// @file ClusterMotion.h
/// Moves several nodes around a cell at once. Helps where each node alone is already at its best
/// place.
#ifndef meshopt_Operations_ClusterMotion_h
#define meshopt_Operations_ClusterMotion_h

#include "Edit/Judge.h"
#include "Operations/Level.h"
#include "Reposition/ClusterProblem.h"

namespace meshopt
{
/// Moves the nodes of the cluster of cell t with neighbours of order 1 (section 2.2), except nodes
/// of cells that are worse than t. Those cells may be at a cap, and would then block every gain.
template <int D, class Shape>
class ClusterMotion
{
public:
  static constexpr int level = Level::LongLookAhead;
  static constexpr bool addsCells = false;
  static bool isOn(const Switches& switches) { return switches.moveNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    return this->move(judge, t, false) || (judge.slides() && this->move(judge, t, true));
  }

private:
  static constexpr int Parts = 4; ///< of the way that are tried: 1, 1/2, 1/4, 1/8

  /// `leaves`: nodes of the surface may leave it, as far as the tolerance allows.
  bool move(Judge<D, Shape>& judge, Index t, bool leaves)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const double old = mesh.quality(t);
    const auto mayMove = [&](Index p)
    {
      return (mesh.isFree(p) || (judge.slides() && mesh.freedom(p) != Freedom::Fixed)) &&
        judge.editor().star(p, this->star_) && !(mesh.worstQuality(this->star_) < old);
    };
    this->gatherer_.gather(judge.editor(), t, 1, mayMove, this->cluster_);
    const std::vector<Index>& cells = this->cluster_.cells;
    if (std::find(cells.begin(), cells.end(), t) == cells.end())
    {
      return false;
    }
    this->readMetrics(judge);
    const bool slides = this->findDirections(judge, leaves);
    if (leaves && !slides)
    {
      return false; // tried already
    }
    const double now = this->problem_.maximize(
      this->cluster_, judge.model().quality, this->metrics_, judge.goal(old, ClusterSteps));
    // Cells may be inverted before the motion: a quality that is not positive proves nothing, so
    // the nodes must also lie among their neighbours.
    const bool mayGain = now > judge.required(old) && (now > 0.0 || this->cluster_.isAmidPoints());
    bool better = false;
    double part = 1.0;
    // What is too far for the surface may be good half of the way.
    for (int k = 0; k < (slides ? Parts : 1) && mayGain && !better; ++k, part *= 0.5)
    {
      this->propose(judge, leaves, part);
      this->proposal_.oldWorst = old;
      this->proposal_.newWorst = now;
      judge.demand(this->proposal_);
      if (slides)
      {
        // Nodes that slide were moved to the surface at last: that may have cost all of the gain.
        this->proposal_.least = this->proposal_.leastFound;
      }
      better = judge.accept(this->proposal_);
    }
    judge.count(Operation::NodeMotion, better);
    return better;
  }

  /// Proposes a part of the way to the new places in the cluster; all nodes of the surface end on
  /// it, or as near as they must.
  void propose(Judge<D, Shape>& judge, bool leaves, double part)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    this->proposal_.clear();
    this->proposal_.cavity = this->cluster_.cells;
    for (int k = 0; k < this->cluster_.numberOfMoving; ++k)
    {
      const Index p = this->cluster_.points[k];
      Vec<D> x = this->cluster_.x[k];
      const auto there = [&]
      {
        return leaves || mesh.freedom(p) == Freedom::Corner
          ? judge.surface()->placeNear(mesh.place(p), x, x)
          : judge.surface()->project(mesh.place(p), x, x);
      };
      Place place;
      if (!mesh.isFree(p))
      {
        place = there();
      }
      if (part < 1.0)
      {
        x = mesh.point(p) + part * (x - mesh.point(p));
        place = mesh.isFree(p) ? place : there();
      }
      this->proposal_.moves.push_back({ p, x, place });
    }
  }

  /// The directions of the nodes that slide. False if there is none.
  bool findDirections(Judge<D, Shape>& judge, bool leaves)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    this->directions_.clear();
    bool slides = false;
    for (int k = 0; k < this->cluster_.numberOfMoving && judge.slides(); ++k)
    {
      const Index p = this->cluster_.points[k];
      Directions<D> directions;
      if (!mesh.isFree(p))
      {
        judge.editor().star(p, this->star_);
        directions.basis.fill(Vec<D>::Zero()); // without a tangent it stays
        directions.count = leaves
          ? 0 // anywhere
          : std::max(1, judge.surface()->tangents(mesh, this->star_, p, directions.basis));
        slides = true;
      }
      this->directions_.push_back(directions);
    }
    this->problem_.restrict(this->directions_);
    return slides;
  }

  /// One metric for each cell of the cluster, or one for all.
  void readMetrics(const Judge<D, Shape>& judge)
  {
    const QualityModel<D, Shape>& model = judge.model();
    this->metrics_.clear();
    if (model.plain)
    {
      this->metrics_.emplace_back();
      return;
    }
    for (Index c : this->cluster_.cells)
    {
      this->metrics_.push_back(model.metric->element(judge.mesh().nodes(c)));
    }
  }

  Proposal<D> proposal_;
  ClusterProblem<D, Shape> problem_;
  ClusterGatherer<D> gatherer_;
  Cluster<D> cluster_;
  std::vector<ElementMetric<D>> metrics_;
  std::vector<Directions<D>> directions_;
  std::vector<Index> star_;
};
}

#endif
