// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshQualityGrid.h"

#include "vtkMeshBridgeFrame.h"

#include "Metric/TensorFunctions.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

namespace vtkMeshQuality
{
namespace
{

constexpr vtkIdType Grain = 8192;

std::array<Kind, 256> MakeKinds()
{
  std::array<Kind, 256> kinds;
  kinds.fill(Kind::Other);
  for (int type : { VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE, VTK_BIQUADRATIC_TRIANGLE,
         VTK_LAGRANGE_TRIANGLE, VTK_BEZIER_TRIANGLE, VTK_HIGHER_ORDER_TRIANGLE })
  {
    kinds[type] = Kind::Triangle;
  }
  for (int type : { VTK_TETRA, VTK_QUADRATIC_TETRA, VTK_LAGRANGE_TETRAHEDRON,
         VTK_BEZIER_TETRAHEDRON, VTK_HIGHER_ORDER_TETRAHEDRON })
  {
    kinds[type] = Kind::Tetrahedron;
  }
  return kinds;
}

template <class T>
const T* PointerOf(vtkDataArray* array)
{
  auto* typed = vtkAOSDataArrayTemplate<T>::SafeDownCast(array);
  return typed ? typed->GetPointer(0) : nullptr;
}

std::vector<vtkTypeInt64> CopyOf(vtkDataArray* array)
{
  std::vector<vtkTypeInt64> copy(array->GetNumberOfValues());
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    copy[i] = static_cast<vtkTypeInt64>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return copy;
}

/**
 * Components of a VTK tensor, 6 (XX YY ZZ XY YZ XZ) or 9.
 */
meshopt::Tensor<3> TensorOf(const double* t, int numberOfComponents)
{
  meshopt::Tensor<3> m;
  if (numberOfComponents == 6)
  {
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  }
  else
  {
    m << t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8];
  }
  return m;
}

} // namespace

const std::array<Kind, 256> Grid::Kinds = MakeKinds();

//------------------------------------------------------------------------------
std::string Grid::Read(
  vtkUnstructuredGrid* grid, const vtkMeshOptimizeBridge::InputArrays& arrays, bool useSizes)
{
  this->NumberOfCells = grid->GetNumberOfCells();
  this->NumberOfPoints = grid->GetNumberOfPoints();
  if (this->NumberOfCells == 0)
  {
    return {};
  }
  this->ReadCells(grid);
  this->ReadPoints(grid);
  this->CountKinds();
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  if (ghosts && ghosts->GetNumberOfTuples() >= this->NumberOfCells)
  {
    this->Ghosts = ghosts->GetPointer(0);
  }
  const struct
  {
    vtkDataArray* Array;
    vtkIdType Wanted;
    const char* Noun;
  } checks[] = { { arrays.Region, this->NumberOfCells, "cells" },
    { arrays.Size, this->NumberOfPoints, "points" },
    { arrays.Metric, this->NumberOfPoints, "points" } };
  for (const auto& check : checks)
  {
    if (check.Array && check.Array->GetNumberOfTuples() != check.Wanted)
    {
      std::ostringstream text;
      text << "The array '" << check.Array->GetName() << "' has "
           << check.Array->GetNumberOfTuples() << " values, but the grid has " << check.Wanted
           << " " << check.Noun << ".";
      return text.str();
    }
  }
  meshopt::Vec<3> low = meshopt::Vec<3>::Constant(std::numeric_limits<double>::infinity());
  meshopt::Vec<3> high = -low;
  for (vtkIdType p = 0; p < this->NumberOfPoints; ++p)
  {
    low = low.cwiseMin(this->GetPoint(p));
    high = high.cwiseMax(this->GetPoint(p));
  }
  std::string error = vtkMeshOptimizeBridge::CheckExtent(low, high);
  if (!error.empty())
  {
    return error;
  }
  if (arrays.Region)
  {
    this->ReadRegions(arrays.Region);
  }
  if (arrays.Size && useSizes)
  {
    error = this->ReadSizes(arrays.Size);
  }
  if (error.empty() && arrays.Metric)
  {
    error = this->ReadMetric(arrays.Metric);
  }
  return error;
}

//------------------------------------------------------------------------------
void Grid::ReadCells(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  if (types && types->GetNumberOfTuples() >= this->NumberOfCells)
  {
    this->Types = types->GetPointer(0);
    this->Kept = types;
  }
  else
  {
    this->TypeCopy.resize(this->NumberOfCells);
    for (vtkIdType c = 0; c < this->NumberOfCells; ++c)
    {
      this->TypeCopy[c] = static_cast<unsigned char>(grid->GetCellType(c));
    }
    this->Types = this->TypeCopy.data();
  }
  vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
  vtkDataArray* offsets = grid->GetCells()->GetOffsetsArray();
  this->Narrow = { PointerOf<vtkTypeInt32>(ids), PointerOf<vtkTypeInt32>(offsets),
    ids->GetNumberOfValues() };
  this->Wide = { PointerOf<vtkTypeInt64>(ids), PointerOf<vtkTypeInt64>(offsets),
    ids->GetNumberOfValues() };
  if (this->Narrow.Ids && this->Narrow.Offsets)
  {
    this->Wide.Ids = nullptr;
  }
  else if (!this->Wide.Ids || !this->Wide.Offsets)
  {
    this->IdCopy = CopyOf(ids);
    this->OffsetCopy = CopyOf(offsets);
    this->Wide = { this->IdCopy.data(), this->OffsetCopy.data(), ids->GetNumberOfValues() };
  }
}

