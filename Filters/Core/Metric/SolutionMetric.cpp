// SPDX-License-Identifier: BSD-3-Clause
// The steps of section 5 of the paper in their order, from nodal values to a metric and h*.
#include "Metric/SolutionMetric.h"

#include "Metric/TensorFunctions.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
/// True if the second difference along every edge is no more than the rounding error of values of
/// this magnitude. (Along edges, since on a stretched mesh the noise is far greater across than
/// along.)
template <int D>
bool isLinearField(const SimplexMesh<D>& mesh, const std::vector<double>& values, int components,
  const std::vector<SymmetricEigen<D>>& metric, double precision)
{
  double magnitude = 0.0, curvature = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      const Index p = mesh.nodes(c)[i];
      for (int k = 0; k < components; ++k)
      {
        const double value = values[static_cast<std::size_t>(components) * p + k];
        magnitude = std::max(magnitude, std::abs(value));
      }
      for (Index q : mesh.nodes(c))
      {
        // e' G e, in the frame of G: the second difference along the edge, (5.1) times its length
        // squared.
        const Vec<D> edge = metric[p].vectors.transpose() * (mesh.point(q) - mesh.point(p));
        curvature = std::max(curvature, metric[p].values.dot(edge.cwiseAbs2()));
      }
    }
  }
  // For a field of zeros both sides are 0: it is linear, too.
  return !(curvature > 500.0 * precision * magnitude);
}

/// Multiplies by det^(-1 / (2p + D)). Eigenvalues are first raised to what the longest possible
/// edge requires (at the h* of the unscaled metric), since 0 has no such power.
template <int D>
void scaleForNorm(const SimplexMesh<D>& mesh, const SolutionMetricOptions& options,
  std::vector<SymmetricEigen<D>>& metric)
{
  // The other limits come once, with the last scaling.
  SizeLimits none;
  none.maximumSize = options.limits.maximumSize;
  MetricScaling<D> scaling(mesh, metric, none, options.countCorrection);
  const double h = scaling.withCount(options.desiredCount).desiredSize;
  // With this eigenvalue an edge of the maximum size has the length h: none need be longer.
  const double least = std::pow(h / scaling.maximumSize(), 2);
  for (SymmetricEigen<D>& e : metric)
  {
    e.values = e.values.cwiseMax(least);
    // By logarithms: a determinant of three numbers near the limits would over- or underflow.
    e.values *= std::exp(-e.values.array().log().sum() / (2.0 * options.normOrder + D));
  }
}
}

namespace
{
/// Derivatives of solutions of magnitude 1e-300 or 1e300 do not fit into a double.
template <int D>
std::string checkRange(const SimplexMesh<D>& mesh, const SolutionMetric<D>& metric)
{
  // Only beyond them is the logarithm tried, which decides and costs more.
  constexpr double least = 1e-140, most = 1e140; // between them squares are safe
  Tensor<D> logarithms;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const double size = mesh.isPointAlive(p) ? metric.tensors[p].trace() : 1.0;
    if (!(size > least && size < most) && !logarithm<D>(metric.tensors[p], logarithms))
    {
      std::ostringstream text;
      text << "The metric at point " << p
           << " is beyond the range of numbers: the solution, or its derivatives, are too large or "
              "too small. Multiply the solution by a number that brings it near 1.";
      return text.str();
    }
  }
  return std::isfinite(metric.desiredSize) && metric.desiredSize > 0.0
    ? std::string()
    : "The desired size is beyond the range of numbers. Multiply the solution by a number that "
      "brings it near 1.";
}
}

template <int D>
SymmetricEigen<D> absoluteValue(const Tensor<D>& hessian)
{
  return combinedHessian<D>(&hessian, 1);
}

