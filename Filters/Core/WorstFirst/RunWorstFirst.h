// SPDX-License-Identifier: BSD-3-Clause
/// @file RunWorstFirst.h
/// The fast engine for one shape measure, declared apart from its code, which few files instantiate.
#ifndef meshopt_WorstFirst_RunWorstFirst_h
#define meshopt_WorstFirst_RunWorstFirst_h

#include "Run/Run.h"

namespace meshopt
{
template <int D, class Shape>
void runWorstFirst(Run<D>& run);
}

#endif
