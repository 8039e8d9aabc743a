// SPDX-License-Identifier: BSD-3-Clause
/// @file LineNetwork.h
/// Lines in the plane, their corners, and the chains of lines from corner to corner.
#ifndef meshopt_Surface_LineNetwork_h
#define meshopt_Surface_LineNetwork_h

#include "Mesh/SimplexMesh.h"

#include <vector>

namespace meshopt
{
/// Lines in the plane: the geometry that a boundary is to follow.
struct LineNetwork
{
  std::vector<Vec<2>> points;
  std::vector<std::array<Index, 2>> lines;
  std::vector<std::uint8_t> corners; ///< nonzero: the point is a corner; one per point, or empty
};

/// The lines from a corner to the next one, or a closed line; points by their ids.
struct LineChain
{
  std::vector<Index> points;
  bool isClosed = false;
};

/// All kept facets of the mesh, each once; points have the ids of the mesh, those that the caller
/// fixed are corners.
LineNetwork keptLines(const SimplexMesh<2>& mesh);

/// Marks the points where not exactly two lines meet, where they turn by more than cornerAngle (degrees,
/// taken as 179 if it is more), and where one line has next to no length.
void markCorners(LineNetwork& network, double cornerAngle);

/// Marks the points where the line turns by more than 10 degrees while it does not at the neighbours:
/// those are no samples of a curve, but corners that are not very sharp.
void markKinks(LineNetwork& network);

/// Every line is in one chain; those that begin at corners come first, by the ids of their points.
std::vector<LineChain> chains(const LineNetwork& network);
}

#endif
