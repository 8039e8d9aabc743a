// SPDX-License-Identifier: BSD-3-Clause
// A grid of bins holds the edges that have a say at a place. Bins are half as wide as
// the boxes that edges reach on average.
#include "Metric/SizeFloor.h"

#include "Metric/SymmetricEigen.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// Sizes fall by this fraction of the distance: to about half from one layer of triangles to the
/// next. The shape of such triangles is still above 0.6.
constexpr double Fall = 0.7;
constexpr double MostBins = 50.0; // per edge
}

/// Each edge goes into all bins that its floor reaches, so that at() looks into a single bin.
template <int D>
SizeFloor<D>::SizeFloor(std::vector<Edge> edges, double least)
  : edges_(std::move(edges))
{
  std::vector<Vec<D>> low, high; // boxes outside of which the edges require less than `least`
  double sum = 0.0;
  for (const Edge& e : this->edges_)
  {
    const double weakest = std::max(SymmetricEigen<D>::of(e.metric).values[0], 1e-300);
    // In the direction in which the metric is weakest the floor falls most slowly.
    const double reach = std::max(e.size - least, 0.0) / (Fall * std::sqrt(weakest));
    low.push_back(e.a.cwiseMin(e.b) - Vec<D>::Constant(reach));
    high.push_back(e.a.cwiseMax(e.b) + Vec<D>::Constant(reach));
    sum += (high.back() - low.back()).maxCoeff();
  }
  const double n = static_cast<double>(this->edges_.size());
  this->width_ = sum > 0.0 ? 0.5 * sum / n : 1.0;
  // So memory stays proportional to the number of edges.
  while (this->countBins(low, high) > MostBins * (n + 1.0)) // if edges differ much in length
  {
    this->width_ *= 2.0;
  }
  for (std::size_t k = 0; k < this->edges_.size(); ++k)
  {
    const Bin first = this->binOf(low[k]), last = this->binOf(high[k]);
    for (Bin bin = first; bin[D - 1] <= last[D - 1];)
    {
      this->bins_[bin].push_back(static_cast<Index>(k));
      for (int d = 0; d < D; ++d) // the next one
      {
        if (++bin[d] <= last[d] || d == D - 1)
        {
          break;
        }
        bin[d] = first[d];
      }
    }
  }
}

/// At least as many as the edges will have entries in the bins.
template <int D>
double SizeFloor<D>::countBins(
  const std::vector<Vec<D>>& low, const std::vector<Vec<D>>& high) const
{
  double count = 0.0;
  for (std::size_t k = 0; k < low.size(); ++k)
  {
    count += ((high[k] - low[k]) / this->width_ + Vec<D>::Constant(2.0)).prod();
  }
  return count;
}

template <int D>
typename SizeFloor<D>::Bin SizeFloor<D>::binOf(const Vec<D>& x) const
{
  Bin bin;
  for (int d = 0; d < D; ++d)
  {
    bin[d] = static_cast<long>(std::floor(x[d] / this->width_));
  }
  return bin;
}

template <int D>
double SizeFloor<D>::at(const Vec<D>& x) const
{
  double floor = 0.0;
  const auto found = this->bins_.find(this->binOf(x));
  for (std::size_t k = 0; found != this->bins_.end() && k < found->second.size(); ++k)
  {
    const Edge& e = this->edges_[found->second[k]];
    // The metric is that of the edge itself, the same all around it: the floor is a cone along it.
    // The nearest point of the edge, in the metric of the edge.
    const Vec<D> along = e.b - e.a, mapped = e.metric * along;
    const double part = std::clamp(mapped.dot(x - e.a) / (e.size * e.size), 0.0, 1.0);
    const Vec<D> away = x - e.a - part * along;
    floor = std::max(floor, e.size - Fall * std::sqrt(away.dot(e.metric * away)));
  }
  return floor;
}

template class SizeFloor<2>;
template class SizeFloor<3>;
}
