// SPDX-License-Identifier: BSD-3-Clause
/// @file Parts.h
/// The fast engine is compiled in parts, side by side: each for some of the measures.
#ifndef meshopt_WorstFirst_Parts_h
#define meshopt_WorstFirst_Parts_h

#include "Run/Run.h"

namespace meshopt
{
inline constexpr int NumberOfParts = 3;

/// Runs the engine if the measure of the run is of this part: of the table of measures every third row,
/// from row Part on. False if it is not. Defined in Schedule.h, instantiated in Part0.cpp, ...
template <int D, int Part>
bool runPart(Run<D>& run);
}

#endif
