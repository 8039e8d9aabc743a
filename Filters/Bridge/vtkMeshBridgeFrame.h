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
 * A sentence if the box is so large or so small that products of powers of lengths leave the range
 * of double precision. An empty string otherwise, and also if it has no points or a bound is not
 * finite.
 */
std::string CheckExtent(const Box& box);

/**
 * The plane of a set of triangles.
 */
struct Plane
{
  vtkMeshBridge::Frame<2> Frame;
  meshopt::Vec<3> Normal = meshopt::Vec<3>::UnitZ(); ///< of a plane that is not direct
  double Extent = 0.0;                               ///< diagonal of the triangles' box
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
 * The same in steps, for triangles of which each process has a part. Between the steps Merge()
 * makes the facts of all parts one, in an order that is the same everywhere.
 */
struct PlaneFacts
{
  Box Bounds;
  meshopt::Vec<3> Largest = meshopt::Vec<3>::Zero(); ///< area vector of the largest triangle
  meshopt::Vec<3> Point = meshopt::Vec<3>::Zero();   ///< a corner of the first triangle
  double Precision = 0.0;                            ///< of the coordinates
  /// Sums of the area vectors that point to the side of `Largest`, and of the others.
  meshopt::Vec<3> Sum = meshopt::Vec<3>::Zero(), Turned = meshopt::Vec<3>::Zero();

  bool IsEmpty() const { return !(this->Bounds.Low[0] <= this->Bounds.High[0]); }
  /// With the facts of another part: after the first step, and after the second.
  void Merge(const PlaneFacts& other);
};
/// The first step: all but the sums. There may be no triangles.
PlaneFacts FindPlaneFacts(const GridView& grid, const std::vector<vtkIdType>& triangles);
/// The second step, with `Largest` of all parts: the sums of this part.
void AddAreas(const GridView& grid, const std::vector<vtkIdType>& triangles, PlaneFacts& facts);
/// The plane of facts that are not empty. Which point is the farthest is the last step.
Plane MakePlane(const PlaneFacts& facts);
void FindFarthest(const GridView& grid, const std::vector<vtkIdType>& triangles, Plane& plane);

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
