// SPDX-License-Identifier: BSD-3-Clause
// Values of sizes and tensors are kept as logarithms. Means of logarithms stay positive definite,
// and twice and half a size are equally far away.
#include "Metric/NodalMetric.h"

#include "Metric/MetricVolume.h"
#include "Metric/TensorFunctions.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
std::string wrongLength(const char* what, std::size_t length, Index points)
{
  std::ostringstream text;
  text << what << ": " << length << " values for " << points << " points.";
  return text.str();
}
}

/// Checks all values before it takes any: a metric is never half new.
template <int D>
std::string NodalMetric<D>::set(const SimplexMesh<D>& mesh, const std::vector<double>& sizes,
  const std::vector<Tensor<D>>& tensors, NodalValues* blamed)
{
  NodalValues ignored;
  NodalValues& about = blamed ? *blamed : ignored;
  const Index n = mesh.numberOfInputPoints();
  about = NodalValues::Sizes;
  if (!sizes.empty() && static_cast<Index>(sizes.size()) != n)
  {
    return wrongLength("Desired sizes", sizes.size(), n);
  }
  if (!tensors.empty() && static_cast<Index>(tensors.size()) != n)
  {
    about = NodalValues::Tensors;
    return wrongLength("Metric tensors", tensors.size(), n);
  }
  // All is checked before anything of the metric changes.
  std::vector<Sample> values(sizes.empty() && tensors.empty() ? 0 : mesh.numberOfPointSlots());
  for (Index p = 0; !values.empty() && p < n; ++p)
  {
    // Values that no cell uses are never read: they need not be usable.
    if (!mesh.isPointAlive(p))
    {
      continue;
    }
    if (!sizes.empty())
    {
      // Written as !(x > 0), so that NaN is refused, too.
      if (!(sizes[p] > 0.0) || !std::isfinite(sizes[p]))
      {
        std::ostringstream text;
        text << "The desired size at point " << p << " is " << sizes[p]
             << "; it must be positive and finite.";
        return text.str();
      }
      values[p].logSize = std::log(sizes[p]);
    }
    if (!tensors.empty() && !logarithm<D>(tensors[p], values[p].logTensor))
    {
      about = NodalValues::Tensors;
      std::ostringstream text;
      text << "The metric tensor at point " << p
           << " is not symmetric, finite and positive definite, with eigenvalues from 1e-200 to "
              "1e200.";
      return text.str();
    }
  }
  this->hasSizes_ = !sizes.empty();
  this->hasTensors_ = !tensors.empty();
  this->background_.reset();
  if (!values.empty())
  {
    this->background_ = std::make_shared<const Background<D>>(mesh);
    for (std::size_t p = 0; p < values.size(); ++p)
    {
      // At first the mesh is its own background: each search begins where it ends.
      values[p].hint = this->background_->cellOfPoint(static_cast<Index>(p));
    }
  }
  // One copy stays as given. The other follows the points of the mesh.
  this->backgroundValues_ = values;
  this->values_ = std::move(values);
  return std::string();
}

/// Sizes are stored per point from here on, since the floor differs from point to point.
template <int D>
NodalMetric<D> NodalMetric<D>::raised(
  const SimplexMesh<D>& mesh, std::shared_ptr<const SizeFloor<D>> floor) const
{
  NodalMetric result = *this;
  if (!result.background_) // so far one value for all points
  {
    result.background_ = std::make_shared<const Background<D>>(mesh);
    result.values_.resize(mesh.numberOfPointSlots());
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      result.values_[p].logSize = this->logSize(p);
      result.values_[p].hint = result.background_->cellOfPoint(p);
    }
    // As wanted, without the floor: resample() raises what it has sampled, at the new place.
    result.backgroundValues_ = result.values_;
  }
  else if (!this->hasSizes_)
  {
    // So far tensors vary, and one size holds everywhere: now it is stored per point, too.
    for (std::vector<Sample>* values : { &result.values_, &result.backgroundValues_ })
    {
      for (Sample& value : *values)
      {
        value.logSize = std::log(this->constantSize_);
      }
    }
  }
  result.hasSizes_ = true;
  result.floor_ = std::move(floor);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      result.raise(p, mesh.point(p));
    }
  }
  return result;
}

/// The floor only raises: where it is lower the wanted size stays.
template <int D>
void NodalMetric<D>::raise(Index p, const Vec<D>& x)
{
  const double least = this->floor_->at(x);
  if (least > 0.0)
  {
    this->values_[p].logSize = std::max(this->values_[p].logSize, std::log(least));
  }
}

