// SPDX-License-Identifier: BSD-3-Clause
/// @file GlobalAlgorithm.h
/// Node repositioning of a whole mesh: clusters around the worst element, one after another.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.2, Global Algorithm, steps 1 to 6.
/// Departures:
///  - Also stops once the worst element that has a movable node has the target quality.
///  - A cluster whose worst quality would rise by less than a fraction `leastGain` stays as it was:
///    its worst element is then KWORST again, and step 2 makes its nodes non-movable. Without this,
///    two neighbours may exchange ever smaller gains without end.
///  - Non-movable from the start are boundary nodes, nodes of kept facets and edges, and the
///    user's.
///  - If the metric or size field varies, the metric of an element is frozen while its cluster is
///    solved. Then the field is sampled at the new places of the nodes. The move is undone unless
///    the worst quality of the cluster has really risen.
#ifndef meshopt_Paper1996_GlobalAlgorithm_h
#define meshopt_Paper1996_GlobalAlgorithm_h

#include "Paper1996/LocalAlgorithm.h"
#include "Paper1996/MeasuredMesh.h"

#include <functional>

namespace meshopt
{
struct RepositionParameters
{
  int neighborhoodLevel = 1;          ///< NL
  long maximumNumberOfIterations = 0; ///< M; 0: no limit
  double target = 1.0;                ///< elements of at least this quality are left alone
  double leastGain = 1e-3;            ///< of one cluster, as a fraction of its quality
  LocalParameters local;
};

struct RepositionResult
{
  long tried = 0, done = 0; ///< local solves, and those that gained
  bool limitReached = false;
};

/// Called before every iteration with the quality of the worst element; false cancels.
using KeepGoing = std::function<bool(double worst)>;

/// Runs the global algorithm. Appends each KWORST to `sequence` if given: tests compare it with the
/// six steps, since an element that only loses its nodes in step 2 leaves no other trace.
template <int D>
RepositionResult reposition(const MeasuredMesh<D>& mesh, const RepositionParameters& parameters,
  const KeepGoing& keepGoing, std::vector<Index>* sequence = nullptr);

extern template RepositionResult reposition<2>(
  const MeasuredMesh<2>&, const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
extern template RepositionResult reposition<3>(
  const MeasuredMesh<3>&, const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
}

#endif
