// SPDX-License-Identifier: BSD-3-Clause
/// @file Optimizer.h
/// The entry point of the core: optimizes a mesh in place.
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
/// Maximizes the quality of the worst element of `mesh` (2.1). Fixed points stay as they are, bit
/// for bit; without a surface kept facets and kept edges, too. Without sizes the worst quality
/// never falls; with them it does not fall below targetQuality. No cell becomes inverted, if none
/// was.
/// `metric` holds h* and the metric at the points; it is sampled where points move or are added.
/// `surface`: what nodes of the surface slide along, built for this mesh (Algorithm::WorstFirst
/// only); null: the surface is kept. It changes if it is released on the way (Surface::release()).
/// Algorithm::WorstFirst first makes the edges as long as wanted (SizeStage.h) if sizes are given,
/// and if beta > 0 or there is a surface.
/// Preconditions: options.check(...) is empty; the mesh was built without error.
template <int D>
Report optimize(SimplexMesh<D>& mesh, NodalMetric<D>& metric, const Options& options,
  const Control& control, Surface<D>* surface = nullptr);

extern template Report optimize<2>(
  SimplexMesh<2>&, NodalMetric<2>&, const Options&, const Control&, Surface<2>*);
extern template Report optimize<3>(
  SimplexMesh<3>&, NodalMetric<3>&, const Options&, const Control&, Surface<3>*);
}

#endif
