// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeCurves.h"

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
#include <array>
#include <cmath>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::LineNetwork;
using vtkMeshBridge::Cells;
using vtkMeshBridge::Frame;

namespace
{

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

std::string FindUsedPoints(vtkPolyData* geometry, std::vector<char>& used)
{
  const vtkIdType all = geometry->GetNumberOfPoints();
  std::string error;
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
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    geometry->GetPoint(static_cast<vtkIdType>(p), x);
    frame.ToGrid(frame.ToCore(x), back);
    const double away = std::hypot(x[0] - back[0], x[1] - back[1], x[2] - back[2]);
    if (used[p] && away > 1e-6 * box.GetDiagonalLength())
    {
      return "Point " + std::to_string(p) +
        " of the geometry is not in the plane of the mesh, but " + std::to_string(away) +
        " away from it.";
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
  places->SetTolerance(1e-10 * box.GetDiagonalLength());
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
  ForLines(geometry,
    [&](vtkIdType n, const vtkIdType* points)
    {
      for (vtkIdType k = 1; k < n; ++k)
      {
        const Index from = ids[points[k - 1]], to = ids[points[k]];
        if (from != to)
        {
          network.lines.push_back({ std::min(from, to), std::max(from, to) });
        }
      }
    });
  std::sort(network.lines.begin(), network.lines.end());
  network.lines.erase(std::unique(network.lines.begin(), network.lines.end()), network.lines.end());
  return {};
}

std::vector<std::uint8_t> ReadCorners(vtkDataArray* array, const Cells& cells)
{
  std::vector<std::uint8_t> corners;
  for (std::size_t p = 0; array && p < cells.PointUse.size(); ++p)
  {
    corners.push_back(array->GetComponent(static_cast<vtkIdType>(p), 0) != 0.0);
  }
  return corners;
}

} // namespace

bool HasCornerArray(vtkAlgorithm* filter, vtkPolyData* geometry)
{
  return FindCorners(filter, geometry) != nullptr;
}

std::string BuildCurves(const Request& request, Model<2>& model, meshopt::BoundaryCurves& curves)
{
  if (!request.Slide)
  {
    return {};
  }
  meshopt::MeshEditor<2> editor(model.Mesh);
  const std::vector<std::uint8_t> corners = ReadCorners(model.Arrays.Corners, model.Cells);
  if (!request.Geometry)
  {
    curves.build(editor, request.Curves, corners);
    return {};
  }
  LineNetwork network;
  const std::string error = ReadLines(
    request.Geometry, FindCorners(request.Filter, request.Geometry), model.Frame, network);
  return error.empty() ? curves.build(editor, network, request.Curves, corners) : error;
}

std::string BuildCurves(const Request& request, Model<3>&, meshopt::BoundaryCurves&)
{
  return request.Slide ? "The boundary mode Slide is for triangles in a plane; the surface of "
                         "tetrahedra can only be kept (boundary mode Fixed)."
                       : "";
}

} // namespace vtkMeshOptimizeBridge