/// Only grows, and only if values vary from point to point.
template <int D>
void NodalMetric<D>::reserve(Index n)
{
  if (!this->values_.empty() && static_cast<Index>(this->values_.size()) < n)
  {
    this->values_.resize(n);
  }
}

template <int D>
void NodalMetric<D>::resample(Index p, const Vec<D>& x, Index near)
{
  if (this->values_.empty())
  {
    return;
  }
  this->reserve(p + 1);
  Sample& value = this->values_[p];
  // A new point has no cell of its own yet: the search begins at that of a neighbour.
  const Index hint = near != None ? this->sample(near).hint : value.hint;
  const Location<D> at = this->background_->locate(x, hint);
  // A place that is not finite: the value stays.
  if (at.cell == None)
  {
    return;
  }
  // The next search of this point begins here.
  value.hint = at.cell;
  if (this->hasSizes_)
  {
    value.logSize = Background<D>::interpolate(
      at, [this](Index q) { return this->backgroundValues_[q].logSize; });
    if (this->floor_)
    {
      this->raise(p, x);
    }
  }
  if (this->hasTensors_)
  {
    value.logTensor = Background<D>::interpolate(
      at, [this](Index q) { return this->backgroundValues_[q].logTensor; });
  }
}

template <int D>
double NodalMetric<D>::logSize(Index p) const
{
  return this->hasSizes_      ? this->values_[p].logSize
    : this->constantSize_ > 0 ? std::log(this->constantSize_)
                              : 0.0; // no size at all: as if 1 were wanted
}

/// Sizes and tensors are kept apart, since either may be given alone.
template <int D>
Tensor<D> NodalMetric<D>::unitTensor(Index p) const
{
  Tensor<D> m = Tensor<D>::Identity();
  if (this->hasTensors_)
  {
    m = exponential<D>(this->values_[p].logTensor);
  }
  if (!this->hasSizes_ && this->constantSize_ > 0.0) // exact if possible
  {
    return m / (this->constantSize_ * this->constantSize_);
  }
  return m * std::exp(-2.0 * this->logSize(p));
}

/// (5.3), with the density sqrt(det M) / h*^D. Sizes may vary from point to point, so that h* is a
/// part of the density here; in the paper it is one factor of the whole.
template <int D>
double NodalMetric<D>::predictedNumberOfElements(const SimplexMesh<D>& mesh) const
{
  std::vector<double> halfLogDeterminants(mesh.numberOfPointSlots(), 0.0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      // The logarithm of a determinant is the trace of the logarithm.
      const double trace = this->hasTensors_ ? this->values_[p].logTensor.trace() : 0.0;
      halfLogDeterminants[p] = 0.5 * trace - (this->hasSizes_ ? D * this->logSize(p) : 0.0);
    }
  }
  // Linear in between, as fill() takes them: the integral is exact, not by one value per cell.
  double inUnits = metricVolume<D>(mesh, halfLogDeterminants);
  // One size for all is a factor of the whole: it need not go through a logarithm at each point.
  for (int d = 0; d < D && !this->hasSizes_ && this->constantSize_ > 0.0; ++d)
  {
    inUnits /= this->constantSize_;
  }
  return regularElementsPerVolume<D> * inUnits;
}

/// Means of logarithms over the nodes, so that the result is positive definite whatever they are:
/// the value at the centroid, since logarithms are linear in an element. The quality then takes it
/// as constant in the element, as (2.2) and (2.3) need it.
template <int D>
void NodalMetric<D>::fill(const Simplex<D>& nodes, ElementMetric<D>& m) const
{
  if (this->hasSizes_)
  {
    double sum = 0.0;
    for (Index p : nodes)
    {
      sum += this->values_[p].logSize;
    }
    // The mean of logarithms: twice and half the size are equally far away.
    m.desiredSize = std::exp(sum / (D + 1));
  }
  if (this->hasTensors_)
  {
    Tensor<D> sum = this->values_[nodes[0]].logTensor;
    for (int i = 1; i <= D; ++i)
    {
      sum += this->values_[nodes[i]].logTensor;
    }
    m.euclidean = false;
    // Half of the mean: the map is the root of the tensor.
    m.map = exponential<D>((sum * (0.5 / (D + 1))).eval());
  }
}

template class NodalMetric<2>;
template class NodalMetric<3>;
}
