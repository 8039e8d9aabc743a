// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/RoomLimit.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace meshopt
{
namespace
{
/// How far motions straight along the way may go.
struct RoomAlong
{
  Vec<3> unit; ///< the way, of length 1
  double distance;
  std::size_t number;
  bool bothWays;
};

/// Whether all motions of at most this length that are within the one limit are within the other.
bool implies(const RoomAlong& one, const RoomAlong& other, double length)
{
  if (other.bothWays && !one.bothWays)
  {
    return false;
  }
  constexpr double slack = 1e-12; // rounding
  const double cosine = one.unit.dot(other.unit), most = (1.0 - slack) * other.distance;
  // The farthest point along the other way is one of the ball of all motions, or of the circle in
  // which the one limit cuts it.
  const double rest = most - one.distance * cosine;
  const double squared = (length * length - one.distance * one.distance) * (1.0 - cosine * cosine);
  return length * cosine <= one.distance ? length <= most : rest >= 0.0 && squared <= rest * rest;
}
}

void keepBinding(double length, std::vector<RoomLimit>& limits)
{
  std::vector<RoomAlong> all, kept;
  for (const RoomLimit& limit : limits)
  {
    const double norm = limit.way.norm();
    all.push_back({ limit.way / norm, limit.most / norm, all.size(), limit.bothWays });
  }
  // Those that allow least imply most. Of equals the first, so that no library matters.
  std::sort(all.begin(), all.end(),
    [](const RoomAlong& a, const RoomAlong& b)
    { return a.distance != b.distance ? a.distance < b.distance : a.number < b.number; });
  std::vector<RoomLimit> binding;
  for (const RoomAlong& reach : all)
  {
    if (std::none_of(
          kept.begin(), kept.end(), [&](const RoomAlong& k) { return implies(k, reach, length); }))
    {
      kept.push_back(reach);
      binding.push_back(limits[reach.number]);
    }
  }
  limits = std::move(binding);
}
}
