// SPDX-License-Identifier: BSD-3-Clause
/// @file Reconnection.h
/// Reconnection of a whole mesh: node and edge clusters around the worst element are emptied and
/// filled again.
///
/// Reference: Buscaglia, Dari, Zavattieri (1996), section 2.3 and figure 1 (the details are in its
/// [7]).
///
/// Candidates are the worst element and all elements that share a node or an edge with it; each
/// brings the clusters of its edges and of its nodes. A cluster is tried *virtually* with every
/// apex. The first filling whose worst element is better than the present worst of the cluster is
/// *really* made:
///  - edge cluster, a node of its ring: the edge is removed (2D: swap);
///  - edge cluster, the midpoint of the edge: the edge is bisected (2D: split);
///  - node cluster, a node of its boundary: the node is contracted into that one (2D: vertex
///    removal);
///  - node cluster, its centre: the node moves to the mean of the cluster's boundary vertices.
/// Clusters at the surface, or at facets between regions, are treated in the same way. These facets
/// are part of their boundary: they are kept bit for bit, and a node or edge on them stays. Their
/// edge clusters then include the exchange of two elements for three, and the centre of their node
/// clusters is a new node.
///
/// What the paper leaves open, and how it is decided here:
///  - A filling is better if its worst quality is above that of the cluster by more than a fraction
///    1e-3, and if it has no more elements of zero or negative quality. So the sorted vector of
///    qualities rises lexicographically, and the iteration ends.
///  - The order of candidates: worst element, those that share an edge with it, those that share a
///    node; each group by (quality, id). Only elements under the target are candidates. For the
///    order of fillings see ElementClusters::forEach().
///  - A cluster is tried only for its worst element. For its other elements it would fail: their
///    turn comes after the worst element's, when the cluster has been tried and has not changed
///    since.
///  - A worst element that no cluster improves is set aside, and the next worst is taken. It
///    returns when anything around one of its nodes has changed. The iteration ends when all
///    elements under the target are set aside.
///  - In a metric that varies, the field is sampled at a moved or new node before the filling is
///    judged.
#ifndef meshopt_Paper1996_Reconnection_h
#define meshopt_Paper1996_Reconnection_h

#include "Edit/Growth.h"
#include "Paper1996/Filling.h"
#include "Paper1996/MeasuredMesh.h"
#include "Quality/ElementQuality.h"

#include <array>
#include <functional>

namespace meshopt
{
struct ReconnectionParameters
{
  double target = 1.0;     ///< elements of at least this quality are left alone
  double leastGain = 1e-3; ///< of the worst quality of a cluster, as a fraction of it
  std::array<bool, NumberOfFillings> allowed{ true, true, true, true, true, true };
  /// When all elements are set aside, this many of the worst get a look-ahead (FillingLookAhead.h).
  /// The iteration continues if one of them gains. 0: none, as in the paper.
  int lookAhead = 0;
  /// Net number of cells that may be added; the look-ahead ignores it.
  long growth = AnyGrowth;
};

struct ReconnectionResult
{
  /// By Filling: fillings tried virtually, and really made.
  std::array<long, NumberOfFillings> tried{}, done{};
  long aheadTried = 0, aheadDone = 0; ///< fillings tried, and kept, by the look-ahead
  long growth = 0;                    ///< net number of cells added, without the look-ahead
};

/// Runs the iteration of section 2.3. `keepGoing` is called before every iteration with the quality
/// of the worst element that is not set aside, and before every look-ahead with that of its
/// element; false cancels.
template <int D>
ReconnectionResult reconnect(const MeasuredMesh<D>& mesh, const ReconnectionParameters& parameters,
  ReconnectionMemory<D>& memory, const std::function<bool(double)>& keepGoing);

extern template ReconnectionResult reconnect<2>(const MeasuredMesh<2>&,
  const ReconnectionParameters&, ReconnectionMemory<2>&, const std::function<bool(double)>&);
extern template ReconnectionResult reconnect<3>(const MeasuredMesh<3>&,
  const ReconnectionParameters&, ReconnectionMemory<3>&, const std::function<bool(double)>&);
}

#endif
