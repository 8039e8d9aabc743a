// SPDX-License-Identifier: BSD-3-Clause
// From TetGen's mesh to a grid: points of the input keep their ids and their data.
#include "vtkTetGenExport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace vtkTetGenBridge
{

namespace
{

void ExportPoints(
  vtkPolyData* input, const Surface& surface, const Mesh& mesh, vtkUnstructuredGrid* output)
{
  const vtkIdType old = input->GetNumberOfPoints();
  const auto used = static_cast<vtkIdType>(surface.PointIds.size());
  // TetGen numbers the points of the surface first, in the order in which they were given.
  const vtkIdType fresh = static_cast<vtkIdType>(mesh.Points.size() / 3) - used;
  vtkNew<vtkPoints> points;
  // TetGen's own precision. Coordinates of the input in floats stay what they are.
  points->SetDataTypeToDouble();
  // All points of the input stay, used or not: their ids are those of the input.
  points->SetNumberOfPoints(old + fresh);
  for (vtkIdType p = 0; p < old; ++p)
  {
    double x[3];
    input->GetPoint(p, x);
    points->SetPoint(p, x);
  }
  for (vtkIdType p = 0; p < fresh; ++p)
  {
    points->SetPoint(old + p, mesh.Points.data() + 3 * (used + p));
  }
  output->SetPoints(points);
}

/**
 * Points of the surface take back their ids; those that TetGen has added come behind all others.
 */
void ExportCells(
  vtkIdType old, const Surface& surface, const Mesh& mesh, vtkUnstructuredGrid* output)
{
  const auto used = static_cast<vtkIdType>(surface.PointIds.size());
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(
    static_cast<vtkIdType>(mesh.Regions.size()), static_cast<vtkIdType>(mesh.Tetrahedra.size()));
  for (std::size_t t = 0; t < mesh.Tetrahedra.size(); t += 4)
  {
    vtkIdType corners[4];
    for (int i = 0; i < 4; ++i)
    {
      const vtkIdType p = mesh.Tetrahedra[t + i];
      // Behind all points of the input, also behind those that no triangle uses: the latter have no
      // number in TetGen's mesh.
      corners[i] = p < used ? surface.PointIds[p] : old + p - used;
    }
    cells->InsertNextCell(4, corners);
  }
  output->SetCells(VTK_TETRA, cells);

  vtkNew<vtkIntArray> regions;
  regions->SetName("Region");
  regions->SetNumberOfTuples(static_cast<vtkIdType>(mesh.Regions.size()));
  std::copy(mesh.Regions.begin(), mesh.Regions.end(), regions->GetPointer(0));
  output->GetCellData()->AddArray(regions);
}

/**
 * Nothing is known about new points. Global ids cannot be invented, so they are left out.
 */
void ExportPointData(vtkPolyData* input, vtkUnstructuredGrid* output)
{
  const vtkIdType old = input->GetNumberOfPoints(), all = output->GetNumberOfPoints();
  vtkPointData* data = output->GetPointData();
  data->CopyGlobalIdsOff();
  data->CopyAllocate(input->GetPointData(), all);
  for (vtkIdType p = 0; p < old; ++p)
  {
    data->CopyData(input->GetPointData(), p, p);
  }
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    // Also of strings, which are empty for new points.
    array->SetNumberOfTuples(all);
    auto numbers = vtkDataArray::SafeDownCast(array);
    if (!numbers)
    {
      continue;
    }
    const int type = numbers->GetDataType();
    // NaN where a type has it; elsewhere 0, which is a value.
    const double unknown = type == VTK_FLOAT || type == VTK_DOUBLE
      ? std::numeric_limits<double>::quiet_NaN()
      : 0.0;
    for (vtkIdType p = old; p < all; ++p)
    {
      for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
      {
        numbers->SetComponent(p, c, unknown);
      }
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Six times the volume of (a, b, c, x).
 */
double Side(const double* a, const double* b, const double* c, const double* x)
{
  double u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i)
  {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    w[i] = x[i] - a[i];
  }
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
    u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/**
 * A tetrahedron that contains x, or -1.
 */
std::ptrdiff_t FindTetrahedron(const Mesh& mesh, const double* x)
{
  // Facet i opposite to corner i, ordered so that Side() is positive for that corner.
  static const int faces[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  // One after the other: there are few region points.
  for (std::size_t t = 0; t < mesh.Regions.size(); ++t)
  {
    const int* corners = mesh.Tetrahedra.data() + 4 * t;
    const auto isInside = [&](const int* face)
    {
      // Also on a face: a point between two tetrahedra lies in both.
      return Side(mesh.Points.data() + 3 * corners[face[0]],
               mesh.Points.data() + 3 * corners[face[1]], mesh.Points.data() + 3 * corners[face[2]],
               x) >= 0.0;
    };
    if (std::all_of(std::begin(faces), std::end(faces), isInside))
    {
      return static_cast<std::ptrdiff_t>(t);
    }
  }
  return -1;
}

} // namespace

//------------------------------------------------------------------------------
void ExportMesh(
  vtkPolyData* input, const Surface& surface, const Mesh& mesh, vtkUnstructuredGrid* output)
{
  ExportPoints(input, surface, mesh, output);
  ExportCells(input->GetNumberOfPoints(), surface, mesh, output);
  ExportPointData(input, output);
  output->GetFieldData()->PassData(input->GetFieldData());
}

std::vector<std::string> CheckRegions(const std::vector<double>& regions, const Mesh& mesh)
{
  std::vector<std::string> warnings;
  for (std::size_t r = 0; r < regions.size(); r += 5)
  {
    const double* x = regions.data() + r;
    // A region has one attribute: of several points in it, only one can have marked it.
    const std::ptrdiff_t t = FindTetrahedron(mesh, x);
    if (t >= 0 && mesh.Regions[t] == static_cast<int>(x[3]))
    {
      continue;
    }
    std::ostringstream text;
    text << "Region point " << r / 5 << " (" << x[0] << ", " << x[1] << ", " << x[2] << ") "
         << (t < 0 ? "lies in no tetrahedron and marks nothing."
                   : "lies where another one has marked, and that one holds.");
    warnings.push_back(text.str());
  }
  return warnings;
}

} // namespace vtkTetGenBridge
