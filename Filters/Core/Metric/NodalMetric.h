// SPDX-License-Identifier: BSD-3-Clause
/// @file NodalMetric.h
/// Desired size h* and metric tensor M at the points of a mesh, frozen on the input mesh.
#ifndef meshopt_Metric_NodalMetric_h
#define meshopt_Metric_NodalMetric_h

#include "Mesh/SimplexMesh.h"
#include "Quality/Measure.h"

#include <vector>

namespace meshopt
{
/// The field lives on the *background*: a copy of the input mesh with the values the user gave at
/// its points. At the points of the mesh being optimized it is sampled by linear interpolation (of
/// log h*, and of log M: log-Euclidean), again whenever a point moves or comes, so that it does
/// not drift. Without sizes and without tensors it is trivial and costs nothing.
template <int D>
class NodalMetric
{
public:
  /// Trivial: Euclidean, h* the same everywhere.
  explicit NodalMetric(double desiredSize = 0.0) { this->constantSize_ = desiredSize; }

  /// Values at the points of `background` (which is copied): sizes empty or one per input point, > 0;
  /// tensors empty or one per input point, symmetric positive definite. Returns a sentence
  /// naming the first unusable value, or an empty string.
  std::string set(const SimplexMesh<D>& background, const std::vector<double>& sizes,
    const std::vector<Tensor<D>>& tensors);

  /// One tensor for all points; same error.
  std::string setConstant(const Tensor<D>& tensor);

  bool isTrivial() const { return this->values_.empty() && !this->hasConstant_; }
  bool hasSizes() const;
  bool hasTensors() const;

  /// Samples the background at x and stores the values for point p (moved or new). Does nothing
  /// where the field does not vary. Points out of the background take the nearest cell's clamped value.
  void resample(Index p, const Vec<D>& x);

  /// The metric and h* of an element: from the mean of the logarithms at its nodes.
  ElementMetric<D> element(const Simplex<D>& nodes) const;

private:
  struct Value
  {
    double logSize = 0.0;
    Tensor<D> logTensor = Tensor<D>::Zero();
  };
  double constantSize_ = 0.0;
  bool hasConstant_ = false;
  ElementMetric<D> constant_;
  std::vector<Value> values_; // per point of the optimized mesh
  // The quality engineer completes this: background copy, walking location.
};
}

#endif
