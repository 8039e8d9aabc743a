// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface as TetGen wants it, and everything that is wrong with it said in terms of the input.
 */
#ifndef vtkTetGenSurface_h
#define vtkTetGenSurface_h

#include "vtkType.h"

#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace vtkTetGenBridge
{

/**
 * Triangles of a vtkPolyData. Points that no triangle uses are left out: TetGen would take them for
 * nodes wanted inside.
 */
struct Surface
{
  std::vector<double> Points;      ///< three numbers each
  std::vector<vtkIdType> PointIds; ///< of each of these points, its id in the input
  std::vector<int> Triangles;      ///< three indices into Points each
  std::vector<vtkIdType> CellIds;  ///< of each triangle, the cell of the input it comes from
};

/**
 * Reads triangles, polygons and strips of `input`. Polygons are cut into triangles
 * (vtkTriangleFilter); vertices and lines are no part of a surface. Returns an error, or "".
 */
std::string ReadSurface(vtkPolyData* input, Surface& surface);

/**
 * Is the surface one that can be filled? Finds points that are not finite or lie on each other,
 * triangles without area, triangles twice, open edges. Edges of three and more triangles are no
 * fault: inner walls have them. O(n log n). Returns an error that says where, or "".
 */
std::string CheckSurface(const Surface& surface);

/**
 * Which of `points` (three numbers each) lie away from the surface, by more than 1e-8 of its size?
 * TetGen would cut a triangle by a point on it, even where the surface is to be kept.
 */
std::vector<double> PointsOffSurface(const Surface& surface, const std::vector<double>& points);

/**
 * Where a triangle is: "cell 7 (points 1, 2, 3 around (x, y, z))", ids being those of the input.
 */
std::string DescribeTriangle(const Surface& surface, int triangle);

/**
 * The pairs of triangles in what TetGen prints when asked for intersections, each once, sorted.
 */
std::vector<std::pair<int, int>> ParseIntersections(const std::string& text);

/**
 * "The surface intersects itself ...", with the number of pairs, of which there is one at least,
 * and the first ones.
 */
std::string DescribeIntersections(
  const Surface& surface, const std::vector<std::pair<int, int>>& pairs);

/**
 * The first triangle of the surface that is not a face of a tetrahedron, or -1. O(n log n).
 */
int FindLostTriangle(const Surface& surface, const std::vector<int>& tetrahedra);

} // namespace vtkTetGenBridge

#endif
