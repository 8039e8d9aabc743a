// SPDX-License-Identifier: BSD-3-Clause
/// @file ElementMetric.h
/// The metric and the wanted size of one element.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), (2.2) and section 5.
#ifndef meshopt_Metric_ElementMetric_h
#define meshopt_Metric_ElementMetric_h

#include "Mesh/Types.h"

namespace meshopt
{
/// The size against which an element is measured (2.2), and the metric in which it is measured. One
/// per element; frozen during one local solve.
template <int D>
struct ElementMetric
{
  bool euclidean = true;
  Tensor<D> map = Tensor<D>::Identity(); ///< M^(1/2): coordinates are first mapped by it
  double desiredSize = 0.0;              ///< h*, in the metric; used when beta > 0
};
}

#endif
