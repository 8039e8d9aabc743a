// SPDX-License-Identifier: BSD-3-Clause
/// @file ClusterProblem.h
/// Where to put several nodes at once: the same as StarProblem for one node. A last resort, for
/// nodes that are all at their best places as long as the others stay.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2: (2.4)-(2.6) on the optimization
/// cluster. Departure: as in ProximalStep, the step maximizes the linearized minimum minus |d|^2 /
/// (2 tau). With w_k = (1 + q_k - q_min; sqrt(tau) grad q_k), and mu in the unit simplex,
///     |sum mu_k w_k|^2 = 1 + 2 s + s^2 + |d|^2 / tau,  s = sum mu_k (q_k - q_min),
/// is its dual up to s^2, which is small against 2 s. So it is one problem of least norm, like the
/// paper's.
#ifndef meshopt_Reposition_ClusterProblem_h
#define meshopt_Reposition_ClusterProblem_h

#include "Mesh/Cluster.h"
#include "Quality/ElementQuality.h"
#include "Quality/Evaluations.h"
#include "Reposition/Directions.h"
#include "Reposition/MinNormPoint.h"
#include "Reposition/TrustRegion.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
template <int D, class Shape>
class ClusterProblem
{
public:
  /// The directions of each moving node of the next cluster. Empty: all may move anywhere.
  void restrict(const std::vector<Directions<D>>& directions) { this->directions_ = directions; }

  /// Moves the moving nodes of the cluster to better places: changes cluster.x and cluster.quality.
  /// Returns the worst quality, which never falls. `metrics`: one per cell, or one for all.
  double maximize(Cluster<D>& cluster, const ElementQuality<D, Shape>& quality,
    const std::vector<ElementMetric<D>>& metrics, const SearchGoal& goal)
  {
    const double worst = *std::min_element(cluster.quality.begin(), cluster.quality.end());
    // L of (2.5), as in the paper a typical length: it makes the first step independent of units.
    const double length = cluster.meanEdge();
    Ascent ascent{ *this, cluster, quality, metrics };
    return ascend(ascent, worst, TrustRegion::FirstShare * length * length, goal);
  }

private:
  static constexpr double Window = 0.15; ///< above the worst: cells that a step may make worst

  /// What ascend() asks for.
  struct Ascent
  {
    ClusterProblem& problem;
    Cluster<D>& cluster;
    const ElementQuality<D, Shape>& quality;
    const std::vector<ElementMetric<D>>& metrics;

    const ElementMetric<D>& metric(std::size_t k) const
    {
      return this->metrics[this->metrics.size() == 1 ? 0 : k];
    }
    void linearize(double worst) { this->problem.linearize(*this, worst); }
    double predict(double tau) { return this->problem.solve(this->cluster.numberOfMoving, tau); }
    double tryStep(double required) { return this->problem.evaluate(*this, required); }
    void accept()
    {
      this->cluster.x.swap(this->problem.x_);
      this->cluster.quality.swap(this->problem.values_);
    }
  };

  void linearize(const Ascent& ascent, double worst)
  {
    const Cluster<D>& cluster = ascent.cluster;
    this->functions_.clear();
    std::array<Vec<D>, D + 1> g;
    for (std::size_t k = 0; k < cluster.cells.size(); ++k)
    {
      // The set I_epsilon of (2.8). A cell above the window is hardly ever the worst after a step;
      // if it is, tryStep() sees it, since it looks at all cells.
      if (!(cluster.quality[k] < worst + Window))
      {
        continue;
      }
      ascent.quality.gradient(cluster.corners(static_cast<int>(k)), ascent.metric(k), g);
      SparsePoint<D> f;
      f.first = cluster.quality[k] - worst;
      for (int i = 0; i <= D; ++i)
      {
        // Moving nodes have the first numbers. The others are constants: they have no block.
        if (cluster.nodes[k][i] < cluster.numberOfMoving)
        {
          const Index node = cluster.nodes[k][i];
          f.block[f.count] = node;
          f.value[f.count++] = this->directions_.empty() ? g[i]
                                                         : this->directions_[node].along(g[i]);
        }
      }
      this->functions_.push_back(f);
    }
    evaluationsOfThread += static_cast<std::int64_t>(this->functions_.size());
    this->worst_ = worst;
  }

  /// Computes the step (in step_) and returns the linearized minimum there.
  double solve(int numberOfMoving, double tau)
  {
    const double root = std::sqrt(tau);
    this->points_ = this->functions_;
    for (SparsePoint<D>& w : this->points_)
    {
      // The 1 turns the linear term of the dual into a part of the norm: see the head of the file.
      w.first += 1.0;
      for (int i = 0; i < w.count; ++i)
      {
        w.value[i] *= root;
      }
    }
    this->minNorm_.solve(this->points_, numberOfMoving);
    this->step_ = this->minNorm_.blocks();
    // The blocks are sqrt(tau) sum mu_k grad q_k, and the step is d = tau sum mu_k grad q_k.
    for (Vec<D>& d : this->step_)
    {
      d *= root;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const SparsePoint<D>& f : this->functions_)
    {
      double q = this->worst_ + f.first;
      for (int i = 0; i < f.count; ++i)
      {
        q += f.value[i].dot(this->step_[f.block[i]]);
      }
      least = std::min(least, q);
    }
    return least;
  }

  /// Computes places and qualities after the step, in x_ and values_. Gives up at the first cell
  /// whose quality is not above `required`, and then returns -infinity.
  double evaluate(const Ascent& ascent, double required)
  {
    const Cluster<D>& cluster = ascent.cluster;
    this->x_ = cluster.x;
    for (int p = 0; p < cluster.numberOfMoving; ++p)
    {
      this->x_[p] += this->step_[p];
    }
    // Into buffers of its own: a step that is refused leaves the cluster as it was.
    this->values_ = cluster.quality;
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cluster.cells.size(); ++k)
    {
      Corners<D> c;
      for (int i = 0; i <= D; ++i)
      {
        c[i] = this->x_[cluster.nodes[k][i]];
      }
      this->values_[k] = ascent.quality.value(c, ascent.metric(k));
      ++evaluationsOfThread;
      worst = std::min(worst, this->values_[k]);
      if (!(this->values_[k] > required))
      {
        return -std::numeric_limits<double>::infinity();
      }
    }
    return worst;
  }

  double worst_ = 0.0;
  std::vector<Directions<D>> directions_;
  std::vector<SparsePoint<D>> functions_, points_; ///< q_k - worst and gradients; the w_k
  MinNormPoint<D> minNorm_;
  std::vector<Vec<D>> step_, x_;
  std::vector<double> values_;
};
}

#endif
