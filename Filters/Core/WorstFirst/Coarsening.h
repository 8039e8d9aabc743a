// SPDX-License-Identifier: BSD-3-Clause
/// @file Coarsening.h
/// Removal of nodes where cells are good, where the surface takes part: what the growth budget
/// lacks at the worst cells comes from there.
#ifndef meshopt_WorstFirst_Coarsening_h
#define meshopt_WorstFirst_Coarsening_h

#include "Run/Run.h"

namespace meshopt
{
/// Contracts edges, so that nodes vanish inside, on patches and along curves; the surface says
/// which. All cells that come of it have a shape (MeanEdgeShape) above `above` times the worst one
/// at first, but at most that of the target. It ends when `most` cells are gone. Of neighbours only
/// one vanishes, so that no edge grows to much more than twice its length. Adds a row to the
/// history. Returns how many cells are gone. Precondition: no cell is inverted. The cost: one look
/// at each node with its neighbours.
long coarsen(Run<3>& run, double above, long most);
}

#endif
