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
    const int m = static_cast<int>(f.size());
    this->size_ = 0;
    int first = 0;
    for (int k = 1; k < m; ++k)
    {
      first = f[k].q < f[first].q ? k : first;
    }
    this->push(first, 1.0);
    double level = f[first].q;
    // The limit guards against cycles from rounding: D + 2 functions at most are active.
    for (int iteration = 0; iteration < 4 * (D + 2); ++iteration)
    {
      this->settle(f, tau, level);
      d.setZero();
      for (int i = 0; i < this->size_; ++i)
      {
        d += tau * this->mu_[i] * f[this->id_[i]].g;
      }
      // The function that the step makes the worst joins the corral.
      int worst = 0;
      double least = f[0].q + f[0].g.dot(d);
      for (int k = 1; k < m; ++k)
      {
        const double value = f[k].q + f[k].g.dot(d);
        if (value < least)
        {
          least = value;
          worst = k;
        }
      }
      if (least >= level - Rounding || this->has(worst) || this->size_ == Room)
      {
        return least;
      }
      this->push(worst, 0.0);
    }
    double least = f[0].q + f[0].g.dot(d);
    for (const Function& k : f)
    {
      least = std::min(least, k.q + k.g.dot(d));
    }
    return least;
  }

private:
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

  /// Minimizes over the affine hull of the corral. If the result is outside of the simplex, walks
  /// to its border and drops the weight that is zero there. `level` is the common value of the
  /// corral.
  void settle(const std::vector<Function>& f, double tau, double& level)
  {
    while (true)
    {
      double mu[Room];
      this->affine(f, tau, mu, level);
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
      if (this->size_ == 1)
      {
        this->mu_[0] = 1.0;
      }
    }
  }

  /// Solves q_i + tau g_i . sum mu_j g_j = level, sum mu = 1 over the corral. A corral of D + 2
  /// functions is never independent. The tiny ridge makes the system solvable, so that one of them
  /// is dropped correctly.
  void affine(const std::vector<Function>& f, double tau, double* mu, double& level) const
  {
    const int s = this->size_;
    double a[Room + 1][Room + 2];
    double trace = 0.0;
    for (int i = 0; i < s; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        a[i][j] = a[j][i] = tau * f[this->id_[i]].g.dot(f[this->id_[j]].g);
      }
      trace += a[i][i];
      a[i][s] = a[s][i] = 1.0;
      a[i][s + 1] = -f[this->id_[i]].q;
    }
    for (int i = 0; i < s; ++i)
    {
      a[i][i] += Ridge * trace + NotZero;
    }
    a[s][s] = 0.0;
    a[s][s + 1] = 1.0;
    eliminate(a, s + 1);
    for (int i = 0; i < s; ++i)
    {
      mu[i] = a[i][s + 1];
    }
    level = -a[s][s + 1];
  }

  static void eliminate(double a[][Room + 2], int n)
  {
    // Gauss with partial pivoting, at most D + 3 equations.
    for (int k = 0; k < n; ++k)
    {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
      {
        pivot = std::fabs(a[i][k]) > std::fabs(a[pivot][k]) ? i : pivot;
      }
      if (pivot != k)
      {
        std::swap_ranges(a[k], a[k] + n + 1, a[pivot]);
      }
      const double inverse = a[k][k] != 0.0 ? 1.0 / a[k][k] : 0.0;
      for (int i = k + 1; i < n; ++i)
      {
        const double factor = a[i][k] * inverse;
        for (int j = k + 1; j <= n; ++j)
        {
          a[i][j] -= factor * a[k][j];
        }
      }
    }
    for (int k = n; k-- > 0;)
    {
      for (int j = k + 1; j < n; ++j)
      {
        a[k][n] -= a[k][j] * a[j][n];
      }
      a[k][n] = a[k][k] != 0.0 ? a[k][n] / a[k][k] : 0.0;
    }
  }

  int size_ = 0;
  int id_[Room + 1];
  double mu_[Room + 1];
};
}

#endif
