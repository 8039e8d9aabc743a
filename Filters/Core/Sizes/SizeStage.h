// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStage.h
/// Makes the edges of a mesh as long as wanted. Runs before the engine improves the worst elements.
#ifndef meshopt_Sizes_SizeStage_h
#define meshopt_Sizes_SizeStage_h

#include "Run/Run.h"

namespace meshopt
{
/// Tolerance on the number of cells in small meshes: the cells that two interior nodes bring.
template <int D>
inline constexpr double CellsOfTwoNodes = D == 2 ? 4.0 : 12.0;

/// Splits edges longer than sqrt(2) h*, longest first, and contracts edges shorter than h* /
/// sqrt(2), shortest first. Lengths are those of EdgeLengths.h. In between, edges are swapped if
/// that raises the worse quality, and nodes move to where their edges have the wanted length. This
/// ends when nothing is left to do, or when the same edges are split and contracted in turn. Then
/// h* is scaled a little, so that the number of elements becomes the `predicted` one (5.3), to 3 %
/// or CellsOfTwoNodes. It is not scaled if the metric is raised: fewer elements are then enough. If
/// there are several times too many elements, splitting ends (report.sizes.cellsAtBrake); this
/// happens where lengths change faster than edges can follow.
///
/// Precondition: no cell is inverted or flat. The surface is kept, except what may slide
/// (Run::surface). No cell becomes inverted. A quality falls under 0.3 only where an edge is split,
/// and then to no less than 0.3 times the worst of the split cells. At the end the stored qualities
/// are those of the shape in the metric (Measure::Shape, beta = 0): the caller must compute his own
/// again. Appends rows to the history. Returns false if the clock has stopped the run.
template <int D>
bool followSizes(Run<D>& run, double predicted);

extern template bool followSizes<2>(Run<2>&, double);
extern template bool followSizes<3>(Run<3>&, double);
}

#endif
