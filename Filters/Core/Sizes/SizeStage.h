// SPDX-License-Identifier: BSD-3-Clause
/// @file SizeStage.h
/// Makes the edges of a mesh as long as is wanted, before the worst elements are seen to.
#ifndef meshopt_Sizes_SizeStage_h
#define meshopt_Sizes_SizeStage_h

#include "Surface/BoundaryCurves.h"
#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Base/Control.h"
#include "Run/Options.h"
#include "Run/Report.h"

namespace meshopt
{
/// In small meshes so many cells more or less, those that two nodes inside bring, are no wrong number.
template <int D>
inline constexpr double CellsOfTwoNodes = D == 2 ? 4.0 : 12.0;

/// Splits edges longer than sqrt(2) h*, the longest first, and contracts those shorter than
/// h* / sqrt(2), the shortest first; lengths are those of EdgeLengths.h. In between, edges are swapped where that
/// raises the worse quality, and nodes move to where their edges have the wanted length. Once nothing
/// is left to do, or the same edges are split and contracted in turn, h* is scaled a little such that the number of
/// elements is the `predicted` one (5.3), to 3 % or CellsOfTwoNodes: not if the metric is raised, which then fills fewer. Where there are several times as many, as where
/// lengths change faster than edges can follow, splitting ends (report.sizes.cellsAtBrake).
///
/// Precondition: no cell is inverted or flat. The surface is kept but for what may slide along `curves`
/// (null: nothing). No cell gets inverted,
/// and a quality falls under .3 only where an edge of a bad cell is split. Qualities are in the end those of the
/// shape in the metric (Measure::Shape, beta = 0): the caller computes his own anew. Appends rows to
/// report.history. Returns false if the caller asked to stop.
template <int D>
bool followSizes(MeshEditor<D>& editor, NodalMetric<D>& metric, double predicted,
  const Options& options, const Control& control, const BoundaryCurves* curves, Report& report);

extern template bool followSizes<2>(MeshEditor<2>&, NodalMetric<2>&, double, const Options&,
  const Control&, const BoundaryCurves*, Report&);
extern template bool followSizes<3>(MeshEditor<3>&, NodalMetric<3>&, double, const Options&,
  const Control&, const BoundaryCurves*, Report&);
}

#endif
