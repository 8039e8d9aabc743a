// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstFirst.h
/// The fast engine: bad cells, worst first, each met with the cheapest change that helps.
///
/// In stages of rising targets. A stage makes passes over the cells under its target; passes are of
/// rising effort (Level.h), and each drains a queue ordered by (quality, id), shared out among chunks
/// of the mesh (ChunkedPass.h). What fails is tried again only after something has changed around it.
#ifndef meshopt_WorstFirst_WorstFirst_h
#define meshopt_WorstFirst_WorstFirst_h

#include "Run/Run.h"

namespace meshopt
{
/// Optimizes the mesh, whose qualities must be up to date (and are kept so); appends one row per
/// stage and pass to the history and sets stopReason, bound and cappedCells of the report.
template <int D>
void optimizeWorstFirst(Run<D>& run);

extern template void optimizeWorstFirst<2>(Run<2>&);
extern template void optimizeWorstFirst<3>(Run<3>&);
}

#endif
