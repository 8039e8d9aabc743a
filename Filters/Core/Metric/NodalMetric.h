// SPDX-License-Identifier: BSD-3-Clause
/// @file NodalMetric.h
/// Desired size h* and metric tensor M at the points of a mesh, frozen on the input mesh.
#ifndef meshopt_Metric_NodalMetric_h
#define meshopt_Metric_NodalMetric_h

#include "Mesh/SimplexMesh.h"
#include "Metric/Background.h"
#include "Metric/ElementMetric.h"
#include "Metric/SizeFloor.h"

#include <memory>
#include <string>
#include <vector>

namespace meshopt
{
/// Which of the values at points a sentence is about.
enum class NodalValues
{
  Sizes,
  Tensors
};

/// The field is defined on the *background*: a copy of the input mesh with the user's values at its
/// points. At the points of the optimized mesh it is sampled by linear interpolation (of log h*,
/// and of log M: log-Euclidean). It is sampled again whenever a point moves or is added, so that it
/// does not drift. Without sizes and tensors it is trivial and costs nothing.
///
/// Copies share the background. Different threads may resample different points if there is room
/// for these (see reserve()).
template <int D>
class NodalMetric
{
public:
  /// The values stored for a point; they are restored if a move is undone.
  struct Sample
  {
    double logSize = 0.0;
    Tensor<D> logTensor = Tensor<D>::Zero();
    Index hint = None; ///< background cell where the point was last found
  };

  /// Trivial: Euclidean, h* the same everywhere.
  explicit NodalMetric(double desiredSize = 0.0) { this->constantSize_ = desiredSize; }

  /// Sets values at the points of `background` (which is copied). Sizes: empty or one per input
  /// point, > 0. Tensors: empty or one per input point, symmetric positive definite, in 1 / unit of
  /// length squared. Returns an empty string, or a sentence about the first unusable value; then
  /// nothing has changed. Points that no cell uses may have any value. `blamed`, if not null,
  /// receives which of the two the sentence is about.
  std::string set(const SimplexMesh<D>& background, const std::vector<double>& sizes,
    const std::vector<Tensor<D>>& tensors, NodalValues* blamed = nullptr);

  bool isTrivial() const { return this->values_.empty(); }
  bool hasSizes() const { return this->hasSizes_; }

  /// Samples the background at x and stores the values for point p (moved or new). Does nothing if
  /// the field does not vary. Points outside of the background get the clamped values of the
  /// nearest cell. `near`, for new points: a point near x, which makes the search short.
  void resample(Index p, const Vec<D>& x, Index near = None);

  /// Makes room for points 0 ... n - 1; needed before several threads resample new points.
  void reserve(Index n);

  /// Present values of point p, to be restored by setSample() if a move is undone.
  Sample sample(Index p) const
  {
    return p < static_cast<Index>(this->values_.size()) ? this->values_[p] : Sample();
  }
  void setSample(Index p, const Sample& value)
  {
    if (p < static_cast<Index>(this->values_.size()))
    {
      this->values_[p] = value;
    }
  }

  /// The metric and h* of an element, from the mean of the logarithms at its nodes.
  ElementMetric<D> element(const Simplex<D>& nodes) const
  {
    ElementMetric<D> m;
    m.desiredSize = this->constantSize_;
    if (!this->isTrivial())
    {
      this->fill(nodes, m);
    }
    return m;
  }

  /// The same field with h* raised to at least `floor`, at the points of `mesh` and wherever it is
  /// sampled from now on. Sizes must be given.
  NodalMetric raised(const SimplexMesh<D>& mesh, std::shared_ptr<const SizeFloor<D>> floor) const;
  bool isRaised() const { return this->floor_ != nullptr; }

  /// M / h*^2 at point p as sampled: edges of the wanted length have length 1 in it. The identity
  /// if neither a size nor a metric is given.
  Tensor<D> unitTensor(Index p) const;

  /// The number of regular elements with edges of the wanted length that fill `mesh` (5.3). This
  /// must be the mesh for which the values were given.
  double predictedNumberOfElements(const SimplexMesh<D>& mesh) const;

private:
  double logSize(Index p) const;
  void raise(Index p, const Vec<D>& x);
  void fill(const Simplex<D>& nodes, ElementMetric<D>& m) const;

  double constantSize_ = 0.0;
  bool hasSizes_ = false;
  bool hasTensors_ = false;
  std::vector<Sample> values_;           ///< per point of the optimized mesh
  std::vector<Sample> backgroundValues_; ///< per point of the background
  std::shared_ptr<const Background<D>> background_;
  std::shared_ptr<const SizeFloor<D>> floor_; ///< null: none
};

extern template class NodalMetric<2>;
extern template class NodalMetric<3>;
}

#endif
