// SPDX-License-Identifier: BSD-3-Clause
/// @file Parallel.h
/// Loops over ranges whose result does not depend on the number of threads.
#ifndef meshopt_Thermoelastic_Parallel_h
#define meshopt_Thermoelastic_Parallel_h

#include "Base/Control.h"
#include "Mesh/Types.h"

#include <algorithm>

namespace meshopt::fem
{
/// Calls body(begin, end) for parts of [0, n) on the caller's threads. The parts depend on n only.
/// A body must not write anything that another part reads or writes.
template <class Body>
void parallelRanges(const Control& control, Index n, const Body& body)
{
  // Enough parts to keep many threads busy, and none so short that sharing it out costs more.
  constexpr Index MostParts = 64, LeastLength = 512;
  const Index parts = std::max<Index>(1, std::min(MostParts, n / LeastLength));
  const auto part = [&](int i)
  {
    // In 64 bits, since the products may exceed an Index.
    const Index begin = static_cast<Index>(std::int64_t(n) * i / parts);
    const Index end = static_cast<Index>(std::int64_t(n) * (i + 1) / parts);
    body(begin, end);
  };
  if (control.parallelFor && parts > 1)
  {
    control.parallelFor(parts, part);
    return;
  }
  for (int i = 0; i < parts; ++i)
  {
    part(i);
  }
}
}

#endif
