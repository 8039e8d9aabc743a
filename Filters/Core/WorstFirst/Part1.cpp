// SPDX-License-Identifier: BSD-3-Clause
// Part 1 of the engine: see Parts.h.
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template bool runPart<2, 1>(Run<2>&);
template bool runPart<3, 1>(Run<3>&);
}
