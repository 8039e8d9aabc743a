// SPDX-License-Identifier: BSD-3-Clause
/// @file LocalAlgorithm.h
/// Moves the moving nodes of one cluster to maximize the quality of its worst element.
///
/// References:
///  - Buscaglia, Dari, Zavattieri (1996), section 2.2, Local Algorithm: (2.4)-(2.9).
///  - E. Polak, On the mathematical foundations of nondifferentiable optimization in engineering
///    analysis, SIAM Review 29 (1987) 21-89: the method (the paper's [20]).
/// Departures:
///  - The search runs in y = x / L, with L the mean edge of the cluster. In y the direction is
///    delta = -sum mu_K L grad f_K; nodes move by lambda L delta. (2.5) stays as printed, and
///    lambda is a number without unit.
///  - The right side of (2.7) lacks its minus sign and mixes units. Used here: psi(y + lambda
///    delta) - psi(y) <= -alpha lambda |delta|^2.
///  - lambda starts at twice the last step, not at 1 each time; it is halved at most 14 times.
///  - The search also stops if the least-norm point is shorter than 1e-5: the cluster is
///    stationary.
///  - An element of positive quality never becomes zero or negative, even while the worst element
///    is still inverted.
#ifndef meshopt_Paper1996_LocalAlgorithm_h
#define meshopt_Paper1996_LocalAlgorithm_h

#include "Mesh/Cluster.h"
#include "Quality/ElementQuality.h"
#include "Quality/Evaluations.h"
#include "Reposition/MinNormPoint.h"

#include <algorithm>

namespace meshopt
{
struct LocalParameters
{
  double epsilon = 0.02;       ///< active set: Q_K - Q_min < epsilon (2.8); TOL is epsilon / 10
  double armijo = 0.01;        ///< alpha of (2.7), in ]0, 1[
  int maximumHalvings = 14;    ///< of the step
  double leastNorm = 1e-5;     ///< of the least-norm point: below it, the cluster is stationary
  int maximumIterations = 200; ///< a safeguard: the tolerance stops the search long before
};

struct LocalResult
{
  double before = 0.0, after = 0.0; ///< worst quality of the cluster
  int iterations = 0;               ///< steps taken
};

/// The local algorithm for one shape measure; keeps its scratch memory between calls. `metrics`
/// holds one element metric per cell of the cluster, or a single one for all cells.
template <int D, class Shape>
class LocalAlgorithm
{
public:
  LocalAlgorithm(const ElementQuality<D, Shape>& quality, const LocalParameters& parameters)
    : quality_(quality)
    , parameters_(parameters)
  {
  }

  /// Changes cluster.x of the moving nodes and cluster.quality. The worst quality does not fall.
  LocalResult solve(Cluster<D>& cluster, const std::vector<ElementMetric<D>>& metrics);

private:
  const ElementMetric<D>& metric(int k) const
  {
    return (*this->metrics_)[this->metrics_->size() == 1 ? 0 : k];
  }
  void findActive(const Cluster<D>& cluster, double worst);
  void formPoints(const Cluster<D>& cluster, double worst);
  void findAffected(const Cluster<D>& cluster);
  bool tryStep(const Cluster<D>& cluster, double lambda, double required);
  void takeStep(Cluster<D>& cluster);

  ElementQuality<D, Shape> quality_;
  LocalParameters parameters_;
  const std::vector<ElementMetric<D>>* metrics_ = nullptr;
  double length_ = 1.0; // L

  std::vector<int> active_;
  std::vector<SparsePoint<D>> points_;
  MinNormPoint<D> minNorm_;
  std::vector<std::uint8_t> moves_; // per moving node: the direction is not zero there
  std::vector<int> movers_, affected_;
  double unaffectedWorst_ = 0.0;
  std::vector<Vec<D>> trialX_;
  std::vector<double> trialQuality_; // of the affected cells
};

template <int D, class Shape>
void LocalAlgorithm<D, Shape>::findActive(const Cluster<D>& cluster, double worst)
{
  this->active_.clear();
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    if (cluster.quality[k] - worst < this->parameters_.epsilon)
    {
      this->active_.push_back(static_cast<int>(k));
    }
  }
  // In the order of ids: the least-norm solver then gives the same bits for every order of the
  // cells.
  std::sort(this->active_.begin(), this->active_.end(),
    [&](int a, int b) { return cluster.cells[a] < cluster.cells[b]; });
}

// The vectors w_K = (psi - f_K ; L grad f_K) of the active elements, with f = -Q.
template <int D, class Shape>
void LocalAlgorithm<D, Shape>::formPoints(const Cluster<D>& cluster, double worst)
{
  this->points_.resize(this->active_.size());
  std::array<Vec<D>, D + 1> g;
  for (std::size_t a = 0; a < this->active_.size(); ++a)
  {
    const int k = this->active_[a];
    SparsePoint<D>& w = this->points_[a];
    this->quality_.gradient(cluster.corners(k), this->metric(k), g);
    ++evaluationsOfThread;
    w.first = cluster.quality[k] - worst;
    w.count = 0;
    for (int i = 0; i <= D; ++i)
    {
      if (cluster.nodes[k][i] < cluster.numberOfMoving)
      {
        w.block[w.count] = cluster.nodes[k][i];
        w.value[w.count] = -this->length_ * g[i];
        ++w.count;
      }
    }
  }
}

