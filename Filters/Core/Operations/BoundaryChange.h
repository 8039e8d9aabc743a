// SPDX-License-Identifier: BSD-3-Clause
/// @file BoundaryChange.h
/// Changes at a cell that involve the boundary (figure 1 of the paper): boundary nodes slide along
/// the curves that the boundary follows, vanish, or are added.
#ifndef meshopt_Operations_BoundaryChange_h
#define meshopt_Operations_BoundaryChange_h

#include "Base/GoldenSection.h"
#include "Base/SortUnique.h"
#include "Edit/Judge.h"
#include "Mesh/Ids.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeSplit.h"
#include "Operations/Level.h"
#include "Operations/NodeMotion.h"

namespace meshopt
{
/// First each node of the cell: it slides, or vanishes. Then each edge: it is divided. So nodes are
/// added only where nothing else helps.
template <int D, class Shape>
class BoundaryChange
{
public:
  static constexpr int level = Level::Topology;
  static constexpr bool addsCells = false; // split() itself asks the budget
  static bool isOn(const Switches&) { return true; }

  bool improve(Judge<D, Shape>& judge, Index t, int level)
  {
    if (!judge.surface())
    {
      return false;
    }
    const SimplexMesh<D>& mesh = judge.mesh();
    const Simplex<D> nodes = mesh.nodes(t);
    for (Index v : nodes)
    {
      const Freedom freedom = mesh.freedom(v);
      const bool mayRemove = level >= Level::Removal && judge.switches().removeNodes;
      // Nodes of patches slide by NodeMotion.
      if ((freedom == Freedom::Curve && judge.switches().moveNodes && this->slide(judge, v)) ||
        (freedom != Freedom::Free && freedom != Freedom::Fixed && mayRemove &&
          this->remove(judge, v)))
      {
        return true;
      }
    }
    for (int e = 0;
         e < Local<D>::numberOfEdges && level >= Level::Insertion && judge.switches().insertNodes;
         ++e)
    {
      if (this->split(judge, t, e))
      {
        return true;
      }
    }
    return false;
  }

private:
  static constexpr int SearchSteps = 14;       ///< along a curve: to 1/1000 of the range
  static constexpr double FarthestSlide = 0.8; ///< fraction of the way to a neighbour

  /// Only in space, where each try costs a proof of distance and more.
  static bool failsAgain(const Judge<D, Shape>& judge, Index v, std::uint32_t failed)
  {
    return judge.slides() && judge.failsAgain(failed, judge.mesh().pointData(v).stamp);
  }

  /// Moves v along its curve to the best place for its star, unless that fails again.
  bool slide(Judge<D, Shape>& judge, Index v)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    this->proposal_.clear();
    std::vector<Index>& star = this->proposal_.cavity;
    if (this->failsAgain(judge, v, mesh.pointData(v).moveFailed) || !judge.editor().star(v, star))
    {
      return false;
    }
    const auto range = judge.surface()->range(mesh, star, v);
    if (!range)
    {
      return false;
    }
    const double old = mesh.worstQuality(star);
    loadStar(judge, star, v, this->problem_);
    Place place = mesh.place(v);
    const double s = place.parameter;
    const auto quality = [&](double u)
    { return this->problem_.evaluate(judge.surface()->at(place.part, u)); };
    double now = Proposal<D>::Never;
    // A sliding node has one degree of freedom: a line search replaces the solver of free nodes.
    place.parameter = goldenSection(s + FarthestSlide * (range->low - s),
      s + FarthestSlide * (range->high - s), SearchSteps, quality, now);
    this->proposal_.moves.push_back({ v, judge.surface()->at(place.part, place.parameter), place });
    this->proposal_.oldWorst = old;
    this->proposal_.newWorst = now;
    judge.demand(this->proposal_);
    const bool done = judge.accept(this->proposal_);
    judge.count(Operation::NodeMotion, done);
    if (!done)
    {
      judge.noteMoveFailed(v);
    }
    return done;
  }

