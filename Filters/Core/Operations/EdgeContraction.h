// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeContraction.h
/// Contracts an edge: a node vanishes, and its neighbour takes its place in all cells. Also on the
/// surface, where that may be remeshed.
#ifndef meshopt_Operations_EdgeContraction_h
#define meshopt_Operations_EdgeContraction_h

#include "Edit/Proposal.h"
#include "Surface/Surface.h"

namespace meshopt
{
/// Proposes that point v vanishes and its neighbour u takes its place. Topology only: the judge
/// decides whether the result is good. False if v must stay: if it is not free and `surface` does
/// not let it join u (null: never), or if the editor does not own one of its cells. The cost is
/// proportional to the star of v.
template <int D>
bool proposeContraction(
  MeshEditor<D>& editor, const Surface<D>* surface, Index v, Index u, Proposal<D>& proposal);

extern template bool proposeContraction<2>(
  MeshEditor<2>&, const Surface<2>*, Index, Index, Proposal<2>&);
extern template bool proposeContraction<3>(
  MeshEditor<3>&, const Surface<3>*, Index, Index, Proposal<3>&);
}

#endif