/// (5.2): the root of the sum of squares. Of one field alone this is the absolute value.
template <int D>
SymmetricEigen<D> combinedHessian(const Tensor<D>* hessians, int components)
{
  SymmetricEigen<D> e;
  if (components == 1)
  {
    // Not as the root of the square: that would lose half of the digits of the smaller eigenvalues.
    e = SymmetricEigen<D>::of(hessians[0]);
    e.values = e.values.cwiseAbs();
  }
  else
  {
    double scale = 0.0; // squares must neither overflow nor underflow
    for (int i = 0; i < components; ++i)
    {
      scale = std::max(scale, hessians[i].cwiseAbs().maxCoeff());
    }
    Tensor<D> sum = Tensor<D>::Zero();
    for (int i = 0; i < components && scale > 0.0; ++i)
    {
      const Tensor<D> h = hessians[i] / scale;
      sum += h * h;
    }
    e = SymmetricEigen<D>::of(sum);
    // Squares have no negative eigenvalue, but rounding can make one.
    e.values = scale * e.values.cwiseMax(0.0).cwiseSqrt();
  }
  // Ascending again: with absolute values the order of one field's eigenvalues may be another.
  std::array<int, D> order;
  for (int i = 0; i < D; ++i)
  {
    order[i] = i;
  }
  // Equal eigenvalues stay in their order: the result has the same bits in each run.
  std::stable_sort(
    order.begin(), order.end(), [&e](int a, int b) { return e.values[a] < e.values[b]; });
  SymmetricEigen<D> sorted;
  for (int i = 0; i < D; ++i)
  {
    sorted.values[i] = e.values[order[i]];
    sorted.vectors.col(i) = e.vectors.col(order[i]);
  }
  return sorted;
}

std::string SolutionMetricOptions::check() const
{
  std::ostringstream text;
  if (!(this->desiredCount > 0.0) || !std::isfinite(this->desiredCount))
  {
    text << "The wanted number of elements must be positive; it is " << this->desiredCount << ".";
  }
  else if (!(this->normOrder >= 0.0) || !std::isfinite(this->normOrder))
  {
    text << "The order of the norm must be 0 (infinity) or positive; it is " << this->normOrder
         << ".";
  }
  else if (!(this->countCorrection > 0.0) || !std::isfinite(this->countCorrection))
  {
    text << "The correction of the number of elements must be positive; it is "
         << this->countCorrection << ".";
  }
  return text.str().empty() ? this->limits.check() : text.str();
}

/// Hessians, their combination (5.2), the scaling for the norm, and h* by (5.3).
template <int D>
std::string solutionMetric(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, const SolutionMetricOptions& options, SolutionMetric<D>& metric)
{
  std::string error = options.check();
  std::vector<Tensor<D>> hessians;
  if (error.empty())
  {
    error = recoverHessians(mesh, values, components, options.recovery, hessians);
  }
  if (!error.empty())
  {
    return error;
  }
  std::vector<SymmetricEigen<D>> g(mesh.numberOfPointSlots());
  for (std::size_t p = 0; p < g.size(); ++p)
  {
    g[p] = combinedHessian<D>(&hessians[components * p], components);
  }
  // Asked before any scaling: the scaling to the wanted number would make a metric of mere noise.
  metric.isLinear = isLinearField(mesh, values, components, g, options.precision);
  if (metric.isLinear)
  {
    // A linear field asks for no size anywhere: the mesh becomes uniform.
    SymmetricEigen<D> euclidean;
    euclidean.values.setOnes();
    std::fill(g.begin(), g.end(), euclidean);
  }
  else if (options.normOrder > 0.0)
  {
    // Only for a finite order: in the maximum norm, the paper's, G stays as it is.
    scaleForNorm(mesh, options, g);
  }
  ScaledMetric<D> scaled = MetricScaling<D>(
    mesh, std::move(g), options.limits, options.countCorrection)
                             .withCount(options.desiredCount);
  metric.desiredSize = scaled.desiredSize;
  metric.predictedCount = scaled.predictedCount;
  metric.isCountReached = scaled.isCountReached;
  metric.tensors = std::move(scaled.unit);
  // The scaled tensors contain h*: metric and h* are handed out apart.
  for (Tensor<D>& tensor : metric.tensors)
  {
    tensor *= scaled.desiredSize * scaled.desiredSize;
  }
  return checkRange(mesh, metric);
}

template SymmetricEigen<2> absoluteValue<2>(const Tensor<2>&);
template SymmetricEigen<3> absoluteValue<3>(const Tensor<3>&);
template SymmetricEigen<2> combinedHessian<2>(const Tensor<2>*, int);
template SymmetricEigen<3> combinedHessian<3>(const Tensor<3>*, int);
template std::string solutionMetric<2>(const SimplexMesh<2>&, const std::vector<double>&, int,
  const SolutionMetricOptions&, SolutionMetric<2>&);
template std::string solutionMetric<3>(const SimplexMesh<3>&, const std::vector<double>&, int,
  const SolutionMetricOptions&, SolutionMetric<3>&);
}
