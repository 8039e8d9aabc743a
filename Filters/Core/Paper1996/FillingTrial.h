// SPDX-License-Identifier: BSD-3-Clause
/// @file FillingTrial.h
/// Tries a filling virtually, and makes it.
#ifndef meshopt_Paper1996_FillingTrial_h
#define meshopt_Paper1996_FillingTrial_h

#include "Mesh/CavityFit.h"
#include "Mesh/PinchedPoints.h"
#include "Metric/NodalMetric.h"
#include "Quality/ElementQuality.h"
#include "Paper1996/Filling.h"

namespace meshopt
{
/// For one shape measure; keeps its scratch between calls.
template <int D, class Shape>
class FillingTrial
{
public:
  FillingTrial(
    MeshEditor<D>& editor, NodalMetric<D>& metric, const ElementQuality<D, Shape>& quality)
    : editor_(editor)
    , mesh_(editor.mesh())
    , metric_(metric)
    , quality_(quality)
    , trivial_(metric.isTrivial())
    , pinched_(pinchedPoints<D>(editor.mesh()))
  {
    if (this->trivial_)
    {
      this->common_ = metric.element(Simplex<D>{});
    }
  }

  /// True if all cells of the filling are better than `required`, no more of them inverted or flat
  /// than the cluster has, and nothing is lost that is to be kept. The mesh stays as it is, but for
  /// a new apex: it becomes a point that no cell uses (apex.id). Call make() or giveUp() next.
  bool isBetter(const Part<D>& part, Apex<D>& apex, double required);
  /// Makes the filling; made() are its cells.
  void make(const Part<D>& part, const Apex<D>& apex);
  void giveUp(const Part<D>& part, const Apex<D>& apex);

  const std::vector<Index>& made() const { return this->made_; }
  /// Cells that the filling last tried has more than its cluster; after isBetter() was true.
  long growth(const Part<D>& part) const
  {
    return static_cast<long>(this->fan_.cells.size()) -
      static_cast<long>(part.cluster.cells.size());
  }

private:
  bool keepsWhatItMust(const Part<D>& part, const Apex<D>& apex);
  void collectCells(Index p);

  MeshEditor<D>& editor_;
  const SimplexMesh<D>& mesh_;
  NodalMetric<D>& metric_;
  ElementQuality<D, Shape> quality_;
  bool trivial_; // the metric is the same for all elements
  std::vector<std::uint8_t> pinched_;
  ElementMetric<D> common_;
  typename NodalMetric<D>::Sample oldSample_; // of a node that is tried at the centre
  Fan<D> fan_;
  std::vector<Index> star_, made_;
  std::vector<Simplex<D>> outside_;
  std::vector<std::array<Index, 2>> keptEdges_;
};

template <int D, class Shape>
bool FillingTrial<D, Shape>::isBetter(const Part<D>& part, Apex<D>& apex, double required)
{
  if (apex.id == None)
  {
    apex.id = this->editor_.addPoint(apex.x);
  }
  if (apex.local < 0)
  {
    const bool isNew = apex.id != part.core[0];
    this->oldSample_ = this->metric_.sample(apex.id);
    this->metric_.resample(apex.id, apex.x, isNew ? part.core[0] : None);
  }
  const auto qualityOf = [&](const Simplex<D>& nodes, const Corners<D>& x) {
    return this->quality_.value(x, this->trivial_ ? this->common_ : this->metric_.element(nodes));
  };
  return fillFromApex<D>(part.cluster, apex, required, qualityOf, this->fan_) &&
    this->keepsWhatItMust(part, apex);
}

template <int D, class Shape>
void FillingTrial<D, Shape>::giveUp(const Part<D>& part, const Apex<D>& apex)
{
  if (apex.local < 0 && apex.id == part.core[0])
  {
    this->metric_.setSample(apex.id, this->oldSample_);
  }
  else if (apex.local < 0)
  {
    this->editor_.dropPoint(apex.id);
  }
}

/// Collects all cells of p in star_.
template <int D, class Shape>
void FillingTrial<D, Shape>::collectCells(Index p)
{
  const bool isPinched = p < static_cast<Index>(this->pinched_.size()) && this->pinched_[p];
  if (!isPinched)
  {
    this->editor_.star(p, this->star_);
    return;
  }
  this->star_.clear();
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    if (this->mesh_.isAlive(c) && this->mesh_.localIndex(c, p) >= 0)
    {
      this->star_.push_back(c);
    }
  }
}

// What geometry does not tell: the fan meets the rest of the mesh in the cluster's boundary only,
// and has the kept edges.
template <int D, class Shape>
bool FillingTrial<D, Shape>::keepsWhatItMust(const Part<D>& part, const Apex<D>& apex)
{
  const bool moves = apex.local < 0 && apex.id == part.core[0];
  if (!moves && !fillsCavity<D>(this->mesh_, part.cluster.cells, this->fan_.cells))
  {
    return false;
  }
  if (apex.local >= 0)
  {
    this->collectCells(apex.id);
    const std::uint32_t mark = this->editor_.newMark();
    for (Index c : part.cluster.cells)
    {
      this->editor_.setMark(c, mark);
    }
    this->outside_.clear();
    for (Index c : this->star_)
    {
      if (!this->editor_.isMarked(c, mark))
      {
        this->outside_.push_back(this->mesh_.nodes(c));
      }
    }
    if (!isFanSafe<D>(part.cluster, apex, this->outside_))
    {
      return false;
    }
  }
  if (!this->mesh_.hasConstrainedEdges())
  {
    return true;
  }
  this->keptEdges_.clear();
  for (Index c : part.cluster.cells)
  {
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      if (this->mesh_.isEdgeConstrained(c, e))
      {
        const auto& local = Local<D>::edges[e];
        this->keptEdges_.push_back(
          { this->mesh_.nodes(c)[local[0]], this->mesh_.nodes(c)[local[1]] });
      }
    }
  }
  return fanHasEdges<D>(this->fan_, this->keptEdges_);
}

template <int D, class Shape>
void FillingTrial<D, Shape>::make(const Part<D>& part, const Apex<D>& apex)
{
  if (apex.local >= 0 || apex.id != part.core[0])
  {
    this->editor_.replace(part.cluster.cells, this->fan_.cells, this->fan_.quality);
    this->made_ = this->editor_.created();
    return;
  }
  // The node goes to the centre. The cells keep the order of their nodes, in which the quality may
  // differ from that of the fan in the last bit.
  this->editor_.movePoint(apex.id, apex.x);
  for (Index c : part.cluster.cells)
  {
    const ElementMetric<D> m = this->trivial_ ? this->common_
                                              : this->metric_.element(this->mesh_.nodes(c));
    this->editor_.setQuality(c, this->quality_.value(this->mesh_.corners(c), m));
  }
  this->made_ = part.cluster.cells;
}
}

#endif
