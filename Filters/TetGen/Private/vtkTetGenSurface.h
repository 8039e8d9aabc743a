// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface in the form that TetGen needs. All its errors are described in terms of the input.
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
 * Triangles of a vtkPolyData. Points that no triangle uses are left out: TetGen would treat them as
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
 * (vtkTriangleFilter); vertices and lines are not part of a surface. Returns an error, or "".
 */
std::string ReadSurface(vtkPolyData* input, Surface& surface);

/**
 * Whether the surface can be filled. Finds points that are not finite or coincide, triangles
 * without area, duplicate triangles, open edges. Edges with three or more triangles are allowed:
 * inner walls have them. O(n log n). Returns an error that says where, or "".
 */
std::string CheckSurface(const Surface& surface);

/**
 * Marks those of `points` (three numbers each) that are farther from the surface than 1e-8 of its
 * size. TetGen would cut a triangle at a point on it, even if the surface is to be kept.
 */
std::vector<double> PointsOffSurface(const Surface& surface, const std::vector<double>& points);

/**
 * The place of a triangle: "cell 7 (points 1, 2, 3 around (x, y, z))", with ids of the input.
 */
std::string DescribeTriangle(const Surface& surface, int triangle);

/**
 * The pairs of triangles in TetGen's output of a test for intersections, each once, sorted.
 */
std::vector<std::pair<int, int>> ParseIntersections(const std::string& text);

/**
 * "The surface intersects itself ...", with the number of pairs (at least one) and the first pairs.
 */
std::string DescribeIntersections(
  const Surface& surface, const std::vector<std::pair<int, int>>& pairs);

/**
 * The first triangle of the surface that is not a face of a tetrahedron, or -1. O(n log n).
 */
int FindLostTriangle(const Surface& surface, const std::vector<int>& tetrahedra);

} // namespace vtkTetGenBridge

#endif
