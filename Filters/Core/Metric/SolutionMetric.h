// SPDX-License-Identifier: BSD-3-Clause
/// @file SolutionMetric.h
/// The solution-adapted metric: computed from a field at the points of a mesh. A mesh with equal
/// edges in this metric is the best one for the field.
///
/// References: Buscaglia, Dari, Zavattieri (1996), section 5.1. Loseille, Alauzet, "Continuous mesh
/// framework" (2011), for the scaling that minimizes the L^p norm of the interpolation error.
#ifndef meshopt_Metric_SolutionMetric_h
#define meshopt_Metric_SolutionMetric_h

#include "Metric/HessianRecovery.h"
#include "Metric/MetricScaling.h"

#include <limits>

namespace meshopt
{
/// |H| = Q |Lambda| Q' of a symmetric tensor, as eigenvalues >= 0 and eigenvectors.
template <int D>
SymmetricEigen<D> absoluteValue(const Tensor<D>& hessian);

/// G = sqrt(sum_i H_i^2) from the Hessians of a vector's components (5.2); for one component |H|.
template <int D>
SymmetricEigen<D> combinedHessian(const Tensor<D>* hessians, int components);

struct SolutionMetricOptions
{
  Recovery recovery = Recovery::LumpedMass;
  double desiredCount = 0.0; ///< elements, > 0
  /// p of the norm of the interpolation error that the metric minimizes for its number of elements:
  /// G is multiplied by det(G)^(-1 / (2p + D)). 0 means infinity, the paper's metric.
  double normOrder = 0.0;
  SizeLimits limits;
  /// Number of elements that the optimizer makes per predicted one: N / N_wanted of the last run.
  double countCorrection = 1.0;
  /// Relative precision of the values: smaller differences are noise.
  double precision = std::numeric_limits<double>::epsilon();

  /// A sentence about what is unusable; empty if all is fine.
  std::string check() const;
};

template <int D>
struct SolutionMetric
{
  /// Per point slot, symmetric positive definite; the wanted edge length in it is desiredSize. It
  /// is G where no limit applies.
  std::vector<Tensor<D>> tensors;
  double desiredSize = 0.0;    ///< h*, in the metric
  double predictedCount = 0.0; ///< elements
  bool isCountReached = true;  ///< false: the limits on the size do not allow the wanted number
  /// True if the field is linear to within its precision. Then there is nothing to adapt to, and
  /// the metric is Euclidean.
  bool isLinear = false;
};

/// Computes the metric of a field with `components` values per point: values[components * p + i],
/// finite at points that cells use. Points that no cell uses get some positive definite tensor.
/// Returns an empty string, or a sentence about what makes the options or the mesh unusable.
template <int D>
std::string solutionMetric(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, const SolutionMetricOptions& options, SolutionMetric<D>& metric);

extern template SymmetricEigen<2> absoluteValue<2>(const Tensor<2>&);
extern template SymmetricEigen<3> absoluteValue<3>(const Tensor<3>&);
extern template SymmetricEigen<2> combinedHessian<2>(const Tensor<2>*, int);
extern template SymmetricEigen<3> combinedHessian<3>(const Tensor<3>*, int);
extern template std::string solutionMetric<2>(const SimplexMesh<2>&, const std::vector<double>&,
  int, const SolutionMetricOptions&, SolutionMetric<2>&);
extern template std::string solutionMetric<3>(const SimplexMesh<3>&, const std::vector<double>&,
  int, const SolutionMetricOptions&, SolutionMetric<3>&);
}

#endif
