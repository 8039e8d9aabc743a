// SPDX-License-Identifier: BSD-3-Clause
// Finds h* for a wanted number of elements. The number falls with h*, but limits on sizes and the
// gradation bend the curve, so that the zero has to be searched.
#include "Metric/MetricScaling.h"

#include "Metric/Gradation.h"
#include "Metric/MetricVolume.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meshopt
{
namespace
{
/// How exactly the number of elements is met, as a logarithm: without gradation, and with it, where
/// each look composes all tensors. Meshes miss the number by some percent in any case.
constexpr double CountTolerance = 1e-4, GradedTolerance = 1e-3;
/// A wanted number beyond the range of the limits is taken this far inside of it, relatively: at
/// its ends the curve is flat, and there would be no zero to find. As small as CountTolerance, so
/// that nobody sees it.
constexpr double InsideRange = 1e-4;
/// Limits that allow numbers within this part of each other allow one number only. More than twice
/// InsideRange, or the ends would cross.
constexpr double NoRange = 1e-3;
/// Looks at the number in one search. Ends those whose number never comes within the tolerance.
constexpr int MostLooks = 100;
/// Limits make the curve flatter than without them: each step towards the zero is longer by this
/// factor than the last. With 1 it would take many; with more the zero is left far behind.
constexpr double Stretch = 1.5;
/// Eigenvalues that differ by less, relatively, are the same up to rounding: the tensor stays as it
/// is, instead of being composed anew with other rounding errors.
constexpr double SameValues = 1e-12;

/// Finds the zero of a falling function of ln h, to `tolerance` in its value. First come steps that
/// would be exact without limits, until the zero lies between two of them; then regula falsi (the
/// Illinois variant). `highest` bounds ln h.
template <class F>
double findZero(F&& value, double start, double highest, double slope, double tolerance)
{
  double x = std::min(start, highest), y = value(x);
  double other = x, otherY = y;
  double stretch = 1.0;
  int evaluations = 1;
  while (std::abs(y) > tolerance && otherY * y > 0.0)
  {
    // Too many elements even at the end of the range: there is no zero.
    if ((y > 0.0 && x >= highest) || evaluations >= MostLooks)
    {
      return x;
    }
    other = x;
    otherY = y;
    x = std::min(highest, x + stretch * y / slope);
    y = value(x);
    stretch *= Stretch;
    ++evaluations;
  }
  while (std::abs(y) > tolerance && evaluations < MostLooks)
  {
    const double next = (other * y - x * otherY) / (y - otherY);
    const double nextY = value(next);
    ++evaluations;
    if (nextY * y < 0.0)
    {
      other = x;
      otherY = y;
    }
    else
    {
      // The same end stays a second time: half its value draws the next step towards it.
      otherY *= 0.5;
    }
    x = next;
    y = nextY;
  }
  return x;
}
}

/// Conditions are written as !(x >= 0), so that NaN is refused, too.
std::string SizeLimits::check() const
{
  std::ostringstream text;
  // Beyond these, volumes and tensors of such sizes would not fit into a double.
  const auto isUsable = [](double size) { return size == 0.0 || (size >= 1e-50 && size <= 1e50); };
  if (!isUsable(this->minimumSize) || !isUsable(this->maximumSize))
  {
    text << "The limits of the size must be 0 (none) or from 1e-50 to 1e50; they are "
         << this->minimumSize << " and " << this->maximumSize << ".";
  }
  else if (this->maximumSize > 0.0 && this->minimumSize > this->maximumSize)
  {
    text << "The minimum size " << this->minimumSize << " is above the maximum size "
         << this->maximumSize << ".";
  }
  else if (this->maximumAnisotropy != 0.0 && !(this->maximumAnisotropy >= 1.0))
  {
    text << "The maximum anisotropy must be 0 (no limit) or at least 1; it is "
         << this->maximumAnisotropy << ".";
  }
  else if (this->gradation != 0.0 && !(this->gradation > 1.0 && std::isfinite(this->gradation)))
  {
    text << "The gradation must be 0 (no limit) or above 1; it is " << this->gradation << ".";
  }
  return text.str();
}

/// The longest size and the greatest eigenvalue bound the search for h*.
template <int D>
MetricScaling<D>::MetricScaling(const SimplexMesh<D>& mesh, std::vector<SymmetricEigen<D>> metric,
  const SizeLimits& limits, double correction)
  : mesh_(mesh)
  , metric_(std::move(metric))
  , limits_(limits)
  , correction_(correction)
{
  Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      low = low.cwiseMin(mesh.point(p));
      high = high.cwiseMax(mesh.point(p));
      this->greatest_ = std::max(this->greatest_, this->metric_[p].values[D - 1]);
    }
  }
  this->maximumSize_ = limits.maximumSize > 0.0 ? limits.maximumSize : (high - low).norm();
  this->volume_ = metricVolume<D>(mesh, std::vector<double>(mesh.numberOfPointSlots(), 0.0));
  if (limits.gradation > 1.0)
  {
    this->graph_ = PointGraph::of(mesh);
  }
}

