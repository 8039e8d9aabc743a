// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/Schedule.h"

namespace meshopt
{
MESHOPT_INSTANTIATE_WORST_FIRST(MinimumSineShape)
MESHOPT_INSTANTIATE_WORST_FIRST(WarpedSineShape)
}
