// SPDX-License-Identifier: BSD-3-Clause
// Point arrays that hold boundary conditions: no point inside gets a part of them.
#include "MeshOptimizeFilterTesting.h"

#include "vtkUnsignedCharArray.h"

using namespace Testing;

namespace
{

/**
 * Arrays that are 0 but on the side x = 0: one of integers, one of real numbers; and x itself,
 * which is 0 all over that side, but not inside.
 */
void AddConditions(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkUnsignedCharArray> held;
  vtkNew<vtkDoubleArray> load, place;
  held->SetName("Constraint");
  load->SetName("Traction");
  load->SetNumberOfComponents(3);
  place->SetName("x");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double x = GetPoint(grid, p)[0];
    held->InsertNextValue(x == 0.0 ? 7 : 0);
    load->InsertNextTuple3(0.0, x == 0.0 ? 2.5 : 0.0, 0.0);
    place->InsertNextValue(x);
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ held, load, place })
  {
    grid->GetPointData()->AddArray(array);
  }
}

/**
 * Each point has a condition if it lies on the side x = 0, and no other one has. Returns how many
 * points lie next to that side, and moved or are new.
 */
int CheckConditions(vtkUnstructuredGrid* before, vtkUnstructuredGrid* after)
{
  std::set<Point> old;
  for (vtkIdType p = 0; p < before->GetNumberOfPoints(); ++p)
  {
    old.insert(GetPoint(before, p));
  }
  vtkPointData* data = after->GetPointData();
  int others = 0;
  for (vtkIdType p = 0; p < after->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(after, p);
    const bool isHeld = x[0] == 0.0;
    EXPECT_EQ(data->GetArray("Constraint")->GetComponent(p, 0), isHeld ? 7 : 0) << "at " << x[0];
    EXPECT_EQ(data->GetArray("Traction")->GetComponent(p, 1), isHeld ? 2.5 : 0.0) << "at " << x[0];
    EXPECT_NEAR(data->GetArray("x")->GetComponent(p, 0), x[0], 1e-12);
    others += x[0] > 0.0 && x[0] < 0.2 && old.count(x) == 0;
  }
  return others;
}

class MeshOptimizeFilterConditions : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterConditions);

TEST_P(MeshOptimizeFilterConditions, NoPointInsideIsHeldOrLoaded)
{
  int others = 0;
  for (int n = 4; n <= 8; ++n)
  {
    Grid input = MakeBox(n, 0.42);
    AddConditions(input);
    OptimizeFilter filter(GetParam());
    filter->SetTargetQuality(0.65);
    filter->SetInputData(input);
    filter->Update();
    others += CheckConditions(input, filter->GetOutput());
  }
  EXPECT_GT(others, 10);
}

TEST(MeshOptimizeFilterConditionsSliding, NorIfTheSurfaceSlides)
{
  int others = 0;
  for (int n = 4; n <= 8; ++n)
  {
    Grid input = MakeBox(n, 0.42);
    AddConditions(input);
    OptimizeFilter filter(vtkMeshOptimizeFilter::WorstFirst);
    filter->SetTargetQuality(0.65);
    filter->SetBoundaryModeToSlide();
    filter->SetSurfaceTolerance(0.0);
    filter->SetInputData(input);
    filter->Update();
    others += CheckConditions(input, filter->GetOutput());
  }
  EXPECT_GT(others, 10);
}

// What is not 0 inside is a field or a mark of points, and new points get values as from others.
TEST_P(MeshOptimizeFilterConditions, WhatIsNotZeroInsideIsNone)
{
  Grid input = MakeBox(6, 0.3);
  AddConditions(input);
  vtkDataArray* held = input->GetPointData()->GetArray("Constraint");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    held->SetComponent(p, 0, GetPoint(input, p)[0] < 0.5 ? 7 : 0);
  }
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    if (GetPoint(output, p)[0] < 0.25)
    {
      EXPECT_EQ(output->GetPointData()->GetArray("Constraint")->GetComponent(p, 0), 7);
    }
  }
}

} // namespace