  /// Joins v with the first neighbour for which that gains, unless that fails again.
  bool remove(Judge<D, Shape>& judge, Index v)
  {
    const std::uint32_t failed = judge.mesh().pointData(v).removeFailed;
    if (this->failsAgain(judge, v, failed) || !judge.editor().star(v, this->star_))
    {
      return false;
    }
    this->collectNeighbours(judge, v);
    if (this->neighbours_.empty() && judge.mesh().freedom(v) == Freedom::Corner)
    {
      return false; // most corners have no other one beside them
    }
    bool done = false;
    for (std::size_t k = 0; k < this->neighbours_.size() && !done; ++k)
    {
      done = proposeContraction(
               judge.editor(), judge.surface(), v, this->neighbours_[k], this->proposal_) &&
        this->offer(judge);
    }
    judge.count(Operation::EdgeContraction, done);
    if (!done)
    {
      judge.noteRemovalFailed(v);
    }
    return done;
  }

  /// The points that v may join: its two neighbours on the curve, or those on the patch; of a
  /// corner, the corners beside it.
  void collectNeighbours(const Judge<D, Shape>& judge, Index v)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    this->neighbours_.clear();
    const auto range = judge.surface()->range(mesh, this->star_, v);
    if (range)
    {
      this->neighbours_.assign(range->ends.begin(), range->ends.end());
    }
    for (std::size_t k = 0; k < this->star_.size() && mesh.freedom(v) == Freedom::Patch; ++k)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Facet<D> f = mesh.facet(this->star_[k], i);
        if (mesh.isKept(this->star_[k], i) && hasId(f, v))
        {
          std::copy_if(f.begin(), f.end(), std::back_inserter(this->neighbours_),
            [&](Index u) { return u != v; });
        }
      }
    }
    for (std::size_t k = 0; k < this->star_.size() && mesh.freedom(v) == Freedom::Corner; ++k)
    {
      for (Index u : mesh.nodes(this->star_[k]))
      {
        if (u != v && mesh.freedom(u) == Freedom::Corner)
        {
          this->neighbours_.push_back(u);
        }
      }
    }
    if (!range)
    {
      sortUnique(this->neighbours_);
    }
  }

  /// Divides edge e of cell t, if it is on a curve, at the place that is best for this cell. The
  /// judge then looks at the other cells of the edge.
  bool split(Judge<D, Shape>& judge, Index t, int e)
  {
    // One for each cell around the edge: two in the plane, about six in space. The judge counts
    // them exactly.
    constexpr long comes = D == 2 ? 2 : 6;
    const SimplexMesh<D>& mesh = judge.mesh();
    const auto& local = Local<D>::edgeFirst[e];
    const Index a = mesh.nodes(t)[local[0]], b = mesh.nodes(t)[local[1]];
    const auto span = mesh.isEdgeKept(t, e) ? judge.surface()->span(mesh, a, b) : std::nullopt;
    if (!span || !judge.mayAddCells(comes))
    {
      return false;
    }
    const double s = this->bestParameter(judge, t, e, *span);
    // The curve decides where the node is, not the chord: the boundary stays on the curve.
    const Vec<D> x = judge.surface()->at(span->part, s);
    const auto mark = judge.begin();
    const Index p = judge.editor().addPoint(x, a, { Freedom::Curve, span->part, s });
    const bool done = p != None &&
      proposeSplit(judge.editor(), judge.surface(), { t, a, b, p }, this->proposal_) &&
      this->offer(judge);
    judge.count(Operation::NodeInsertion, done);
    return judge.end(mark, done);
  }

  /// The parameter on the span for which the worse of the two halves of cell t is best.
  double bestParameter(const Judge<D, Shape>& judge, Index t, int e, const Span& span) const
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const QualityModel<D, Shape>& model = judge.model();
    const ElementMetric<D> metric = model.metric->element(mesh.nodes(t));
    Corners<D> first;
    for (int i = 0; i <= D; ++i)
    {
      first[i] = mesh.point(mesh.nodes(t)[Local<D>::edgeFirst[e][i]]);
    }
    Corners<D> second = first;
    const auto quality = [&](double s)
    {
      first[1] = second[0] = judge.surface()->at(span.part, s);
      return std::min(model.quality.value(first, metric), model.quality.value(second, metric));
    };
    double best = Proposal<D>::Never;
    return goldenSection(span.from, span.to, SearchSteps, quality, best);
  }

  /// Makes the change if its worst cell is better than the worst cell before.
  bool offer(Judge<D, Shape>& judge)
  {
    judge.demand(this->proposal_);
    return judge.measure(this->proposal_) && judge.accept(this->proposal_);
  }

  Proposal<D> proposal_;
  StarProblem<D, Shape> problem_;
  std::vector<Index> star_, neighbours_;
};
}

#endif
