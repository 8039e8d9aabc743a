// SPDX-License-Identifier: BSD-3-Clause
/// @file NodalMetric.h
/// Desired size h* and metric tensor M at the points of a mesh, frozen on the input mesh.
#ifndef meshopt_Metric_NodalMetric_h
#define meshopt_Metric_NodalMetric_h

#include "Mesh/SimplexMesh.h"
#include "Metric/Background.h"
#include "Metric/SizeFloor.h"
#include "Metric/ElementMetric.h"

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

/// The field lives on the *background*: a copy of the input mesh with the values the user gave at
/// its points. At the points of the mesh being optimized it is sampled by linear interpolation (of
/// log h*, and of log M: log-Euclidean), again whenever a point moves or comes, so that it does
/// not drift. Without sizes and without tensors it is trivial and costs nothing.
///
/// Copies share the background. Different points may be resampled by different threads if there is
/// room for them (see reserve()).
template <int D>
class NodalMetric
{
public:
  /// What is stored for a point; to be taken and put back where a move is undone.
  struct Sample
  {
    double logSize = 0.0;
    Tensor<D> logTensor = Tensor<D>::Zero();
    Index hint = None; ///< cell of the background where the point was found last
  };

  /// Trivial: Euclidean, h* the same everywhere.
  explicit NodalMetric(double desiredSize = 0.0) { this->constantSize_ = desiredSize; }

  /// Values at the points of `background` (which is copied): sizes empty or one per input point, >
  /// 0; tensors empty or one per input point, symmetric positive definite, in 1 / unit of length
  /// squared. Returns a sentence naming the first unusable value, or an empty string; after an
  /// error nothing has changed. Points that no cell uses may have any value.
  /// `blamed`, where not null, is told which of the two the sentence is about.
  std::string set(const SimplexMesh<D>& background, const std::vector<double>& sizes,
    const std::vector<Tensor<D>>& tensors, NodalValues* blamed = nullptr);

  /// One tensor for all points; same error.
  std::string setConstant(const Tensor<D>& tensor);

  bool isTrivial() const { return this->values_.empty() && !this->hasConstant_; }
  bool hasSizes() const { return this->hasSizes_; }

  /// Samples the background at x and stores the values for point p (moved or new). Does nothing
  /// where the field does not vary. Points out of the background take the nearest cell's clamped
  /// value. `near` is a point whose neighbourhood x is in, for new points: it makes the search
  /// short.
  void resample(Index p, const Vec<D>& x, Index near = None);

  /// Makes room for points 0 ... n - 1; needed before several threads resample new points.
  void reserve(Index n);

  /// Values of point p as they are, to be put back by setSample() where a move is undone.
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

  /// The metric and h* of an element: from the mean of the logarithms at its nodes.
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

  /// The same field with h* raised to what `floor` says, at the points of `mesh` and wherever it is sampled
  /// from then on. There must be sizes.
  NodalMetric raised(const SimplexMesh<D>& mesh, std::shared_ptr<const SizeFloor<D>> floor) const;
  bool isRaised() const { return this->floor_ != nullptr; }

  /// M / h*^2 at point p as it was sampled: in it, edges of the wanted length have length 1. The
  /// identity where neither a size nor a metric is given.
  Tensor<D> unitTensor(Index p) const;

  /// The number of regular elements whose edges have the wanted length that fill `mesh` (5.3); it is
  /// to be the one that the values were given for.
  double predictedNumberOfElements(const SimplexMesh<D>& mesh) const;

private:
  double logSize(Index p) const;
  void raise(Index p, const Vec<D>& x);
  void fill(const Simplex<D>& nodes, ElementMetric<D>& m) const;

  double constantSize_ = 0.0;
  bool hasSizes_ = false;
  bool hasTensors_ = false;
  bool hasConstant_ = false;
  Tensor<D> constantMap_ = Tensor<D>::Identity(); ///< M^(1/2)
  std::vector<Sample> values_;                    ///< per point of the optimized mesh
  std::vector<Sample> backgroundValues_;          ///< per point of the background
  std::shared_ptr<const Background<D>> background_;
  std::shared_ptr<const SizeFloor<D>> floor_; ///< null: none
};

extern template class NodalMetric<2>;
extern template class NodalMetric<3>;
}

#endif
