// SPDX-License-Identifier: BSD-3-Clause
/// @file QualityModel.h
/// The quality that one run maximizes: measure, size factor and metric in one object.
#ifndef meshopt_Edit_QualityModel_h
#define meshopt_Edit_QualityModel_h

#include "Bound/Caps.h"
#include "Metric/NodalMetric.h"
#include "Quality/EdgeSum.h"
#include "Quality/ElementQuality.h"
#include "Quality/Evaluations.h"

namespace meshopt
{
template <int D, class Shape>
struct QualityModel
{
  const SimplexMesh<D>* mesh;
  NodalMetric<D>* metric;
  ElementQuality<D, Shape> quality;
  /// Euclidean and without size factor: the metric need not be read.
  bool plain;
  /// The measure is a function of volume and edge sum: if also plain, edge lengths can be shared.
  static constexpr bool HasSum = EdgeSum<Shape>::value;
  /// If set, the quality of a cell is multiplied by Caps::weight(), unless it is under the floor.
  const Caps<D>* weights = nullptr;
  double floor = 0.0;

  bool fast() const { return HasSum && this->plain && !this->weights; }

  QualityModel(const SimplexMesh<D>& m, NodalMetric<D>& field, double beta, const Shape& shape = {})
    : mesh(&m)
    , metric(&field)
    , quality{ beta, shape }
    , plain(beta == 0.0 && field.isTrivial())
  {
  }

  /// The quality of a cell if its nodes were at the places x.
  double at(const Simplex<D>& nodes, const Corners<D>& x) const
  {
    ++evaluationsOfThread;
    const double q = this->plain ? this->quality.shape.value(x) : this->inMetric(nodes, x);
    const bool weigh = this->weights && !(q < this->floor);
    return weigh ? this->weighted(nodes, q) : q;
  }
  double operator()(const Simplex<D>& nodes) const
  {
    Corners<D> x;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = this->mesh->point(nodes[i]);
    }
    return this->at(nodes, x);
  }
  double weight(const Facet<D>& f) const { return this->weights ? this->weights->weight(f) : 1.0; }

private:
  // Not inlined: without them the usual case is short enough to be inlined where it is asked often.
  [[gnu::noinline]] double inMetric(const Simplex<D>& nodes, const Corners<D>& x) const
  {
    return this->quality.value(x, this->metric->element(nodes));
  }
  [[gnu::noinline]] double weighted(const Simplex<D>& nodes, double q) const
  {
    return q * this->weights->weight(nodes);
  }
};
}

#endif
