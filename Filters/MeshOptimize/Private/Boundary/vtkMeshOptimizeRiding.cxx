// SPDX-License-Identifier: BSD-3-Clause
// Triangles on the surface of tetrahedra carry boundary conditions. Where the surface slides they
// cannot stay: they are made again from the facets of the result, and lines from its edges.
#include "Boundary/vtkMeshOptimizeRiding.h"

#include "Boundary/vtkMeshOptimizeRidingLines.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/Ids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <map>

namespace vtkMeshOptimizeBridge
{

using meshopt::Facet;
using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

using Riding = std::vector<std::pair<Facet<3>, vtkIdType>>;

Facet<3> KeyOf(const vtkIdType* ids)
{
  return meshopt::sortedIds(
    Facet<3>{ static_cast<Index>(ids[0]), static_cast<Index>(ids[1]), static_cast<Index>(ids[2]) });
}

bool LessKey(const std::pair<Facet<3>, vtkIdType>& entry, const Facet<3>& key)
{
  return entry.first < key;
}

/**
 * The cell with these points, or -1.
 */
vtkIdType Find(const Riding& riding, const Facet<3>& key)
{
  const auto found = std::lower_bound(riding.begin(), riding.end(), key, LessKey);
  return found != riding.end() && found->first == key ? found->second : -1;
}

/**
 * All triangles of the grid whose points are a face's only once.
 */
// Two triangles on one face stand for something that one face cannot carry on: they hold their
// points.
Riding ListTriangles(vtkUnstructuredGrid* grid)
{
  Riding all;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_TRIANGLE)
    {
      vtkIdType n = 0;
      const vtkIdType* ids = nullptr;
      grid->GetCellPoints(c, n, ids);
      all.emplace_back(KeyOf(ids), c);
    }
  }
  return WithoutTwins(all);
}

/**
 * Keeps those that are faces of tetrahedra of the mesh.
 */
Riding FacesAmong(const Riding& triangles, const Model<3>& model)
{
  std::vector<char> isFace(triangles.size(), 0);
  for (const vtkIdType c : model.Cells.Simplices)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    model.Grid->GetCellPoints(c, n, ids);
    for (int i = 0; i < 4; ++i)
    {
      const vtkIdType face[3] = { ids[(i + 1) % 4], ids[(i + 2) % 4], ids[(i + 3) % 4] };
      // Most faces have a point that no triangle uses: they need no search.
      const bool mayBe = std::all_of(face, face + 3,
        [&](vtkIdType p) { return (model.Cells.PointUse[p] & vtkMeshBridge::UsedByOther) != 0; });
      if (mayBe)
      {
        const Facet<3> key = KeyOf(face);
        const auto found = std::lower_bound(triangles.begin(), triangles.end(), key, LessKey);
        if (found != triangles.end() && found->first == key)
        {
          isFace[found - triangles.begin()] = 1;
        }
      }
    }
  }
  // In the order of the points, for Find().
  Riding faces;
  for (std::size_t k = 0; k < triangles.size(); ++k)
  {
    if (isFace[k])
    {
      faces.push_back(triangles[k]);
    }
  }
  return faces;
}

/**
 * The kept facets of the mesh on patches, each once, with their patches.
 */
std::vector<std::pair<Facet<3>, Index>> ListFacets(const SimplexMesh<3>& mesh)
{
  std::vector<std::pair<Facet<3>, Index>> facets;
  ForKeptFacets(mesh,
    [&](Index c, int i)
    { facets.emplace_back(meshopt::sortedIds(mesh.facet(c, i)), mesh.patch(c, i)); });
  std::sort(facets.begin(), facets.end());
  return facets;
}

/**
 * The facet with its points in the order of the triangle that it comes from.
 */
