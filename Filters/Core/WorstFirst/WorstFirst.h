// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstFirst.h
/// The fast engine: bad cells, worst first, each met with the cheapest change that helps.
///
/// In stages of rising targets. A stage makes passes over the cells under its target; passes are of
/// rising effort (Improver::Level), and each drains a queue ordered by (quality, id). What fails is
/// tried again only after something has changed around it.
///
/// Threads: the points are split into chunks, by place; a cell belongs to a chunk if all its points
/// do, and an editor changes only cells of its chunk (see MeshEditor::setOwner). The number of
/// chunks, their borders, and the slots each may take depend on the mesh only, every chunk is
/// worked on in sequence, and chunks cannot see each other: the result does not depend on the
/// number of threads. What a border holds up comes next pass, when borders lie elsewhere.
#ifndef meshopt_WorstFirst_WorstFirst_h
#define meshopt_WorstFirst_WorstFirst_h

#include "Surface/BoundaryCurves.h"
#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Base/Control.h"
#include "Run/Options.h"
#include "Run/Report.h"

namespace meshopt
{
/// Optimizes the mesh, whose qualities must be up to date (and are kept so); appends one row per
/// stage and pass to report.history and sets stopReason, bound and cappedCells.
template <int D>
void optimizeWorstFirst(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, const BoundaryCurves* curves = nullptr);

extern template void optimizeWorstFirst<2>(
  MeshEditor<2>&, NodalMetric<2>&, const Options&, const Control&, Report&, const BoundaryCurves*);
extern template void optimizeWorstFirst<3>(
  MeshEditor<3>&, NodalMetric<3>&, const Options&, const Control&, Report&, const BoundaryCurves*);
}

#endif
