// SPDX-License-Identifier: BSD-3-Clause
// The unit of the benchmarks: one bare pass over tetrahedra, on one thread. No VTK.
#ifndef meshopt_Testing_BarePass_h
#define meshopt_Testing_BarePass_h

#include "Quality/Shape.h"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>
#include <vector>

struct BarePass
{
  double Seconds = std::numeric_limits<double>::infinity(); ///< processor time, the best of several
  double Minimum = std::numeric_limits<double>::infinity(); ///< worst S
};

/// Loads the four corners of each cell, computes S and stores it, `repeats` times. Coordinates x y
/// z of each point, four point ids of each cell.
inline BarePass measureBarePass(
  const std::vector<double>& x, const std::vector<std::int64_t>& ids, int repeats)
{
  std::vector<double> values(ids.size() / 4);
  BarePass pass;
  for (int k = 0; k < repeats; ++k)
  {
    const std::clock_t start = std::clock();
    for (std::size_t c = 0; c < values.size(); ++c)
    {
      meshopt::Corners<3> corners;
      for (int i = 0; i < 4; ++i)
      {
        const double* p = x.data() + 3 * ids[4 * c + i];
        corners[i] = meshopt::Vec<3>(p[0], p[1], p[2]);
      }
      values[c] = meshopt::MeanEdgeShape<3>::value(corners);
    }
    pass.Seconds = std::min(pass.Seconds, double(std::clock() - start) / CLOCKS_PER_SEC);
    pass.Minimum = *std::min_element(values.begin(), values.end());
  }
  return pass;
}

#endif
