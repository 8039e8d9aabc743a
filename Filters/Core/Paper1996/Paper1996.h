// SPDX-License-Identifier: BSD-3-Clause
/// @file Paper1996.h
/// The optimizer of the paper: reconnection, then repositioning, and so on.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), opening of section 2: "The optimization sequence
/// starts with a connectivity optimization, followed by repositioning the nodes at optimal
/// locations for that structure, and so on."
/// What it leaves open: when an alternation has raised the worst quality by less than a fraction
/// 1e-3, the next one gives the 20 worst elements a look-ahead (LookAhead.h, a departure). The
/// sequence ends when that does not help either, when the target is reached, or after a number of
/// alternations.
#ifndef meshopt_Paper1996_Paper1996_h
#define meshopt_Paper1996_Paper1996_h

#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Base/Control.h"
#include "Run/Options.h"
#include "Run/Report.h"
#include "Paper1996/Reconnection.h"

namespace meshopt
{
/// Optimizes the mesh, whose qualities must be up to date (and are kept so); appends two rows per
/// alternation to report.history and sets report.stopReason. At most `growth` cells may come.
template <int D>
void optimizePaper1996(MeshEditor<D>& editor, NodalMetric<D>& metric, const Options& options,
  const Control& control, Report& report, long growth = AnyGrowth);

extern template void optimizePaper1996<2>(
  MeshEditor<2>&, NodalMetric<2>&, const Options&, const Control&, Report&, long);
extern template void optimizePaper1996<3>(
  MeshEditor<3>&, NodalMetric<3>&, const Options&, const Control&, Report&, long);
}

#endif
