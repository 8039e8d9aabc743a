// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeContraction.h
/// A node goes: its neighbour takes its place in all cells; also on the surface where that may be
/// remeshed.
#ifndef meshopt_Operations_EdgeContraction_h
#define meshopt_Operations_EdgeContraction_h

#include "Edit/Proposal.h"
#include "Surface/Surface.h"

namespace meshopt
{
/// Proposes that point v goes and its neighbour u takes its place. Topology only: whether the result
/// is any good is the judge's to see. False if v must stay: it is held and `surface` does not let it
/// join u (null: never), or one of its cells is not the editor's. The cost goes with the star of v.
template <int D>
bool proposeContraction(
  MeshEditor<D>& editor, const Surface<D>* surface, Index v, Index u, Proposal<D>& proposal);

extern template bool proposeContraction<2>(
  MeshEditor<2>&, const Surface<2>*, Index, Index, Proposal<2>&);
extern template bool proposeContraction<3>(
  MeshEditor<3>&, const Surface<3>*, Index, Index, Proposal<3>&);
}

#endif
