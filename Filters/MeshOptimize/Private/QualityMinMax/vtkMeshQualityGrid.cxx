// SPDX-License-Identifier: BSD-3-Clause
// A grid as it is measured: unlike the optimizer, this takes curved cells by their corners,
// triangles in space, and cells that cannot be used, which get NaN.
#include "QualityMinMax/vtkMeshQualityGrid.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeValues.h"

#include "Metric/TensorFunctions.h"

#include "vtkDataArray.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

namespace vtkMeshQualityBridge
{
namespace
{

constexpr vtkIdType Grain = 8192;

} // namespace

//------------------------------------------------------------------------------
Grid::Grid(vtkUnstructuredGrid* grid)
  : View(grid)
{
  this->CountKinds();
  // Beside tetrahedra each triangle is measured in a plane of its own.
  if (this->HasTriangles() && !this->HasTetrahedra())
  {
    this->FindPlane();
  }
}

//------------------------------------------------------------------------------
std::string Grid::Read(const vtkMeshOptimizeBridge::InputArrays& arrays, bool useSizes)
{
  if (this->GetNumberOfCells() == 0)
  {
    return {};
  }
  const vtkIdType points = this->GetNumberOfPoints();
  std::string error = arrays.Region
    ? vtkMeshBridge::CheckLength(arrays.Region, this->GetNumberOfCells(), "cell")
    : std::string();
  for (vtkDataArray* array : { arrays.Size, arrays.Metric })
  {
    if (error.empty() && array)
    {
      error = vtkMeshBridge::CheckLength(array, points, "point");
    }
  }
  error = error.empty() ? this->CheckExtent() : error;
  if (error.empty() && arrays.Region)
  {
    this->ReadRegions(arrays.Region);
  }
  if (error.empty() && arrays.Size && useSizes)
  {
    error = this->ReadSizes(arrays.Size);
  }
  if (error.empty() && arrays.Metric)
  {
    error = this->IsFlat()
      ? this->ReadMetric(arrays.Metric, this->Frame, this->LogTensors2)
      : this->ReadMetric(arrays.Metric, vtkMeshBridge::Frame<3>(), this->LogTensors3);
  }
  return error;
}

//------------------------------------------------------------------------------
void Grid::CountKinds()
{
  for (vtkIdType c = 0; c < this->GetNumberOfCells(); ++c)
  {
    const Kind kind = this->GetKind(c);
    this->NumberOfTetrahedra += kind == Kind::Tetrahedron ? 1 : 0;
    this->NumberOfTriangles += kind == Kind::Triangle ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> Grid::ListTriangles(bool areGhosts) const
{
  std::vector<vtkIdType> triangles;
  for (vtkIdType c = 0; c < this->GetNumberOfCells(); ++c)
  {
    vtkIdType ids[3];
    if (this->GetKind(c) == Kind::Triangle && this->IsGhost(c) == areGhosts &&
      this->GetCorners(c, 3, ids) &&
      std::all_of(ids, ids + 3, [&](vtkIdType p) { return this->GetPoint(p).allFinite(); }))
    {
      triangles.push_back(c);
    }
  }
  return triangles;
}

/**
 * The plane is that of the triangles that count, since these are judged. Ghosts must lie in it,
 * too, since they are measured in it.
 */
void Grid::FindPlane()
{
  std::vector<vtkIdType> triangles = this->ListTriangles(false), ghosts = this->ListTriangles(true);
  if (triangles.empty())
  {
    // Nothing but ghosts: their plane will do.
    triangles.swap(ghosts);
  }
  if (triangles.empty())
  {
    return;
  }
  const vtkMeshBridge::Plane plane = vtkMeshBridge::FindPlane(this->View, triangles);
  const auto isInPlane = [&](vtkIdType triangle)
  {
    vtkIdType ids[3] = {};
    this->GetCorners(triangle, 3, ids);
    return std::all_of(ids, ids + 3, [&](vtkIdType p) { return plane.Has(this->GetPoint(p)); });
  };
  this->Frame = plane.Frame;
  this->Flat = plane.HasAll() && std::all_of(ghosts.begin(), ghosts.end(), isInPlane);
}

//------------------------------------------------------------------------------
/**
 * First checks all points, which is fast; only if they do not pass, those that count.
 */
std::string Grid::CheckExtent() const
{
  vtkMeshBridge::Box all;
  for (vtkIdType p = 0; p < this->GetNumberOfPoints(); ++p)
  {
    all.Add(this->GetPoint(p));
  }
  if (vtkMeshBridge::CheckExtent(all).empty())
  {
    return {};
  }
  // Points of ghosts, or of no cell, may lie anywhere.
  const std::vector<bool> used = this->FindUsedPoints();
  vtkMeshBridge::Box box;
  for (vtkIdType p = 0; p < this->GetNumberOfPoints(); ++p)
  {
    if (used[p])
    {
      box.Add(this->GetPoint(p));
    }
  }
  return vtkMeshBridge::CheckExtent(box);
}

//------------------------------------------------------------------------------
void Grid::ReadRegions(vtkDataArray* array)
{
  this->RegionArrayGiven = true;
  const std::vector<long long> values = vtkMeshBridge::ReadIntegers(array);
  this->Regions = vtkMeshBridge::FindDistinct(values);
  this->RegionOfCell.resize(values.size());
  std::transform(values.begin(), values.end(), this->RegionOfCell.begin(),
    [this](long long value) { return vtkMeshBridge::FindRank(this->Regions, value); });
}

//------------------------------------------------------------------------------
/**
 * Points of the simplices that count: ghosts do not.
 */
std::vector<bool> Grid::FindUsedPoints() const
{
  std::vector<bool> used(this->GetNumberOfPoints(), false);
  for (vtkIdType c = 0; c < this->GetNumberOfCells(); ++c)
  {
    vtkIdType ids[4];
    const Kind kind = this->GetKind(c);
    const int n = kind == Kind::Tetrahedron ? 4 : 3;
    if (kind != Kind::Other && !this->IsGhost(c) && this->GetCorners(c, n, ids))
    {
      for (int k = 0; k < n; ++k)
      {
        used[ids[k]] = true;
      }
    }
  }
  return used;
}

//------------------------------------------------------------------------------
std::string Grid::ReadSizes(vtkDataArray* array)
{
  const std::vector<bool> used = this->FindUsedPoints();
  this->LogSizes = vtkMeshBridge::ReadSizes(array);
  for (vtkIdType p = 0; p < this->GetNumberOfPoints(); ++p)
  {
    const double size = this->LogSizes[p];
    this->LogSizes[p] = vtkMeshBridge::LogOfSize(size);
    if (used[p] && std::isnan(this->LogSizes[p]))
    {
      std::ostringstream text;
      text << "The size array '" << array->GetName() << "' is " << size << " at point " << p
           << "; sizes must be positive and finite.";
      return text.str();
    }
  }
  return {};
}

//------------------------------------------------------------------------------
/**
 * Only tensors of cells that count must be usable. Those of the others become NaN if they are not.
 */
template <int D>
std::string Grid::ReadMetric(
  vtkDataArray* array, const vtkMeshBridge::Frame<D>& frame, std::vector<meshopt::Tensor<D>>& logs)
{
  const std::vector<bool> used = this->FindUsedPoints();
  logs.assign(this->GetNumberOfPoints(),
    meshopt::Tensor<D>::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::atomic<vtkIdType> firstBad(this->GetNumberOfPoints());
  vtkSMPTools::For(0, this->GetNumberOfPoints(), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const meshopt::Tensor<D> m = vtkMeshBridge::ReadTensor(array, p, frame);
        if (!meshopt::logarithm<D>(m, logs[p]) && used[p])
        {
          // The lowest id: the message must not depend on the threads.
          vtkIdType known = firstBad.load();
          while (p < known && !firstBad.compare_exchange_weak(known, p))
          {
          }
        }
      }
    });
  if (firstBad < this->GetNumberOfPoints())
  {
    std::ostringstream text;
    text << "The metric array '" << array->GetName() << "' is not symmetric, finite and positive "
         << "definite, with eigenvalues from 1e-200 to 1e200, at point " << firstBad << ".";
    return text.str();
  }
  return {};
}

} // namespace vtkMeshQualityBridge
