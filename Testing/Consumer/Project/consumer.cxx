// A program of another project: makes a small grid with one sliver, optimizes it, reports the worst quality.
#include <vtkCellType.h>
#include <vtkMeshOptimizeFilter.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <cstdlib>
#include <iostream>

int main()
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

  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->SetPoints(points);
  for (int octant = 0; octant < 8; ++octant)
  {
    const vtkIdType x = octant & 1;
    const vtkIdType y = 2 + ((octant >> 1) & 1);
    const vtkIdType z = 4 + ((octant >> 2) & 1);
    // Three corners seen from outside in clockwise order, so that the volume with the centre inside is positive.
    const bool odd = ((x + y + z) & 1) != 0;
    const vtkIdType tetra[4] = { x, odd ? y : z, odd ? z : y, centre };
    mesh->InsertNextCell(VTK_TETRA, 4, tetra);
  }

  vtkNew<vtkMeshOptimizeFilter> optimize;
  optimize->SetInputData(mesh);
  optimize->SetTargetQuality(0.6);
  optimize->Update();
  std::cout << "worst quality " << optimize->GetWorstQualityBefore() << " -> "
            << optimize->GetWorstQualityAfter() << ", " << optimize->GetStopReasonAsString()
            << '\n';
  const bool better = optimize->GetWorstQualityAfter() > 2 * optimize->GetWorstQualityBefore();
  return better && optimize->GetWorstQualityBefore() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
