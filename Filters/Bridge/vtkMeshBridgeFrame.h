// SPDX-License-Identifier: BSD-3-Clause
/**
 * Maps coordinates of a grid to those of the core, and back. In 3D they are the same; in 2D the
 * plane gets two axes.
 */
#ifndef vtkMeshBridgeFrame_h
#define vtkMeshBridgeFrame_h

#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeGridView.h"

#include "Mesh/Types.h"

#include <string>
#include <vector>

namespace vtkMeshBridge
{

template <int D>
struct Frame;

template <>
struct Frame<3>
{
  meshopt::Vec<3> ToCore(const double x[3]) const { return { x[0], x[1], x[2] }; }
  void ToGrid(const meshopt::Vec<3>& u, double x[3]) const
  {
    x[0] = u[0];
    x[1] = u[1];
    x[2] = u[2];
  }
  meshopt::Tensor<3> ToCore(const meshopt::Tensor<3>& m) const { return m; }
};

template <>
struct Frame<2>
{
  meshopt::Vec<3> Origin = meshopt::Vec<3>::Zero();
  meshopt::Vec<3> Axes[2] = { meshopt::Vec<3>::UnitX(), meshopt::Vec<3>::UnitY() };

  /// If the plane is parallel to two axes, these two coordinates are used unchanged, without
  /// rounding. Otherwise -1.
  int Direct[2] = { 0, 1 };

  meshopt::Vec<2> ToCore(const double x[3]) const
  {
    if (this->Direct[0] >= 0)
    {
      return { x[this->Direct[0]], x[this->Direct[1]] };
    }
    const meshopt::Vec<3> d = meshopt::Vec<3>(x[0], x[1], x[2]) - this->Origin;
    return { d.dot(this->Axes[0]), d.dot(this->Axes[1]) };
  }
  void ToGrid(const meshopt::Vec<2>& u, double x[3]) const;

  /// The part of the tensor in the plane.
  meshopt::Tensor<2> ToCore(const meshopt::Tensor<3>& m) const;
};

/**
 * The bounding box of the points of some cells. NaN changes nothing.
 */
struct Box
{
  meshopt::Vec<3> Low, High; ///< Low > High: no points

  Box();
  void Add(const meshopt::Vec<3>& x);
  double GetDiagonal() const { return (this->High - this->Low).norm(); }
  double GetMagnitude() const;
};

/**
 * A sentence if the box is so large or so small that cubed lengths leave the range of double
 * precision. An empty string otherwise, and also if it has no points or a bound is not finite.
 */
std::string CheckExtent(const Box& box);

/**
 * The plane of a set of triangles.
 */
struct Plane
{
  vtkMeshBridge::Frame<2> Frame;
  double Extent = 0.0;    ///< diagonal of the triangles' box
  double Tolerance = 0.0; ///< 1e-6 of Extent, plus the rounding error of the coordinate type
  double Farthest = 0.0;  ///< greatest distance of a point from the plane
  vtkIdType FarthestPoint = -1;

  bool HasAll() const { return this->Farthest <= this->Tolerance; }

  /// Whether this point is in the plane, up to the tolerance.
  bool Has(const meshopt::Vec<3>& x) const;
};

/**
 * Finds the plane of `triangles`: at least one, with existing, finite corners.
 *
 * The upper side is the one for which most of the area is positive. So a mesh that is numbered
 * clockwise about z stays so, and no mesh is inverted as a whole. If the plane is parallel to two
 * axes, their coordinates are used unchanged; z is the first candidate to be left out.
 */
Plane FindPlane(const GridView& grid, const std::vector<vtkIdType>& triangles);

/**
 * In 3D there is nothing to find; only the extent is checked.
 */
std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<3>& frame);

/**
 * The plane of all triangles. Returns a sentence if they are not in one plane.
 */
std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<2>& frame);

} // namespace vtkMeshBridge

#endif
