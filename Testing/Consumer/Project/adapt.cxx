// The adaptive loop: a plate with a hole under tension, its mesh made for the solution on it.
//   mesh -> vtkThermoelasticFilter -> vtkSolutionMetricFilter -> vtkMeshOptimizeFilter -> and
//   again, until two successive meshes are close enough.
// The plate is a quarter, and so large a piece of the infinite plane: its outer sides are displaced
// as G. Kirsch (1898) has it, so that the stress at the top of the hole is 3 times the tension.
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkMeshOptimizeFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkSolutionMetricFilter.h>
#include <vtkThermoelasticFilter.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace
{
constexpr double Side = 4.0;  // the radius of the hole is 1
constexpr double Near = 1e-9; // nodes that have slid along a side are on it to rounding
constexpr double Young = 1.0, Poisson = 0.3;
constexpr int Wanted = 2000, MaximumSteps = 8;
/// Two meshes are close enough if elements and strain energy differ by less than these parts.
constexpr double CloseCount = 0.02, CloseEnergy = 2e-4;

/// Ten triangles; the hole is given by nine points, and a B-spline makes it round.
vtkSmartPointer<vtkUnstructuredGrid> firstMesh()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i <= 8; ++i)
  {
    const double angle = i * vtkMath::Pi() / 16.0;
    points->InsertNextPoint(i == 8 ? 0.0 : std::cos(angle), std::sin(angle), 0.0);
  }
  const vtkIdType right = points->InsertNextPoint(Side, 0.0, 0.0);
  const vtkIdType corner = points->InsertNextPoint(Side, Side, 0.0);
  const vtkIdType top = points->InsertNextPoint(0.0, Side, 0.0);

  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(points);
  const auto triangle = [&mesh](vtkIdType a, vtkIdType b, vtkIdType c)
  {
    const vtkIdType ids[3] = { a, b, c };
    mesh->InsertNextCell(VTK_TRIANGLE, 3, ids);
  };
  for (vtkIdType i = 0; i < 8; ++i)
  {
    triangle(i, i < 4 ? right : top, i + 1);
  }
  triangle(4, right, corner);
  triangle(4, corner, top);
  return mesh;
}

/// Kirsch's displacement under unit tension along x, in plane strain.
void exactDisplacement(const double x[3], double u[3])
{
  const double kappa = 3.0 - 4.0 * Poisson, mu = Young / (2.0 * (1.0 + Poisson));
  const double r = std::hypot(x[0], x[1]), t = std::atan2(x[1], x[0]), cube = 2.0 / (r * r * r);
  u[0] = r * (kappa + 1.0) * std::cos(t) +
    2.0 / r * ((1.0 + kappa) * std::cos(t) + std::cos(3.0 * t)) - cube * std::cos(3.0 * t);
  u[1] = r * (kappa - 3.0) * std::sin(t) +
    2.0 / r * ((1.0 - kappa) * std::sin(t) + std::sin(3.0 * t)) - cube * std::sin(3.0 * t);
  u[0] /= 8.0 * mu;
  u[1] /= 8.0 * mu;
  u[2] = 0.0;
}

/// Adds the arrays that say how the plate is held: outer sides displaced, no motion across the
/// lines of symmetry.
void addConstraints(vtkUnstructuredGrid* mesh)
{
  vtkNew<vtkDoubleArray> constraint, displacement;
  for (vtkDoubleArray* array : { constraint.Get(), displacement.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(mesh->GetNumberOfPoints());
    array->Fill(0.0);
  }
  constraint->SetName("Constraint");
  displacement->SetName("PrescribedDisplacement");
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); ++p)
  {
    double x[3], u[3];
    mesh->GetPoint(p, x);
    const bool outer = x[0] > Side - Near || x[1] > Side - Near;
    constraint->SetTuple3(p, outer || x[0] < Near, outer || x[1] < Near, 0.0);
    if (outer)
    {
      exactDisplacement(x, u);
      displacement->SetTuple(p, u);
    }
  }
  mesh->GetPointData()->AddArray(constraint);
  mesh->GetPointData()->AddArray(displacement);
}

/// Stress along x at the top of the hole, (0, 1).
double stressAtHole(vtkUnstructuredGrid* solution)
{
  double top[3] = { 0.0, 1.0, 0.0 };
  const vtkIdType p = solution->FindPoint(top);
  return solution->GetPointData()->GetArray("Stress")->GetComponent(p, 0);
}
}

int main()
{
  // From the ten triangles: a uniform mesh, to begin with.
  vtkNew<vtkMeshOptimizeFilter> optimize;
  optimize->SetInputData(firstMesh());
  optimize->SetBoundaryModeToSlide();
  optimize->SetBeta(2.0); // the size counts
  optimize->SetDesiredSize(
    std::sqrt(4.0 / std::sqrt(3.0) * (Side * Side - vtkMath::Pi() / 4.0) / Wanted));

  vtkNew<vtkThermoelasticFilter> solve;
  solve->SetTemperatureModeToUniform(); // and 0, as by default: no thermal load
  solve->SetYoungsModulus(Young);
  solve->SetPoissonsRatio(Poisson);

  vtkNew<vtkSolutionMetricFilter> metric;
  metric->SetSolutionArray("Displacement");
  metric->SetDesiredNumberOfElements(Wanted);

  std::printf(
    "step  nodes  elements  worst quality  right edges  estimated error  stress at the hole\n");
  double energy = 0.0, count = 0.0, uniformError = 0.0;
  for (int step = 0; step <= MaximumSteps; ++step)
  {
    optimize->Update();
    vtkNew<vtkUnstructuredGrid> mesh;
    mesh->DeepCopy(optimize->GetOutput());
    addConstraints(mesh);
    solve->SetInputData(mesh);
    solve->Update();
    if (optimize->GetErrorCode() != 0 || solve->GetErrorCode() != 0)
    {
      return EXIT_FAILURE;
    }
    const double stress = stressAtHole(solve->GetOutput()),
                 error = solve->GetRelativeErrorEstimate();
    std::printf("%4d  %5lld  %8lld  %13.3f  %10.1f%%  %14.2f%%  %18.4f\n", step,
      static_cast<long long>(mesh->GetNumberOfPoints()),
      static_cast<long long>(mesh->GetNumberOfCells()), optimize->GetWorstQualityAfter(),
      100.0 * optimize->GetEdgeLengthShare(), 100.0 * error, stress);

    const double cells = static_cast<double>(mesh->GetNumberOfCells());
    const bool close = std::fabs(solve->GetStrainEnergy() / energy - 1.0) < CloseEnergy &&
      std::fabs(cells / count - 1.0) < CloseCount;
    if (step > 0 && close)
    {
      const bool right = std::fabs(stress / 3.0 - 1.0) < 0.03 && error < uniformError &&
        std::fabs(cells / Wanted - 1.0) < 0.1;
      return right ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    energy = solve->GetStrainEnergy();
    count = cells;
    uniformError = step == 0 ? error : uniformError;

    // What mesh would be right for this solution? That one is made from the one that is there.
    metric->SetInputData(solve->GetOutput());
    metric->Update();
    if (metric->GetErrorCode() != 0)
    {
      return EXIT_FAILURE;
    }
    vtkNew<vtkUnstructuredGrid> background;
    background->DeepCopy(metric->GetOutput());
    optimize->SetInputData(background);
    optimize->SetMetricArray("Metric");
    optimize->SetSizeArray("DesiredSize");
  }
  std::printf("the meshes do not settle\n");
  return EXIT_FAILURE;
}
