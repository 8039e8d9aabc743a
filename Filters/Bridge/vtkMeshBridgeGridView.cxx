// SPDX-License-Identifier: BSD-3-Clause
// A grid seen through plain pointers, which many threads may read. Arrays of a layout that is not
// known here are copied once.
#include "vtkMeshBridgeGridView.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

namespace vtkMeshBridge
{
namespace
{

std::array<Kind, 256> MakeKinds()
{
  std::array<Kind, 256> kinds;
  // Curved simplices have the kind of their corners: measured like straight ones, never optimized.
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

/**
 * Whether the values of `array` are stored contiguously as T.
 */
template <class T>
bool IsOf(vtkDataArray* array)
{
  return vtkAOSDataArrayTemplate<T>::SafeDownCast(array) != nullptr;
}

template <class T>
const T* PointerOf(vtkDataArray* array)
{
  return vtkAOSDataArrayTemplate<T>::SafeDownCast(array)->GetPointer(0);
}

/**
 * For arrays of another type or layout, which are rare: slow, but right for all.
 */
std::vector<vtkTypeInt64> CopyOf(vtkDataArray* array)
{
  std::vector<vtkTypeInt64> copy(array->GetNumberOfValues());
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    copy[i] = static_cast<vtkTypeInt64>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return copy;
}

} // namespace

const std::array<Kind, 256> GridView::Kinds = MakeKinds();

//------------------------------------------------------------------------------
GhostCells::GhostCells(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* flags = grid->GetCellGhostArray();
  // An array of another shape is no ghost array, whatever its name says.
  if (flags && flags->GetNumberOfComponents() == 1 &&
    flags->GetNumberOfTuples() >= grid->GetNumberOfCells())
  {
    this->Flags = flags->GetPointer(0);
  }
}

//------------------------------------------------------------------------------
GridView::GridView(vtkUnstructuredGrid* grid)
  : NumberOfCells(grid->GetNumberOfCells())
  , NumberOfPoints(grid->GetNumberOfPoints())
  , Ghosts(grid)
{
  if (this->NumberOfCells > 0)
  {
    this->ReadCells(grid);
  }
  if (this->NumberOfPoints > 0)
  {
    this->ReadPoints(grid);
  }
}

//------------------------------------------------------------------------------
/**
 * Points into the arrays of the grid where their layout allows it, and copies them otherwise.
 */
void GridView::ReadCells(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  // Kept: GetCellTypesArray() may hand out an array that nobody else holds.
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
      // Fewer types than cells: the grid is faulty, but must not be read beyond its end.
      const bool isThere = !types || c < types->GetNumberOfTuples();
      this->TypeCopy[c] = static_cast<unsigned char>(
        isThere ? grid->GetCellType(c) : VTK_EMPTY_CELL);
    }
    this->Types = this->TypeCopy.data();
  }
  vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
  vtkDataArray* offsets = grid->GetCells()->GetOffsetsArray();
  const vtkIdType length = ids->GetNumberOfValues();
  // Both of one width: then a pointer to each will do. Mixed ones are copied.
  if (IsOf<vtkTypeInt64>(ids) && IsOf<vtkTypeInt64>(offsets))
  {
    this->Wide = { PointerOf<vtkTypeInt64>(ids), PointerOf<vtkTypeInt64>(offsets), length };
  }
  else if (IsOf<vtkTypeInt32>(ids) && IsOf<vtkTypeInt32>(offsets))
  {
    this->Narrow = { PointerOf<vtkTypeInt32>(ids), PointerOf<vtkTypeInt32>(offsets), length };
  }
  else
  {
    this->IdCopy = CopyOf(ids);
    this->OffsetCopy = CopyOf(offsets);
    this->Wide = { this->IdCopy.data(), this->OffsetCopy.data(), length };
  }
}

//------------------------------------------------------------------------------
void GridView::ReadPoints(vtkUnstructuredGrid* grid)
{
  vtkDataArray* points = grid->GetPoints()->GetData();
  // All other types count as single precision, which is the safe side for tolerances.
  this->Precision = points->GetDataType() == VTK_DOUBLE
    ? std::numeric_limits<double>::epsilon()
    : static_cast<double>(std::numeric_limits<float>::epsilon());
  if (IsOf<double>(points))
  {
    this->Points = PointerOf<double>(points);
    return;
  }
  this->PointCopy.resize(3 * this->NumberOfPoints);
  if (IsOf<float>(points))
  {
    const float* single = PointerOf<float>(points);
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

} // namespace vtkMeshBridge
