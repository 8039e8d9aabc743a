// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that slide, sizes that are followed: what vtkMeshOptimizeFilter takes and gives.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRegularPolygonSource.h"
#include "vtkStringArray.h"

using namespace Testing;

namespace
{
const double Pi = std::acos(-1.0);

/**
 * Boundaries slide with this algorithm only.
 */
class WorstFirst : public OptimizeFilter
{
public:
  WorstFirst()
    : OptimizeFilter(vtkMeshOptimizeFilter::WorstFirst)
  {
  }
};

/**
 * How many equilateral triangles with edges of `size` fill an area.
 */
double TrianglesIn(double area, double size) { return 4.0 / std::sqrt(3.0) * area / size / size; }

Point Flat(double u, double v) { return { { u, v, 0 } }; }

/**
 * A disc of n triangles around its centre, radius 1, put into space by `map`.
 */
Grid MakeDisc(int n, const std::function<Point(double, double)>& map = Flat)
{
  std::vector<Point> points;
  for (int k = 0; k < n; ++k)
  {
    points.push_back(map(std::cos(2 * Pi * k / n), std::sin(2 * Pi * k / n)));
  }
  points.push_back(map(0, 0));
  Grid grid = MakeGrid(points);
  for (int k = 0; k < n; ++k)
  {
    AddCell(grid, VTK_TRIANGLE, { k, (k + 1) % n, n });
  }
  return grid;
}

void Slide(vtkMeshOptimizeFilter* filter, double size)
{
  filter->SetBoundaryModeToSlide();
  filter->SetDesiredSize(size);
}

/**
 * Points at the end of an edge that only one triangle has.
 */
std::set<vtkIdType> BoundaryPoints(vtkUnstructuredGrid* grid)
{
  std::map<std::set<vtkIdType>, int> edges;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    for (int i = 0; i < 3 && grid->GetCellType(c) == VTK_TRIANGLE; ++i)
    {
      ++edges[{ ids[i], ids[(i + 1) % 3] }];
    }
  }
  std::set<vtkIdType> points;
  for (const auto& edge : edges)
  {
    if (edge.second == 1)
    {
      points.insert(edge.first.begin(), edge.first.end());
    }
  }
  return points;
}