/// The eigenvalues of a metric over h^2, with the limits on sizes and on anisotropy.
template <int D>
Vec<D> MetricScaling<D>::limited(const Vec<D>& eigenvalues, double h) const
{
  const double least = 1.0 / (this->maximumSize_ * this->maximumSize_);
  Vec<D> values = (eigenvalues / (h * h)).cwiseMax(least);
  if (this->limits_.minimumSize > 0.0)
  {
    const double most = 1.0 / (this->limits_.minimumSize * this->limits_.minimumSize);
    // Where both contradict each other, because the diagonal stands in for a maximum, the minimum
    // size wins.
    values = values.cwiseMin(most).cwiseMax(std::min(least, most));
  }
  if (this->limits_.maximumAnisotropy >= 1.0)
  {
    // Raises the small eigenvalues: long edges become shorter, short ones stay.
    const double ratio = this->limits_.maximumAnisotropy * this->limits_.maximumAnisotropy;
    values = values.cwiseMax(values.maxCoeff() / ratio);
  }
  return values;
}

template <int D>
double MetricScaling<D>::countFromVolume(double volume) const
{
  return regularElementsPerVolume<D> * this->correction_ * volume;
}

/// Number of elements of a uniform mesh with edge h.
template <int D>
double MetricScaling<D>::uniformCount(double h) const
{
  return this->countFromVolume(this->volume_ / std::pow(h, D));
}

/// Without gradation determinants do: no tensor is composed.
template <int D>
double MetricScaling<D>::predict(double h) const
{
  std::vector<double> half(this->metric_.size(), 0.0);
  for (std::size_t p = 0; p < half.size(); ++p)
  {
    half[p] = 0.5 * this->limited(this->metric_[p].values, h).array().log().sum();
  }
  return this->countFromVolume(metricVolume<D>(this->mesh_, half));
}

/// With gradation, which has to compose all tensors and sweep over the mesh: far dearer.
template <int D>
double MetricScaling<D>::predictGraded(double h)
{
  this->makeUnit(h);
  std::vector<double> half(this->unit_.size(), 0.0);
  for (std::size_t p = 0; p < half.size(); ++p)
  {
    half[p] = 0.5 * std::log(this->unit_[p].determinant());
  }
  return this->countFromVolume(metricVolume<D>(this->mesh_, half));
}

template <int D>
void MetricScaling<D>::makeUnit(double h)
{
  // The search asks for the same h again at its end.
  if (h == this->unitSize_)
  {
    return;
  }
  this->unitSize_ = h;
  this->unit_.resize(this->metric_.size());
  for (std::size_t p = 0; p < this->unit_.size(); ++p)
  {
    SymmetricEigen<D> e = this->metric_[p];
    e.values = this->limited(e.values, h);
    this->unit_[p] = e.compose();
  }
  if (this->limits_.gradation > 1.0)
  {
    limitGradation(this->mesh_, this->graph_, this->limits_.gradation, this->unit_);
    for (std::size_t p = 0; p < this->unit_.size(); ++p)
    {
      // The gradation may overstep the limits of a point a little.
      SymmetricEigen<D> e = SymmetricEigen<D>::of(this->unit_[p]);
      const Vec<D> values = this->limited(e.values, 1.0);
      if (!values.isApprox(e.values, SameValues))
      {
        e.values = values;
        this->unit_[p] = e.compose();
      }
    }
  }
}

template <int D>
ScaledMetric<D> MetricScaling<D>::withSize(double h)
{
  ScaledMetric<D> result;
  result.desiredSize = h;
  result.predictedCount = this->predictGraded(h);
  result.unit = this->unit_;
  return result;
}

/// The count falls as h grows, from `most` to `fewest`. For a count beyond these there is no h.
template <int D>
ScaledMetric<D> MetricScaling<D>::withCount(double count)
{
  // Both ends of the range are uniform meshes: everything at one of the two limits.
  const double fewest = this->uniformCount(this->maximumSize_);
  const double most = this->limits_.minimumSize > 0.0
    ? this->uniformCount(this->limits_.minimumSize)
    : std::numeric_limits<double>::infinity();
  const double goal = std::max(
    fewest * (1.0 + InsideRange), std::min(most * (1.0 - InsideRange), count));
  // At this h* everything has the maximum size, and so it has at any greater one.
  const double highest = std::log(this->maximumSize_ * std::sqrt(this->greatest_));
  if (!(most > (1.0 + NoRange) * fewest))
  {
    ScaledMetric<D> uniform = this->withSize(std::exp(highest));
    uniform.isCountReached = std::abs(count - fewest) <= NoRange * fewest;
    return uniform;
  }
  // First without gradation, which is much cheaper; its zero is the start of the other search.
  double x = findZero([&](double lnH) { return std::log(this->predict(std::exp(lnH)) / goal); },
    highest, highest, D, CountTolerance);
  if (this->limits_.gradation > 1.0)
  {
    x = findZero([&](double lnH) { return std::log(this->predictGraded(std::exp(lnH)) / goal); }, x,
      highest, D, GradedTolerance);
  }
  ScaledMetric<D> result = this->withSize(std::exp(x));
  result.isCountReached = count >= fewest && count <= most;
  return result;
}

template class MetricScaling<2>;
template class MetricScaling<3>;
}
