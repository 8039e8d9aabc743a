// SPDX-License-Identifier: BSD-3-Clause
/// @file Optimizer.h
/// The door of the core: optimize a mesh in place.
#ifndef meshopt_Optimize_Optimizer_h
#define meshopt_Optimize_Optimizer_h

#include "Base/Control.h"
#include "Mesh/SimplexMesh.h"
#include "Metric/NodalMetric.h"
#include "Run/Options.h"
#include "Run/Report.h"
#include "Surface/Surface.h"

namespace meshopt
{
/// Maximizes the quality of the worst element of `mesh` (2.1). Kept facets, kept edges and fixed points
/// are untouched, bit for bit. The worst quality never falls, and no cell is inverted that was not.
/// `metric` holds h* and the metric at the points; it is sampled where points move or come.
/// `surface`: what nodes of the surface slide along, built for this mesh (Algorithm::WorstFirst; null:
/// the surface is kept). Where sizes are given, and beta > 0 or a surface, Algorithm::WorstFirst first
/// makes the edges as long as is wanted (SizeStage.h); then the worst quality may fall, but not below
/// targetQuality.
/// Preconditions: options.check(...) is empty; the mesh was built without error.
template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, const Surface<D>* surface = nullptr);

extern template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, const Surface<2>*);
extern template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, const Surface<3>*);
}

#endif
