// SPDX-License-Identifier: BSD-3-Clause
/// @file Raised.h
/// A quality that is clearly above another one.
#ifndef meshopt_Base_Raised_h
#define meshopt_Base_Raised_h

#include <cmath>

namespace meshopt
{
/// q, raised by a part of its size. Qualities of inverted cells are negative: these rise, too.
inline double raised(double q, double part) { return q + part * std::fabs(q); }
}

#endif
