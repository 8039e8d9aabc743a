// SPDX-License-Identifier: BSD-3-Clause
// From polygonal data to triangles and their points, as TetGen wants them; cells keep the ids by
// which the user knows them.
#include "vtkTetGenSurface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vtkTetGenBridge
{

namespace
{

// Unlikely as a name in the input, whose own arrays must not be taken for it.
const char* const CellIdName = "vtkTetGenCellId";

/**
 * Ids in range, polygons of three points and more, no point twice. Returns an error, or "". VTK
 * itself checks none of this: the triangle filter would read beyond the points.
 */
std::string CheckCells(vtkPolyData* input)
{
  // Ids of a vtkPolyData count vertices and lines first, then polygons, then strips.
  vtkIdType cell = input->GetNumberOfVerts() + input->GetNumberOfLines();
  for (vtkCellArray* cells : { input->GetPolys(), input->GetStrips() })
  {
    const bool isStrip = cells == input->GetStrips();
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell)
    {
      vtkIdType size;
      const vtkIdType* ids;
      cells->GetCellAtId(i, size, ids);
      const std::string name = "Cell " + std::to_string(cell);
      if (size < 3)
      {
        return name + " of the surface has " + std::to_string(size) + " points only.";
      }
      std::vector<vtkIdType> sorted(ids, ids + size);
      std::sort(sorted.begin(), sorted.end());
      if (sorted.front() < 0 || sorted.back() >= input->GetNumberOfPoints())
      {
        const vtkIdType wrong = sorted.front() < 0 ? sorted.front() : sorted.back();
        return name + " of the surface uses point " + std::to_string(wrong) + ", but there are " +
          std::to_string(input->GetNumberOfPoints()) + " points.";
      }
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (!isStrip && twice != sorted.end()) // a strip may return to a point
      {
        return name + " of the surface has point " + std::to_string(*twice) + " twice.";
      }
    }
  }
  return {};
}

/**
 * A polygon of n points has n - 2 triangles; vtkTriangleFilter returns fewer if it fails.
 */
std::string CheckTriangulation(vtkPolyData* input, const std::vector<vtkIdType>& cellIds)
{
  const vtkIdType first = input->GetNumberOfVerts() + input->GetNumberOfLines();
  std::vector<vtkIdType> found(input->GetNumberOfPolys(), 0);
  // Polygons only: a strip can always be cut.
  for (const vtkIdType cell : cellIds)
  {
    if (cell - first < input->GetNumberOfPolys())
    {
      ++found[cell - first];
    }
  }
  for (vtkIdType i = 0; i < input->GetNumberOfPolys(); ++i)
  {
    const vtkIdType size = input->GetPolys()->GetCellSize(i);
    if (found[i] != size - 2)
    {
      return "Cell " + std::to_string(first + i) + " of the surface, a polygon of " +
        std::to_string(size) + " points, cannot be cut into triangles.";
    }
  }
  return {};
}

/**
 * `input` with its ids as cell data, cut into triangles.
 */
vtkSmartPointer<vtkPolyData> CutIntoTriangles(vtkPolyData* input)
{
  vtkNew<vtkPolyData> numbered;
  // The arrays of the input stay behind: nothing reads them.
  numbered->CopyStructure(input);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(CellIdName);
  ids->SetNumberOfTuples(input->GetNumberOfCells());
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfTuples(), vtkIdType(0));
  // Cell data go along: each triangle knows the cell that it was cut from.
  numbered->GetCellData()->AddArray(ids);
  vtkNew<vtkTriangleFilter> cut;
  cut->PassVertsOff();
  cut->PassLinesOff();
  cut->SetInputData(numbered);
  cut->Update();
  return cut->GetOutput();
}

} // namespace

//------------------------------------------------------------------------------
std::string ReadSurface(vtkPolyData* input, Surface& surface)
{
  if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    return "The input has no facets: no triangle, polygon or strip among its " +
      std::to_string(input->GetNumberOfCells()) + " cells.";
  }
  const std::string error = CheckCells(input);
  if (!error.empty())
  {
    return error;
  }
  const vtkSmartPointer<vtkPolyData> cut = CutIntoTriangles(input);
  vtkCellArray* triangles = cut->GetPolys();
  auto cellIds = vtkIdTypeArray::SafeDownCast(cut->GetCellData()->GetArray(CellIdName));
  constexpr vtkIdType most = std::numeric_limits<int>::max() / 4;
  if (triangles->GetNumberOfCells() > most || input->GetNumberOfPoints() > most)
  {
    return "The surface is too large for TetGen, which counts in 32 bits.";
  }

  // Used points, in the order of the input.
  std::vector<int> number(input->GetNumberOfPoints(), -1);
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    triangles->GetCellAtId(i, size, ids);
    for (int k = 0; k < 3; ++k)
    {
      number[ids[k]] = 0;
    }
    // For messages, which name cells of the input.
    surface.CellIds.push_back(cellIds->GetValue(i));
  }
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    if (number[p] == 0)
    {
      number[p] = static_cast<int>(surface.PointIds.size());
      surface.PointIds.push_back(p);
      double x[3];
      input->GetPoint(p, x);
      surface.Points.insert(surface.Points.end(), x, x + 3);
    }
  }
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    triangles->GetCellAtId(i, size, ids);
    for (int k = 0; k < 3; ++k)
    {
      surface.Triangles.push_back(number[ids[k]]);
    }
  }
  return CheckTriangulation(input, surface.CellIds);
}

} // namespace vtkTetGenBridge
