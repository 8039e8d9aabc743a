// SPDX-License-Identifier: BSD-3-Clause
// Part 0 of the engine: see Parts.h.
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template class Improver<2, MeanEdgeShape<2>>;
template class Improver<3, MeanEdgeShape<3>>;
template bool runPart<2, 0>(Run<2>&);
template bool runPart<3, 0>(Run<3>&);
}
