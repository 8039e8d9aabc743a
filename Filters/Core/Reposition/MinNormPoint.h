// SPDX-License-Identifier: BSD-3-Clause
/// @file MinNormPoint.h
/// The point of least norm in the convex hull of a few sparse vectors: the quadratic program
/// (2.4)-(2.6).
///
/// References:
///  - Buscaglia, Dari, Zavattieri (1996), (2.4)-(2.6). With w_K = (psi - f_K ; L grad f_K) the
///    functional of (2.5) is |sum mu_K w_K|^2: its first square is one more coordinate.
///  - P. Wolfe, Finding the nearest point in a polytope, Mathematical Programming 11 (1976): an
///    active set method (the paper's [22] is a general text on such methods).
/// Departures: products between points are formed only for points of the corral, from their common
/// blocks. Ties go to the point with the lowest number. Weights under 1e-12 are dropped.
#ifndef meshopt_Reposition_MinNormPoint_h
#define meshopt_Reposition_MinNormPoint_h

#include "Mesh/Types.h"

#include <vector>

namespace meshopt
{
/// A vector of one scalar and n blocks of D numbers each; at most D + 1 blocks are not zero.
template <int D>
struct SparsePoint
{
  double first = 0.0;
  int count = 0; ///< blocks in use
  std::array<int, D + 1> block{};
  std::array<Vec<D>, D + 1> value;

  double dot(const SparsePoint& other) const
  {
    double sum = this->first * other.first;
    for (int i = 0; i < this->count; ++i)
    {
      for (int j = 0; j < other.count; ++j)
      {
        if (this->block[i] == other.block[j])
        {
          sum += this->value[i].dot(other.value[j]);
        }
      }
    }
    return sum;
  }
};

/// Finds the weights; keeps its scratch memory between calls.
template <int D>
class MinNormPoint
{
public:
  /// Finds the point of least norm in the convex hull of `points` (at least one), whose blocks are
  /// numbered 0 .. numberOfBlocks - 1. The corral never has more than D * numberOfBlocks + 2
  /// points. Converged when <x, w> >= |x|^2 - 1e-12 max |w|^2 for every point w.
  void solve(const std::vector<SparsePoint<D>>& points, int numberOfBlocks);

  /// Points with a weight, ascending, and their weights (> 0, sum 1). They are the certificate of
  /// the point of least norm, which is all that callers need: tests check it.
  const std::vector<int>& corral() const { return this->corral_; }
  const std::vector<double>& weights() const { return this->weights_; }
  /// The point of least norm: its scalar and its blocks.
  double first() const { return this->first_; }
  const std::vector<Vec<D>>& blocks() const { return this->blocks_; }
  double squaredNorm() const { return this->squaredNorm_; }

private:
  bool append(const std::vector<SparsePoint<D>>& points, int k);
  void drop(std::size_t i);
  bool factorFrom(std::size_t row);
  void affineWeights();
  bool reduceToCorral();
  void formPoint(const std::vector<SparsePoint<D>>& points);
  double product(const SparsePoint<D>& w) const;
  void sortCorral();

  double scale_ = 1.0; // max |w|^2
  std::vector<int> corral_;
  std::vector<double> weights_, affine_;
  /// Rows of the lower triangles. Kept from step to step: a point that joins the corral adds a row,
  /// one that leaves it changes only the rows behind its own.
  std::vector<std::vector<double>> gram_, factor_;
  double first_ = 0.0, squaredNorm_ = 0.0;
  std::vector<Vec<D>> blocks_;
};

extern template class MinNormPoint<2>;
extern template class MinNormPoint<3>;
}

#endif
