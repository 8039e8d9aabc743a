// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstFirst.h
/// The fast engine: takes bad cells worst first, and applies the cheapest change that helps each.
///
/// It works in stages of rising targets. A stage makes passes of rising effort (Level.h) over the
/// cells under its target. Each pass drains a queue ordered by (quality, id), which is shared out
/// among chunks of the mesh (ChunkedPass.h). A failed cell is tried again only after something has
/// changed around it, or with more effort.
#ifndef meshopt_WorstFirst_WorstFirst_h
#define meshopt_WorstFirst_WorstFirst_h

#include "Run/Run.h"

namespace meshopt
{
/// Optimizes the mesh. Its qualities must be up to date, and are kept up to date. Appends one row
/// per stage and pass to the history, and sets stopReason, bound and cappedCells of the report.
template <int D>
void optimizeWorstFirst(Run<D>& run);

extern template void optimizeWorstFirst<2>(Run<2>&);
extern template void optimizeWorstFirst<3>(Run<3>&);
}

#endif
