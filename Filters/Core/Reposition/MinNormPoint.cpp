// SPDX-License-Identifier: BSD-3-Clause
// Wolfe's method. The corral is a set of points whose affine hull is looked at; a Cholesky factor
// of their products is kept up to date, row by row.
#include "Reposition/MinNormPoint.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshopt
{
namespace
{
constexpr double Tolerance = 1e-12;
constexpr double LeastWeight = 1e-12;
// With a relative pivot below this, the new point depends on the corral up to rounding.
constexpr double LeastPivot = 1e-14;
}

/// The product of the present point and w: only the blocks that w has count.
template <int D>
double MinNormPoint<D>::product(const SparsePoint<D>& w) const
{
  double sum = this->first_ * w.first;
  for (int i = 0; i < w.count; ++i)
  {
    sum += this->blocks_[w.block[i]].dot(w.value[i]);
  }
  return sum;
}

/// The point that the present weights stand for, and its squared norm.
template <int D>
void MinNormPoint<D>::formPoint(const std::vector<SparsePoint<D>>& points)
{
  this->first_ = 0.0;
  std::fill(this->blocks_.begin(), this->blocks_.end(), Vec<D>::Zero());
  for (std::size_t k = 0; k < this->corral_.size(); ++k)
  {
    const SparsePoint<D>& w = points[this->corral_[k]];
    this->first_ += this->weights_[k] * w.first;
    for (int i = 0; i < w.count; ++i)
    {
      this->blocks_[w.block[i]] += this->weights_[k] * w.value[i];
    }
  }
  this->squaredNorm_ = this->first_ * this->first_;
  for (const Vec<D>& b : this->blocks_)
  {
    this->squaredNorm_ += b.squaredNorm();
  }
}

// Cholesky factor of (Gram matrix + scale ee'), rows `row` and below. The shift makes the matrix
// definite for every affinely independent corral. It changes the affine weights only by a factor.
template <int D>
bool MinNormPoint<D>::factorFrom(std::size_t row)
{
  this->factor_.resize(this->gram_.size());
  for (std::size_t i = row; i < this->gram_.size(); ++i)
  {
    std::vector<double>& f = this->factor_[i];
    f.assign(i + 1, 0.0);
    double pivot = this->gram_[i][i] + this->scale_;
    for (std::size_t j = 0; j < i; ++j)
    {
      double sum = this->gram_[i][j] + this->scale_;
      for (std::size_t k = 0; k < j; ++k)
      {
        sum -= f[k] * this->factor_[j][k];
      }
      f[j] = sum / this->factor_[j][j];
      pivot -= f[j] * f[j];
    }
    if (!(pivot > LeastPivot * this->scale_))
    {
      return false;
    }
    f[i] = std::sqrt(pivot);
  }
  return true;
}

/// Adds point k to the corral. False, with nothing changed, if it depends on the others.
template <int D>
bool MinNormPoint<D>::append(const std::vector<SparsePoint<D>>& points, int k)
{
  std::vector<double> row;
  for (int other : this->corral_)
  {
    row.push_back(points[k].dot(points[other]));
  }
  row.push_back(points[k].dot(points[k]));
  this->gram_.push_back(std::move(row));
  if (!this->factorFrom(this->gram_.size() - 1))
  {
    // The new point is not independent of the corral: take it out again.
    this->gram_.pop_back();
    this->factor_.pop_back();
    return false;
  }
  this->corral_.push_back(k);
  // It gets its weight in reduceToCorral().
  this->weights_.push_back(0.0);
  return true;
}

/// Leaves the factor as it is: from row i on it is out of date until factorFrom().
template <int D>
void MinNormPoint<D>::drop(std::size_t i)
{
  this->corral_.erase(this->corral_.begin() + i);
  this->weights_.erase(this->weights_.begin() + i);
  this->gram_.erase(this->gram_.begin() + i);
  for (std::size_t k = i; k < this->gram_.size(); ++k)
  {
    this->gram_[k].erase(this->gram_[k].begin() + i);
  }
}

// The weights (of any sign, sum 1) of the point of least norm in the affine hull of the corral.
template <int D>
void MinNormPoint<D>::affineWeights()
{
  const std::size_t n = this->corral_.size();
  this->affine_.assign(n, 1.0);
  // Solves (Gram + scale ee') w = e by the factor: forward, then back.
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      this->affine_[i] -= this->factor_[i][j] * this->affine_[j];
    }
    this->affine_[i] /= this->factor_[i][i];
  }
  for (std::size_t i = n; i-- > 0;)
  {
    for (std::size_t j = i + 1; j < n; ++j)
    {
      this->affine_[i] -= this->factor_[j][i] * this->affine_[j];
    }
    this->affine_[i] /= this->factor_[i][i];
  }
  // This also removes the factor by which the shift has scaled the weights.
  const double sum = std::accumulate(this->affine_.begin(), this->affine_.end(), 0.0);
  for (double& v : this->affine_)
  {
    v /= sum;
  }
}

