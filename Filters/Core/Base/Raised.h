// SPDX-License-Identifier: BSD-3-Clause
/// @file Raised.h
/// A quality that is clearly above another one.
#ifndef meshopt_Base_Raised_h
#define meshopt_Base_Raised_h

#include <algorithm>
#include <cmath>

namespace meshopt
{
/// q, raised by a part of its size. Qualities of inverted cells are negative: these rise, too. By
/// 1e-20 at least: from 1e-300 it would be a long way up.
inline double raised(double q, double part) { return q + std::max(part * std::fabs(q), 1e-20); }
}

#endif
