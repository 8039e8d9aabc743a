// SPDX-License-Identifier: BSD-3-Clause
/// @file Optimizer.h
/// The door of the core: optimize a mesh in place.
#ifndef meshopt_Optimize_Optimizer_h
#define meshopt_Optimize_Optimizer_h

#include "Surface/BoundaryCurves.h"
#include "Mesh/SimplexMesh.h"
#include "Metric/NodalMetric.h"
#include "Base/Control.h"
#include "Run/Options.h"
#include "Run/Report.h"

namespace meshopt
{
/// Maximizes the quality of the worst element of `mesh` (2.1). Kept facets, kept edges and fixed points are
/// untouched, bit for bit. The worst quality never falls, and no cell is inverted that was not.
/// `metric` holds h* and the metric at the points; it is sampled where points move or come.
/// `curves`: what boundary nodes slide along, built for this mesh (D = 2, Algorithm::WorstFirst; null:
/// the boundary is kept). Where sizes are given, and beta > 0 or curves, Algorithm::WorstFirst first makes the
/// edges as long as is wanted (SizeStage.h); then the worst quality may fall, but not below targetQuality.
/// Preconditions: options.check(...) is empty; the mesh was built without error.
template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, const BoundaryCurves* curves = nullptr);

extern template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, const BoundaryCurves*);
extern template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, const BoundaryCurves*);
}

#endif
