// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeSplit.h
/// Divides an edge by a new node; also an edge of the surface, where that may be remeshed.
#ifndef meshopt_Operations_EdgeSplit_h
#define meshopt_Operations_EdgeSplit_h

#include "Edit/Proposal.h"
#include "Surface/Surface.h"

namespace meshopt
{
/// An edge of a cell, and the new point that divides it.
struct EdgeDivision
{
  Index cell;
  Index first, second; ///< ends of the edge
  Index middle;
};

/// Proposes that all cells around an edge are divided by a new point on it. Topology only: the
/// judge decides whether the result is good. False if the edge must stay: if it is kept and
/// `surface` does not let it be divided (null: never), or if the editor does not own one of the
/// cells. The cost is proportional to the number of cells around the edge.
template <int D>
bool proposeSplit(const MeshEditor<D>& editor, const Surface<D>* surface,
  const EdgeDivision& division, Proposal<D>& proposal);

extern template bool proposeSplit<2>(
  const MeshEditor<2>&, const Surface<2>*, const EdgeDivision&, Proposal<2>&);
extern template bool proposeSplit<3>(
  const MeshEditor<3>&, const Surface<3>*, const EdgeDivision&, Proposal<3>&);
}

#endif
