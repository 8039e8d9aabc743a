// SPDX-License-Identifier: BSD-3-Clause
/// @file FillingLookAhead.h
/// A filling that pays only after its nodes have been repositioned.
///
/// This is a departure from Buscaglia, Dari, Zavattieri (1996), who judge a filling as it is made,
/// with the centre of a cluster where the mean of its vertices is. Here the fillings of section 2.3
/// are made in a transaction, the Local Algorithm of section 2.2 moves the nodes of their worst
/// cell, and the whole is kept if the worst of all changed cells is better than it was; else it is
/// undone, to the bit.
#ifndef meshopt_Paper1996_FillingLookAhead_h
#define meshopt_Paper1996_FillingLookAhead_h

#include "Paper1996/FillingTrial.h"
#include "Paper1996/ClusterSolver.h"

#include <algorithm>
#include <utility>

namespace meshopt
{
template <int D, class Shape>
class LookAhead
{
public:
  LookAhead(MeshEditor<D>& editor, NodalMetric<D>& metric,
    const ElementQuality<D, Shape>& quality, double leastGain)
    : editor_(editor)
    , metric_(metric)
    , trial_(editor, metric, quality)
    , solver_(editor, metric, quality, LocalParameters{}, leastGain)
    , leastGain_(leastGain)
  {
  }

  /// Tries one filling (but Filling::Centre). If it is kept, changed() are the cells that are new
  /// or have another quality.
  bool improve(const Part<D>& part, Apex<D> apex);
  const std::vector<Index>& changed() const { return this->changed_; }

private:
  static constexpr int Solves = 3; // of the worst new cell, whichever it is by then

  void reposition(double& before);
  double worstOfChanged() const;

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  FillingTrial<D, Shape> trial_;
  ClusterSolver<D, Shape> solver_;
  double leastGain_;
  std::vector<std::uint8_t> movable_;
  std::vector<Index> changed_;
  std::vector<std::pair<Index, typename NodalMetric<D>::Sample>> samples_; // before, in order
};

template <int D, class Shape>
double LookAhead<D, Shape>::worstOfChanged() const
{
  double worst = std::numeric_limits<double>::infinity();
  for (Index c : this->changed_)
  {
    worst = std::min(worst, this->editor_.mesh().quality(c));
  }
  return worst;
}

// Solves around the worst new cell. `before` falls to the old quality of cells that change and do
// not belong to the filling.
template <int D, class Shape>
void LookAhead<D, Shape>::reposition(double& before)
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  for (Index p = static_cast<Index>(this->movable_.size()); p < mesh.numberOfPointSlots(); ++p)
  {
    this->movable_.push_back(!mesh.isFixed(p));
  }
  const std::vector<Index> made = this->changed_;
  for (int k = 0; k < Solves; ++k)
  {
    const Index worst = *std::min_element(made.begin(), made.end(), [&](Index a, Index b)
      { return std::make_pair(mesh.quality(a), a) < std::make_pair(mesh.quality(b), b); });
    if (!this->solver_.solve(worst, 0, this->movable_))
    {
      return;
    }
    const Cluster<D>& cluster = this->solver_.cluster();
    for (std::size_t i = 0; i < cluster.cells.size(); ++i)
    {
      const Index c = cluster.cells[i];
      const double old = this->solver_.oldQuality()[i];
      if (cluster.quality[i] != old &&
        std::find(this->changed_.begin(), this->changed_.end(), c) == this->changed_.end())
      {
        this->changed_.push_back(c);
        before = std::min(before, old);
      }
    }
    for (std::size_t i = 0; i < this->solver_.oldSamples().size(); ++i)
    {
      this->samples_.emplace_back(cluster.points[i], this->solver_.oldSamples()[i]);
    }
  }
}

template <int D, class Shape>
bool LookAhead<D, Shape>::improve(const Part<D>& part, Apex<D> apex)
{
  // A filling may be worse for now, but not more inverted.
  const double required = std::min(0.0, part.cluster.worst);
  const std::size_t place = this->editor_.begin();
  this->samples_.clear();
  if (this->trial_.isBetter(part, apex, required))
  {
    this->trial_.make(part, apex);
    this->changed_ = this->trial_.made();
    double before = part.cluster.worst;
    this->reposition(before);
    if (this->worstOfChanged() > before + this->leastGain_ * std::abs(before))
    {
      this->editor_.commit(place);
      return true;
    }
  }
  this->editor_.rollback(place);
  for (std::size_t k = this->samples_.size(); k-- > 0;)
  {
    this->metric_.setSample(this->samples_[k].first, this->samples_[k].second);
  }
  return false;
}
}

#endif
