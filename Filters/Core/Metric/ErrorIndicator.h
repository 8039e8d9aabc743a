// SPDX-License-Identifier: BSD-3-Clause
/// @file ErrorIndicator.h
/// Element sizes from an error indicator: the paper's first alternative for adaptation, where h* is
/// defined at each point of the domain.
///
/// References: Buscaglia, Dari, Zavattieri (1996), section 5. Zienkiewicz, Zhu, "A simple error
/// estimator and adaptive procedure for practical engineering analysis" (1987). Departure from the
/// latter: sizes follow from the number of elements that is least for the error, each of which has
/// then the same error in the *new* mesh.
#ifndef meshopt_Metric_ErrorIndicator_h
#define meshopt_Metric_ErrorIndicator_h

#include "Metric/MetricScaling.h"

namespace meshopt
{
struct ErrorIndicatorOptions
{
  double desiredCount = 0.0; ///< elements, > 0 where desiredErrorFraction is 0
  /// > 0: the number of elements is what makes the total error (root of the sum of squares) this
  /// part of the present one.
  double desiredErrorFraction = 0.0;
  /// The error goes with this power of the size: 1 for stresses and energy norms of linear
  /// elements, 2 for their values in L2.
  double convergenceOrder = 1.0;
  SizeLimits limits;            ///< without the anisotropy: sizes are the same in all directions
  double countCorrection = 1.0; ///< as in SolutionMetricOptions

  /// A sentence that says what is unusable; empty if all is fine.
  std::string check() const;
};

struct ErrorIndicatorSizes
{
  std::vector<double> sizes;   ///< wanted edge length per point slot
  double predictedCount = 0.0; ///< elements
  bool isCountReached = true;  ///< false: the limits on the size do not allow the wanted number
  bool isZero = false;         ///< no error anywhere: the sizes are the same everywhere
};

/// Sizes from the error of each cell, `errors` per cell of a mesh that has not been edited: norms
/// over the cell, >= 0, whose squares add up over cells.
///
/// With h_K the edge of the regular simplex of the cell's volume and a the convergence order, the
/// size is proportional to h_K error_K^(-2 / (2a + D)): the number of elements is then the least for
/// their total error. At the points stands the mean density of elements of the cells around.
/// Returns a sentence that names the first unusable cell or option, or an empty string.
template <int D>
std::string sizesFromErrors(const SimplexMesh<D>& mesh, const std::vector<double>& errors,
  const ErrorIndicatorOptions& options, ErrorIndicatorSizes& result);

extern template std::string sizesFromErrors<2>(const SimplexMesh<2>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
extern template std::string sizesFromErrors<3>(const SimplexMesh<3>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
}

#endif
