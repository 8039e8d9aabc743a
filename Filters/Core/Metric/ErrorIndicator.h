// SPDX-License-Identifier: BSD-3-Clause
/// @file ErrorIndicator.h
/// Element sizes from an error indicator. This is the paper's first alternative for adaptation: h*
/// is defined at each point of the domain.
///
/// References: Buscaglia, Dari, Zavattieri (1996), section 5. Zienkiewicz, Zhu, "A simple error
/// estimator and adaptive procedure for practical engineering analysis" (1987). Departure from the
/// latter: the sizes give the lowest number of elements for the error; each element then has the
/// same error in the *new* mesh.
#ifndef meshopt_Metric_ErrorIndicator_h
#define meshopt_Metric_ErrorIndicator_h

#include "Metric/MetricScaling.h"

namespace meshopt
{
struct ErrorIndicatorOptions
{
  double desiredCount = 0.0; ///< elements; > 0 if desiredErrorFraction is 0
  /// If > 0, the number of elements is chosen to make the total error (root of the sum of squares)
  /// this fraction of the present one.
  double desiredErrorFraction = 0.0;
  /// The error is proportional to this power of the size: 1 for stresses and energy norms of linear
  /// elements, 2 for their values in L2.
  double convergenceOrder = 1.0;
  SizeLimits limits;            ///< without anisotropy: sizes are the same in all directions
  double countCorrection = 1.0; ///< as in SolutionMetricOptions

  /// A sentence about what is unusable; empty if all is fine.
  std::string check() const;
};

struct ErrorIndicatorSizes
{
  std::vector<double> sizes;   ///< wanted edge length per point slot
  double predictedCount = 0.0; ///< elements
  bool isCountReached = true;  ///< false: the limits on the size do not allow the wanted number
  bool isZero = false;         ///< no error anywhere: the sizes are the same everywhere
};

/// Computes sizes from the error of each cell. `errors`: one per cell of a mesh that has not been
/// edited; norms over the cell, >= 0, whose squares add up over cells.
///
/// Let h_K be the edge of the regular simplex with the cell's volume, and a the convergence order.
/// The size is proportional to h_K error_K^(-2 / (2a + D)), which gives the lowest number of
/// elements for their total error. A point gets the mean density of elements of the cells around
/// it. Returns a sentence about the first unusable cell or option, or an empty string.
template <int D>
std::string sizesFromErrors(const SimplexMesh<D>& mesh, const std::vector<double>& errors,
  const ErrorIndicatorOptions& options, ErrorIndicatorSizes& result);

extern template std::string sizesFromErrors<2>(const SimplexMesh<2>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
extern template std::string sizesFromErrors<3>(const SimplexMesh<3>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
}

#endif
