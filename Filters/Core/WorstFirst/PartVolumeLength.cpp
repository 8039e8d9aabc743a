// SPDX-License-Identifier: BSD-3-Clause
// The engine for the measure VolumeLength: see Parts.h.
#include "WorstFirst/Schedule.h"

namespace meshopt
{
template void optimizeWith(Run<2>&, const VolumeLengthShape<2>&);
template void optimizeWith(Run<3>&, const VolumeLengthShape<3>&);
}
