// SPDX-License-Identifier: BSD-3-Clause
/// @file GlobalAlgorithm.h
/// Node repositioning of a whole mesh: clusters around the worst element, one after another.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2, Global Algorithm, steps 1 to 6.
/// Departures:
///  - Also stops once the worst element that has a movable node has the target quality.
///  - A cluster whose worst quality would rise by less than a fraction `leastGain` is left as it
///    was: its worst element is then KWORST once more and step 2 sets its nodes non-movable.
///    Without this, two neighbours may exchange ever smaller gains for ever.
///  - Non-movable from the start are boundary nodes, nodes of kept facets and edges, and the
///    user's.
///  - With a metric or size field that varies, the metric of an element is frozen while the cluster
///    is solved; the field is then sampled where nodes have moved, and the move is undone unless
///    the worst quality of the cluster has really risen.
#ifndef meshopt_Paper1996_GlobalAlgorithm_h
#define meshopt_Paper1996_GlobalAlgorithm_h

#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Paper1996/LocalAlgorithm.h"

#include <functional>

namespace meshopt
{
struct RepositionParameters
{
  int neighborhoodLevel = 1;          ///< NL
  long maximumNumberOfIterations = 0; ///< M; 0: no limit
  double target = 1.0;                ///< elements of this quality or a better one are left alone
  double leastGain = 1e-3;            ///< in quality, of one cluster, as a fraction of the quality
  bool naiveSearch = false;           ///< see WorstQueue
  LocalParameters local;
};

struct RepositionResult
{
  long tried = 0, done = 0; ///< local solves, and those that gained
  bool limitReached = false;
  bool cancelled = false;
};

/// Asked before every iteration, with the quality of the worst element: false cancels.
using KeepGoing = std::function<bool(double worst)>;

/// Runs the global algorithm. Qualities of the mesh's cells must be up to date, and are kept so.
/// Appends each KWORST to `sequence` if given.
template <int D>
RepositionResult reposition(MeshEditor<D>& editor, NodalMetric<D>& metric, Measure measure,
  double beta, const RepositionParameters& parameters, const KeepGoing& keepGoing,
  std::vector<Index>* sequence = nullptr);

extern template RepositionResult reposition<2>(MeshEditor<2>&, NodalMetric<2>&, Measure, double,
  const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
extern template RepositionResult reposition<3>(MeshEditor<3>&, NodalMetric<3>&, Measure, double,
  const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
}

#endif
