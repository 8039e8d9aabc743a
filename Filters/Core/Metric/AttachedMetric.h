// SPDX-License-Identifier: BSD-3-Clause
/// @file AttachedMetric.h
/// The samples of a metric, as values that follow the points of a mesh.
#ifndef meshopt_Metric_AttachedMetric_h
#define meshopt_Metric_AttachedMetric_h

#include "Mesh/PointAttachment.h"
#include "Metric/NodalMetric.h"

namespace meshopt
{
/// Samples the metric wherever an editor places a point; for MeshEditor::attach().
template <int D>
class AttachedMetric final : public PointAttachment<D>
{
public:
  using Sample = typename NodalMetric<D>::Sample;

  explicit AttachedMetric(NodalMetric<D>& metric)
    : metric_(&metric)
  {
  }

  std::unique_ptr<typename PointAttachment<D>::Journal> makeJournal() override
  {
    return std::make_unique<ValueJournal<D, AttachedMetric, Sample>>(*this);
  }
  void reserve(Index n) override { this->metric_->reserve(n); }
  void pointPlaced(Index p, const Vec<D>& x, Index near) override
  {
    this->metric_->resample(p, x, near);
  }

  Sample get(Index p) const { return this->metric_->sample(p); }
  void set(Index p, const Sample& value) { this->metric_->setSample(p, value); }

private:
  NodalMetric<D>* metric_;
};
}

#endif
