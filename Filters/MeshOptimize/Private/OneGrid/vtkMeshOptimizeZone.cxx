// SPDX-License-Identifier: BSD-3-Clause
// Only a part of the mesh may change: it becomes a mesh of its own, whose surface is kept like any
// other, and the rest is added to the report.
#include "OneGrid/vtkMeshOptimizeZone.h"

#include "Grid/vtkMeshOptimizeImport.h"

#include "vtkUnstructuredGrid.h"

#include "Quality/ElementQuality.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace vtkMeshOptimizeBridge
{

using meshopt::Index;
using meshopt::SimplexMesh;

namespace
{

/**
 * Not those stored in the mesh: only a run computes these.
 */
template <int D>
std::vector<double> Qualities(const Model<D>& model, const meshopt::Options& options)
{
  const SimplexMesh<D>& mesh = model.Mesh;
  std::vector<double> values(mesh.numberOfInputCells());
  meshopt::dispatch<D>(options.measure,
    [&](auto shape)
    {
      const meshopt::ElementQuality<D, decltype(shape)> quality{ options.beta };
      for (Index k = 0; k < mesh.numberOfInputCells(); ++k)
      {
        values[k] = quality.value(mesh.corners(k), model.Metric.element(mesh.nodes(k)));
      }
    });
  return values;
}

/**
 * The core swaps the last two nodes of a cell that it renumbers.
 */
template <int D>
bool IsReversed(vtkUnstructuredGrid* grid, vtkIdType cell, const meshopt::Simplex<D>& nodes)
{
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cell, n, ids);
  return static_cast<Index>(ids[D]) != nodes[D];
}

/**
 * Marks the points of the cells in `isInside`.
 */
template <int D>
std::vector<char> MarkPoints(const SimplexMesh<D>& mesh, const std::vector<char>& isInside)
{
  std::vector<char> isMarked(mesh.numberOfPointSlots(), 0);
  for (Index k = 0; k < mesh.numberOfInputCells(); ++k)
  {
    for (Index p : mesh.nodes(k))
    {
      isMarked[p] |= isInside[k];
    }
  }
  return isMarked;
}

/**
 * Adds the cells that share a node with those in `isInside`. Returns whether there were any.
 */
template <int D>
bool AddLayer(const SimplexMesh<D>& mesh, std::vector<char>& isInside)
{
  const std::vector<char> isTouched = MarkPoints(mesh, isInside);
  bool added = false;
  for (Index k = 0; k < mesh.numberOfInputCells(); ++k)
  {
    const auto& nodes = mesh.nodes(k);
    const bool touches = std::any_of(
      nodes.begin(), nodes.end(), [&](Index p) { return isTouched[p] != 0; });
    added |= touches && !isInside[k];
    // Cells inside touch themselves: none is lost.
    isInside[k] = touches;
  }
  return added;
}

template <int D>
LeftOut SumUp(const SimplexMesh<D>& mesh, const std::vector<double>& qualities, double target,
  const std::vector<char>& isInside)
{
  LeftOut rest;
  rest.Worst = std::numeric_limits<double>::infinity();
  // Points of the zone are counted by its own run.
  std::vector<char> isKnown = MarkPoints(mesh, isInside);
  for (Index k = 0; k < mesh.numberOfInputCells(); ++k)
  {
    if (!isInside[k])
    {
      for (Index p : mesh.nodes(k))
      {
        rest.NumberOfPoints += !std::exchange(isKnown[p], 1);
      }
      ++rest.NumberOfCells;
      rest.BelowTarget += qualities[k] < target;
      rest.Worst = std::min(rest.Worst, qualities[k]);
      rest.Sum += qualities[k];
    }
  }
  return rest;
}

/**
 * The cells that may change: those under the threshold, and layers around them.
 */
template <int D>
std::vector<char> MarkZone(
  const Request& request, const Model<D>& model, const std::vector<double>& qualities)
{
  std::vector<char> isInside(qualities.size());
  bool grows = false;
  for (Index k = 0; k < model.Mesh.numberOfInputCells(); ++k)
  {
    // What is outside passes through as the grid numbers it: cells that were renumbered are inside.
    isInside[k] = qualities[k] < request.OptimizeBelow ||
      IsReversed<D>(model.Grid, model.Cells.Simplices[k], model.Mesh.nodes(k));
    grows |= isInside[k] != 0;
  }
  for (int layer = 0; layer < request.NumberOfLayers && grows; ++layer)
  {
    grows = AddLayer(model.Mesh, isInside);
  }
  return isInside;
}

/**
 * Removes simplices from the list. `isKept` has one value for each simplex; those with false pass
 * through from now on, like ghost cells.
 */
void KeepSimplices(
  vtkUnstructuredGrid* grid, const std::vector<char>& isKept, vtkMeshBridge::Cells& cells)
{
  // Points of what is left out count as used by others, like those of ghosts: so the border of the
  // zone is held.
  for (std::uint8_t& use : cells.PointUse)
  {
    use &= static_cast<std::uint8_t>(~vtkMeshBridge::UsedBySimplex);
  }
  std::vector<vtkIdType> kept;
  for (std::size_t k = 0; k < isKept.size(); ++k)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(cells.Simplices[k], n, ids);
    for (vtkIdType i = 0; i < n; ++i)
    {
      cells.PointUse[ids[i]] |= isKept[k] ? vtkMeshBridge::UsedBySimplex
                                          : vtkMeshBridge::UsedByOther;
    }
    if (isKept[k])
    {
      kept.push_back(cells.Simplices[k]);
    }
  }
  cells.Simplices.swap(kept);
}

