// SPDX-License-Identifier: BSD-3-Clause
/// @file MetricVolume.h
/// Volume of a mesh in a metric (5.3), and the number of elements that follows from it.
#ifndef meshopt_Metric_MetricVolume_h
#define meshopt_Metric_MetricVolume_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Mean of exp(f) over a simplex, for the linear f with values a at its nodes: D! exp[a_0, ...,
/// a_D], a divided difference. Relative error about 1e-13.
template <int D>
double meanOfExponential(const std::array<double, D + 1>& a);

/// int sqrt(det M) over the mesh, with log-Euclidean interpolation of M as in NodalMetric. This is
/// exact, while the paper's (5.3) uses one value per cell. `halfLogDeterminants` holds ln(det M) /
/// 2 per point slot. Volumes count without their sign.
template <int D>
double metricVolume(const SimplexMesh<D>& mesh, const std::vector<double>& halfLogDeterminants);

/// Number of regular elements of edge 1 per unit of volume: 4 / sqrt(3), 6 sqrt(2). (An estimate:
/// regular tetrahedra do not fill space.)
template <int D>
constexpr double regularElementsPerVolume = D == 2 ? 2.3094010767585030 : 8.4852813742385703;

extern template double meanOfExponential<2>(const std::array<double, 3>&);
extern template double meanOfExponential<3>(const std::array<double, 4>&);
extern template double metricVolume<2>(const SimplexMesh<2>&, const std::vector<double>&);
extern template double metricVolume<3>(const SimplexMesh<3>&, const std::vector<double>&);
}

#endif
