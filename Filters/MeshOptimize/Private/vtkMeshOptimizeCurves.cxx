#include "vtkMeshOptimizeCurves.h"

#include "vtkMeshOptimizeRun.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::LineNetwork;

namespace
{

vtkDataArray* FindCorners(vtkAlgorithm* filter, vtkPolyData* geometry)
{
  vtkInformation* wanted = filter->GetInputArrayInformation(CornerArray);
  const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
  return geometry && name && *name ? geometry->GetPointData()->GetArray(name) : nullptr;
}

/**
 * The lines of `geometry` in the plane of the mesh. Points at the same place become one, and so do
 * lines with the same ends: both sides of a crack may be given as one line or as two.
 */
std::string ReadLines(
  vtkPolyData* geometry, vtkDataArray* corners, const Frame<2>& frame, LineNetwork& network)
{
  if (geometry->GetNumberOfLines() == 0)
  {
    return "The geometry has no lines. (It must be polygonal data whose lines the boundary of the "
           "mesh is to follow.)";
  }
  double bounds[6];
  geometry->GetBounds(bounds);
  const double extent = std::max(
    { bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4], 1e-300 });
  std::map<std::array<double, 2>, Index> places;
  std::vector<Index> ids(static_cast<std::size_t>(geometry->GetNumberOfPoints()), meshopt::None);
  const auto take = [&](vtkIdType p) -> std::string
  {
    Index& id = ids[static_cast<std::size_t>(p)];
    if (id != meshopt::None)
    {
      return {};
    }
    double x[3], back[3];
    geometry->GetPoint(p, x);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return "Point " + std::to_string(p) + " of the geometry has coordinates that are not finite.";
    }
    const meshopt::Vec<2> u = frame.ToCore(x);
    frame.ToGrid(u, back);
    const double away = std::hypot(x[0] - back[0], x[1] - back[1], x[2] - back[2]);
    if (away > 1e-6 * extent)
    {
      return "Point " + std::to_string(p) + " of the geometry is not in the plane of the mesh, but " +
        std::to_string(away) + " away from it.";
    }
    const auto [place, isNew] =
      places.emplace(std::array<double, 2>{ u[0], u[1] }, static_cast<Index>(network.points.size()));
    id = place->second;
    if (isNew)
    {
      network.points.push_back(u);
      network.corners.push_back(0);
    }
    network.corners[id] |= std::uint8_t(corners && corners->GetComponent(p, 0) != 0.0);
    return {};
  };
  auto line = vtkSmartPointer<vtkCellArrayIterator>::Take(geometry->GetLines()->NewIterator());
  for (line->GoToFirstCell(); !line->IsDoneWithTraversal(); line->GoToNextCell())
  {
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    line->GetCurrentCell(n, points);
    for (vtkIdType k = 0; k < n; ++k)
    {
      const std::string error = take(points[k]);
      if (!error.empty())
      {
        return error;
      }
      const Index to = ids[points[k]];
      const Index from = k > 0 ? ids[points[k - 1]] : to;
      if (from != to)
      {
        network.lines.push_back({ std::min(from, to), std::max(from, to) });
      }
    }
  }
  std::sort(network.lines.begin(), network.lines.end());
  network.lines.erase(
    std::unique(network.lines.begin(), network.lines.end()), network.lines.end());
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

std::string BuildCurves(const Cells& cells, const InputArrays& arrays, const Frame<2>& frame,
  const Request& request, meshopt::SimplexMesh<2>& mesh, meshopt::BoundaryCurves& curves)
{
  if (!request.Slide)
  {
    return {};
  }
  meshopt::MeshEditor<2> editor(mesh);
  const std::vector<std::uint8_t> corners = ReadCorners(arrays.Corners, cells);
  if (!request.Geometry)
  {
    curves.build(editor, request.Curves, corners);
    return {};
  }
  LineNetwork network;
  const std::string error =
    ReadLines(request.Geometry, FindCorners(request.Filter, request.Geometry), frame, network);
  return error.empty() ? curves.build(editor, network, request.Curves, corners) : error;
}

std::string BuildCurves(const Cells&, const InputArrays&, const Frame<3>&, const Request& request,
  meshopt::SimplexMesh<3>&, meshopt::BoundaryCurves&)
{
  return request.Slide ? "The boundary mode Slide is for triangles in a plane; the surface of "
                         "tetrahedra can only be kept (boundary mode Fixed)."
                       : "";
}

} // namespace vtkMeshOptimizeBridge