//------------------------------------------------------------------------------
void Grid::ReadPoints(vtkUnstructuredGrid* grid)
{
  if (this->NumberOfPoints == 0)
  {
    return;
  }
  vtkDataArray* points = grid->GetPoints()->GetData();
  this->Points = PointerOf<double>(points);
  if (this->Points)
  {
    return;
  }
  this->PointCopy.resize(3 * this->NumberOfPoints);
  if (const float* single = PointerOf<float>(points))
  {
    std::copy(single, single + this->PointCopy.size(), this->PointCopy.begin());
  }
  else
  {
    for (vtkIdType p = 0; p < this->NumberOfPoints; ++p)
    {
      points->GetTuple(p, &this->PointCopy[3 * p]);
    }
  }
  this->Points = this->PointCopy.data();
}

//------------------------------------------------------------------------------
void Grid::CountKinds()
{
  for (vtkIdType c = 0; c < this->NumberOfCells; ++c)
  {
    const Kind kind = this->GetKind(c);
    this->NumberOfTetrahedra += kind == Kind::Tetrahedron ? 1 : 0;
    this->NumberOfTriangles += kind == Kind::Triangle ? 1 : 0;
  }
  this->Flat = this->NumberOfTriangles > 0 && this->NumberOfTetrahedra == 0;
  bool first = true;
  double z = 0.0;
  for (vtkIdType c = 0; this->Flat && c < this->NumberOfCells; ++c)
  {
    vtkIdType ids[3];
    if (this->GetKind(c) == Kind::Triangle && this->GetCorners(c, 3, ids))
    {
      z = first ? this->Points[3 * ids[0] + 2] : z;
      first = false;
      for (vtkIdType p : ids)
      {
        // a coordinate that is not a number does not make a surface of a plane mesh
        this->Flat = this->Flat && !(std::fabs(this->Points[3 * p + 2] - z) > 0.0);
      }
    }
  }
}

//------------------------------------------------------------------------------
void Grid::ReadRegions(vtkDataArray* array)
{
  this->RegionArrayGiven = true;
  const bool isSmall = array->GetDataTypeSize() < 8;
  std::vector<long long> values(this->NumberOfCells);
  for (vtkIdType c = 0; c < this->NumberOfCells; ++c)
  {
    values[c] = isSmall ? static_cast<long long>(array->GetComponent(c, 0))
                        : array->GetVariantValue(c).ToLongLong();
    if (this->Regions.empty() || values[c] != this->Regions.back())
    {
      this->Regions.push_back(values[c]);
    }
  }
  std::sort(this->Regions.begin(), this->Regions.end());
  this->Regions.erase(std::unique(this->Regions.begin(), this->Regions.end()), this->Regions.end());
  this->RegionOfCell.resize(this->NumberOfCells);
  for (vtkIdType c = 0; c < this->NumberOfCells; ++c)
  {
    const auto at = std::lower_bound(this->Regions.begin(), this->Regions.end(), values[c]);
    this->RegionOfCell[c] = static_cast<int>(at - this->Regions.begin());
  }
}

//------------------------------------------------------------------------------
std::vector<bool> Grid::FindUsedPoints() const
{
  std::vector<bool> used(this->NumberOfPoints, false);
  for (vtkIdType c = 0; c < this->NumberOfCells; ++c)
  {
    vtkIdType ids[4];
    const Kind kind = this->GetKind(c);
    const int n = kind == Kind::Tetrahedron ? 4 : 3;
    if (kind != Kind::Other && this->GetCorners(c, n, ids))
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
  this->LogSizes.assign(this->NumberOfPoints, 0.0);
  for (vtkIdType p = 0; p < this->NumberOfPoints; ++p)
  {
    const double size = array->GetComponent(p, 0);
    if (used[p] && !(size > 0.0 && std::isfinite(size)))
    {
      std::ostringstream text;
      text << "The size array '" << array->GetName() << "' is " << size << " at point " << p
           << "; sizes must be positive and finite.";
      return text.str();
    }
    this->LogSizes[p] = used[p] ? std::log(size) : 0.0;
  }
  return {};
}

//------------------------------------------------------------------------------
std::string Grid::ReadMetric(vtkDataArray* array)
{
  const std::vector<bool> used = this->FindUsedPoints();
  const int n = array->GetNumberOfComponents();
  this->LogTensors.assign(this->NumberOfPoints, meshopt::Tensor<3>::Zero());
  std::atomic<vtkIdType> firstBad(this->NumberOfPoints);
  vtkSMPTools::For(0, this->NumberOfPoints, Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        double t[9];
        array->GetTuple(p, t);
        meshopt::Tensor<3> m = TensorOf(t, n);
        if (this->Flat)
        {
          // only the plane's part counts, so that a 2D metric need not say anything about z
          m.row(2).setZero();
          m.col(2).setZero();
          m(2, 2) = 1.0;
        }
        if (used[p] && !meshopt::logarithm<3>(m, this->LogTensors[p]))
        {
          vtkIdType known = firstBad.load();
          while (p < known && !firstBad.compare_exchange_weak(known, p))
          {
          }
        }
      }
    });
  if (firstBad < this->NumberOfPoints)
  {
    std::ostringstream text;
    text << "The metric array '" << array->GetName() << "' is not symmetric, finite and positive "
         << "definite at point " << firstBad << ".";
    return text.str();
  }
  return {};
}

} // namespace vtkMeshQuality
