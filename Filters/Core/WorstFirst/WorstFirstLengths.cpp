// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/Schedule.h"

namespace meshopt
{
MESHOPT_INSTANTIATE_WORST_FIRST(MeanEdgeShape)
MESHOPT_INSTANTIATE_WORST_FIRST(VolumeLengthShape)
}
