// SPDX-License-Identifier: BSD-3-Clause
/// @file LineNetwork.h
/// Lines in the plane, their corners, and the chains of lines from corner to corner.
#ifndef meshopt_Surface_LineNetwork_h
#define meshopt_Surface_LineNetwork_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Lines in the plane: the geometry that a boundary follows.
struct LineNetwork
{
  std::vector<Vec<2>> points;
  std::vector<std::array<Index, 2>> lines;
  std::vector<std::uint8_t> corners; ///< nonzero: the point is a corner; one per point, or empty
  std::vector<std::int64_t> names;   ///< of points, for messages; empty: their numbers
};

/// The lines from one corner to the next, or a closed line; points by their ids.
struct LineChain
{
  std::vector<Index> points;
  bool isClosed = false;
};

/// All kept facets of the mesh, each once. Points have the ids of the mesh. Points that the caller
/// fixed are corners.
LineNetwork keptLines(const SimplexMesh<2>& mesh);

/// Marks as corners: points where not exactly two lines meet, points where the line turns by more
/// than cornerAngle (degrees; at most 179), and the ends of lines of almost no length.
void markCorners(LineNetwork& network, double cornerAngle);
/// With this angle corners are found by the number of lines only, and where the line turns back.
inline constexpr double TurnsNever = 180.0;

/// Marks the points where the line turns by more than 10 degrees while it does not at the
/// neighbours. These are not samples of a curve, but corners, if not sharp ones.
void markKinks(LineNetwork& network);

/// Divides the lines into chains; every line is in one. Chains that begin at corners come first.
/// The order is that of the point ids.
std::vector<LineChain> chains(const LineNetwork& network);
}

#endif
