// SPDX-License-Identifier: BSD-3-Clause
/// @file KeptSizes.h
/// The sizes that can be reached beside edges that must stay as they are.
#ifndef meshopt_Surface_KeptSizes_h
#define meshopt_Surface_KeptSizes_h

#include "Metric/NodalMetric.h"
#include "Surface/Surface.h"

#include <memory>

namespace meshopt
{
/// The lowest sizes that can be reached beside edges of a plane mesh that must stay: kept edges,
/// except those that `surface` (null: none) allows to be divided. `longest`: the longest of these
/// edges, in units of the length wanted there. Null if that is at most 2: the wanted sizes can then
/// be reached. Always null in 3D: there is no such floor yet, and `longest` is not changed.
template <int D>
std::shared_ptr<const SizeFloor<D>> keptSizeFloor(const SimplexMesh<D>& mesh,
  const NodalMetric<D>& metric, const Surface<D>* surface, double& longest);

template <>
std::shared_ptr<const SizeFloor<2>> keptSizeFloor<2>(
  const SimplexMesh<2>&, const NodalMetric<2>&, const Surface<2>*, double&);
template <>
std::shared_ptr<const SizeFloor<3>> keptSizeFloor<3>(
  const SimplexMesh<3>&, const NodalMetric<3>&, const Surface<3>*, double&);
}

#endif
