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
  CHECK(share && histogram);
  if (share && histogram)
  {
    CHECK(share->GetComponent(0, 0) == filter->GetEdgeLengthShare());
    double all = 0.0, inside = 0.0;
    for (vtkIdType k = 0; k < histogram->GetNumberOfTuples(); ++k)
    {
      const double from = histogram->GetComponent(k, 0), n = histogram->GetComponent(k, 1);
      all += n;
      inside += from > 0.7 && from < 1.4 ? n : 0.0;
    }
    CHECK(std::abs(inside / all - filter->GetEdgeLengthShare()) < 0.01);
  }
  CHECK(MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")) ==
    filter->GetWorstQualityAfter());
}

//------------------------------------------------------------------------------
void TestSquare()
{
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(MakeSquare(1, 0, Flat));
  Slide(filter, 0.02);
  filter->Update();
  CHECK(messages.Errors.empty() && messages.Warnings.empty());
  CHECK(std::abs(filter->GetOutput()->GetNumberOfCells() / 5773.5 - 1.0) < 0.1);
  CHECK(filter->GetWorstQualityAfter() >= 0.6);
  CHECK(filter->GetEdgeLengthShare() >= 0.9);
  CheckFigures(filter);
  double bounds[6];
  filter->GetOutput()->GetBounds(bounds);
  CHECK(bounds[0] == 0 && bounds[1] == 1 && bounds[2] == 0 && bounds[3] == 1);

  // Fixed, and without Beta: sizes do not count, and the boundary stays.
  filter->SetBoundaryModeToFixed();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfCells() == 2);
  CHECK(filter->GetEdgeLengthShare() == 0.0);
  // With Beta they do; where the boundary is fine enough it need not slide.
  filter->SetInputData(MakeSquare(8, 0.1, Flat));
  filter->SetBeta(0.2);
  filter->SetDesiredSize(0.11);
  const auto kept = KeptFacets(MakeSquare(8, 0.1, Flat));
  filter->Update();
  CHECK(KeptFacets(filter->GetOutput()) == kept);
  CHECK(filter->GetEdgeLengthShare() > 0.8);
}

/**
 * The same bytes whatever the number of threads.
 */
void TestThreads()
{
  Grid first;
  for (const int threads : { 1, 2, 4 })
  {
    OptimizeFilter filter;
    filter->SetInputData(MakeDisc(16));
    Slide(filter, 0.05);
    filter->SetNumberOfThreads(threads);
    filter->Update();
    CHECK(OutOfRound(filter->GetOutput()) < 1e-4);
    if (!first)
    {
      first = filter->GetOutput();
    }
    CHECK(SameGrid(first, filter->GetOutput()));
  }
}

/**
 * A plane in space: the same as in the xy plane, turned.
 */
void TestObliquePlane()
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
    OptimizeFilter filter;
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
    CHECK(messages.Errors.empty());
    CHECK(OutOfRound(filter->GetOutput()) < 1e-4);
    CHECK(filter->GetOutput()->GetNumberOfCells() > 500);
    CHECK(filter->GetWorstQualityAfter() >= 0.6);
  }
}

/**
 * A second input by a connection; when it changes, all is done again.
 */
void TestGeometryPort()
{
  vtkNew<vtkRegularPolygonSource> circle;
  circle->SetNumberOfSides(16);
  circle->GeneratePolygonOff();
  circle->SetRadius(1.0);
  circle->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(MakeDisc(16));
  Slide(filter, 0.1);
  filter->SetBoundaryCurveToStraight();
  filter->SetCornerAngle(20.0);
  filter->SetGeometryConnection(circle->GetOutputPort());
  filter->Update();
  CHECK(messages.Errors.empty());
  const double polygon = OutOfRound(filter->GetOutput());
  CHECK(polygon > 0.01 && polygon < 1.0 - std::cos(Pi / 16) + 1e-12);

  filter->SetCornerAngle(45.0);
  circle->SetNumberOfSides(256);
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetOutput()->GetMTime() > before);
  CHECK(OutOfRound(filter->GetOutput()) < 1.0 - std::cos(Pi / 256) + 1e-12);
  const vtkMTimeType again = filter->GetOutput()->GetMTime();
  filter->Update();
  CHECK(filter->GetOutput()->GetMTime() == again); // nothing has changed

  circle->SetRadius(1.1);
  filter->Update();
  CHECK(messages.Errors.size() == 1);
  CHECK(filter->GetOutput()->GetNumberOfCells() == 0);
  circle->SetRadius(1.0);
  filter->Update();
  CHECK(messages.Errors.size() == 1);
  CHECK(filter->GetOutput()->GetNumberOfCells() > 500);
  filter->RemoveAllInputConnections(1);
  filter->SetBoundaryCurveToBSpline();
  filter->Update();
  CHECK(messages.Errors.size() == 1);
  CHECK(OutOfRound(filter->GetOutput()) < 1e-4);
}

/**
 * Corners by an array of the mesh or of the geometry; points twice but for rounding.
 */
