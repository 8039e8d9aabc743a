// SPDX-License-Identifier: BSD-3-Clause
// Lines and corners that a boundary of triangles follows: the second input, arrays of corners.
#include "BoundaryTesting.h"

#include "vtkFeatureEdges.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkRegularPolygonSource.h"

using namespace Testing;

namespace
{
/**
 * A second input by a connection; when it changes, all is done again.
 */
TEST(MeshOptimizeFilterGeometry, RunsAgainWhenTheGeometryChanges)
{
  vtkNew<vtkRegularPolygonSource> circle;
  circle->SetNumberOfSides(16);
  circle->GeneratePolygonOff();
  circle->SetRadius(1.0);
  circle->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(MakeDisc(16));
  Slide(filter, 0.1);
  filter->SetBoundaryCurveToStraight();
  filter->SetCornerAngle(20.0);
  filter->SetGeometryConnection(circle->GetOutputPort());
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  const double polygon = OutOfRound(filter->GetOutput());
  EXPECT_GT(polygon, 0.01); // a side of n sides is 1 - cos(pi / n) from the circle in its middle
  EXPECT_LT(polygon, 1.0 - std::cos(Pi / 16) + 1e-12);

  filter->SetCornerAngle(45.0);
  circle->SetNumberOfSides(256);
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_GT(filter->GetOutput()->GetMTime(), before);
  EXPECT_LT(OutOfRound(filter->GetOutput()), 1.0 - std::cos(Pi / 256) + 1e-12);
  const vtkMTimeType again = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), again); // nothing has changed

  circle->SetRadius(1.1);
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 1u);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  circle->SetRadius(1.0);
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 1u);
  EXPECT_NEAR(filter->GetOutput()->GetNumberOfCells() / TrianglesIn(Pi, 0.1), 1.0, 0.1);
  filter->RemoveAllInputConnections(1);
  filter->SetBoundaryCurveToBSpline();
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 1u);
  EXPECT_LT(OutOfRound(filter->GetOutput()), 1e-4);
}

/**
 * Corners by an array of the mesh or of the geometry; points twice but for rounding.
 */
TEST(MeshOptimizeFilterGeometry, CornersOfAnArrayStay)
{
  Grid disc = MakeDisc(16);
  vtkNew<vtkIntArray> corners;
  corners->SetName("corner");
  for (vtkIdType p = 0; p < disc->GetNumberOfPoints(); ++p)
  {
    corners->InsertNextValue(p < 16 && p % 4 == 0);
  }
  disc->GetPointData()->AddArray(corners);
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(disc);
  Slide(filter, 0.5); // coarse: of the points of the boundary many go, corners stay
  filter->SetCornerArray("corner");
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  for (int k = 0; k < 16; k += 4)
  {
    SCOPED_TRACE("corner at point " + std::to_string(k));
    bool found = false;
    for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
    {
      found |= GetPoint(filter->GetOutput(), p) == GetPoint(disc, k);
    }
    EXPECT_TRUE(found);
  }
}

/**
 * A closed line of the geometry whose end is its beginning but for rounding, with a point twice in
 * between and, if wanted, a corner at a fifth of it.
 */
vtkSmartPointer<vtkPolyData> MakeRoundedLine(bool withCorner)
{
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(67);
  vtkNew<vtkIntArray> flags;
  flags->SetName("corner");
  for (int k = 0; k <= 66; ++k)
  {
    const int at = k > 30 ? k - 1 : k; // 30 twice
    const double a = 2 * Pi * std::min(at, 65) / 65.0;
    lines->InsertCellPoint(points->InsertNextPoint(std::cos(a), std::sin(a), k == 31 ? 1e-15 : 0));
    flags->InsertNextValue(0);
  }
  flags->SetValue(13, 1); // at a fifth, where the mesh has a point only if it has five
  geometry->SetPoints(points);
  geometry->SetLines(lines);
  if (withCorner)
  {
    geometry->GetPointData()->AddArray(flags);
  }
  return geometry;
}

TEST(MeshOptimizeFilterGeometry, PointsOfTheGeometryMayBeTwiceButForRounding)
{
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(MakeDisc(15));
  Slide(filter, 0.1);
  filter->SetGeometryData(MakeRoundedLine(false));
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_LT(OutOfRound(filter->GetOutput()), 1e-4);
}

/**
 * The plane of a mesh is no more exact than its coordinates.
 */
TEST(MeshOptimizeFilterGeometry, FloatsFarAwayAreInTheirPlane)
{
  const auto map = [](double x, double y) {
    return Point{ { 0.9 * x + 1000.0, 0.3 * x + 0.8 * y + 1000.0, 0.2 * x - y + 1000.0 } };
  };
  Grid square = MakeSquare(6, 0.1, map, VTK_FLOAT);
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(square->GetPoints());
  surface->SetPolys(square->GetCells());
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->Update();
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(square);
  filter->SetBoundaryModeToSlide();
  filter->SetGeometryData(edges->GetOutput());
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
}

TEST(MeshOptimizeFilterGeometry, CornersOfTheGeometryMustBePointsOfTheMesh)
{
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(MakeDisc(15));
  Slide(filter, 0.1);
  filter->SetGeometryData(MakeRoundedLine(true));
  filter->SetCornerArray("corner");
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages); // 15 points have one at a fifth
  filter->SetInputData(MakeDisc(16));
  filter->Update();
  ASSERT_EQ(messages.Errors.size(), 1u);
  EXPECT_TRUE(Says(messages.Errors[0], "corner"));
}

} // namespace
