// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeFloor.h
/// The lowest size that can be reached around edges that stay as they are.
#ifndef meshopt_Metric_SizeFloor_h
#define meshopt_Metric_SizeFloor_h

#include "Mesh/Types.h"

#include <array>
#include <map>
#include <vector>

namespace meshopt
{
/// Beside an edge no element much smaller than the edge is good. Away from it, sizes fall by a
/// fraction of the distance, as fast as good triangles can follow. Immutable.
template <int D>
class SizeFloor
{
public:
  struct Edge
  {
    Vec<D> a, b;
    Tensor<D> metric; ///< for its length, and for distances from it
    double size;      ///< its length in the metric
  };

  /// `least`: floors below this size do not matter.
  SizeFloor(std::vector<Edge> edges, double least);

  /// The greatest size that any of the edges requires at x; at most 0 far from all of them.
  double at(const Vec<D>& x) const;

private:
  using Bin = std::array<long, D>;
  Bin binOf(const Vec<D>& x) const;
  double countBins(const std::vector<Vec<D>>& low, const std::vector<Vec<D>>& high) const;

  std::vector<Edge> edges_;
  double width_ = 1.0; // of a bin
  std::map<Bin, std::vector<Index>> bins_;
};

extern template class SizeFloor<2>;
extern template class SizeFloor<3>;
}

#endif
