// SPDX-License-Identifier: BSD-3-Clause
/// @file FlatScale.h
/// How the steps of a node are measured where elements are flat.
///
/// A node of a flat element may move along its facet by far more than towards it. If one length
/// serves all directions, it is the small one, and the node creeps. Here the square of a step d is
///     d . A d,   A = mean of (grad q_k / q_k) (grad q_k / q_k)^T over the elements.
/// In a flat element grad q / q is the normal of the facet over the distance to it, so steps of
/// length 1 fill the ellipsoid of an interior point method, which is the same for a mesh that is
/// pressed flatter. Reference: I. I. Dikin, Iterative solution of problems of linear and quadratic
/// programming, Soviet Math. Doklady 8 (1967).
#ifndef meshopt_Reposition_FlatScale_h
#define meshopt_Reposition_FlatScale_h

#include "Mesh/Types.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace meshopt
{
template <int D>
class FlatScale
{
public:
  void clear()
  {
    this->a_.setZero();
    this->count_ = 0;
  }
  /// Adds an element of quality q > 0, with the gradient g by the place of the node.
  void add(double q, const Vec<D>& g)
  {
    const Vec<D> h = g / q;
    this->a_ += h * h.transpose();
    ++this->count_;
  }
  /// To be called after the last add().
  void close()
  {
    this->a_ /= std::max(1, this->count_);
    this->a_.diagonal().array() += LeastPart * this->a_.trace() +
      std::numeric_limits<double>::min();
    this->factors_.compute(this->a_);
  }

  /// A gradient, by steps of this scale. Its square there is that of its ascent.
  void scale(Vec<D>& g) const { this->factors_.matrixL().solveInPlace(g); }
  /// The step in space.
  void unscale(Vec<D>& d) const { this->factors_.matrixU().solveInPlace(d); }

private:
  /// Of the squares of lengths, the shortest by the longest: some digits above rounding. So steps
  /// have a length, too, where no gradient points.
  static constexpr double LeastPart = 1e-12;

  Eigen::Matrix<double, D, D> a_ = Eigen::Matrix<double, D, D>::Zero();
  int count_ = 0;
  Eigen::LLT<Eigen::Matrix<double, D, D>> factors_;
};
}

#endif
