// SPDX-License-Identifier: BSD-3-Clause
// Makes what the boundary slides along, from a geometry, corner arrays and labels of patches; and
// finds the faces that blocks share.
#include "Boundary/vtkMeshOptimizeSurface.h"

#include "Boundary/vtkMeshOptimizeGeometry.h"
#include "Boundary/vtkMeshOptimizeRiding.h"
#include "Boundary/vtkMeshOptimizeSets.h"

#include "vtkBoundingBox.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkUnsignedCharArray.h"
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

namespace
{

std::vector<std::uint8_t> ReadCorners(vtkDataArray* array, const Cells& cells)
{
  std::vector<std::uint8_t> corners;
  for (std::size_t p = 0; array && p < cells.PointUse.size(); ++p)
  {
    corners.push_back(array->GetComponent(static_cast<vtkIdType>(p), 0) != 0.0);
  }
  return corners;
}

/**
 * Calls f(cell, ids) for each tetrahedron.
 */
template <class F>
void ForTetrahedra(vtkUnstructuredGrid* grid, F&& f)
{
  // The grid has not been checked yet: it may have fewer types than cells.
  vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  const vtkIdType count = types ? types->GetNumberOfValues() : 0;
  for (vtkIdType c = 0; c < std::min(grid->GetNumberOfCells(), count); ++c)
  {
    if (types->GetValue(c) == VTK_TETRA)
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

using FaceCorners = std::array<double, 9>; // of its corners, ascending: their coordinates

FaceCorners CornersOf(vtkUnstructuredGrid* grid, const meshopt::Facet<3>& face)
{
  // Compared bit for bit.
  std::array<std::array<double, 3>, 3> x;
  for (int i = 0; i < 3; ++i)
  {
    grid->GetPoint(face[i], x[i].data());
  }
  // Different blocks number the corners differently.
  std::sort(x.begin(), x.end());
  FaceCorners corners;
  for (int i = 0; i < 9; ++i)
  {
    corners[i] = x[i / 3][i % 3];
  }
  return corners;
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
  std::vector<std::tuple<FaceCorners, std::size_t, meshopt::Facet<3>>> faces;
  for (std::size_t k = 0; k < grids.size(); ++k)
  {
    for (const meshopt::Facet<3>& face : ListOuterFaces(grids[k]))
    {
      const FaceCorners corners = CornersOf(grids[k], face);
      // NaN has no place in an order; its point is reported later.
      if (std::all_of(corners.begin(), corners.end(), [](double x) { return std::isfinite(x); }))
      {
        faces.emplace_back(corners, k, face);
      }
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
  if (request.Boundary)
  {
    curves.build(editor, *request.Boundary, *request.BoundaryOfPart);
    return {};
  }
  if (!request.Geometry)
  {
    curves.build(editor, request.Curves, corners);
    return {};
  }
  LineNetwork network;
  const std::string error = ReadGeometry(request, model.Frame, network);
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
           "own surface.";
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

void KeepPlaces(const Request& request, const Model<2>& model, const OutputMap& map,
  const meshopt::BoundaryCurves& curves)
{
  if (!request.Boundary)
  {
    return;
  }
  std::vector<meshopt::WholeBoundary::PlaceOnPiece>& places = request.BoundaryOfPart->places;
  std::vector<meshopt::WholeBoundary::PlaceOnPiece> after;
  after.reserve(map.PointToSlot.size());
  for (const Index p : map.PointToSlot)
  {
    const auto place = curves.inWhole(*request.Boundary, model.Mesh, p);
    // Where other parts have the point, too, it was held, and is where it was.
    const bool isHeld = place.piece == meshopt::None && p < static_cast<Index>(places.size());
    after.push_back(isHeld ? places[p] : place);
  }
  places.swap(after);
}

void KeepPlaces(const Request&, const Model<3>&, const OutputMap&, const meshopt::SlidingSurface&)
{
}

std::string DescribeTwins(const meshopt::BoundaryCurves&) { return {}; }

std::string DescribeTwins(const meshopt::SlidingSurface& surface)
{
  const Index n = surface.numberOfTwins();
  return n == 0 ? ""
                : std::to_string(n) +
      " facets of the surface lie on other facets but have points of their own: the lips of a "
      "closed crack, or two blocks. They stay as they are, so that they stay together. If points "
      "are doubled by mistake, the filter Clean to Grid joins them.";
}

} // namespace vtkMeshOptimizeBridge
