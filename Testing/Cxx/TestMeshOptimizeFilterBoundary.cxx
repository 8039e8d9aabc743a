// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that slide, sizes that are followed: what vtkMeshOptimizeFilter makes of them.
#include "BoundaryTesting.h"

#include "vtkRegularPolygonSource.h"

using namespace Testing;

namespace
{
void CheckFigures(vtkMeshOptimizeFilter* filter)
{
  vtkFieldData* fields = filter->GetOutput()->GetFieldData();
  vtkDataArray* share = fields->GetArray("EdgeLengthShare");
  vtkDataArray* histogram = fields->GetArray("EdgeLengthHistogram");
  ASSERT_TRUE(share && histogram);
  EXPECT_EQ(share->GetComponent(0, 0), filter->GetEdgeLengthShare());
  double all = 0.0, inside = 0.0;
  for (vtkIdType k = 0; k < histogram->GetNumberOfTuples(); ++k)
  {
    const double from = histogram->GetComponent(k, 0), n = histogram->GetComponent(k, 1);
    all += n;
    inside += from > 0.7 && from < 1.4 ? n : 0.0;
  }
  EXPECT_NEAR(inside / all, filter->GetEdgeLengthShare(), 0.01);
  EXPECT_EQ(MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")),
    filter->GetWorstQualityAfter());
}

//------------------------------------------------------------------------------
TEST(MeshOptimizeFilterBoundary, SquareIsFilledWithTrianglesOfTheDesiredSize)
{
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(MakeSquare(1, 0, Flat));
  Slide(filter, 0.02);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  EXPECT_NEAR(filter->GetOutput()->GetNumberOfCells() / TrianglesIn(1.0, 0.02), 1.0, 0.1);
  EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
  EXPECT_GE(filter->GetEdgeLengthShare(), 0.9);
  CheckFigures(filter);
  double bounds[6];
  filter->GetOutput()->GetBounds(bounds);
  EXPECT_EQ(bounds[0], 0);
  EXPECT_EQ(bounds[1], 1);
  EXPECT_EQ(bounds[2], 0);
  EXPECT_EQ(bounds[3], 1);

  // Then fixed, and without Beta: sizes do not count, and the boundary stays.
  filter->SetBoundaryModeToFixed();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 2);
  EXPECT_EQ(filter->GetEdgeLengthShare(), 0.0);
}

/**
 * With Beta sizes count; where the boundary is fine enough it need not slide.
 */
TEST(MeshOptimizeFilterBoundary, FixedBoundaryStaysWhereSizesAreFollowed)
{
  WorstFirst filter;
  filter->SetBoundaryModeToFixed();
  filter->SetInputData(MakeSquare(8, 0.1, Flat));
  filter->SetBeta(0.2);
  filter->SetDesiredSize(0.11);
  filter->Update();
  const auto kept = KeptFacets(MakeSquare(8, 0.1, Flat));
  EXPECT_TRUE(SameFacets(kept, KeptFacets(filter->GetOutput())));
  EXPECT_GT(filter->GetEdgeLengthShare(), 0.8);
}

/**
 * The same bytes whatever the number of threads.
 */
TEST(MeshOptimizeFilterBoundary, SameBytesWithAnyNumberOfThreads)
{
  Grid first;
  for (const int threads : { 1, 2, 4 })
  {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    WorstFirst filter;
    filter->SetInputData(MakeDisc(16));
    Slide(filter, 0.05);
    filter->SetNumberOfThreads(threads);
    filter->Update();
    EXPECT_LT(OutOfRound(filter->GetOutput()), 1e-4);
    if (!first)
    {
      first = filter->GetOutput();
    }
    EXPECT_TRUE(SameGrid(first, filter->GetOutput()));
  }
}

/**
 * A plane in space: the same as in the xy plane, turned.
 */
TEST(MeshOptimizeFilterBoundary, ObliquePlaneIsLikeAnyOther)
{
  const double c = 0.6, s = 0.8;
  const auto turned = [=](double u, double v) -> Point { return { { c * u, s * u, v } }; };
  const auto more = [=](double u, double v) -> Point
  {
    const Point x = turned(u, v);
    return { { c * x[0] - s * x[2], x[1], s * x[0] + c * x[2] } };
  };
  vtkNew<vtkRegularPolygonSource> fine;
  fine->SetNumberOfSides(200);
  fine->SetRadius(1.0);
  fine->GeneratePolygonOff();
  fine->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const bool given : { false, true })
  {
    SCOPED_TRACE(given ? "with a geometry" : "without a geometry");
    WorstFirst filter;
    Messages messages(filter);
    filter->SetInputData(MakeDisc(16, more));
    Slide(filter, 0.1);
    if (given)
    {
      // the normal of the disc is more(1, 0) x more(0, 1)
      const Point a = more(1, 0), b = more(0, 1);
      fine->SetNormal(
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
      filter->SetGeometryConnection(fine->GetOutputPort());
    }
    filter->Update();
    EXPECT_EQ(messages.Errors, NoMessages);
    EXPECT_LT(OutOfRound(filter->GetOutput()), 1e-4);
    EXPECT_NEAR(filter->GetOutput()->GetNumberOfCells() / TrianglesIn(Pi, 0.1), 1.0, 0.1);
    EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
  }
}

/**
 * Late: a sound mesh, and it says so. No machine does it in a microsecond.
 */
TEST(MeshOptimizeFilterBoundary, TimeLimitLeavesASoundMesh)
{
  WorstFirst filter;
  filter->SetInputData(MakeDisc(16));
  Slide(filter, 0.01);
  filter->SetTimeLimit(1e-6);
  filter->Update();
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::TimeLimitReached);
  EXPECT_GE(filter->GetOutput()->GetNumberOfCells(), 16);
  EXPECT_EQ(filter->GetNumberOfInvertedCellsAfter(), 0);
}

} // namespace
