// SPDX-License-Identifier: BSD-3-Clause
// Reads what the boundary is to slide along: lines of a geometry, corner arrays, labels of patches;
// and finds the faces that blocks share.
#include "vtkMeshOptimizeSurface.h"

#include "vtkMeshOptimizeRiding.h"
#include "vtkMeshOptimizeSets.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointLocator.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/Ids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

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
  // Rounding only: points nearer than that were meant to be one.
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

namespace
{

/**
 * Calls f(cell, ids) for each tetrahedron.
 */
template <class F>
void ForTetrahedra(vtkUnstructuredGrid* grid, F&& f)
{
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_TETRA)
    {
      vtkIdType n = 0;
      const vtkIdType* ids = nullptr;
      grid->GetCellPoints(c, n, ids);
      const bool isValid = n == 4 &&
        std::all_of(
          ids, ids + 4, [&](vtkIdType p) { return p >= 0 && p < grid->GetNumberOfPoints(); });
      if (isValid) // others are reported later
      {
        f(ids);
      }
    }
  }
}

/**
 * The faces of tetrahedra that only one has.
 */
std::vector<meshopt::Facet<3>> ListOuterFaces(vtkUnstructuredGrid* grid)
{
  // Blocks are separate grids: a face between two of them is outer in both.
  std::vector<meshopt::Facet<3>> all, once;
  ForTetrahedra(grid,
    [&](const vtkIdType* ids)
    {
      for (int i = 0; i < 4; ++i)
      {
        all.push_back(meshopt::sortedIds(meshopt::Facet<3>{ static_cast<Index>(ids[(i + 1) % 4]),
          static_cast<Index>(ids[(i + 2) % 4]), static_cast<Index>(ids[(i + 3) % 4]) }));
      }
    });
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    if ((k == 0 || all[k - 1] != all[k]) && (k + 1 == all.size() || all[k + 1] != all[k]))
    {
      once.push_back(all[k]);
    }
  }
  return once;
}

using Place = std::array<double, 9>; // of a facet: its corners in order

Place PlaceOf(vtkUnstructuredGrid* grid, const meshopt::Facet<3>& face)
{
  // Compared bit for bit.
  std::array<std::array<double, 3>, 3> x;
  for (int i = 0; i < 3; ++i)
  {
    grid->GetPoint(face[i], x[i].data());
  }
  // Different blocks number the corners differently.
  std::sort(x.begin(), x.end());
  Place place;
  for (int i = 0; i < 9; ++i)
  {
    place[i] = x[i / 3][i % 3];
  }
  return place;
}

} // namespace

std::vector<std::vector<meshopt::Facet<3>>> PrepareSurface(
  Request& request, const std::vector<vtkUnstructuredGrid*>& grids)
{
  std::vector<std::vector<meshopt::Facet<3>>> locked(grids.size());
  if (!request.Slide)
  {
    return locked;
  }
  // Of tetrahedra only: other cells of the grid may be anywhere.
  vtkBoundingBox box;
  for (vtkUnstructuredGrid* grid : grids)
  {
    ForTetrahedra(grid,
      [&](const vtkIdType* ids)
      {
        for (int i = 0; i < 4; ++i)
        {
          double x[3];
          grid->GetPoint(ids[i], x);
          box.AddPoint(x);
        }
      });
  }
  if (!request.ToleranceIsAbsolute && box.IsValid())
  {
    // Of all blocks together: the same tolerance everywhere.
    request.Surface.tolerance *= box.GetDiagonalLength();
    request.ToleranceIsAbsolute = true;
  }
  if (grids.size() < 2)
  {
    return locked;
  }
  // Faces of different blocks at the same place.
  std::vector<std::tuple<Place, std::size_t, meshopt::Facet<3>>> faces;
  for (std::size_t k = 0; k < grids.size(); ++k)
  {
    for (const meshopt::Facet<3>& face : ListOuterFaces(grids[k]))
    {
      faces.emplace_back(PlaceOf(grids[k], face), k, face);
    }
  }
  std::sort(faces.begin(), faces.end());
  // Neighbours in the order of places: a face at one place comes from two blocks, or twice from
  // one.
  for (std::size_t k = 1; k < faces.size(); ++k)
  {
    if (std::get<0>(faces[k - 1]) == std::get<0>(faces[k]))
    {
      for (std::size_t i : { k - 1, k })
      {
        locked[std::get<1>(faces[i])].push_back(std::get<2>(faces[i]));
      }
    }
  }
  // Sorted, as SurfaceOptions::locked wants to have it.
  for (std::vector<meshopt::Facet<3>>& ofGrid : locked)
  {
    std::sort(ofGrid.begin(), ofGrid.end());
  }
  return locked;
}

namespace
{

using Labels = std::vector<std::pair<meshopt::Facet<3>, Index>>;

/**
 * Facets get one number for each pair of numbers.
 */
Labels Combined(const Labels& first, const Labels& second)
{
  if (second.empty())
  {
    return first;
  }
  std::map<meshopt::Facet<3>, std::array<Index, 2>> pairs;
  for (const Labels* labels : { &first, &second })
  {
    for (const auto& [facet, label] : *labels)
    {
      pairs.try_emplace(facet, std::array<Index, 2>{ meshopt::None, meshopt::None })
        .first->second[labels == &second] = label;
    }
  }
  // Two facets are alike if both their labels are. Numbers follow the order of the facets, which
  // the input alone decides.
  std::map<std::array<Index, 2>, Index> numbers;
  Labels combined;
  for (const auto& [facet, pair] : pairs)
  {
    combined.emplace_back(
      facet, numbers.emplace(pair, static_cast<Index>(numbers.size())).first->second);
  }
  return combined;
}

} // namespace

std::string BuildSurface(const Request& request, Model<2>& model, meshopt::BoundaryCurves& curves)
{
  if (!request.Slide)
  {
    return {};
  }
  // Places are set by the editor, which alone may change a mesh.
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

std::string BuildSurface(const Request& request, Model<3>& model, meshopt::SlidingSurface& surface)
{
  if (!request.Slide)
  {
    return {};
  }
  if (request.Geometry)
  {
    return "The geometry on input port 1 is for triangles in a plane; tetrahedra slide on their "
           "own "
           "surface.";
  }
  if (!model.Metric.isTrivial() || request.Options.beta > 0.0 ||
    request.Options.desiredSize > 0.0 || model.Arrays.Size)
  {
    return "The boundary mode Slide of tetrahedra does not work together with wanted sizes or a "
           "metric.";
  }
  meshopt::SurfaceOptions options = request.Surface;
  options.corners = ReadCorners(model.Arrays.Corners, model.Cells);
  const auto ofPoints = LabelByPoints(model);
  options.labels = Combined(LabelRiding(model), ofPoints);
  options.lines = LabelRidingLines(model);
  // Points with a label that no facet around them has would lose it: they stay.
  KeepLonePoints(model, ofPoints, options.corners);
  options.sets = FindNodeSets(model);
  meshopt::MeshEditor<3> editor(model.Mesh);
  surface.build(editor, options);
  return {};
}

std::string DescribeTwins(const meshopt::BoundaryCurves&) { return {}; }

std::string DescribeTwins(const meshopt::SlidingSurface& surface)
{
  const Index n = surface.numberOfTwins();
  return n == 0 ? ""
                : std::to_string(n) +
      " facets of the surface lie on others, corner by corner, without having their points: lips "
      "of "
      "a closed crack, or of two blocks. They stay as they are, so that they stay together.";
}

} // namespace vtkMeshOptimizeBridge
