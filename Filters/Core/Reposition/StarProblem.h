// SPDX-License-Identifier: BSD-3-Clause
/// @file StarProblem.h
/// Where to put one node: the worst quality of the elements around it as a function of its place.
///
/// The elements are the facets of a polyhedron (the link of a node, or the boundary of a cavity)
/// joined to the node. For a fixed topology the worst shape quality is quasi-concave where it is
/// positive, so the maximum found is global. It is found by steps of ProximalStep. The trust in the
/// linearization (tau) grows and shrinks with what the steps really gain.
#ifndef meshopt_Reposition_StarProblem_h
#define meshopt_Reposition_StarProblem_h

#include "Mesh/LocalNumbers.h"
#include "Quality/EdgeSum.h"
#include "Quality/ElementQuality.h"
#include "Quality/Evaluations.h"
#include "Reposition/Directions.h"
#include "Reposition/FlatScale.h"
#include "Reposition/ProximalStep.h"
#include "Reposition/TrustRegion.h"

#include <Eigen/Geometry>

namespace meshopt
{
/// To be used in this order: clear(); addPoint() and addFacet() for the polyhedron; maximize().
/// Keeps its memory, since it is loaded for each try.
template <int D, class Shape>
class StarProblem
{
public:
  /// plain: Euclidean, without size factor. Otherwise addFacetMetric() gives each facet its metric.
  /// The quality must live until the next clear().
  void clear(const ElementQuality<D, Shape>& quality, bool plain)
  {
    this->quality_ = &quality;
    this->plain_ = plain;
    this->numbers_.clear();
    this->ring_.clear();
    this->facets_.clear();
    this->metrics_.clear();
    this->directions_.count = 0;
  }
  void clear(const ElementQuality<D, Shape>&&, bool) = delete; // it would not live long enough
  /// From now on maximize() moves the node only in these directions.
  void restrict(const Directions<D>& directions) { this->directions_ = directions; }

  /// The local number of point p, which lies at x. A point that comes again keeps its number.
  int addPoint(Index p, const Vec<D>& x)
  {
    const int k = this->numbers_.add(p);
    if (k == static_cast<int>(this->ring_.size()))
    {
      this->ring_.push_back({ x, 0.0 });
    }
    return k;
  }

  /// Whether x is in the bounding box of the points. Outside of it some element is always inverted.
  /// But elements get flatter the farther away the node is, so that such a place may seem better.
  bool isAmidPoints(const Vec<D>& x) const
  {
    Eigen::AlignedBox<double, D> box;
    for (const auto& p : this->ring_)
    {
      box.extend(p.x);
    }
    return box.contains(x);
  }

  /// Adds a facet, by local point numbers; (facet, node) is positive for a node inside. The quality
  /// of its element is multiplied by `weight` > 0.
  void addFacet(const std::array<int, D>& f, double weight = 1.0)
  {
    FacetData data;
    data.weight = weight;
    data.points = f;
    // What does not depend on the place of the node is computed here, once for all its steps: the
    // normal, by which det is linear in the place, and the sum over the edges of the facet.
    const Vec<D>& a = this->ring_[f[0]].x;
    if constexpr (D == 3)
    {
      const Vec<D> u = this->ring_[f[1]].x - a, v = this->ring_[f[2]].x - a;
      data.normal = u.cross(v);
      if constexpr (EdgeSum<Shape>::value)
      {
        data.sum = EdgeSum<Shape>::weight(u.squaredNorm()) +
          EdgeSum<Shape>::weight(v.squaredNorm()) + EdgeSum<Shape>::weight((u - v).squaredNorm());
      }
    }
    else
    {
      const Vec<D> u = this->ring_[f[1]].x - a;
      data.normal = Vec<D>(-u[1], u[0]);
      if constexpr (EdgeSum<Shape>::value)
      {
        data.sum = EdgeSum<Shape>::weight(u.squaredNorm());
      }
    }
    this->facets_.push_back(data);
  }
  void addFacetMetric(const ElementMetric<D>& m) { this->metrics_.push_back(m); }

  /// Computes the quality of each element with the node at x; returns the worst.
  double evaluate(const Vec<D>& x)
  {
    this->values_.resize(this->facets_.size());
    evaluationsOfThread += static_cast<std::int64_t>(this->facets_.size());
    double worst = std::numeric_limits<double>::infinity();
    if (this->fast())
    {
      this->evaluateFast(x);
    }
    else
    {
      for (std::size_t k = 0; k < this->facets_.size(); ++k)
      {
        this->values_[k] = this->facets_[k].weight *
          this->quality_->value(this->corners(k, x), this->metric(k));
      }
    }
    for (double q : this->values_)
    {
      worst = std::min(worst, q);
    }
    return worst;
  }
  /// Qualities of the last evaluate(), in the order of the facets.
  const std::vector<double>& values() const { return this->values_; }

  /// Moves x to a better place; returns the worst quality there. Afterwards values() belong to x.
  double maximize(Vec<D>& x, const SearchGoal& goal)
  {
    Ascent ascent{ *this, x };
    const double start = this->evaluate(x);
    this->isFlat_ = 0.0 < start && start < goal.flat;
    const double tau = this->isFlat_ ? TrustRegion::FirstOfFlat : this->firstTau(x);
    const double worst = ascend(ascent, start, tau, goal);
    // The last step may have been refused: values() are then those of its place.
    return ascent.isAtX ? worst : this->evaluate(x);
  }

private:
  static constexpr bool HasSum = EdgeSum<Shape>::value;
  /// Above the worst: elements up to there are those that a step could make the worst.
  static constexpr double Window = 0.35;

