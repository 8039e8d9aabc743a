// SPDX-License-Identifier: BSD-3-Clause
// Lines on the surface are parts of its curves. Each edge of such a curve knows, by its parameter,
// the edge of the input that it lies on, and so the line whose data it gets.
#include "Boundary/vtkMeshOptimizeRidingLines.h"

#include "Boundary/vtkMeshOptimizeRiding.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellType.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/Ids.h"

#include <algorithm>
#include <tuple>

namespace vtkMeshOptimizeBridge
{

using meshopt::Facet;
using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

using Edge = std::array<Index, 2>;
using Lines = std::vector<std::pair<Edge, vtkIdType>>;

/**
 * The number of the entry with these points, or -1.
 */
template <class Key>
std::ptrdiff_t FindEntry(const std::vector<std::pair<Key, vtkIdType>>& entries, const Key& key)
{
  const auto found = std::lower_bound(entries.begin(), entries.end(), key,
    [](const auto& entry, const Key& k) { return entry.first < k; });
  return found != entries.end() && found->first == key ? found - entries.begin() : -1;
}

/**
 * All lines of the grid whose two points no other line has.
 */
Lines ListLines(vtkUnstructuredGrid* grid)
{
  Lines all;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    if (grid->GetCellType(c) == VTK_LINE)
    {
      grid->GetCellPoints(c, n, ids);
    }
    if (n == 2 && ids[0] != ids[1])
    {
      all.emplace_back(
        meshopt::sortedIds(static_cast<Index>(ids[0]), static_cast<Index>(ids[1])), c);
    }
  }
  return WithoutTwins(all);
}

/// A face of a tetrahedron that has a line as an edge: number of the line, sorted points, region.
using FaceAtLine = std::tuple<std::ptrdiff_t, Facet<3>, Index>;

/**
 * The faces at the lines, each once for each of its tetrahedra; in ascending order.
 */
std::vector<FaceAtLine> ListFacesAtLines(const Lines& lines, const Model<3>& model)
{
  std::vector<FaceAtLine> faces;
  const std::vector<Index> regions = vtkMeshBridge::ReadRegions(model.Arrays.Region, model.Cells);
  for (std::size_t k = 0; k < model.Cells.Simplices.size(); ++k)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    model.Grid->GetCellPoints(model.Cells.Simplices[k], n, ids);
    for (const auto& e : meshopt::Local<3>::edges)
    {
      // Most edges have a point that no line uses: they need no search.
      const bool mayBe = (model.Cells.PointUse[ids[e[0]]] & model.Cells.PointUse[ids[e[1]]] &
                           vtkMeshBridge::UsedByOther) != 0;
      const Index a = static_cast<Index>(ids[e[0]]), b = static_cast<Index>(ids[e[1]]);
      const std::ptrdiff_t line = mayBe ? FindEntry(lines, meshopt::sortedIds(a, b)) : -1;
      for (int i = 0; i < 4 && line >= 0; ++i)
      {
        const Index c = static_cast<Index>(ids[i]);
        if (c != a && c != b)
        {
          faces.emplace_back(
            line, meshopt::sortedIds(Facet<3>{ a, b, c }), regions.empty() ? 0 : regions[k]);
        }
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

} // namespace

std::vector<std::pair<std::array<Index, 2>, vtkIdType>> FindRidingLines(const Model<3>& model)
{
  const Lines lines = ListLines(model.Grid);
  std::vector<char> isOnSurface(lines.size(), 0);
  const std::vector<FaceAtLine> faces = lines.empty() ? std::vector<FaceAtLine>()
                                                      : ListFacesAtLines(lines, model);
  for (std::size_t first = 0, last = 0; first < faces.size(); first = last)
  {
    const auto& [line, face, region] = faces[first];
    bool isKept = FindEntry(model.Riding, face) >= 0;
    for (; last < faces.size() && std::get<0>(faces[last]) == line &&
         std::get<1>(faces[last]) == face;
         ++last)
    {
      isKept = isKept || std::get<2>(faces[last]) != region;
    }
    // With one tetrahedron: an outer face.
    isOnSurface[line] |= static_cast<char>(isKept || last == first + 1);
  }
  Lines riding;
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    if (isOnSurface[k])
    {
      riding.push_back(lines[k]);
    }
  }
  return riding;
}

namespace
{

/**
 * All edges that the mesh keeps by themselves, each once.
 */
std::vector<Edge> ListKeptEdges(const SimplexMesh<3>& mesh)
{
  std::vector<Edge> edges;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int e = 0; e < 6 && mesh.isAlive(c); ++e)
    {
      if (mesh.isEdgeKeptByItself(c, e))
      {
        const auto& local = meshopt::Local<3>::edges[e];
        edges.push_back(meshopt::sortedIds(mesh.nodes(c)[local[0]], mesh.nodes(c)[local[1]]));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/**
 * The edge with its points in the direction of the line that it lies on.
 */
Edge DirectedLike(const Model<3>& model, vtkIdType source, Edge edge)
{
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  model.Grid->GetCellPoints(source, n, ids);
  meshopt::Vec<3> a, b;
  model.Grid->GetPoint(ids[0], a.data());
  model.Grid->GetPoint(ids[1], b.data());
  // An edge never turns back from its curve: see SpaceCurve::deviation().
  if ((model.Mesh.point(edge[1]) - model.Mesh.point(edge[0])).dot(b - a) < 0.0)
  {
    std::swap(edge[0], edge[1]);
  }
  return edge;
}

} // namespace

std::vector<NewLine> FindNewLines(
  const Model<3>& model, const meshopt::SlidingSurface& surface, std::vector<char>& isGone)
{
  std::vector<NewLine> lines;
  if (model.RidingLines.empty())
  {
    return lines;
  }
  for (const auto& entry : model.RidingLines)
  {
    isGone[entry.second] = 1;
  }
  for (const Edge& edge : ListKeptEdges(model.Mesh))
  {
    // What is on no curve that may change stays: it lies on itself.
    const Edge origin = surface.inputEdge(model.Mesh, edge[0], edge[1]).value_or(edge);
    const std::ptrdiff_t k = FindEntry(model.RidingLines, origin);
    if (k < 0)
    {
      continue;
    }
    const vtkIdType source = model.RidingLines[k].second;
    if (origin == edge)
    {
      isGone[source] = 0;
      continue;
    }
    lines.push_back({ DirectedLike(model, source, edge), source });
  }
  return lines;
}

} // namespace vtkMeshOptimizeBridge
