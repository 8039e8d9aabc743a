// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeLengths.h
/// The lengths of the edges of a mesh, in units of the wanted lengths.
#ifndef meshopt_Metric_EdgeLengths_h
#define meshopt_Metric_EdgeLengths_h

#include "Metric/NodalMetric.h"

#include <array>
#include <cmath>

namespace meshopt
{
/// Length of edge (a, b) in the metric of its ends and in units of the length wanted there: (l_a -
/// l_b) / ln(l_a / l_b), which is exact if ln l is linear in between.
template <int D>
double edgeLength(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, Index a, Index b);

/// sqrt(e' m e).
template <int D>
double lengthIn(const Tensor<D>& m, const Vec<D>& e)
{
  return std::sqrt(e.dot(m * e));
}

/// Mean length of an edge whose length is la in units of what one end wants, and lb of the other.
double logMeanLength(double la, double lb);

struct EdgeLengths
{
  static constexpr int BinsPerOctave = 4, Octaves = 3; ///< of the histogram, above 1 and below

  long edges = 0;
  double share = 0.0; ///< of edges from 1 / sqrt 2 to sqrt 2; 0 if there are none
  double shortest = 0.0, longest = 0.0;
  /// Bin k counts lengths from 2^(k / BinsPerOctave - Octaves) on. Lengths beyond are in the end
  /// bins.
  std::array<long, 2 * BinsPerOctave * Octaves> histogram{};
  /// Lower end of bin k.
  static double lowerEnd(std::size_t k);

  /// Adds those of another mesh.
  void add(const EdgeLengths& other);
};

/// Each live edge counts once. O(n log n).
template <int D>
EdgeLengths measureEdges(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric);

extern template double edgeLength<2>(const SimplexMesh<2>&, const NodalMetric<2>&, Index, Index);
extern template double edgeLength<3>(const SimplexMesh<3>&, const NodalMetric<3>&, Index, Index);
extern template EdgeLengths measureEdges<2>(const SimplexMesh<2>&, const NodalMetric<2>&);
extern template EdgeLengths measureEdges<3>(const SimplexMesh<3>&, const NodalMetric<3>&);
}

#endif
