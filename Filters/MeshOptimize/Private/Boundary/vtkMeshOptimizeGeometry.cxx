// SPDX-License-Identifier: BSD-3-Clause
// Reads the lines of the second input, which the boundary of triangles is to follow.
#include "Boundary/vtkMeshOptimizeGeometry.h"

#include "Request/vtkMeshOptimizeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointLocator.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::LineNetwork;
using vtkMeshBridge::Frame;

namespace
{

// How far points of the geometry may be from the plane of the mesh, as a part of the diagonal of
// their box. Files with single precision are off by 1e-7; what is off by more was meant to be.
constexpr double InPlane = 1e-6;
// The same as a part of the greatest coordinate, four roundings of a float: the mesh may have these
// where the geometry has none, and its plane is no more exact than they are.
constexpr double OfFloats = 4.0 * FLT_EPSILON;
// Points nearer to each other than this part of that diagonal were meant to be one. Rounding only:
// with more, short lines would vanish; with none, lines that meet would not be connected.
constexpr double SamePlace = 1e-10;

vtkDataArray* FindCorners(vtkAlgorithm* filter, vtkPolyData* geometry)
{
  vtkInformation* wanted = filter->GetInputArrayInformation(CornerArray);
  const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
  return geometry && name && *name ? geometry->GetPointData()->GetArray(name) : nullptr;
}

/**
 * `corners`, if given, must have one number per point of `geometry`.
 */
std::string CheckCorners(vtkPolyData* geometry, vtkDataArray* corners)
{
  if (corners && corners->GetNumberOfComponents() != 1)
  {
    return "The corner array '" + std::string(corners->GetName()) + "' of the geometry has " +
      std::to_string(corners->GetNumberOfComponents()) + " components; one is needed.";
  }
  if (corners && corners->GetNumberOfTuples() != geometry->GetNumberOfPoints())
  {
    return "The corner array '" + std::string(corners->GetName()) + "' of the geometry has " +
      std::to_string(corners->GetNumberOfTuples()) + " values, but the geometry has " +
      std::to_string(geometry->GetNumberOfPoints()) + " points.";
  }
  return {};
}

/**
 * Calls f(n, points) for each line of `geometry`.
 */
// By an iterator, since geometries with 32-bit ids have no pointer to hand out.
template <class F>
void ForLines(vtkPolyData* geometry, F&& f)
{
  auto line = vtkSmartPointer<vtkCellArrayIterator>::Take(geometry->GetLines()->NewIterator());
  for (line->GoToFirstCell(); !line->IsDoneWithTraversal(); line->GoToNextCell())
  {
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    line->GetCurrentCell(n, points);
    f(n, points);
  }
}

/**
 * Points that no line uses may have any coordinates.
 */
std::string FindUsedPoints(vtkPolyData* geometry, std::vector<char>& used)
{
  const vtkIdType all = geometry->GetNumberOfPoints();
  std::string error;
  // Lines of a file may use points that are not there: checked before any is read.
  used.assign(static_cast<std::size_t>(all), 0);
  ForLines(geometry,
    [&](vtkIdType n, const vtkIdType* points)
    {
      for (vtkIdType k = 0; k < n && error.empty(); ++k)
      {
        if (points[k] < 0 || points[k] >= all)
        {
          error = "A line of the geometry uses point " + std::to_string(points[k]) +
            ", but the geometry has " + std::to_string(all) + " points.";
          return;
        }
        used[static_cast<std::size_t>(points[k])] = 1;
      }
    });
  return error;
}

/**
 * The points of `geometry` that are in use must be finite and in the plane of the mesh; `box` is
 * theirs.
 */
std::string CheckPoints(
  vtkPolyData* geometry, const std::vector<char>& used, const Frame<2>& frame, vtkBoundingBox& box)
{
  double x[3], back[3];
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    geometry->GetPoint(static_cast<vtkIdType>(p), x);
    if (used[p] && !(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])))
    {
      return "Point " + std::to_string(p) + " of the geometry has coordinates that are not finite.";
    }
    if (used[p])
    {
      box.AddPoint(x);
    }
  }
  // Two passes: the tolerance is relative to the box of all points.
  double greatest = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    greatest = std::max(greatest, std::fabs(box.GetBound(i)));
  }
  const double slack = InPlane * box.GetDiagonalLength() + OfFloats * greatest;
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    geometry->GetPoint(static_cast<vtkIdType>(p), x);
    frame.ToGrid(frame.ToCore(x), back);
    const double away = std::hypot(x[0] - back[0], x[1] - back[1], x[2] - back[2]);
    if (used[p] && away > slack)
    {
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.3g", away);
      return "Point " + std::to_string(p) +
        " of the geometry is not in the plane of the mesh, but " + digits + " away from it.";
    }
  }
  return {};
}

/**
 * The lines of `geometry` in the plane of the mesh. Points at the same place (up to rounding)
 * become one, and so do lines with the same ends: the sides of a crack may be given as one line or
 * as two.
 */
std::string ReadLines(
  vtkPolyData* geometry, vtkDataArray* corners, const Frame<2>& frame, LineNetwork& network)
{
  if (geometry->GetNumberOfLines() == 0)
  {
    return "The geometry has no lines. (It must be polygonal data whose lines the boundary of the "
           "mesh is to follow.)";
  }
  std::vector<char> used;
  vtkBoundingBox box;
  std::string error = CheckCorners(geometry, corners);
  error = error.empty() ? FindUsedPoints(geometry, used) : error;
  error = error.empty() ? CheckPoints(geometry, used, frame, box) : error;
  if (!error.empty())
  {
    return error;
  }
  double bounds[6];
  box.GetBounds(bounds);
  vtkNew<vtkPoints> distinct;
  distinct->SetDataTypeToDouble();
  vtkNew<vtkPointLocator> places;
  places->SetTolerance(SamePlace * box.GetDiagonalLength());
  places->InitPointInsertion(distinct, bounds, geometry->GetNumberOfPoints());
  std::vector<Index> ids(used.size(), meshopt::None);
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    if (used[p])
    {
      double x[3];
      vtkIdType id = 0;
      geometry->GetPoint(static_cast<vtkIdType>(p), x);
      if (places->InsertUniquePoint(x, id))
      {
        network.points.push_back(frame.ToCore(x));
        network.corners.push_back(0);
      }
      ids[p] = static_cast<Index>(id);
      network.corners[id] |= std::uint8_t(
        corners && corners->GetComponent(static_cast<vtkIdType>(p), 0) != 0.0);
    }
  }
  // A polyline of n points has n - 1 lines; those without length are left out.
  ForLines(geometry,
    [&](vtkIdType n, const vtkIdType* points)
    {
      for (vtkIdType k = 1; k < n; ++k)
      {
        const Index from = ids[points[k - 1]], to = ids[points[k]];
        if (from != to)
        {
          // Lower end first, so that both sides of a crack become the same line.
          network.lines.push_back({ std::min(from, to), std::max(from, to) });
        }
      }
    });
  std::sort(network.lines.begin(), network.lines.end());
  network.lines.erase(std::unique(network.lines.begin(), network.lines.end()), network.lines.end());
  return {};
}

} // namespace

//------------------------------------------------------------------------------
bool HasCornerArray(vtkAlgorithm* filter, vtkPolyData* geometry)
{
  return FindCorners(filter, geometry) != nullptr;
}

std::string ReadGeometry(const Request& request, const Frame<2>& frame, LineNetwork& network)
{
  return ReadLines(request.Geometry, FindCorners(request.Filter, request.Geometry), frame, network);
}

} // namespace vtkMeshOptimizeBridge
