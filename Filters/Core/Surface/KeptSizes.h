// SPDX-License-Identifier: BSD-3-Clause
/// @file KeptSizes.h
/// Which sizes can be had where edges must stay as they are.
#ifndef meshopt_Surface_KeptSizes_h
#define meshopt_Surface_KeptSizes_h

#include "Metric/NodalMetric.h"
#include "Surface/Surface.h"

#include <memory>

namespace meshopt
{
/// The least size that can be had beside the edges of a plane mesh that must stay: kept ones, but those
/// that `surface` (null: none) lets be divided. `longest`: the longest of them, in the length wanted
/// there. Null where that is at most 2: then what is wanted can be had. In space always null: there is
/// no such floor yet, and `longest` stays as it is.
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
