// SPDX-License-Identifier: BSD-3-Clause
/// @file Summary.h
/// Qualities of all cells of a mesh, and their summary as a row of the history.
#ifndef meshopt_Run_Summary_h
#define meshopt_Run_Summary_h

#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Quality/Measure.h"
#include "Run/Report.h"

namespace meshopt
{
/// Computes the quality (2.2) of every live cell, in the metric at its nodes, and stores it in the
/// mesh. Linear in the size of the mesh.
template <int D>
void computeQualities(
  MeshEditor<D>& editor, const NodalMetric<D>& metric, Measure measure, double beta);

/// Worst and mean quality (0 if there are no cells) and counts. `inverted` receives the number of
/// cells with quality <= 0. Linear; sums run in the order of the cells, so they are the same on
/// every run.
template <int D>
PassRecord summarize(const SimplexMesh<D>& mesh, double target, long* inverted = nullptr);

extern template void computeQualities<2>(MeshEditor<2>&, const NodalMetric<2>&, Measure, double);
extern template void computeQualities<3>(MeshEditor<3>&, const NodalMetric<3>&, Measure, double);
extern template PassRecord summarize<2>(const SimplexMesh<2>&, double, long*);
extern template PassRecord summarize<3>(const SimplexMesh<3>&, double, long*);
}

#endif
