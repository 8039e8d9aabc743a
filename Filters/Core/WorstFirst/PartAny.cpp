// SPDX-License-Identifier: BSD-3-Clause
// The engine for all measures that share no edge lengths: see Parts.h.
#include "Quality/AnyShape.h"
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template void optimizeWith(Run<2>&, const AnyShape<2>&);
template void optimizeWith(Run<3>&, const AnyShape<3>&);
}
