// SPDX-License-Identifier: BSD-3-Clause
/// @file Workpiece.h
/// What the fast engine works on: the mesh, the quality of its cells, and the caps that bound it.
#ifndef meshopt_WorstFirst_Workpiece_h
#define meshopt_WorstFirst_Workpiece_h

#include "Bound/Caps.h"
#include "Edit/QualityModel.h"
#include "Run/Run.h"
#include "WorstFirst/Constants.h"
#include "WorstFirst/Task.h"
#include "WorstFirst/Weights.h"

namespace meshopt
{
namespace worstfirst
{
template <int D, class Shape>
class Workpiece
{
public:
  /// Certifies the caps. The run must outlive this object.
  Workpiece(Run<D>& run, const Shape& shape)
    : run_(run)
    , model_(run.mesh(), run.metric, run.options.beta, shape)
    , weights_(run.editor, this->model_, this->caps_)
    , worst_(run.report.history.back().worst)
  {
    const Options& options = run.options;
    // Caps are needed up to the highest target of any stage: a cell above that is never tried.
    const double highest = run.effort == Effort::Best
      ? std::max(*(std::end(Stages) - 1), run.target)
      : run.target;
    // No cap is certified if the metric varies or if the surface itself can change.
    this->caps_.build(run.mesh(), options.measure, highest, run.metric.isTrivial() && !run.surface);
    this->caps_.setFull(run.target / TinyReached);
    run.report.bound = std::min(this->caps_.bound(), run.bound);
    this->findWorstOfPart();
  }
  Workpiece(const Workpiece&) = delete; // its parts know each other
  Workpiece& operator=(const Workpiece&) = delete;

  Run<D>& run() const { return this->run_; }
  const SimplexMesh<D>& mesh() const { return this->run_.mesh(); }
  const Options& options() const { return this->run_.options; }
  Effort effort() const { return this->run_.effort; }
  const QualityModel<D, Shape>& model() const { return this->model_; }
  Caps<D>& caps() { return this->caps_; }
  const Caps<D>& caps() const { return this->caps_; }
  Weights<D, Shape>& weights() { return this->weights_; }

  // --- targets and bounds
  /// Of this run of the engine.
  double target() const { return this->run_.target; }
  bool isPast(double target) const { return target > this->target() + SameTarget; }
  /// What no cell can exceed, or need not.
  double bound() const
  {
    const double most = this->options().mostQuality;
    return most >= 0.0 ? most : std::min(this->caps_.bound(), this->run_.bound);
  }
  /// The worst quality when the last row of the history was written. Of all cells; in a part of a
  /// mesh of those that are not left to other runs.
  double worst() const { return this->worst_; }
  /// False where no bound is known, unless the surface takes part: then hardly anything is bound.
  bool isFarBelowBound() const
  {
    return (this->bound() < 1.0 || this->slides()) && this->worst_ < FarBelowBound * this->bound();
  }
  /// Whether nothing can lift the worst cell any more, but for rounding.
  bool hasReachedBound() const { return this->worst_ >= CapReached * this->bound(); }
  /// Whether polishing ends then: where the surface takes part, it is not known which other cells
  /// are held; and a quick run leaves these as they are.
  bool isPolished() const
  {
    return this->hasReachedBound() &&
      (this->slides() || (this->effort() == Effort::Quick && this->isKeptAndPlain()));
  }
  /// Whether cells at facets with tiny caps count. At the border of a part they do not.
  bool sparesTiny() const { return this->caps_.hasTiny() && this->bound() < Caps<D>::Tiny; }

  // --- the mesh
  /// Whether the surface of tetrahedra takes part: see Judge::slides().
  bool slides() const { return this->run_.surface && this->run_.surface->judgesChanges(); }
  /// Whether the surface is kept, and lengths are not those of a metric. Elsewhere a change costs
  /// more, and fewer cells are stuck for good: there other rules hold.
  bool isKeptAndPlain() const { return this->model_.plain && !this->slides(); }
  /// The least gain of a change, in general.
  double usualGain() const { return this->model_.plain ? Gain : CoarseGain; }
  /// How many cells count as few: see FewCells.
  long fewCells() const
  {
    const long cells = this->mesh().numberOfCellSlots();
    return std::max({ FewestCells, std::min(FewCells, cells / FewCellsPart), cells / FewOfMany });
  }
  /// The diagonal of the mesh in its mean edges. About: by one cell in many.
  double widthInEdges() const;
  /// Whether the cell is at the border of a part, and better off in another run.
  bool isLeft(Index c) const
  {
    const Simplex<D>& nodes = this->mesh().nodes(c);
    return this->mesh().hasBorder() &&
      std::any_of(nodes.begin(), nodes.end(), [&](Index p) { return this->mesh().isAtBorder(p); });
  }
  /// A failed cell is tried again only with more effort, or after something has changed around it.
  bool isWorthTrying(Index c, Phase phase, int level) const
  {
    const auto& data = this->mesh().cellData(c);
    const auto& nodes = this->mesh().nodes(c);
    return data.stamp == 0 || data.level < rankOf(phase, level) ||
      std::any_of(nodes.begin(), nodes.end(),
        [&](Index p) { return this->mesh().pointData(p).stamp > data.stamp; });
  }

  /// The true qualities, not the weighted ones, as a row of the history. worst() is theirs from now
  /// on.
  PassRecord summary(long& inverted)
  {
    const bool weighed = this->weights_.areOn();
    this->weights_.switchOff();
    const PassRecord row = summarize(this->mesh(), this->options().targetQuality, &inverted);
    this->worst_ = row.worst;
    this->findWorstOfPart();
    if (weighed)
    {
      this->weights_.switchOn();
    }
    return row;
  }

private:
  /// In a part of a mesh: the worst quality of the cells that are not left to other runs; 1 if
  /// there are none.
  void findWorstOfPart()
  {
    if (!this->mesh().hasBorder())
    {
      return;
    }
    this->worst_ = 1.0;
    for (Index c = 0; c < this->mesh().numberOfCellSlots(); ++c)
    {
      // The quality first: hardly any cell is worse than all before.
      const double q = this->mesh().quality(c);
      this->worst_ = q < this->worst_ && this->mesh().isAlive(c) && !this->isLeft(c) ? q
                                                                                     : this->worst_;
    }
  }

  Run<D>& run_;
  QualityModel<D, Shape> model_;
  Caps<D> caps_;
  Weights<D, Shape> weights_;
  double worst_;
};

template <int D, class Shape>
double Workpiece<D, Shape>::widthInEdges() const
{
  constexpr Index sampled = 1000;
  const SimplexMesh<D>& mesh = this->mesh();
  const Index step = 1 + mesh.numberOfCellSlots() / sampled;
  Eigen::AlignedBox<double, D> box;
  double sum = 0.0;
  long edges = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); c += step)
  {
    for (const auto& e : Local<D>::edges)
    {
      if (mesh.isAlive(c))
      {
        const Vec<D> a = mesh.point(mesh.nodes(c)[e[0]]), b = mesh.point(mesh.nodes(c)[e[1]]);
        box.extend(a);
        box.extend(b);
        sum += (a - b).norm();
        ++edges;
      }
    }
  }
  return sum > 0.0 ? box.diagonal().norm() * static_cast<double>(edges) / sum : 0.0;
}
}
}

#endif
