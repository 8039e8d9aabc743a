// SPDX-License-Identifier: BSD-3-Clause
// A grid of eight tetrahedra with one sliver.
#ifndef Sliver_h
#define Sliver_h

#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

inline vtkSmartPointer<vtkUnstructuredGrid> makeSliver()
{
  // An octahedron around one interior point that has been pushed almost onto a face.
  const double corners[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double* corner : corners)
  {
    points->InsertNextPoint(corner);
  }
  const vtkIdType centre = points->InsertNextPoint(0.32, 0.32, 0.32);

  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(points);
  for (int octant = 0; octant < 8; ++octant)
  {
    const vtkIdType x = octant & 1;
    const vtkIdType y = 2 + ((octant >> 1) & 1);
    const vtkIdType z = 4 + ((octant >> 2) & 1);
    // Three corners seen from outside in clockwise order, so that the volume with the centre inside
    // is positive.
    const bool odd = ((x + y + z) & 1) != 0;
    const vtkIdType tetra[4] = { x, odd ? y : z, odd ? z : y, centre };
    mesh->InsertNextCell(VTK_TETRA, 4, tetra);
  }
  return mesh;
}

#endif