// Finds the nodes that move and the cells that contain them: all other cells keep their quality.
// Active cells come first, so that a step that is too long is refused early.
template <int D, class Shape>
void LocalAlgorithm<D, Shape>::findAffected(const Cluster<D>& cluster)
{
  this->moves_.assign(cluster.points.size(), 0);
  this->movers_.clear();
  for (int p = 0; p < cluster.numberOfMoving; ++p)
  {
    if (this->minNorm_.blocks()[p].squaredNorm() > 0.0)
    {
      this->moves_[p] = 1;
      this->movers_.push_back(p);
    }
  }
  const auto isAffected = [&](int k)
  {
    bool any = false;
    for (Index p : cluster.nodes[k])
    {
      any = any || this->moves_[p];
    }
    return any;
  };
  this->affected_.clear();
  this->unaffectedWorst_ = std::numeric_limits<double>::infinity();
  const double worst = *std::min_element(cluster.quality.begin(), cluster.quality.end());
  for (int k : this->active_)
  {
    if (isAffected(k))
    {
      this->affected_.push_back(k);
    }
  }
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    if (!isAffected(static_cast<int>(k)))
    {
      this->unaffectedWorst_ = std::min(this->unaffectedWorst_, cluster.quality[k]);
    }
    else if (!(cluster.quality[k] - worst < this->parameters_.epsilon))
    {
      this->affected_.push_back(static_cast<int>(k));
    }
  }
}

// The qualities after a step. False as soon as one is under `required`.
template <int D, class Shape>
bool LocalAlgorithm<D, Shape>::tryStep(const Cluster<D>& cluster, double lambda, double required)
{
  if (this->unaffectedWorst_ < required)
  {
    return false;
  }
  for (int p : this->movers_)
  {
    // delta = -(least-norm point)
    this->trialX_[p] = cluster.x[p] - (lambda * this->length_) * this->minNorm_.blocks()[p];
  }
  this->trialQuality_.resize(this->affected_.size());
  for (std::size_t a = 0; a < this->affected_.size(); ++a)
  {
    const int k = this->affected_[a];
    Corners<D> x;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = this->trialX_[cluster.nodes[k][i]];
    }
    const double q = this->quality_.value(x, this->metric(k));
    ++evaluationsOfThread;
    if (!(q >= required) || (q <= 0.0 && cluster.quality[k] > 0.0))
    {
      return false;
    }
    this->trialQuality_[a] = q;
  }
  return true;
}

template <int D, class Shape>
void LocalAlgorithm<D, Shape>::takeStep(Cluster<D>& cluster)
{
  for (int p : this->movers_)
  {
    cluster.x[p] = this->trialX_[p];
  }
  for (std::size_t a = 0; a < this->affected_.size(); ++a)
  {
    cluster.quality[this->affected_[a]] = this->trialQuality_[a];
  }
}

template <int D, class Shape>
LocalResult LocalAlgorithm<D, Shape>::solve(
  Cluster<D>& cluster, const std::vector<ElementMetric<D>>& metrics)
{
  LocalResult result;
  if (cluster.cells.empty())
  {
    return result;
  }
  this->metrics_ = &metrics;
  this->length_ = cluster.meanEdge();
  this->trialX_ = cluster.x;
  const auto worstOf = [&]
  { return *std::min_element(cluster.quality.begin(), cluster.quality.end()); };
  double worst = worstOf();
  result.before = worst;
  double lambda = 0.5; // doubled before its first use
  while (result.iterations < this->parameters_.maximumIterations)
  {
    this->findActive(cluster, worst);
    this->formPoints(cluster, worst);
    this->minNorm_.solve(this->points_, cluster.numberOfMoving);
    double slope = 0.0; // |delta|^2
    for (const Vec<D>& b : this->minNorm_.blocks())
    {
      slope += b.squaredNorm();
    }
    const double least = this->parameters_.leastNorm;
    if (this->minNorm_.squaredNorm() < least * least || slope == 0.0)
    {
      break;
    }
    this->findAffected(cluster);

    // The last step is a good guess; doubling lets it grow again.
    lambda = std::min(1.0, 2.0 * lambda);
    bool found = false;
    for (int k = 0; k <= this->parameters_.maximumHalvings && !found; ++k)
    {
      found = this->tryStep(cluster, lambda, worst + this->parameters_.armijo * lambda * slope);
      lambda *= found ? 1.0 : 0.5;
    }
    if (!found)
    {
      break;
    }
    this->takeStep(cluster);
    ++result.iterations;
    const double now = worstOf();
    const double gain = now - worst;
    worst = now;
    if (gain < this->parameters_.epsilon / 10.0)
    {
      break;
    }
  }
  result.after = worst;
  return result;
}
}

#endif
