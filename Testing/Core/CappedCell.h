// SPDX-License-Identifier: BSD-3-Clause
// The mesh that the surface caps for certain.
#ifndef meshopt_Testing_CappedCell_h
#define meshopt_Testing_CappedCell_h

#include "Bound/ApexBound.h"
#include "Mesh/SimplexMesh.h"

#include <limits>

namespace meshopt
{
/// One cell whose fourth node is the best there is for the facet of the others (facetCap()).
/// No mesh with that facet has a worst cell of higher shape. `height`: of the facet.
inline MeshInput<3> cellAtItsCap(double height = 0.3)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, height, 0 } };
  Vec<3> apex;
  facetCap(
    in.points[0], in.points[1], in.points[2], std::numeric_limits<double>::infinity(), &apex);
  in.points.push_back(apex);
  in.cells = { { 0, 1, 2, 3 } };
  return in;
}

/// The same, and a corner of a cube that shares nothing with it.
inline MeshInput<3> cappedCellAndCorner(double height = 0.3)
{
  MeshInput<3> in = cellAtItsCap(height);
  in.points.insert(in.points.end(), { { 9, 9, 9 }, { 10, 9, 9 }, { 9, 10, 9 }, { 9, 9, 10 } });
  in.cells.push_back({ 4, 5, 6, 7 });
  return in;
}
}

#endif
