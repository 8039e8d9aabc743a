// SPDX-License-Identifier: BSD-3-Clause
/// @file SharpCorners.h
/// Division of the edges at corners where two curves enclose a sharp angle, where the surface takes
/// part.
///
/// A cell between two curves that leave a corner in nearly the same direction is as bad as their
/// angle is sharp. The curves may go apart by the tolerance, and that opens the angle the more, the
/// shorter their first edges are. But shorter edges alone make worse cells, which would be undone
/// at once: so the edges are divided, and the new nodes go apart, before anything else is tried.
#ifndef meshopt_WorstFirst_SharpCorners_h
#define meshopt_WorstFirst_SharpCorners_h

#include "Run/Run.h"

namespace meshopt
{
/// At cells whose quality is under `below`, the worst first: where edges on two curves leave a
/// corner at less than 30 degrees, divides both, and the edge to the cell's fourth node. Then moves
/// the new nodes to better places, as far as the surface allows. No cell is inverted by that, but
/// qualities may fall. Adds a row to the history. Returns the number of divisions; the run's growth
/// limits them. Precondition: no cell is inverted. The cost: a few looks at all cells, beside the
/// divisions.
long divideAtCorners(Run<3>& run, double below);
}

#endif
