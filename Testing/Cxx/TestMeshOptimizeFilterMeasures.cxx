// SPDX-License-Identifier: BSD-3-Clause
// vtkMeshOptimizeFilter: measures, sizes and metrics reach the optimizer, and it may measure only.
#include "MeshOptimizeFilterTesting.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterMeasures : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterMeasures);

/**
 * With every kind of change off the mesh comes out as it went in, and is measured.
 */
TEST_P(MeshOptimizeFilterMeasures, WithEveryChangeOffItMeasuresOnly)
{
  Grid input = MakeBox(3, 0.25, VTK_FLOAT);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  ChangeNothing(filter);
  filter->Update();
  EXPECT_EQ(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  EXPECT_EQ(filter->GetNumberOfOperations(), 0);
  EXPECT_TRUE(
    SameArray(input->GetPoints()->GetData(), filter->GetOutput()->GetPoints()->GetData()));
  EXPECT_EQ(MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")),
    filter->GetWorstQualityAfter());
}

/**
 * Each measure reaches the optimizer: what is reported differs and gets better.
 */
TEST_P(MeshOptimizeFilterMeasures, EachMeasureGetsBetter)
{
  Grid input = MakeBox(4, 0.28);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  std::set<double> worst;
  for (int measure = vtkMeshOptimizeFilter::Shape; measure <= vtkMeshOptimizeFilter::VolumeLength;
       ++measure)
  {
    SCOPED_TRACE("measure " + std::to_string(measure));
    filter->SetQualityMeasure(measure);
    filter->Update();
    worst.insert(filter->GetWorstQualityBefore());
    EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
    CheckFieldData(filter);
  }
  EXPECT_GE(worst.size(), 5u); // the two sines agree where no angle is obtuse
}

/**
 * So does the size factor. The same size at every point, as an array, is the same quality; as is
 * the identity as a metric.
 */
TEST_P(MeshOptimizeFilterMeasures, SizeAsANumberAndAsAnArrayAreTheSame)
{
  Grid input = MakeBox(4, 0.28);
  std::set<double> worst;
  for (int measure = vtkMeshOptimizeFilter::Shape; measure <= vtkMeshOptimizeFilter::VolumeLength;
       ++measure)
  {
    OptimizeFilter plain(GetParam());
    plain->SetInputData(input);
    plain->SetQualityMeasure(measure);
    ChangeNothing(plain);
    plain->Update();
    worst.insert(plain->GetWorstQualityBefore());
  }
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->SetBeta(0.5);
  filter->SetDesiredSize(0.3);
  filter->Update();
  const double sized = filter->GetWorstQualityBefore();
  EXPECT_EQ(worst.count(sized), 0u);
  CheckFieldData(filter);

  vtkNew<vtkDoubleArray> size, metric;
  size->SetName("h");
  metric->SetName("M");
  metric->SetNumberOfComponents(6);
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    size->InsertNextValue(0.3);
    metric->InsertNextTuple6(1, 1, 1, 0, 0, 0);
  }
  input->GetPointData()->AddArray(size);
  input->GetPointData()->AddArray(metric);
  filter->SetDesiredSize(0.0);
  filter->SetSizeArray("h");
  filter->SetMetricArray("M");
  filter->Update();
  EXPECT_NEAR(filter->GetWorstQualityBefore(), sized, 1e-12);
  CheckFieldData(filter);
}

/**
 * A metric with XX = 4 is a mesh that is twice as long in x; 9 components say the same as 6.
 */
TEST_P(MeshOptimizeFilterMeasures, MetricIsTheStretchedMesh)
{
  Grid plain = MakeBox(3, 0.2), stretched = MakeBox(3, 0.2);
  vtkNew<vtkDoubleArray> six, nine;
  six->SetName("six");
  six->SetNumberOfComponents(6);
  nine->SetName("nine");
  nine->SetNumberOfComponents(9);
  for (vtkIdType p = 0; p < plain->GetNumberOfPoints(); ++p)
  {
    // The map diag(2, 1, 1) times the shear x += y / 2, y += z / 4: M = A' A, XX YY ZZ XY YZ XZ.
    const Point x = GetPoint(plain, p);
    stretched->GetPoints()->SetPoint(p, 2 * x[0] + x[1], x[1] + 0.25 * x[2], x[2]);
    six->InsertNextTuple6(4, 2, 1.0625, 2, 0.25, 0);
    nine->InsertNextTuple9(4, 2, 0, 2, 2, 0.25, 0, 0.25, 1.0625);
  }
  plain->GetPointData()->AddArray(six);
  plain->GetPointData()->AddArray(nine);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(stretched);
  filter->Update();
  const double wanted = filter->GetWorstQualityBefore();
  filter->SetInputData(plain);
  filter->Update();
  EXPECT_GT(std::abs(filter->GetWorstQualityBefore() - wanted), 0.01);
  for (const char* name : { "six", "nine" })
  {
    SCOPED_TRACE(std::string(name) + " components");
    filter->SetMetricArray(name);
    filter->Update();
    EXPECT_NEAR(filter->GetWorstQualityBefore(), wanted, 1e-9);
  }
}

} // namespace
