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

#include "Run/Run.h"

namespace meshopt
{
/// Optimizes the mesh, whose qualities must be up to date (and are kept so); appends two rows per
/// alternation to the history and sets report.stopReason. The surface is kept. At most run.growth cells
/// may come.
/// `target` takes the place of options.targetQuality; without `lookAhead` no element gets one.
template <int D>
void optimizePaper1996(Run<D>& run, double target, bool lookAhead);

extern template void optimizePaper1996<2>(Run<2>&, double, bool);
extern template void optimizePaper1996<3>(Run<3>&, double, bool);
}

#endif
