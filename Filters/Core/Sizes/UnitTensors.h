// SPDX-License-Identifier: BSD-3-Clause
/// @file UnitTensors.h
/// The wanted lengths at the points of a mesh, as tensors in which edges of the wanted length have
/// length 1.
#ifndef meshopt_Sizes_UnitTensors_h
#define meshopt_Sizes_UnitTensors_h

#include "Mesh/PointAttachment.h"
#include "Metric/NodalMetric.h"

namespace meshopt
{
/// M / h*^2 at each point. It is stored because it costs a matrix exponential. Follows the points
/// once attached; attach it after the metric, which it reads.
template <int D>
class UnitTensors final : public PointAttachment<D>
{
public:
  explicit UnitTensors(const NodalMetric<D>& metric)
    : metric_(&metric)
  {
  }

  const Tensor<D>& operator[](Index p) const { return this->units_[p]; }
  void update(Index p) { this->units_[p] = this->metric_->unitTensor(p); }

  std::unique_ptr<typename PointAttachment<D>::Journal> makeJournal() override
  {
    return std::make_unique<ValueJournal<D, UnitTensors, Tensor<D>>>(*this);
  }
  /// Identity until a point is placed there: every slot has a usable tensor.
  void reserve(Index n) override
  {
    if (static_cast<Index>(this->units_.size()) < n)
    {
      this->units_.resize(n, Tensor<D>::Identity());
    }
  }
  void pointPlaced(Index p, const Vec<D>&, Index) override { this->update(p); }

  /// For the journal: an undone move brings back the old tensor without computing it.
  Tensor<D> get(Index p) const { return this->units_[p]; }
  void set(Index p, const Tensor<D>& value) { this->units_[p] = value; }

private:
  const NodalMetric<D>* metric_;
  std::vector<Tensor<D>> units_;
};
}

#endif
