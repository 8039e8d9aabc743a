// SPDX-License-Identifier: BSD-3-Clause
/// @file MetricScaling.h
/// How fine to mesh: the h* at which a metric gives the wanted number of elements, within limits.
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
/// Lengths in units of the mesh. 0 always means: no limit.
struct SizeLimits
{
  double minimumSize = 0.0; ///< shortest wanted edge, in any direction
  /// Longest wanted edge. 0: the diagonal of the bounding box. Even where the metric wants infinite
  /// edges, the mesh has no room for longer ones.
  double maximumSize = 0.0;
  double maximumAnisotropy = 0.0; ///< >= 1: longest over shortest wanted edge at a point
  double gradation = 0.0;         ///< > 1: see limitGradation()

  /// A sentence about what is unusable; empty if all is fine.
  std::string check() const;
};

template <int D>
struct ScaledMetric
{
  /// Per point slot, within the limits; the wanted edge length in it is 1.
  std::vector<Tensor<D>> unit;
  double desiredSize = 0.0;    ///< h*: the wanted length in the metric that was scaled
  double predictedCount = 0.0; ///< elements
  /// False if the limits on the size allow only more or fewer elements than wanted. The number is
  /// then as close to it as they allow.
  bool isCountReached = true;
};

/// A metric G at the points of a mesh, and G / h*^2 within limits for any h*. The number of
/// elements is regularElementsPerVolume * correction * metricVolume().
///
/// Limits are applied in this order: sizes; anisotropy, by shortening the long directions;
/// gradation, which also makes edges shorter; then the limits of each point again, since the
/// gradation may overstep them a little.
template <int D>
class MetricScaling
{
public:
  /// `metric`: per point slot, with eigenvalues >= 0, and > 0 somewhere at a point that a cell
  /// uses. `correction` > 0: number of real elements for each predicted one.
  MetricScaling(const SimplexMesh<D>& mesh, std::vector<SymmetricEigen<D>> metric,
    const SizeLimits& limits, double correction);

  /// The scaling with `count` > 0 elements, to a relative 1e-4 without gradation and 1e-3 with it.
  ScaledMetric<D> withCount(double count);
  /// The scaling for a given h* > 0.
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
  double volume_ = 0.0;         ///< of the mesh, Euclidean
  double greatest_ = 0.0;       ///< greatest eigenvalue
  PointGraph graph_;            ///< empty without gradation
  std::vector<Tensor<D>> unit_; ///< for h* = unitSize_
  double unitSize_ = 0.0;
};

extern template class MetricScaling<2>;
extern template class MetricScaling<3>;
}

#endif
