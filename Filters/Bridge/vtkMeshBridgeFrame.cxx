// SPDX-License-Identifier: BSD-3-Clause
// The plane of triangles, and how their coordinates get into it and back. A plane parallel to two
// axes only leaves out a coordinate, and so does not round; a tilted one turns, and rounds.
#include "vtkMeshBridgeFrame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace vtkMeshBridge
{

using meshopt::Tensor;
using meshopt::Vec;

//------------------------------------------------------------------------------
void Frame<2>::ToGrid(const Vec<2>& u, double x[3]) const
{
  // No arithmetic: coordinates come out as they went in, bit for bit.
  if (this->Direct[0] >= 0)
  {
    // The numbers of the three axes add up to 3.
    const int third = 3 - this->Direct[0] - this->Direct[1];
    x[this->Direct[0]] = u[0];
    x[this->Direct[1]] = u[1];
    x[third] = this->Origin[third];
    return;
  }
  const Vec<3> y = this->Origin + u[0] * this->Axes[0] + u[1] * this->Axes[1];
  x[0] = y[0];
  x[1] = y[1];
  x[2] = y[2];
}

Tensor<2> Frame<2>::ToCore(const Tensor<3>& m) const
{
  Tensor<2> inPlane;
  for (int i = 0; i < 2; ++i)
  {
    for (int j = 0; j < 2; ++j)
    {
      inPlane(i, j) = this->Axes[i].dot(m * this->Axes[j]);
    }
  }
  return inPlane;
}

//------------------------------------------------------------------------------
Box::Box()
  : Low(Vec<3>::Constant(std::numeric_limits<double>::infinity()))
  , High(-this->Low)
{
}

void Box::Add(const Vec<3>& x)
{
  // Comparisons with NaN are false, so that it does not get into the box; CheckExtent() is about
  // range only.
  for (int i = 0; i < 3; ++i)
  {
    this->Low[i] = std::min(this->Low[i], x[i]);
    this->High[i] = std::max(this->High[i], x[i]);
  }
}

double Box::GetMagnitude() const
{
  return std::max(this->Low.cwiseAbs().maxCoeff(), this->High.cwiseAbs().maxCoeff());
}

std::string CheckExtent(const Box& box)
{
  // Lengths are raised to the third power, and products of two of these must stay in range.
  constexpr double least = 1e-50, most = 1e50;
  const double extent = (box.High - box.Low).maxCoeff();
  const double magnitude = box.GetMagnitude();
  const bool isLarge = magnitude > most, isSmall = extent > 0.0 && extent < least;
  if (!std::isfinite(magnitude) || !std::isfinite(extent) || (!isLarge && !isSmall))
  {
    return {};
  }
  std::ostringstream text;
  text << "The coordinates are too " << (isLarge ? "large (up to " : "small (extent ")
       << (isLarge ? magnitude : extent)
       << "): products of their powers leave the range of double precision. Scale the mesh to "
          "lengths "
          "between 1e-50 and 1e50.";
  return text.str();
}

//------------------------------------------------------------------------------
namespace
{

using TrianglePoints = std::array<vtkIdType, 3>;

TrianglePoints PointsOf(const GridView& grid, vtkIdType triangle)
{
  TrianglePoints ids{};
  grid.GetCorners(triangle, 3, ids.data());
  return ids;
}

Box FindBox(const GridView& grid, const std::vector<vtkIdType>& cells, int corners)
{
  Box box;
  for (vtkIdType cell : cells)
  {
    vtkIdType ids[4] = {};
    grid.GetCorners(cell, corners, ids);
    std::for_each(ids, ids + corners, [&](vtkIdType p) { box.Add(grid.GetPoint(p)); });
  }
  return box;
}

Vec<3> AreaVector(const GridView& grid, vtkIdType triangle)
{
  const TrianglePoints ids = PointsOf(grid, triangle);
  const Vec<3> a = grid.GetPoint(ids[0]), b = grid.GetPoint(ids[1]), c = grid.GetPoint(ids[2]);
  return 0.5 * Vec<3>(b - a).cross(Vec<3>(c - a));
}

/**
 * The sum of all area vectors, after those that point backwards are reversed. Its sign is such that
 * the reversed part is the smaller one. Zero only if no triangle has an area.
 */
Vec<3> FindNormal(const PlaneFacts& facts)
{
  const Vec<3> normal = facts.Sum - facts.Turned;
  return facts.Turned.squaredNorm() > facts.Sum.squaredNorm() ? Vec<3>(-normal) : normal;
}

/**
 * The coordinate that is the same for all points, or -1; z is preferred.
 */
int FindConstantCoordinate(const Box& box)
{
  for (int i = 2; i >= 0; --i)
  {
    if (box.Low[i] == box.High[i])
    {
      return i;
    }
  }
  return -1;
}

/**
 * `positive`: the normal points along the constant axis. The order of the other two is such that
 * triangles with this normal are positive.
 */
Frame<2> MakeDirect(const Box& box, int constant, bool positive)
{
  // Origin and axes along coordinates: ToCore() only picks two of them.
  Frame<2> frame;
  frame.Origin[constant] = box.Low[constant];
  const int first = (constant + 1) % 3, second = (constant + 2) % 3;
  frame.Direct[0] = positive ? first : second;
  frame.Direct[1] = positive ? second : first;
  frame.Axes[0] = Vec<3>::Unit(frame.Direct[0]);
  frame.Axes[1] = Vec<3>::Unit(frame.Direct[1]);
  return frame;
}

/**
 * `x` is a point of the plane, `middle` a point near it.
 */
Frame<2> MakeTilted(const Vec<3>& middle, const Vec<3>& x, const Vec<3>& normal)
{
  // -1: no coordinate can be taken over directly.
  Frame<2> frame;
  frame.Direct[0] = frame.Direct[1] = -1;
  frame.Origin = middle;
  frame.Origin += normal * normal.dot(x - frame.Origin);
  frame.Axes[0] = normal.unitOrthogonal();
  frame.Axes[1] = normal.cross(frame.Axes[0]);
  return frame;
}

double DistanceOf(const Frame<2>& frame, const Vec<3>& x)
{
  return std::abs(frame.Axes[0].cross(frame.Axes[1]).dot(x - frame.Origin));
}

Plane FindPlane(const GridView& grid, const std::vector<vtkIdType>& triangles, const Box& box)
{
  PlaneFacts facts = FindPlaneFacts(grid, triangles);
  facts.Bounds = box;
  AddAreas(grid, triangles, facts);
  Plane plane = MakePlane(facts);
  FindFarthest(grid, triangles, plane);
  return plane;
}

} // namespace

//------------------------------------------------------------------------------
void PlaneFacts::Merge(const PlaneFacts& other)
{
  // The first point in the order of merging, the same on all ranks.
  if (!other.IsEmpty())
  {
    this->Point = this->IsEmpty() ? other.Point : this->Point;
    this->Bounds.Add(other.Bounds.Low);
    this->Bounds.Add(other.Bounds.High);
  }
  if (other.Largest.squaredNorm() > this->Largest.squaredNorm())
  {
    // The direction of the largest triangle of all decides which others are turned.
    this->Largest = other.Largest;
  }
  this->Precision = std::max(this->Precision, other.Precision);
  this->Sum += other.Sum;
  this->Turned += other.Turned;
}

PlaneFacts FindPlaneFacts(const GridView& grid, const std::vector<vtkIdType>& triangles)
{
  PlaneFacts facts;
  if (triangles.empty())
  {
    return facts;
  }
  facts.Bounds = FindBox(grid, triangles, 3);
  facts.Point = grid.GetPoint(PointsOf(grid, triangles.front())[0]);
  facts.Precision = grid.GetPrecision();
  for (vtkIdType triangle : triangles)
  {
    const Vec<3> area = AreaVector(grid, triangle);
    if (area.squaredNorm() > facts.Largest.squaredNorm())
    {
      facts.Largest = area;
    }
  }
  return facts;
}

void AddAreas(const GridView& grid, const std::vector<vtkIdType>& triangles, PlaneFacts& facts)
{
  facts.Sum = facts.Turned = Vec<3>::Zero();
  for (vtkIdType triangle : triangles)
  {
    // Triangles may be numbered either way: each counts on one side.
    const Vec<3> area = AreaVector(grid, triangle);
    (area.dot(facts.Largest) < 0.0 ? facts.Turned : facts.Sum) += area;
  }
}

Plane MakePlane(const PlaneFacts& facts)
{
  const Box& box = facts.Bounds;
  Plane plane;
  plane.Extent = box.GetDiagonal();
  // Far from the origin, and as floats, coordinates are less exact than the extent alone tells.
  plane.Tolerance = 1e-6 * plane.Extent + 4.0 * facts.Precision * box.GetMagnitude();
  Vec<3> normal = FindNormal(facts);
  const int constant = FindConstantCoordinate(box);
  if (constant >= 0)
  {
    // Also a normal that is 0 or not a number gives the positive order.
    plane.Frame = MakeDirect(box, constant, !(normal[constant] < 0.0));
    return plane;
  }
  if (normal.squaredNorm() == 0.0) // all points are collinear
  {
    // Any normal will do: flat triangles have no side.
    normal = Vec<3>(box.High - box.Low).unitOrthogonal();
  }
  normal.normalize();
  // The middle of the box need not lie in the plane.
  plane.Frame = MakeTilted(0.5 * (box.Low + box.High), facts.Point, normal);
  plane.Normal = normal;
  return plane;
}

/**
 * Among equally far points the one with the lowest id.
 */
void FindFarthest(const GridView& grid, const std::vector<vtkIdType>& triangles, Plane& plane)
{
  if (plane.Frame.Direct[0] >= 0) // all have the same coordinate
  {
    return;
  }
  for (vtkIdType triangle : triangles)
  {
    for (vtkIdType p : PointsOf(grid, triangle))
    {
      const double distance = std::abs(plane.Normal.dot(grid.GetPoint(p) - plane.Frame.Origin));
      if (distance > plane.Farthest ||
        (distance == plane.Farthest && distance > 0.0 && p < plane.FarthestPoint))
      {
        plane.Farthest = distance;
        plane.FarthestPoint = p;
      }
    }
  }
}

bool Plane::Has(const Vec<3>& x) const { return DistanceOf(this->Frame, x) <= this->Tolerance; }

Plane FindPlane(const GridView& grid, const std::vector<vtkIdType>& triangles)
{
  return FindPlane(grid, triangles, FindBox(grid, triangles, 3));
}

//------------------------------------------------------------------------------
std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<3>&)
{
  return CheckExtent(FindBox(GridView(grid), cells.Simplices, 4));
}

std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<2>& frame)
{
  const GridView view(grid);
  const Box box = FindBox(view, cells.Simplices, 3);
  const std::string error = CheckExtent(box);
  if (!error.empty())
  {
    return error;
  }
  const Plane plane = FindPlane(view, cells.Simplices, box);
  if (!plane.HasAll())
  {
    std::ostringstream text;
    text << "The triangles are not in one plane: point " << plane.FarthestPoint << " is "
         << plane.Farthest << " away from it (extent of the mesh " << plane.Extent
         << "). Triangles are optimized in a plane only; a volume needs tetrahedra.";
    return text.str();
  }
  frame = plane.Frame;
  return {};
}

} // namespace vtkMeshBridge
