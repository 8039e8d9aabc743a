// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceRounds.h
/// The fast engine where the surface takes part: a run, then divisions of long edges with a run
/// after each, then a last run.
#ifndef meshopt_Optimize_SurfaceRounds_h
#define meshopt_Optimize_SurfaceRounds_h

#include "Run/Run.h"

namespace meshopt
{
/// How often a run is repeated because facets pass through others: then it refuses more. If that
/// does not help, the mesh stays as it was.
inline constexpr int MostRepeats = 4;

/// What no mesh of the body can exceed, by what its ridges and corners force where they stay as
/// they are: certified. The value of the regular element if nothing is known.
template <int D>
double boundOfAngles(const Surface<D>& surface, Measure measure);

/// Back to an earlier state of the mesh.
template <int D>
void restore(Run<D>& run, const SimplexMesh<D>& mesh);

/// Improves the worst cells with another effort and with a part of the growth that is left
/// (optimizeWorstFirst()). `surface`: that of the run. If facets pass through others then
/// (Surface::refuseCrossings()), does the same again from the mesh before, up to MostRepeats times.
template <int D>
void optimizeOnSurface(
  Run<D>& run, Surface<D>& surface, Effort effort, double part, bool polishesWidely);

/// Where the surface takes part (Surface::judgesChanges()): if the engine reaches neither the
/// target nor boundOfAngles(), long edges are divided at the worst cells and the engine runs again,
/// as long as that helps. Where the growth budget is short, nodes vanish elsewhere. The worst
/// quality never falls.
template <int D>
void optimizeSliding(Run<D>& run, Surface<D>& surface);

extern template double boundOfAngles(const Surface<2>&, Measure);
extern template double boundOfAngles(const Surface<3>&, Measure);
extern template void restore(Run<2>&, const SimplexMesh<2>&);
extern template void restore(Run<3>&, const SimplexMesh<3>&);
extern template void optimizeOnSurface(Run<2>&, Surface<2>&, Effort, double, bool);
extern template void optimizeOnSurface(Run<3>&, Surface<3>&, Effort, double, bool);
extern template void optimizeSliding(Run<2>&, Surface<2>&);
extern template void optimizeSliding(Run<3>&, Surface<3>&);
}

#endif
