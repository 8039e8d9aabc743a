// SPDX-License-Identifier: BSD-3-Clause
#include "WorstFirst/Schedule.h"

namespace meshopt
{
MESHOPT_INSTANTIATE_WORST_FIRST(RadiusRatioShape)
MESHOPT_INSTANTIATE_WORST_FIRST(MeanRatioShape)
}
