// SPDX-License-Identifier: BSD-3-Clause
/// @file Parts.h
/// The fast engine is compiled in parts, in parallel: each part serves some of the measures.
#ifndef meshopt_WorstFirst_Parts_h
#define meshopt_WorstFirst_Parts_h

#include "Run/Run.h"

namespace meshopt
{
inline constexpr int NumberOfParts = 3;

/// Runs the engine if the run's measure belongs to this part: every third row of the table of
/// measures, starting at row Part. Returns false if it does not. Defined in Schedule.h,
/// instantiated in Part0.cpp, Part1.cpp and Part2.cpp.
template <int D, int Part>
bool runPart(Run<D>& run);
}

#endif
