// SPDX-License-Identifier: BSD-3-Clause
// From errors in the present cells to sizes of a new mesh in which all cells have the same error.
// It assumes that an error falls with a power of the size, the order of convergence.
#include "Metric/ErrorIndicator.h"

#include "Metric/MetricVolume.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
/// The density of elements h^-D at the points that makes the errors of all new elements equal, up
/// to the factor h*^-D. Errors are relative to the greatest.
template <int D>
std::vector<double> densities(
  const SimplexMesh<D>& mesh, const std::vector<double>& errors, double greatest, double power)
{
  // Elements of size h in place of one of size h_K have the squared error e^2 (h / h_K)^(2 order +
  // D) each. It is the same for all of them if h = h* h_K e^-power.
  std::vector<double> sum(mesh.numberOfPointSlots(), 0.0), volume(sum);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      // density times volume: h_K^D = regularElementsPerVolume * volume cancels
      const double share = std::pow(errors[c] / greatest, D * power) / regularElementsPerVolume<D>;
      for (Index p : mesh.nodes(c))
      {
        sum[p] += share;
        volume[p] += std::abs(signedVolume(mesh.corners(c)));
      }
    }
  }
  for (std::size_t p = 0; p < sum.size(); ++p)
  {
    // The mean of the densities around the point, weighted by volume.
    sum[p] = volume[p] > 0.0 ? sum[p] / volume[p] : 0.0;
  }
  return sum;
}

constexpr double LeastSize = 1e-50; ///< its powers fit into a double

/// The h* with which the total error is `fraction` of the present one.
double sizeForError(
  const std::vector<double>& errors, double greatest, double fraction, double power, double order)
{
  // The new elements in place of an old one have the squared error e^2 (h / h_K)^(2 order)
  // together, with h / h_K = h* e^-power as above.
  double now = 0.0, then = 0.0; // squares: now, and of the new mesh with h* = 1
  for (double error : errors)
  {
    const double e = error / greatest;
    now += e * e;
    then += e > 0.0 ? std::pow(e, 2.0 - 2.0 * order * power) : 0.0;
  }
  return std::pow(fraction * fraction * now / then, 0.5 / order);
}

std::string checkErrors(const std::vector<double>& errors)
{
  for (std::size_t c = 0; c < errors.size(); ++c)
  {
    if (!(errors[c] >= 0.0) || !std::isfinite(errors[c]))
    {
      std::ostringstream text;
      text << "The error of cell " << c << " is " << errors[c]
           << "; it must be a finite number that is not negative.";
      return text.str();
    }
  }
  return std::string();
}
}

std::string ErrorIndicatorOptions::check() const
{
  std::ostringstream text;
  if (this->desiredErrorFraction == 0.0 &&
    (!(this->desiredCount > 0.0) || !std::isfinite(this->desiredCount)))
  {
    text << "The wanted number of elements must be positive; it is " << this->desiredCount << ".";
  }
  else if (!(this->desiredErrorFraction >= 0.0) || !std::isfinite(this->desiredErrorFraction))
  {
    text << "The wanted part of the error must be 0 (not used) or positive; it is "
         << this->desiredErrorFraction << ".";
  }
  else if (!(this->convergenceOrder > 0.0) || !std::isfinite(this->convergenceOrder))
  {
    text << "The convergence order must be positive; it is " << this->convergenceOrder << ".";
  }
  else if (!(this->countCorrection > 0.0) || !std::isfinite(this->countCorrection))
  {
    text << "The correction of the number of elements must be positive; it is "
         << this->countCorrection << ".";
  }
  return text.str().empty() ? this->limits.check() : text.str();
}

/// Densities become a metric of spheres, so that limits and h* are found as for a solution.
template <int D>
std::string sizesFromErrors(const SimplexMesh<D>& mesh, const std::vector<double>& errors,
  const ErrorIndicatorOptions& options, ErrorIndicatorSizes& result)
{
  const std::string problem = options.check();
  const std::string error = problem.empty() ? checkErrors(errors) : problem;
  if (!error.empty() || errors.empty())
  {
    return error;
  }
  const double greatest = *std::max_element(errors.begin(), errors.end());
  // From (h / h_K)^(2 order + D) in densities().
  const double power = 2.0 / (2.0 * options.convergenceOrder + D);
  result.isZero = greatest == 0.0;
  std::vector<SymmetricEigen<D>> metric(mesh.numberOfPointSlots());
  std::vector<double> density(metric.size(), 1.0);
  if (!result.isZero)
  {
    density = densities(mesh, errors, greatest, power);
  }
  for (std::size_t p = 0; p < metric.size(); ++p)
  {
    // A density is h^-D, an eigenvalue of a metric h^-2.
    metric[p].values.setConstant(std::pow(density[p], 2.0 / D));
  }
  SizeLimits limits = options.limits;
  // A size has no direction.
  limits.maximumAnisotropy = 0.0;
  MetricScaling<D> scaling(mesh, std::move(metric), limits, options.countCorrection);
  // Where there is no error a part of it says nothing: without a wanted number, the present one is
  // kept.
  const bool byError = options.desiredErrorFraction > 0.0 && !result.isZero;
  const double size = byError
    ? sizeForError(errors, greatest, options.desiredErrorFraction, power, options.convergenceOrder)
    : 1.0;
  if (!(size > LeastSize && size < 1.0 / LeastSize)) // relative to the present elements
  {
    std::ostringstream text;
    text << "For " << options.desiredErrorFraction << " of the error, with a convergence order of "
         << options.convergenceOrder << ", sizes would be beyond the range of numbers.";
    return text.str();
  }
  const ScaledMetric<D> scaled = byError
    ? scaling.withSize(size)
    : scaling.withCount(options.desiredCount > 0.0 ? options.desiredCount : errors.size());
  result.predictedCount = scaled.predictedCount;
  result.isCountReached = scaled.isCountReached;
  result.sizes.resize(scaled.unit.size());
  for (std::size_t p = 0; p < scaled.unit.size(); ++p)
  {
    result.sizes[p] = 1.0 / std::sqrt(scaled.unit[p](0, 0));
  }
  return std::string();
}

template std::string sizesFromErrors<2>(const SimplexMesh<2>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
template std::string sizesFromErrors<3>(const SimplexMesh<3>&, const std::vector<double>&,
  const ErrorIndicatorOptions&, ErrorIndicatorSizes&);
}