/**
 * Builds the mesh of the simplices inside: the model's cells now list only these.
 */
template <int D>
void BuildZone(const std::vector<char>& isInside, Model<D>& model)
{
  meshopt::MeshInput<D> input = ImportMesh(model);
  Index next = 0;
  for (Index k = 0; k < model.Mesh.numberOfInputCells(); ++k)
  {
    if (isInside[k])
    {
      input.cells[next++] = model.Mesh.nodes(k);
    }
  }
  // The whole mesh has been oriented. The volume of a part alone may mislead.
  input.isOriented = true;
  SimplexMesh<D>::build(input, model.Mesh); // cannot fail: the whole mesh was built before
}

} // namespace

template <int D>
LeftOut RestrictToZone(
  const Request& request, Model<D>& model, std::vector<meshopt::Simplex<D>>& others)
{
  const std::vector<double> qualities = Qualities(model, request.Options);
  const std::vector<char> isInside = MarkZone(request, model, qualities);
  const LeftOut rest = SumUp(model.Mesh, qualities, request.Options.targetQuality, isInside);
  for (Index k = 0; k < model.Mesh.numberOfInputCells(); ++k)
  {
    if (!isInside[k])
    {
      others.push_back(model.Mesh.nodes(k));
    }
  }
  if (!others.empty())
  {
    KeepSimplices(model.Grid, isInside, model.Cells);
    BuildZone(isInside, model);
  }
  return rest;
}

template <int D>
bool FitsTogether(const SimplexMesh<D>& zone, const std::vector<meshopt::Simplex<D>>& others)
{
  meshopt::MeshInput<D> input;
  input.cells = others;
  // Only facets are counted here: numbering does not matter.
  input.isOriented = true;
  for (Index p = 0; p < zone.numberOfPointSlots(); ++p)
  {
    input.points.push_back(zone.point(p));
  }
  for (Index c = 0; c < zone.numberOfCellSlots(); ++c)
  {
    if (zone.isAlive(c))
    {
      input.cells.push_back(zone.nodes(c));
    }
  }
  SimplexMesh<D> whole;
  // It refuses a facet with more than two cells.
  return !SimplexMesh<D>::build(input, whole);
}

/**
 * Rows of the history get the rest, too: they are about the whole mesh.
 */
void AddLeftOut(const LeftOut& rest, Outcome& outcome)
{
  if (rest.NumberOfCells == 0)
  {
    return;
  }
  const auto lower = [&](double& worst, vtkIdType cells)
  { worst = cells > 0 ? std::min(worst, rest.Worst) : rest.Worst; };
  const auto average = [&](double& mean, vtkIdType cells)
  {
    mean = (mean * static_cast<double>(cells) + rest.Sum) /
      static_cast<double>(cells + rest.NumberOfCells);
  };
  meshopt::Report& report = outcome.Report;
  for (meshopt::PassRecord& row : report.history)
  {
    lower(row.worst, row.cells);
    average(row.mean, row.cells);
    row.belowTarget += static_cast<long>(rest.BelowTarget);
    row.cells += static_cast<long>(rest.NumberOfCells);
    row.points += static_cast<long>(rest.NumberOfPoints);
  }
  lower(report.worstBefore, outcome.NumberOfCellsBefore);
  lower(report.worstAfter, outcome.NumberOfCells);
  average(report.meanBefore, outcome.NumberOfCellsBefore);
  average(report.meanAfter, outcome.NumberOfCells);
  // What is left out stays: nothing can lift the whole above its worst.
  report.bound = std::min(report.bound, rest.Worst);
  outcome.NumberOfCellsBefore += rest.NumberOfCells;
  outcome.NumberOfCells += rest.NumberOfCells;
}

template LeftOut RestrictToZone<2>(const Request&, Model<2>&, std::vector<meshopt::Simplex<2>>&);
template LeftOut RestrictToZone<3>(const Request&, Model<3>&, std::vector<meshopt::Simplex<3>>&);
template bool FitsTogether<2>(const SimplexMesh<2>&, const std::vector<meshopt::Simplex<2>>&);
template bool FitsTogether<3>(const SimplexMesh<3>&, const std::vector<meshopt::Simplex<3>>&);

} // namespace vtkMeshOptimizeBridge