Facet<3> TurnedLike(const Model<3>& model, vtkIdType source, Facet<3> facet)
{
  // Facets of the mesh are seen from their cell; a triangle is seen from where its user meant.
  const auto normal = [](const meshopt::Vec<3>& a, const meshopt::Vec<3>& b,
                        const meshopt::Vec<3>& c) { return meshopt::Vec<3>((b - a).cross(c - a)); };
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  model.Grid->GetCellPoints(source, n, ids);
  meshopt::Vec<3> x[3];
  for (int i = 0; i < 3; ++i)
  {
    model.Grid->GetPoint(ids[i], x[i].data());
  }
  const SimplexMesh<3>& mesh = model.Mesh;
  const meshopt::Vec<3> before = normal(x[0], x[1], x[2]);
  if (normal(mesh.point(facet[0]), mesh.point(facet[1]), mesh.point(facet[2])).dot(before) < 0.0)
  {
    std::swap(facet[1], facet[2]);
  }
  return facet;
}

} // namespace

void FindRiding(Model<2>&) {}

void FindRiding(Model<3>& model)
{
  model.Riding = FacesAmong(ListTriangles(model.Grid), model);
  model.RidingLines = FindRidingLines(model);
  if (model.Riding.empty() && model.RidingLines.empty())
  {
    return;
  }
  std::vector<char> rides(static_cast<std::size_t>(model.Grid->GetNumberOfCells()), 0);
  for (const auto& entry : model.Riding)
  {
    rides[entry.second] = 1;
  }
  for (const auto& entry : model.RidingLines)
  {
    rides[entry.second] = 1;
  }
  // Simplices are no other cells: they count as riding here, so that they hold nothing.
  for (const vtkIdType c : model.Cells.Simplices)
  {
    rides[c] = 1;
  }
  // What rides does not hold its points; all other cells do.
  for (std::uint8_t& use : model.Cells.PointUse)
  {
    use &= std::uint8_t(~vtkMeshBridge::UsedByOther);
  }
  for (vtkIdType c = 0; c < model.Grid->GetNumberOfCells(); ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    model.Grid->GetCellPoints(c, n, ids);
    for (vtkIdType k = 0; k < n && !rides[c]; ++k)
    {
      model.Cells.PointUse[ids[k]] |= vtkMeshBridge::UsedByOther;
    }
  }
}

namespace
{

/**
 * One number for each set of values that occurs among the riding cells.
 */
template <class Key>
std::vector<std::pair<Key, Index>> NumberByValues(
  const Model<3>& model, const std::vector<std::pair<Key, vtkIdType>>& riding)
{
  vtkDataSetAttributes* data = model.Grid->GetCellData();
  std::vector<vtkDataArray*> arrays;
  // Without a patch array all arrays of integers divide: they may mark boundary conditions.
  const bool isChosen = model.Arrays.Patch && !model.Arrays.PatchIsAtPoints;
  for (int i = 0; i < data->GetNumberOfArrays() && !isChosen; ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array->GetNumberOfComponents() == 1 && vtkMeshBridge::HoldsIntegers(array) &&
      !vtkMeshBridge::HoldsIds(data, i))
    {
      arrays.push_back(array);
    }
  }
  if (isChosen)
  {
    arrays.push_back(model.Arrays.Patch);
  }
  // Cells whose data differ lie in different patches, or on different curves: their border stays.
  std::map<std::vector<double>, Index> numbers;
  std::vector<std::pair<Key, Index>> labels;
  for (const auto& [key, cell] : riding)
  {
    std::vector<double> values;
    values.reserve(arrays.size());
    for (vtkDataArray* array : arrays)
    {
      values.push_back(array->GetComponent(cell, 0));
    }
    const auto number = numbers.emplace(values, static_cast<Index>(numbers.size())).first->second;
    labels.emplace_back(key, number);
  }
  return labels;
}

} // namespace

std::vector<std::pair<Facet<3>, Index>> LabelRiding(const Model<3>& model)
{
  return NumberByValues(model, model.Riding);
}

std::vector<std::pair<std::array<Index, 2>, Index>> LabelRidingLines(const Model<3>& model)
{
  return NumberByValues(model, model.RidingLines);
}

void MapRiding(const Model<2>&, const meshopt::BoundaryCurves&, OutputMap&) {}

