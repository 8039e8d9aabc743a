// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshBridgeFrame.h"

#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <sstream>

namespace vtkMeshOptimizeBridge
{

using meshopt::Tensor;
using meshopt::Vec;

//------------------------------------------------------------------------------
Vec<2> Frame<2>::ToCore(const double x[3]) const
{
  if (this->Direct[0] >= 0)
  {
    return { x[this->Direct[0]], x[this->Direct[1]] };
  }
  const Vec<3> d = Vec<3>(x[0], x[1], x[2]) - this->Origin;
  return { d.dot(this->Axes[0]), d.dot(this->Axes[1]) };
}

void Frame<2>::ToGrid(const Vec<2>& u, double x[3]) const
{
  if (this->Direct[0] >= 0)
  {
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

std::string CheckExtent(const Vec<3>& low, const Vec<3>& high)
{
  constexpr double least = 1e-100, most = 1e100;
  const double extent = (high - low).maxCoeff();
  const double magnitude = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const bool isLarge = magnitude > most, isSmall = extent > 0.0 && extent < least;
  if (!std::isfinite(magnitude) || !std::isfinite(extent) || (!isLarge && !isSmall))
  {
    return {};
  }
  std::ostringstream text;
  text
    << "The coordinates are too " << (isLarge ? "large (up to " : "small (extent ")
    << (isLarge ? magnitude : extent)
    << "): lengths squared and cubed leave the range of double precision. Scale the mesh; between "
       "1e-100 and 1e100 all is well.";
  return text.str();
}

namespace
{

struct Box
{
  Vec<3> Low = Vec<3>::Constant(std::numeric_limits<double>::infinity());
  Vec<3> High = -Low;
  double Diagonal() const { return (this->High - this->Low).norm(); }
  double Magnitude() const
  {
    return std::max(this->Low.cwiseAbs().maxCoeff(), this->High.cwiseAbs().maxCoeff());
  }
};

Vec<3> GridPoint(vtkUnstructuredGrid* grid, vtkIdType p)
{
  Vec<3> x;
  grid->GetPoint(p, x.data());
  return x;
}

Box FindBox(vtkUnstructuredGrid* grid, const Cells& cells)
{
  Box box;
  for (std::size_t p = 0; p < cells.PointUse.size(); ++p)
  {
    if (cells.PointUse[p] & UsedBySimplex)
    {
      const Vec<3> x = GridPoint(grid, static_cast<vtkIdType>(p));
      box.Low = box.Low.cwiseMin(x);
      box.High = box.High.cwiseMax(x);
    }
  }
  return box;
}

Vec<3> AreaVector(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cell, n, ids);
  const Vec<3> a = GridPoint(grid, ids[0]), b = GridPoint(grid, ids[1]),
               c = GridPoint(grid, ids[2]);
  return 0.5 * Vec<3>(b - a).cross(Vec<3>(c - a));
}

/**
 * Sum of all area vectors, those that look backwards turned round; its sign such that what was
 * turned round is the smaller part. Zero only if no triangle has an area.
 */
Vec<3> FindNormal(vtkUnstructuredGrid* grid, const Cells& cells)
{
  Vec<3> largest = Vec<3>::Zero();
  for (vtkIdType cell : cells.Simplices)
  {
    const Vec<3> area = AreaVector(grid, cell);
    if (area.squaredNorm() > largest.squaredNorm())
    {
      largest = area;
    }
  }
  Vec<3> sum = Vec<3>::Zero(), turned = Vec<3>::Zero();
  for (vtkIdType cell : cells.Simplices)
  {
    const Vec<3> area = AreaVector(grid, cell);
    (area.dot(largest) < 0.0 ? turned : sum) += area;
  }
  const Vec<3> normal = sum - turned;
  return turned.squaredNorm() > sum.squaredNorm() ? Vec<3>(-normal) : normal;
}

/**
 * The coordinate that all points have in common, or -1; z is preferred.
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

void SetDirect(Frame<2>& frame, const Box& box, int constant, bool positive)
{
  frame.Origin = Vec<3>::Zero();
  frame.Origin[constant] = box.Low[constant];
  const int first = (constant + 1) % 3, second = (constant + 2) % 3;
  frame.Direct[0] = positive ? first : second;
  frame.Direct[1] = positive ? second : first;
  frame.Axes[0] = Vec<3>::Unit(frame.Direct[0]);
  frame.Axes[1] = Vec<3>::Unit(frame.Direct[1]);
}

std::string CheckPlane(vtkUnstructuredGrid* grid, const Cells& cells, const Vec<3>& origin,
  const Vec<3>& normal, const Box& box)
{
  const double precision = grid->GetPoints()->GetDataType() == VTK_DOUBLE
    ? std::numeric_limits<double>::epsilon()
    : static_cast<double>(std::numeric_limits<float>::epsilon());
  const double tolerance = 1e-6 * box.Diagonal() + 4.0 * precision * box.Magnitude();
  double farthest = 0.0;
  std::size_t where = 0;
  for (std::size_t p = 0; p < cells.PointUse.size(); ++p)
  {
    if (cells.PointUse[p] & UsedBySimplex)
    {
      const double distance = std::abs(
        normal.dot(GridPoint(grid, static_cast<vtkIdType>(p)) - origin));
      if (distance > farthest)
      {
        farthest = distance;
        where = p;
      }
    }
  }
  if (farthest <= tolerance)
  {
    return {};
  }
  std::ostringstream text;
  text << "The triangles are not in one plane: point " << where << " is " << farthest
       << " away from it (extent of the mesh " << box.Diagonal()
       << "). Triangles are optimized in a plane only; a volume needs tetrahedra.";
  return text.str();
}

} // namespace

std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<3>&)
{
  const Box box = FindBox(grid, cells);
  return CheckExtent(box.Low, box.High);
}

std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<2>& frame)
{
  const Box box = FindBox(grid, cells);
  const std::string error = CheckExtent(box.Low, box.High);
  if (!error.empty())
  {
    return error;
  }
  Vec<3> normal = FindNormal(grid, cells);
  const int constant = FindConstantCoordinate(box);
  if (constant >= 0)
  {
    SetDirect(frame, box, constant, !(normal[constant] < 0.0));
    return {};
  }
  if (normal.squaredNorm() == 0.0) // all on one line
  {
    normal = Vec<3>(box.High - box.Low).unitOrthogonal();
  }
  normal.normalize();
  frame.Direct[0] = frame.Direct[1] = -1;
  frame.Origin = 0.5 * (box.Low + box.High);
  // The middle of the box need not lie in the plane: take a point's height above it away.
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cells.Simplices.front(), n, ids);
  frame.Origin += normal * normal.dot(GridPoint(grid, ids[0]) - frame.Origin);
  frame.Axes[0] = normal.unitOrthogonal();
  frame.Axes[1] = normal.cross(frame.Axes[0]);
  return CheckPlane(grid, cells, frame.Origin, normal, box);
}

} // namespace vtkMeshOptimizeBridge
