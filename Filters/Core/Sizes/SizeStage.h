// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStage.h
/// Makes the edges of a mesh as long as is wanted, before the worst elements are seen to.
#ifndef meshopt_Sizes_SizeStage_h
#define meshopt_Sizes_SizeStage_h

#include "Run/Run.h"

namespace meshopt
{
/// Tolerance on the number of cells in small meshes: what two interior nodes bring.
template <int D>
inline constexpr double CellsOfTwoNodes = D == 2 ? 4.0 : 12.0;

/// Splits edges longer than sqrt(2) h*, the longest first, and contracts those shorter than
/// h* / sqrt(2), the shortest first; lengths are those of EdgeLengths.h. In between, edges are swapped
/// where that raises the worse quality, and nodes move to where their edges have the wanted length.
/// Once nothing is left to do, or the same edges are split and contracted in turn, h* is scaled a
/// little such that the number of elements is the `predicted` one (5.3), to 3 % or CellsOfTwoNodes: not
/// if the metric is raised, which then fills fewer. Where there are several times as many, as where
/// lengths change faster than edges can follow, splitting ends (report.sizes.cellsAtBrake).
///
/// Precondition: no cell is inverted or flat. The surface is kept but for what may slide (Run::surface).
/// No cell gets inverted, and a quality falls under .3 only where an edge of a bad cell is split.
/// Qualities are in the end those of the shape in the metric (Measure::Shape, beta = 0): the caller
/// computes his own anew. Appends rows to the history. Returns false if the clock has stopped the run.
template <int D>
bool followSizes(Run<D>& run, double predicted);

extern template bool followSizes<2>(Run<2>&, double);
extern template bool followSizes<3>(Run<3>&, double);
}

#endif