double Norm(const Point& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

double OutOfRound(vtkUnstructuredGrid* grid)
{
  double worst = 0.0;
  for (vtkIdType p : BoundaryPoints(grid))
  {
    worst = std::max(worst, std::abs(Norm(GetPoint(grid, p)) - 1.0));
  }
  return worst;
}

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
 * A second input by a connection; when it changes, all is done again.
 */
TEST(MeshOptimizeFilterBoundary, RunsAgainWhenTheGeometryChanges)
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
TEST(MeshOptimizeFilterBoundary, CornersOfAnArrayStay)
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

TEST(MeshOptimizeFilterBoundary, PointsOfTheGeometryMayBeTwiceButForRounding)
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

TEST(MeshOptimizeFilterBoundary, CornersOfTheGeometryMustBePointsOfTheMesh)
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

/**
 * Arrays of all kinds are carried along; lines that pass through keep their points and are kept.
 */
TEST(MeshOptimizeFilterBoundary, ArraysAndOtherCellsAreCarriedAlong)
{
  Grid grid = MakeSquare(4, 0.1, Flat);
  vtkNew<vtkDoubleArray> linear, perCell;
  vtkNew<vtkIntArray> region;
  vtkNew<vtkStringArray> names;
  linear->SetName("linear");
  region->SetName("region");
  perCell->SetName("perCell");
  names->SetName("names");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(grid, p);
    linear->InsertNextValue(3 * x[0] - 2 * x[1] + 1);
  }
  AddCell(grid, VTK_LINE, { 6, 7 });
  AddCell(grid, VTK_VERTEX, { 2 }); // on the lower side
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const bool right = c < 32 && c % 8 >= 4; // half of each row
    region->InsertNextValue(c < 32 ? (right ? 7 : -3) : 5);
    perCell->InsertNextValue(right ? 7 : c < 32 ? -3 : 5);
  }
  names->InsertNextValue("a name");
  grid->GetPointData()->AddArray(linear);
  grid->GetCellData()->AddArray(region);
  grid->GetCellData()->AddArray(perCell);
  grid->GetFieldData()->AddArray(names);
  const Point from = GetPoint(grid, 6), to = GetPoint(grid, 7);

  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->SetRegionArray("region");
  Slide(filter, 0.06);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  vtkUnstructuredGrid* out = filter->GetOutput();
  EXPECT_NEAR(out->GetNumberOfCells() / TrianglesIn(1.0, 0.06), 1.0, 0.1);
  auto value = vtkDoubleArray::SafeDownCast(out->GetPointData()->GetArray("linear"));
  ASSERT_NE(value, nullptr);
  for (vtkIdType p = 0; p < out->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(out, p);
    EXPECT_NEAR(value->GetValue(p), (3 * x[0] - 2 * x[1] + 1), 1e-12);
  }
  int lines = 0, vertices = 0;
  double area = 0.0;
  vtkDataArray* regions = out->GetCellData()->GetArray("region");
  vtkDataArray* values = out->GetCellData()->GetArray("perCell");
  for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(out, c);
    EXPECT_EQ(regions->GetComponent(c, 0), values->GetComponent(c, 0));
    if (out->GetCellType(c) == VTK_LINE)
    {
      ++lines;
      EXPECT_EQ(GetPoint(out, ids[0]), from);
      EXPECT_EQ(GetPoint(out, ids[1]), to);
    }
    else if (out->GetCellType(c) == VTK_VERTEX)
    {
      ++vertices;
      EXPECT_EQ(GetPoint(out, ids[0]), GetPoint(grid, 2));
    }
    else
    {
      const Point a = GetPoint(out, ids[0]), b = GetPoint(out, ids[1]), d = GetPoint(out, ids[2]);
      const double twice = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
      const double middle = (a[0] + b[0] + d[0]) / 3;
      EXPECT_GT(twice, 0.0);
      area += regions->GetComponent(c, 0) == 7 ? 0.5 * twice : 0.0;
      EXPECT_TRUE(regions->GetComponent(c, 0) == (middle > 0.5 + 0.1 ? 7 : -3) ||
        std::abs(middle - 0.5) < 0.1);
    }
  }
  EXPECT_EQ(lines, 1);
  EXPECT_EQ(vertices, 1);
  EXPECT_GT(area, 0.45);
  EXPECT_LT(area, 0.55);
  EXPECT_NE(out->GetFieldData()->GetAbstractArray("names"), nullptr);
}

/**
 * Sizes and a metric at the points; a block each.
 */
TEST(MeshOptimizeFilterBoundary, EachBlockFollowsItsSizes)
{
  Grid disc = MakeDisc(16);
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("size");
  for (vtkIdType p = 0; p < disc->GetNumberOfPoints(); ++p)
  {
    sizes->InsertNextValue(p < 16 ? 0.05 : 0.2);
  }
  disc->GetPointData()->AddArray(sizes);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, disc);
  blocks->SetBlock(2, MakeSquare(1, 0, Flat));
  WorstFirst filter;
  Messages messages(filter);
  filter->SetInputData(blocks);
  Slide(filter, 0.1);
  filter->SetSizeArray("size");
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  auto output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto first = output ? vtkUnstructuredGrid::SafeDownCast(output->GetBlock(0)) : nullptr;
  auto second = output ? vtkUnstructuredGrid::SafeDownCast(output->GetBlock(2)) : nullptr;
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_LT(OutOfRound(first), 1e-4);
  // The second block has no size array: the desired size counts.
  EXPECT_NEAR(second->GetNumberOfCells() / TrianglesIn(1.0, 0.1), 1.0, 0.2);
  // Sizes grow by the factor g = 4 from the circle to the centre. Their logarithms are linear
  // between: in the ring of radius r the size is .2 / g^r, and the number is that of the size .2
  // times int 2 r g^(2 r) dr from 0 to 1.
  const double l = std::log(16.0);
  const double finer = 2.0 * (16.0 / l - 15.0 / (l * l));
  EXPECT_NEAR(first->GetNumberOfCells() / (TrianglesIn(Pi, 0.2) * finer), 1.0, 0.1);
  EXPECT_GT(filter->GetEdgeLengthShare(), 0.85);
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
