// SPDX-License-Identifier: BSD-3-Clause
// The engine for the paper's S: see Parts.h.
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template class Improver<2, MeanEdgeShape<2>>;
template class Improver<3, MeanEdgeShape<3>>;
template void optimizeWith(Run<2>&, const MeanEdgeShape<2>&);
template void optimizeWith(Run<3>&, const MeanEdgeShape<3>&);
}
