// SPDX-License-Identifier: BSD-3-Clause
/// @file ElementMetric.h
/// The metric and the wanted size of one element.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), (2.2) and section 4.
#ifndef meshopt_Metric_ElementMetric_h
#define meshopt_Metric_ElementMetric_h

#include "Mesh/Types.h"

namespace meshopt
{
/// What an element's size is measured against (2.2), and in which metric. One per element; frozen
/// within one local solve.
template <int D>
struct ElementMetric
{
  bool euclidean = true;
  Tensor<D> map = Tensor<D>::Identity(); ///< M^(1/2): coordinates are mapped by it first
  double desiredSize = 0.0;              ///< h*, in the metric; used when beta > 0
};
}

#endif
