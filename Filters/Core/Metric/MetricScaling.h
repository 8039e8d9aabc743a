// SPDX-License-Identifier: BSD-3-Clause
/// @file MetricScaling.h
/// How fine: the h* for which a metric gives the wanted number of elements, within limits.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), equation (5.3).
#ifndef meshopt_Metric_MetricScaling_h
#define meshopt_Metric_MetricScaling_h

#include "Metric/PointGraph.h"
#include "Metric/SymmetricEigen.h"

#include <string>
#include <vector>

namespace meshopt
{
/// Lengths in the units of the mesh; 0 always means: no limit.
struct SizeLimits
{
  double minimumSize = 0.0; ///< shortest wanted edge, in any direction
  /// Longest wanted edge. Without limit it is the diagonal of the bounding box: where the metric
  /// asks for infinite edges, the mesh has room for no longer ones.
  double maximumSize = 0.0;
  double maximumAnisotropy = 0.0; ///< >= 1: longest over shortest wanted edge at a point
  double gradation = 0.0;         ///< > 1: see limitGradation()

  /// A sentence that says what is unusable; empty if all is fine.
  std::string check() const;
};

template <int D>
struct ScaledMetric
{
  /// Per point slot, within the limits; such that the wanted edge length is 1.
  std::vector<Tensor<D>> unit;
  double desiredSize = 0.0;    ///< h*: the wanted length in the metric that was scaled
  double predictedCount = 0.0; ///< elements
  /// False if the limits on the size leave only more or fewer elements than wanted; it is as close as
  /// they let it be.
  bool isCountReached = true;
};

/// A metric G at the points of a mesh, and G / h*^2 within limits for any h*. The number of
/// elements is regularElementsPerVolume * correction * metricVolume().
///
/// Limits are applied in this order: sizes; anisotropy, by shortening the long directions;
/// gradation, which makes edges shorter as well; then the limits of a point once more, since the
/// gradation may overstep them a little.
template <int D>
class MetricScaling
{
public:
  /// `metric` per point slot: eigenvalues >= 0, somewhere > 0 at a point that a cell uses.
  /// `correction` > 0: elements that come out for each one predicted.
  MetricScaling(const SimplexMesh<D>& mesh, std::vector<SymmetricEigen<D>> metric,
    const SizeLimits& limits, double correction);

  /// The scaling with `count` > 0 elements, to 1e-4 of them without gradation and 1e-3 with it.
  ScaledMetric<D> withCount(double count);
  /// The scaling for an h* > 0 that is known.
  ScaledMetric<D> withSize(double h);

  /// The longest wanted edge: the limit, or the diagonal of the bounding box.
  double maximumSize() const { return this->maximumSize_; }

private:
  Vec<D> limited(const Vec<D>& eigenvalues, double h) const;
  double predict(double h) const;
  double predictGraded(double h);
  double countFromVolume(double volume) const;
  double uniformCount(double h) const;
  void makeUnit(double h);

  const SimplexMesh<D>& mesh_;
  std::vector<SymmetricEigen<D>> metric_;
  SizeLimits limits_;
  double correction_;
  double maximumSize_ = 0.0;
  double volume_ = 0.0;         ///< of the mesh, as it is
  double greatest_ = 0.0;       ///< eigenvalue
  PointGraph graph_;            ///< empty without gradation
  std::vector<Tensor<D>> unit_; ///< for h* = unitSize_
  double unitSize_ = 0.0;
};

extern template class MetricScaling<2>;
extern template class MetricScaling<3>;
}

#endif
