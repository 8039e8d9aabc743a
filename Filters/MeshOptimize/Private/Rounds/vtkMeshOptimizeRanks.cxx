// SPDX-License-Identifier: BSD-3-Clause
// Whether pieces of several ranks can be optimized as one mesh, and the order of the work. Whatever
// is decided here is decided by all ranks alike: it depends on gathered facts only.
#include "Rounds/vtkMeshOptimizeRanks.h"

#include "Ranks/vtkMeshRanksNode.h"
#include "Ranks/vtkMeshRanksPart.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "Rounds/vtkMeshOptimizeRounds.h"
#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeGridView.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <chrono>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

/**
 * What of the request is not built for borders. The same on all ranks.
 */
std::string FindObstacle(const Request& request)
{
  // Without Beta a boundary that is kept does not look at sizes.
  const bool hasSizes = request.Options.desiredSize > 0.0 ||
    vtkMeshBridge::IsWanted(request.Filter, SizeArray);
  return request.Options.beta > 0.0 || (request.Slide && hasSizes) ||
      vtkMeshBridge::IsWanted(request.Filter, MetricArray)
    ? "sizes or a metric are used"
    : "";
}

/**
 * Whether the cells beside the simplices are nothing but copies of other ranks' simplices. Hidden
 * cells are no copies: dropped, they would be lost.
 */
bool HasOnlyCopies(vtkUnstructuredGrid* input, const vtkMeshBridge::Cells& cells)
{
  if (static_cast<vtkIdType>(cells.Simplices.size()) + cells.NumberOfGhostSimplices !=
    cells.NumberOfCells)
  {
    return false;
  }
  const vtkMeshBridge::GhostCells ghosts(input);
  for (vtkIdType c = 0; c < cells.NumberOfCells; ++c)
  {
    if (ghosts.IsHidden(c))
    {
      return false;
    }
  }
  vtkUnsignedCharArray* points = input->GetPointGhostArray();
  for (vtkIdType p = 0; points && p < points->GetNumberOfValues(); ++p)
  {
    if (points->GetValue(p) & vtkDataSetAttributes::HIDDENPOINT)
    {
      return false;
    }
  }
  return true;
}

/**
 * What of this rank's piece is not built for borders. Finds its cells.
 */
std::string FindObstacle(
  vtkUnstructuredGrid* input, vtkMeshBridge::Cells& cells, std::string& error)
{
  error = vtkMeshBridge::ClassifyCells(input, cells);
  if (!error.empty() || !HasOnlyCopies(input, cells))
  {
    return "there are other cells than tetrahedra, or than triangles in a plane";
  }
  // Points, then cells.
  for (int kind : { 0, 1 })
  {
    vtkDataSetAttributes* data = input->GetAttributes(kind);
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (!CanPack(data->GetAbstractArray(i)))
      {
        return "an array cannot be sent";
      }
    }
  }
  return {};
}

/**
 * Arrays must be the same on all ranks that have cells.
 */
std::string CompareArrays(const Ranks& ranks, vtkUnstructuredGrid* input)
{
  Bytes arrays;
  if (input->GetNumberOfCells() > 0)
  {
    for (int kind : { 0, 1 })
    {
      vtkDataSetAttributes* data = input->GetAttributes(kind);
      // Global ids are no part of a schema, but all ranks must have them, or none.
      Put(arrays, data->GetGlobalIds() != nullptr);
      const Bytes schema = Schema::Of(
        data, kind == 1 ? Schema::Qualities::LeftOut : Schema::Qualities::Listed)
                             .Describe();
      arrays.insert(arrays.end(), schema.begin(), schema.end());
    }
  }
  Bytes common;
  for (const Bytes& one : ranks.Gather(arrays))
  {
    if (!one.empty() && !common.empty() && one != common)
    {
      return "ranks have different arrays";
    }
    // The first rank with cells says what the others must have.
    common = common.empty() ? one : common;
  }
  return {};
}

std::string FindObstacle(const Ranks& ranks, const Request& request, vtkUnstructuredGrid* input,
  vtkMeshBridge::Cells& cells, int& dimension)
{
  std::string error, obstacle = FindObstacle(request);
  if (obstacle.empty())
  {
    // A rank that has found an obstacle goes on until all know of it: the others wait for it.
    obstacle = FindObstacle(input, cells, error);
    ranks.Agree(error);
    const int mine = cells.Dimension;
    const std::vector<int> all = ranks.Gather(mine);
    // Ranks without cells have dimension 0.
    dimension = *std::max_element(all.begin(), all.end());
    const bool isMixed = mine != 0 && mine != dimension;
    obstacle = isMixed ? "some ranks have triangles only, others tetrahedra" : obstacle;
    if (request.Slide && dimension == 3)
    {
      obstacle = "the surface of tetrahedra slides on one rank only";
    }
    const std::string arrays = CompareArrays(ranks, input);
    obstacle = obstacle.empty() ? arrays : obstacle;
  }
  // The first sentence, on all ranks: each then takes the same way.
  for (const Bytes& bytes : ranks.Gather(Bytes(obstacle.begin(), obstacle.end())))
  {
    if (!bytes.empty())
    {
      return { bytes.begin(), bytes.end() };
    }
  }
  return {};
}

} // namespace

//------------------------------------------------------------------------------
std::string OptimizeOnRanks(vtkMultiProcessController* controller, Request& request,
  const std::function<std::string()>& check, vtkUnstructuredGrid* input,
  vtkUnstructuredGrid* output, Outcome& outcome, std::string& obstacle)
{
  const Ranks ranks(controller);
  return ranks.Together(
    [&]()
    {
      request.HasGeometryCorners = ranks.IsAny(request.HasGeometryCorners);
      ranks.Agree(check());
      // Each rank for itself would take all cores of the computer.
      if (request.NumberOfThreads <= 0)
      {
        request.NumberOfThreads = GetShareOfCores(ranks);
      }
      int dimension = 0;
      vtkMeshBridge::Cells cells;
      obstacle = FindObstacle(ranks, request, input, cells, dimension);
      if (!obstacle.empty())
      {
        return std::string();
      }
      Rounds rounds(ranks, request, outcome);
      // Without any cells the dimension does not matter.
      obstacle = rounds.Read(input, cells.Simplices, dimension == 0 ? 3 : dimension);
      if (!obstacle.empty())
      {
        return std::string();
      }
      cells = {}; // the lists of a whole piece are not needed any more
      const auto start = std::chrono::steady_clock::now();
      rounds.OptimizePieces();
      rounds.OptimizeBorders();
      rounds.SendHome();
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
      outcome.Seconds = spent.count();
      rounds.Write(input, output);
      return std::string();
    });
}

} // namespace vtkMeshOptimizeBridge
