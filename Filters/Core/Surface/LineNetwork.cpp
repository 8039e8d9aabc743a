// SPDX-License-Identifier: BSD-3-Clause
// Lines in the plane, divided into chains at corners. A corner is found by its angle, or because
// its neighbours do not turn.
#include "Surface/LineNetwork.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// A line shorter than this fraction of the next one has no direction: its ends are corners.
constexpr double NoLength = 1e-9;
/// Degrees. A line that turns by more goes back, as at the tip of a slit: always a corner.
constexpr double TurnsBack = 179.0;

/// LeastKink, in radians: a smaller turn counts as smooth. KinkShare: if two neighbours are both on
/// a curve, each turns at least by this fraction of the other's turn.
constexpr double LeastKink = 0.17, KinkShare = 0.25;

using Lines = std::vector<std::vector<Index>>;

/// The lines at each point.
Lines linesOfPoints(const LineNetwork& network)
{
  Lines lines(network.points.size());
  for (std::size_t l = 0; l < network.lines.size(); ++l)
  {
    for (Index p : network.lines[l])
    {
      lines[p].push_back(static_cast<Index>(l));
    }
  }
  return lines;
}

Index otherEnd(const LineNetwork& network, Index line, Index p)
{
  const std::array<Index, 2>& l = network.lines[line];
  return l[0] == p ? l[1] : l[0];
}

}

/// All kept facets of the mesh, each once.
LineNetwork keptLines(const SimplexMesh<2>& mesh)
{
  LineNetwork result;
  result.points.resize(mesh.numberOfPointSlots());
  result.corners.assign(mesh.numberOfPointSlots(), 0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    result.points[p] = mesh.point(p);
    result.corners[p] = (mesh.pointData(p).flags & SimplexMesh<2>::PointFixedByUser) != 0;
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 3 && mesh.isAlive(c); ++i)
    {
      const Index h = mesh.adjacent(c, i);
      // From the cell with the lower number.
      if (mesh.isKept(c, i) && (h == None || mesh.cellOf(h) > c))
      {
        result.lines.push_back(mesh.facet(c, i));
      }
    }
  }
  return result;
}

/// By angle and by the number of lines. Corners of the caller stay corners.
void markCorners(LineNetwork& network, double cornerAngle)
{
  const Lines lines = linesOfPoints(network);
  network.corners.resize(network.points.size(), 0);
  const double limit = std::cos(std::min(cornerAngle, TurnsBack) * std::acos(-1.0) / 180.0);
  for (std::size_t p = 0; p < lines.size(); ++p)
  {
    if (lines[p].empty())
    {
      continue;
    }
    // Where lines end or more than two meet.
    bool isCorner = lines[p].size() != 2;
    if (!isCorner)
    {
      const Index id = static_cast<Index>(p);
      const Vec<2> in = network.points[p] - network.points[otherEnd(network, lines[p][0], id)];
      const Vec<2> out = network.points[otherEnd(network, lines[p][1], id)] - network.points[p];
      const double a = in.norm(), b = out.norm();
      isCorner = !(in.dot(out) >= limit * a * b) || std::min(a, b) <= NoLength * std::max(a, b);
    }
    network.corners[p] = network.corners[p] || isCorner;
  }
}

/// From corner to corner; then what is left, which is closed.
std::vector<LineChain> chains(const LineNetwork& network)
{
  const Lines lines = linesOfPoints(network);
  std::vector<char> seen(network.lines.size(), 0);
  std::vector<LineChain> result;
  const auto follow = [&](Index start, Index line)
  {
    LineChain chain;
    chain.points.push_back(start);
    for (Index p = start; !seen[line];)
    {
      seen[line] = 1;
      p = otherEnd(network, line, p);
      chain.points.push_back(p);
      if (network.corners[p] || p == start)
      {
        break;
      }
      // No corner, so exactly two lines meet here.
      line = lines[p][0] == line ? lines[p][1] : lines[p][0];
    }
    if (!network.corners[start]) // closed: back at the start
    {
      chain.isClosed = true;
      chain.points.pop_back();
    }
    result.push_back(std::move(chain));
  };
  // First the open chains, from their corners. All lines left over belong to closed chains.
  for (const bool fromCorners : { true, false })
  {
    for (std::size_t p = 0; p < lines.size(); ++p)
    {
      for (Index line : lines[p])
      {
        if (!seen[line] && (network.corners[p] != 0) == fromCorners)
        {
          follow(static_cast<Index>(p), line);
        }
      }
    }
  }
  return result;
}

/// A point where the line turns, between neighbours where it does not, is not a sample of a curve:
/// it is a corner, if not a sharp one.
void markKinks(LineNetwork& network)
{
  const Lines lines = linesOfPoints(network);
  // A copy: what is found here must not change what its neighbours are compared with.
  const std::vector<std::uint8_t> corners = network.corners;
  const auto next = [&](Index from, Index p) // None behind a corner
  {
    if (corners[p])
    {
      return None;
    }
    const Index a = otherEnd(network, lines[p][0], p);
    return a == from ? otherEnd(network, lines[p][1], p) : a;
  };
  const auto turn = [&](Index from, Index p, Index to)
  {
    if (to == None)
    {
      return 0.0;
    }
    const Vec<2> in = network.points[p] - network.points[from];
    const Vec<2> out = network.points[to] - network.points[p];
    return std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
  };
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    const Index p = static_cast<Index>(k);
    if (lines[k].size() != 2 || corners[k])
    {
      continue;
    }
    const Index a = otherEnd(network, lines[k][0], p), b = otherEnd(network, lines[k][1], p);
    const double here = turn(a, p, b);
    // Walked backwards from p, the turn at a has the other sign.
    const double before = -turn(p, a, next(p, a)), after = turn(p, b, next(p, b));
    network.corners[k] = std::fabs(here) > LeastKink && !(before / here > KinkShare) &&
      !(after / here > KinkShare);
  }
}
}