  /// What ascend() asks for, with the node at x.
  struct Ascent
  {
    StarProblem& star;
    Vec<D>& x;
    Vec<D> step = Vec<D>::Zero(), next = Vec<D>::Zero();
    bool isAtX = true; ///< values() belong to x, not to a step that was not taken

    void linearize(double worst) { this->star.linearize(this->x, worst); }
    double predict(double tau)
    {
      const double least = this->star.solver_.solve(this->star.active_, tau, this->step);
      if (this->star.isFlat_)
      {
        this->star.scale_.unscale(this->step);
      }
      return least * this->star.unit_;
    }
    /// All values, not only until one is too low: after accept() they are needed.
    double tryStep(double /*required*/)
    {
      this->next = this->x + this->step;
      this->isAtX = false;
      return this->star.evaluate(this->next);
    }
    void accept()
    {
      this->x = this->next;
      this->isAtX = true;
    }
  };

  struct RingPoint
  {
    Vec<D> x;
    double weight;
  };
  struct FacetData
  {
    Vec<D> normal; // det = normal . (node - first point)
    double sum = 0.0, weight = 1.0;
    std::array<int, D> points;
  };

  /// In a metric lengths differ from element to element: then nothing can be shared.
  bool fast() const { return HasSum && this->plain_; }
  ElementMetric<D> metric(std::size_t k) const
  {
    return this->plain_ ? ElementMetric<D>() : this->metrics_[k];
  }

  Corners<D> corners(std::size_t k, const Vec<D>& x) const
  {
    Corners<D> c;
    for (int i = 0; i < D; ++i)
    {
      c[i] = this->ring_[this->facets_[k].points[i]].x;
    }
    // The node last: (facet, node) is positive.
    c[D] = x;
    return c;
  }

  /// Each point of the ring has one weight, which all elements at its edge share.
  void evaluateFast([[maybe_unused]] const Vec<D>& x)
  {
    if constexpr (HasSum)
    {
      for (RingPoint& r : this->ring_)
      {
        r.weight = EdgeSum<Shape>::weight((x - r.x).squaredNorm());
      }
      for (std::size_t k = 0; k < this->facets_.size(); ++k)
      {
        const FacetData& f = this->facets_[k];
        double sum = f.sum;
        for (int p : f.points)
        {
          sum += this->ring_[p].weight;
        }
        this->values_[k] = f.weight *
          EdgeSum<Shape>::quality(f.normal.dot(x - this->ring_[f.points[0]].x), sum);
      }
    }
  }

  /// Values and gradients of the elements in the window.
  void linearize(const Vec<D>& x, double worst)
  {
    this->active_.clear();
    const double limit = worst + Window;
    for (std::size_t k = 0; k < this->facets_.size(); ++k)
    {
      // Projected gradients: the step, their sum, then keeps to the directions by itself.
      if (this->values_[k] < limit)
      {
        this->active_.push_back(
          { this->values_[k], this->directions_.along(this->gradient(k, x)) });
      }
    }
    evaluationsOfThread += static_cast<std::int64_t>(this->active_.size());
    this->unit_ = 1.0;
    if (this->isFlat_)
    {
      this->flatten(worst);
    }
  }

  /// From here on the active elements are measured by the worst, and steps by FlatScale.
  void flatten(double worst)
  {
    this->unit_ = worst;
    this->scale_.clear();
    for (const auto& f : this->active_)
    {
      this->scale_.add(f.q, f.g);
    }
    this->scale_.close();
    for (auto& f : this->active_)
    {
      f.q /= worst;
      f.g /= worst;
      this->scale_.scale(f.g);
    }
  }

  /// Of the quality of element k, by the place of the node.
  Vec<D> gradient(std::size_t k, const Vec<D>& x) const
  {
    if constexpr (HasSum)
    {
      if (this->plain_)
      {
        const FacetData& f = this->facets_[k];
        double sum = f.sum, byDet, bySum;
        Vec<D> g = Vec<D>::Zero();
        for (int p : f.points)
        {
          const RingPoint& r = this->ring_[p];
          sum += r.weight;
          g += EdgeSum<Shape>::slope(r.weight) * (x - r.x);
        }
        EdgeSum<Shape>::derivatives(
          f.normal.dot(x - this->ring_[f.points[0]].x), sum, byDet, bySum);
        return f.weight * (byDet * f.normal + bySum * g);
      }
    }
    std::array<Vec<D>, D + 1> g;
    this->quality_->gradient(this->corners(k, x), this->metric(k), g);
    return this->facets_[k].weight * g[D];
  }

  /// The trust at the start: with a gradient of 1 / L the node moves by a tenth of L, where L is
  /// the (quadratic) mean distance to the points around.
  double firstTau(const Vec<D>& x) const
  {
    double sum = 0.0;
    for (const RingPoint& r : this->ring_)
    {
      sum += (x - r.x).squaredNorm();
    }
    return TrustRegion::FirstShare * sum /
      static_cast<double>(std::max<std::size_t>(1, this->ring_.size()));
  }

  const ElementQuality<D, Shape>* quality_ = nullptr;
  bool plain_ = true;
  LocalNumbers numbers_;
  std::vector<RingPoint> ring_;
  std::vector<FacetData> facets_;
  std::vector<ElementMetric<D>> metrics_;
  Directions<D> directions_;
  std::vector<double> values_;
  std::vector<typename ProximalStep<D>::Function> active_;
  ProximalStep<D> solver_;
  bool isFlat_ = false; ///< steps are measured by scale_
  FlatScale<D> scale_;
  double unit_ = 1.0; ///< of the qualities in active_
};
}

#endif
