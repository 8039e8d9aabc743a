// SPDX-License-Identifier: BSD-3-Clause
/// @file Directions.h
/// The directions in which a node may move.
#ifndef meshopt_Reposition_Directions_h
#define meshopt_Reposition_Directions_h

#include "Mesh/Types.h"

namespace meshopt
{
/// Steps are sums of gradients: they stay in the directions in which these lie.
template <int D>
struct Directions
{
  Directions() { this->basis.fill(Vec<D>::Zero()); }

  std::array<Vec<D>, D> basis; ///< of those that count: orthonormal
  int count = 0;               ///< how many of the basis count; 0: the node may move anywhere

  /// The part of v in these directions: the orthogonal projection.
  Vec<D> along(const Vec<D>& v) const
  {
    // Nearly all nodes: they must cost nothing.
    if (this->count == 0)
    {
      return v;
    }
    Vec<D> sum = Vec<D>::Zero();
    for (int i = 0; i < this->count; ++i)
    {
      sum += this->basis[i] * this->basis[i].dot(v);
    }
    return sum;
  }
};
}

#endif
