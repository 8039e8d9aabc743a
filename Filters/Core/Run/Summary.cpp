// SPDX-License-Identifier: BSD-3-Clause
// One pass over all cells each: qualities, and their summary. Both are serial, so that sums have
// the same bits in each run.
#include "Run/Summary.h"

#include "Quality/ElementQuality.h"

#include <algorithm>
#include <limits>

namespace meshopt
{
/// For a new mesh, and wherever the measure or the metric has changed as a whole.
template <int D>
void computeQualities(
  MeshEditor<D>& editor, const NodalMetric<D>& metric, Measure measure, double beta)
{
  dispatch<D>(measure,
    [&](auto shape)
    {
      // The measure is chosen here, once, and not in the loop.
      const ElementQuality<D, decltype(shape)> quality{ beta };
      const SimplexMesh<D>& mesh = editor.mesh();
      for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
      {
        if (mesh.isAlive(c))
        {
          editor.setQuality(c, quality.value(mesh.corners(c), metric.element(mesh.nodes(c))));
        }
      }
    });
}

/// Of the qualities that the cells have stored: no cell is measured again.
template <int D>
PassRecord summarize(const SimplexMesh<D>& mesh, double target, long* inverted)
{
  PassRecord row;
  row.worst = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  long flat = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      const double q = mesh.quality(c);
      row.worst = std::min(row.worst, q);
      // Strictly below: a cell at the target has reached it.
      row.belowTarget += q < target ? 1 : 0;
      flat += q <= 0.0 ? 1 : 0;
      sum += q;
      ++row.cells;
    }
  }
  // Without cells: numbers that can be shown, not infinity.
  row.worst = row.cells > 0 ? row.worst : 0.0;
  row.mean = row.cells > 0 ? sum / static_cast<double>(row.cells) : 0.0;
  row.points = mesh.countPoints();
  if (inverted)
  {
    *inverted = flat;
  }
  return row;
}

template void computeQualities<2>(MeshEditor<2>&, const NodalMetric<2>&, Measure, double);
template void computeQualities<3>(MeshEditor<3>&, const NodalMetric<3>&, Measure, double);
template PassRecord summarize<2>(const SimplexMesh<2>&, double, long*);
template PassRecord summarize<3>(const SimplexMesh<3>&, double, long*);
}
