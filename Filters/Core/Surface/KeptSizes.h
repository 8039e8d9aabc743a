// SPDX-License-Identifier: BSD-3-Clause
/// @file KeptSizes.h
/// Which sizes can be had where edges must stay as they are.
#ifndef meshopt_Surface_KeptSizes_h
#define meshopt_Surface_KeptSizes_h

#include "Surface/BoundaryCurves.h"
#include "Metric/NodalMetric.h"

#include <memory>

namespace meshopt
{
/// The least size that can be had beside the edges of a plane mesh that must stay (on no piece of
/// `curves`; null: all kept ones). `longest`: the longest of them, in the length wanted there. Null where
/// that is at most 2: then what is wanted can be had.
std::shared_ptr<const SizeFloor<2>> keptSizeFloor(const SimplexMesh<2>& mesh,
  const NodalMetric<2>& metric, const BoundaryCurves* curves, double& longest);
}

#endif
