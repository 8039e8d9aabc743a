// SPDX-License-Identifier: BSD-3-Clause
/// @file ProximalStep.h
/// One ascent step for the minimum of a few smooth functions of one node.
///
/// With values q_k and gradients g_k at x, the step d maximizes the linearized minimum minus a
/// proximal term,
///     min_k (q_k + g_k . d) - |d|^2 / (2 tau).
/// Its dual is the minimum over the unit simplex of sum mu_k q_k + tau/2 |sum mu_k g_k|^2, with d =
/// tau sum mu_k g_k. This is problem (2.5) of the paper with the first square replaced by the
/// linear term. Near a maximum that D + 1 functions determine, it converges quadratically, while
/// (2.5) converges linearly. Reference for the active-set method: P. Wolfe, Finding the nearest
/// point in a polytope, Math. Programming 11 (1976).
#ifndef meshopt_Reposition_ProximalStep_h
#define meshopt_Reposition_ProximalStep_h

#include "Mesh/Types.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meshopt
{
template <int D>
class ProximalStep
{
public:
  struct Function
  {
    double q;
    Vec<D> g;
  };

  /// The step d for m >= 1 functions and tau > 0; returns the linearized minimum at d.
  double solve(const std::vector<Function>& f, double tau, Vec<D>& d)
  {
    const auto isWorse = [](const Function& a, const Function& b) { return a.q < b.q; };
    this->size_ = 0;
    // The worst function alone: its step is along its gradient.
    this->push(static_cast<int>(std::min_element(f.begin(), f.end(), isWorse) - f.begin()), 1.0);
    double least = 0.0;
    // The limit guards against cycles from rounding: D + 2 functions at most are active.
    for (int iteration = 0; iteration < 4 * (D + 2); ++iteration)
    {
      this->settle(f, tau);
      Vec<D> sum = this->mu_[0] * f[this->id_[0]].g;
      for (int i = 1; i < this->size_; ++i)
      {
        sum += this->mu_[i] * f[this->id_[i]].g;
      }
      d = tau * sum;
      // All functions of the corral have about this value.
      const double level = at(f[this->id_[0]], d);
      // The function that the step makes the worst joins the corral.
      // If it is there already, only rounding is left. A full corral has no room for it.
      const int worst = worstAt(f, d, least);
      if (least >= level - Rounding || this->has(worst) || this->size_ == Room)
      {
        break;
      }
      this->push(worst, 0.0);
    }
    return least;
  }

private:
  /// D + 1 functions determine a maximum in D dimensions. One more has just joined, and the next
  /// settle() drops one.
  static constexpr int Room = D + 2;
  static constexpr double Rounding = 1e-9;     ///< of a quality
  static constexpr double LeastWeight = 1e-12; ///< a function with less is not in the corral
  static constexpr double Ridge = 1e-10;       ///< of the trace: see affine()
  static constexpr double NotZero = 1e-300;    ///< where a divisor may be 0

  void push(int k, double mu)
  {
    this->id_[this->size_] = k;
    this->mu_[this->size_++] = mu;
  }

  bool has(int k) const
  {
    return std::find(this->id_, this->id_ + this->size_, k) != this->id_ + this->size_;
  }

  void drop(int i)
  {
    --this->size_;
    for (; i < this->size_; ++i)
    {
      this->id_[i] = this->id_[i + 1];
      this->mu_[i] = this->mu_[i + 1];
    }
  }

  static double at(const Function& f, const Vec<D>& d) { return f.q + f.g.dot(d); }

  /// The function with the least value after step d, the first of several; and that value. Two
  /// searches side by side: each waits for its last comparison.
  static int worstAt(const std::vector<Function>& f, const Vec<D>& d, double& least)
  {
    const int m = static_cast<int>(f.size());
    int even = 0, odd = 0;
    double low = at(f[0], d), other = low;
    for (int k = 1; k + 1 < m; k += 2)
    {
      const double a = at(f[k], d), b = at(f[k + 1], d);
      odd = a < other ? k : odd;
      other = std::min(a, other);
      even = b < low ? k + 1 : even;
      low = std::min(b, low);
    }
    if (m % 2 == 0 && at(f[m - 1], d) < other)
    {
      odd = m - 1;
      other = at(f[m - 1], d);
    }
    const bool isOdd = other < low || (other == low && odd < even);
    least = isOdd ? other : low;
    return isOdd ? odd : even;
  }

  /// Minimizes over the affine hull of the corral. If the result is outside of the simplex, walks
  /// to its border and drops the weight that is zero there.
  void settle(const std::vector<Function>& f, double tau)
  {
    while (this->size_ > 1)
    {
      double mu[Room];
      this->affine(f, tau, mu);
      // On the way from the present weights to those of the hull: the first that becomes zero.
      int out = -1;
      double step = 1.0;
      for (int i = 0; i < this->size_; ++i)
      {
        if (mu[i] < LeastWeight)
        {
          const double reach = this->mu_[i] / std::max(this->mu_[i] - mu[i], NotZero);
          if (reach < step || out < 0)
          {
            step = std::min(step, reach);
            out = i;
          }
        }
      }
      for (int i = 0; i < this->size_; ++i)
      {
        this->mu_[i] += step * (mu[i] - this->mu_[i]);
      }
      if (out < 0)
      {
        return;
      }
      this->drop(out);
    }
    this->mu_[0] = 1.0;
  }

  /// Solves q_i + tau g_i . sum mu_j g_j = level, sum mu = 1 over the corral. The first equation
  /// is subtracted from the others, and its weight is 1 less the others: what remains is
  /// symmetric, with the products of the differences of the gradients. A corral of D + 2 functions
  /// is never independent. The tiny ridge makes the system solvable, so that one of them is dropped
  /// correctly.
  void affine(const std::vector<Function>& f, double tau, double* mu) const
  {
    constexpr int most = Room - 1;
    const int n = this->size_ - 1;
    const Function& first = f[this->id_[0]];
    Vec<D> h[most];
    double a[most][most], b[most];
    double trace = first.g.squaredNorm();
    for (int i = 0; i < n; ++i)
    {
      const Function& other = f[this->id_[i + 1]];
      trace += other.g.squaredNorm();
      h[i] = other.g - first.g;
      b[i] = first.q - other.q - tau * h[i].dot(first.g);
      for (int j = 0; j <= i; ++j)
      {
        a[i][j] = tau * h[i].dot(h[j]);
      }
    }
    // In the full system the ridge is on the diagonal. The first equation is subtracted, with mu_0
    // = 1 - sum mu_j: so it comes into every entry and into the right-hand side.
    const double ridge = Ridge * tau * trace + NotZero;
    for (int i = 0; i < n; ++i)
    {
      b[i] += ridge;
      a[i][i] += ridge;
      for (int j = 0; j <= i; ++j)
      {
        a[i][j] += ridge;
      }
    }
    solveSymmetric(a, b, n);
    mu[0] = 1.0;
    for (int i = 0; i < n; ++i)
    {
      mu[i + 1] = b[i];
      mu[0] -= b[i];
    }
  }

  /// By the factors L D L^T of a positive matrix, of which the lower half is given. The result
  /// replaces b.
  template <int N>
  static void solveSymmetric(double (&a)[N][N], double (&b)[N], int n)
  {
    double inverse[N];
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        // a[i][k], k < j, holds L[i][k] D[k] until the row is done.
        for (int k = 0; k < j; ++k)
        {
          a[i][j] -= a[i][k] * a[j][k];
        }
      }
      for (int j = 0; j < i; ++j)
      {
        const double factor = a[i][j] * inverse[j];
        a[i][i] -= factor * a[i][j];
        b[i] -= factor * b[j];
        a[i][j] = factor;
      }
      // A pivot that rounding has made zero: its weight becomes 0, and not infinite.
      inverse[i] = a[i][i] > 0.0 ? 1.0 / a[i][i] : 0.0;
    }
    for (int i = n; i-- > 0;)
    {
      b[i] *= inverse[i];
      for (int k = i + 1; k < n; ++k)
      {
        b[i] -= a[k][i] * b[k];
      }
    }
  }

  int size_ = 0;
  int id_[Room + 1];
  double mu_[Room + 1];
};
}

#endif