namespace
{

/**
 * Takes cells out of the map that are gone; those after them move up.
 */
void RemoveGone(const std::vector<char>& isGone, OutputMap& map)
{
  std::size_t to = 0;
  vtkIdType old = 0;
  for (std::size_t c = 0; c < map.CellToSource.size(); ++c)
  {
    // Simplices stay whatever their source: it may be one that has ceased to be.
    const bool stays = map.CellToSlot[c] != meshopt::None || !isGone[map.CellToSource[c]];
    if (stays)
    {
      map.CellToSource[to] = map.CellToSource[c];
      map.CellToSlot[to] = map.CellToSlot[c];
      old += static_cast<vtkIdType>(c) < map.NumberOfOldCells;
      ++to;
    }
  }
  map.CellToSource.resize(to);
  map.CellToSlot.resize(to);
  map.NumberOfOldCells = old;
}

/**
 * One triangle for each new facet of a patch that had triangles.
 */
void AddTriangles(const Model<3>& model, const meshopt::SlidingSurface& surface,
  const std::vector<std::pair<Facet<3>, Index>>& facets, OutputMap& map)
{
  const SimplexMesh<3>& mesh = model.Mesh;
  for (const auto& [key, patch] : facets)
  {
    if (patch == meshopt::None || surface.label(patch) == meshopt::None ||
      Find(model.Riding, key) >= 0)
    {
      continue;
    }
    const meshopt::Vec<3> centre = (mesh.point(key[0]) + mesh.point(key[1]) + mesh.point(key[2])) /
      3.0;
    // Data of a new triangle are those of the nearest facet of the input in its patch.
    const vtkIdType source = Find(model.Riding, surface.inputFacet(patch, centre));
    if (source < 0)
    {
      continue; // a patch of a node set, without triangles
    }
    map.Triangles.push_back(TurnedLike(model, source, key));
    map.CellToSource.push_back(source);
    map.CellToSlot.push_back(meshopt::None);
  }
}

} // namespace

/**
 * First takes out the triangles and lines that are no facets and edges any more, then adds new
 * ones: triangles before lines, as the map wants them.
 */
void MapRiding(const Model<3>& model, const meshopt::SlidingSurface& surface, OutputMap& map)
{
  if (model.Riding.empty() && model.RidingLines.empty())
  {
    return;
  }
  const auto facets = ListFacets(model.Mesh);
  const auto isThere = [&](const Facet<3>& key)
  {
    const auto found = std::lower_bound(facets.begin(), facets.end(), key,
      [](const auto& entry, const Facet<3>& k) { return entry.first < k; });
    return found != facets.end() && found->first == key;
  };
  std::vector<char> isGone(static_cast<std::size_t>(model.Grid->GetNumberOfCells()), 0);
  for (const auto& [key, cell] : model.Riding)
  {
    isGone[cell] = !isThere(key);
  }
  const std::vector<NewLine> lines = FindNewLines(model, surface, isGone);
  RemoveGone(isGone, map);
  if (!model.Riding.empty())
  {
    AddTriangles(model, surface, facets, map);
  }
  for (const NewLine& line : lines)
  {
    map.Lines.push_back(line.Points);
    map.CellToSource.push_back(line.Source);
    map.CellToSlot.push_back(meshopt::None);
  }
}

void AddBoundaryPlace(const Model<2>&, const OutputMap&, vtkUnstructuredGrid*) {}

void AddBoundaryPlace(const Model<3>& model, const OutputMap& map, vtkUnstructuredGrid* output)
{
  vtkNew<vtkIntArray> places;
  places->SetName("BoundaryPlace");
  places->SetNumberOfValues(static_cast<vtkIdType>(map.PointToSlot.size()));
  for (std::size_t id = 0; id < map.PointToSlot.size(); ++id)
  {
    const Index p = map.PointToSlot[id];
    using meshopt::Freedom;
    // The values that the documentation gives.
    static_assert(static_cast<int>(Freedom::Free) == 0 && static_cast<int>(Freedom::Patch) == 1 &&
      static_cast<int>(Freedom::Curve) == 2 && static_cast<int>(Freedom::Corner) == 3);
    const Freedom freedom = model.Mesh.isPointAlive(p) ? model.Mesh.freedom(p) : Freedom::Fixed;
    // Users need not know which corners have some room.
    places->SetValue(static_cast<vtkIdType>(id),
      static_cast<int>(freedom == Freedom::Fixed ? Freedom::Corner : freedom));
  }
  output->GetPointData()->AddArray(places);
}

} // namespace vtkMeshOptimizeBridge
