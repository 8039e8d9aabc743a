// SPDX-License-Identifier: BSD-3-Clause
// Part 2 of the engine: see Parts.h.
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template bool runPart<2, 2>(Run<2>&);
template bool runPart<3, 2>(Run<3>&);
}