void TestCorners()
{
  Grid disc = MakeDisc(16);
  vtkNew<vtkIntArray> corners;
  corners->SetName("corner");
  for (vtkIdType p = 0; p < disc->GetNumberOfPoints(); ++p)
  {
    corners->InsertNextValue(p < 16 && p % 4 == 0);
  }
  disc->GetPointData()->AddArray(corners);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(disc);
  Slide(filter, 0.5); // coarse: of the points of the boundary many go, corners stay
  filter->SetCornerArray("corner");
  filter->Update();
  CHECK(messages.Errors.empty());
  for (int k = 0; k < 16; k += 4)
  {
    bool found = false;
    for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
    {
      found |= GetPoint(filter->GetOutput(), p) == GetPoint(disc, k);
    }
    CHECK(found);
  }

  // A closed line whose end is its beginning but for rounding, and a point twice in between.
  vtkNew<vtkPolyData> geometry;
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
  OptimizeFilter smooth;
  Messages others(smooth);
  smooth->SetInputData(MakeDisc(15));
  Slide(smooth, 0.1);
  smooth->SetGeometryData(geometry);
  smooth->Update();
  CHECK(others.Errors.empty());
  CHECK(OutOfRound(smooth->GetOutput()) < 1e-4);
  geometry->GetPointData()->AddArray(flags);
  smooth->SetCornerArray("corner");
  smooth->Update();
  CHECK(others.Errors.empty()); // 15 points have one at a fifth
  smooth->SetInputData(MakeDisc(16));
  smooth->Update();
  CHECK(others.Errors.size() == 1);
  CHECK(!others.Errors.empty() && others.Errors[0].find("corner") != std::string::npos);
}

/**
 * Arrays of all kinds are carried along; lines that pass through keep their points and are kept.
 */
void TestData()
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

  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->SetRegionArray("region");
  Slide(filter, 0.06);
  filter->Update();
  CHECK(messages.Errors.empty());
  vtkUnstructuredGrid* out = filter->GetOutput();
  CHECK(out->GetNumberOfCells() > 400);
  auto value = vtkDoubleArray::SafeDownCast(out->GetPointData()->GetArray("linear"));
  CHECK(value != nullptr);
  for (vtkIdType p = 0; value && p < out->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(out, p);
    CHECK(std::abs(value->GetValue(p) - (3 * x[0] - 2 * x[1] + 1)) < 1e-12);
  }
  int lines = 0, vertices = 0;
  double area = 0.0;
  vtkDataArray* regions = out->GetCellData()->GetArray("region");
  vtkDataArray* values = out->GetCellData()->GetArray("perCell");
  for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(out, c);
    CHECK(regions->GetComponent(c, 0) == values->GetComponent(c, 0));
    if (out->GetCellType(c) == VTK_LINE)
    {
      ++lines;
      CHECK(GetPoint(out, ids[0]) == from && GetPoint(out, ids[1]) == to);
    }
    else if (out->GetCellType(c) == VTK_VERTEX)
    {
      ++vertices;
      CHECK(GetPoint(out, ids[0]) == GetPoint(grid, 2));
    }
    else
    {
      const Point a = GetPoint(out, ids[0]), b = GetPoint(out, ids[1]), d = GetPoint(out, ids[2]);
      const double twice = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
      const double middle = (a[0] + b[0] + d[0]) / 3;
      CHECK(twice > 0.0);
      area += regions->GetComponent(c, 0) == 7 ? 0.5 * twice : 0.0;
      CHECK(regions->GetComponent(c, 0) == (middle > 0.5 + 0.1 ? 7 : -3) ||
        std::abs(middle - 0.5) < 0.1);
    }
  }
  CHECK(lines == 1 && vertices == 1);
  CHECK(area > 0.45 && area < 0.55);
  CHECK(out->GetFieldData()->GetAbstractArray("names") != nullptr);
}

/**
 * Sizes and a metric at the points; a block each.
 */
void TestComposite()
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
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(blocks);
  Slide(filter, 0.1);
  filter->SetSizeArray("size");
  filter->Update();
  CHECK(messages.Errors.empty());
  auto output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto first = output ? vtkUnstructuredGrid::SafeDownCast(output->GetBlock(0)) : nullptr;
  auto second = output ? vtkUnstructuredGrid::SafeDownCast(output->GetBlock(2)) : nullptr;
  CHECK(first && second);
  if (first && second)
  {
    CHECK(OutOfRound(first) < 1e-4);
    CHECK(std::abs(second->GetNumberOfCells() / 231.0 - 1.0) < 0.2); // DesiredSize, no array here
    CHECK(first->GetNumberOfCells() > 500);
  }
  CHECK(filter->GetEdgeLengthShare() > 0.85);
}

/**
 * Late, or aborted: a sound mesh, and it says which.
 */
void TestLimits()
{
  OptimizeFilter filter;
  filter->SetInputData(MakeDisc(16));
  Slide(filter, 0.01);
  filter->SetTimeLimit(1e-6);
  filter->Update();
  CHECK(filter->GetStopReason() == vtkMeshOptimizeFilter::TimeLimitReached);
  CHECK(filter->GetOutput()->GetNumberOfCells() >= 16);
  CHECK(filter->GetNumberOfInvertedCellsAfter() == 0);
}

void TestSettings()
{
  vtkNew<vtkMeshOptimizeFilter> f;
  CHECK(f->GetBoundaryMode() == vtkMeshOptimizeFilter::Fixed);
  CHECK(f->GetBoundaryCurve() == vtkMeshOptimizeFilter::BSpline);
  CHECK(f->GetCornerAngle() == 45.0);
  CHECK(f->GetEdgeLengthShare() == 0.0);
  f->SetBoundaryMode(9);
  CHECK(f->GetBoundaryMode() == vtkMeshOptimizeFilter::Slide);
  f->SetBoundaryCurve(-1);
  CHECK(f->GetBoundaryCurve() == vtkMeshOptimizeFilter::Straight);
  f->SetCornerAngle(1000.0);
  CHECK(f->GetCornerAngle() == 180.0);
  f->Print(std::cout);
}

} // namespace

int main(int, char*[])
{
  TestSquare();
  TestThreads();
  TestObliquePlane();
  TestGeometryPort();
  TestCorners();
  TestData();
  TestComposite();
  TestLimits();
  TestSettings();
  return Testing::Failures;
}
