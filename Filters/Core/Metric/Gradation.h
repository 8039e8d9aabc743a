// SPDX-License-Identifier: BSD-3-Clause
/// @file Gradation.h
/// A limit on how fast a metric may change from point to point.
///
/// Reference: Alauzet, "Size gradation control of anisotropic meshes" (2010): growth that is
/// homogeneous in the metric. Departure: the loop over edges runs until nothing changes, not for a
/// fixed number of passes.
#ifndef meshopt_Metric_Gradation_h
#define meshopt_Metric_Gradation_h

#include "Metric/PointGraph.h"

#include <vector>

namespace meshopt
{
/// The metric whose unit ball is the largest inside both unit balls, along the axes that both have
/// in common (simultaneous reduction). It is at least `a` and at least `b` in every direction, up
/// to rounding. Both must be symmetric positive definite.
template <int D>
Tensor<D> intersection(const Tensor<D>& a, const Tensor<D>& b);

/// The metric that the metric `m` of a point allows at the other end of an edge: lengths grow by
/// the factor 1 + l ln(gradation), where l is the length of the edge in m.
template <int D>
Tensor<D> grown(const Tensor<D>& m, const Vec<D>& edge, double gradation);

/// Makes metrics stronger until, along each edge and both ways, the metric at one end is at least
/// what the other end allows. `metrics`: one per point slot, in which the wanted edge length is 1.
/// `gradation` > 1: about the ratio of the lengths of neighbouring edges. At the end less than 1e-3
/// of a metric is missing. Deterministic. Returns the number of sweeps over the points.
template <int D>
int limitGradation(const SimplexMesh<D>& mesh, const PointGraph& graph, double gradation,
  std::vector<Tensor<D>>& metrics);

extern template Tensor<2> intersection<2>(const Tensor<2>&, const Tensor<2>&);
extern template Tensor<3> intersection<3>(const Tensor<3>&, const Tensor<3>&);
extern template Tensor<2> grown<2>(const Tensor<2>&, const Vec<2>&, double);
extern template Tensor<3> grown<3>(const Tensor<3>&, const Vec<3>&, double);
extern template int limitGradation<2>(
  const SimplexMesh<2>&, const PointGraph&, double, std::vector<Tensor<2>>&);
extern template int limitGradation<3>(
  const SimplexMesh<3>&, const PointGraph&, double, std::vector<Tensor<3>>&);
}

#endif
