// SPDX-License-Identifier: BSD-3-Clause
/// @file Paper1996.h
/// The optimizer of the paper: alternates between reconnection and repositioning.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), opening of section 2: "The optimization sequence
/// starts with a connectivity optimization, followed by repositioning the nodes at optimal
/// locations for that structure, and so on."
/// The paper leaves open when to end. Here, after an alternation that has raised the worst quality
/// by less than a fraction 1e-3, the next one gives the 20 worst elements a look-ahead
/// (FillingLookAhead.h, a departure). The sequence ends when that does not help either, when the
/// target is reached, or after a number of alternations.
#ifndef meshopt_Paper1996_Paper1996_h
#define meshopt_Paper1996_Paper1996_h

#include "Run/Run.h"

namespace meshopt
{
/// Optimizes the mesh. Its qualities must be up to date, and are kept up to date. Appends two rows
/// per alternation to the history and sets report.stopReason. The surface is kept. Adds at most
/// run.growth cells.
/// `target` takes the place of options.targetQuality. Without `lookAhead` no element gets one.
template <int D>
void optimizePaper1996(Run<D>& run, double target, bool lookAhead);

extern template void optimizePaper1996<2>(Run<2>&, double, bool);
extern template void optimizePaper1996<3>(Run<3>&, double, bool);
}

#endif
