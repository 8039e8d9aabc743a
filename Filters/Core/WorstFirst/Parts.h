// SPDX-License-Identifier: BSD-3-Clause
/// @file Parts.h
/// The fast engine is compiled in parts, in parallel: each part serves one functor.
#ifndef meshopt_WorstFirst_Parts_h
#define meshopt_WorstFirst_Parts_h

#include "Run/Run.h"

namespace meshopt
{
/// Runs the engine with a functor that dispatchOptimizable() gives. Defined in Schedule.h,
/// instantiated in PartMeanEdge.cpp, PartVolumeLength.cpp and PartAny.cpp.
template <int D, class Shape>
void optimizeWith(Run<D>& run, const Shape& shape);
}

#endif