// Wolfe's minor cycle. Moves from the present weights towards the affine ones and drops points
// whose weight becomes zero, until the affine point lies inside the hull of the remaining points.
template <int D>
bool MinNormPoint<D>::reduceToCorral()
{
  for (;;)
  {
    this->affineWeights();
    double theta = 1.0;
    bool inside = true;
    for (std::size_t i = 0; i < this->affine_.size(); ++i)
    {
      const double w = this->weights_[i], a = this->affine_[i];
      if (a < LeastWeight)
      {
        // On the border of the simplex, or beyond.
        inside = false;
        theta = w > a ? std::min(theta, w / (w - a)) : theta;
      }
    }
    if (inside)
    {
      this->weights_ = this->affine_;
      return true;
    }
    // theta is the longest step that keeps all weights >= 0; at least one weight is then zero.
    std::size_t least = 0;
    for (std::size_t i = 0; i < this->weights_.size(); ++i)
    {
      this->weights_[i] += theta * (this->affine_[i] - this->weights_[i]);
      least = this->weights_[i] < this->weights_[least] ? i : least;
    }
    // A single point can only have weight 1.
    if (this->corral_.size() == 1)
    {
      this->weights_[0] = 1.0;
      return true;
    }
    std::size_t lowest = least;
    this->drop(least);
    for (std::size_t i = this->corral_.size(); i-- > 0;)
    {
      if (this->weights_[i]<LeastWeight&& this->corral_.size()> 1)
      {
        // From the back, so that the places of those still to be looked at stay.
        this->drop(i);
        lowest = std::min(lowest, i);
      }
    }
    // Rows above the first dropped point are still valid.
    if (!this->factorFrom(lowest))
    {
      return false;
    }
  }
}

template <int D>
void MinNormPoint<D>::sortCorral()
{
  // By number, so that the sums of formPoint() do not depend on the order in which points came.
  std::vector<std::pair<int, double>> pairs;
  double sum = 0.0;
  for (std::size_t i = 0; i < this->corral_.size(); ++i)
  {
    pairs.emplace_back(this->corral_[i], this->weights_[i]);
    sum += this->weights_[i];
  }
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    this->corral_[i] = pairs[i].first;
    this->weights_[i] = pairs[i].second / sum;
  }
}

/// Wolfe's major cycle: the point that lies lowest as seen along the present one joins the corral.
template <int D>
void MinNormPoint<D>::solve(const std::vector<SparsePoint<D>>& points, int numberOfBlocks)
{
  const int m = static_cast<int>(points.size());
  this->corral_.clear();
  this->weights_.clear();
  this->gram_.clear();
  this->factor_.clear();
  this->blocks_.assign(numberOfBlocks, Vec<D>::Zero());
  // Start from the point of least norm, the lowest number among equals.
  int start = 0;
  double least = points[0].dot(points[0]);
  this->scale_ = least;
  for (int k = 1; k < m; ++k)
  {
    const double norm = points[k].dot(points[k]);
    this->scale_ = std::max(this->scale_, norm);
    if (norm < least)
    {
      least = norm;
      start = k;
    }
  }
  this->scale_ = this->scale_ > 0.0 ? this->scale_ : 1.0;
  if (!this->append(points, start))
  {
    // Squares that are no numbers, or beyond their range: then there is no way to go.
    this->formPoint(points);
    return;
  }
  this->weights_[0] = 1.0;
  this->formPoint(points);

  // Wolfe's method is finite; the limit is a guard against cycles from rounding.
  const int limit = 20 + 4 * m;
  for (int cycle = 0; cycle < limit; ++cycle)
  {
    int best = 0;
    double lowest = this->product(points[0]);
    for (int k = 1; k < m; ++k)
    {
      const double p = this->product(points[k]);
      if (p < lowest)
      {
        lowest = p;
        best = k;
      }
    }
    // If the best point is already in the corral, rounding has hidden the end of the search.
    const bool known = std::find(this->corral_.begin(), this->corral_.end(), best) !=
      this->corral_.end();
    // Wolfe's criterion: if no point lies on the near side of the plane through the present point,
    // this is the nearest one of the hull.
    if (known || lowest >= this->squaredNorm_ - Tolerance * this->scale_ ||
      !this->append(points, best))
    {
      break;
    }
    const bool sound = this->reduceToCorral();
    this->formPoint(points);
    if (!sound)
    {
      break;
    }
  }
  this->sortCorral();
  this->formPoint(points);
}

template class MinNormPoint<2>;
template class MinNormPoint<3>;
}
