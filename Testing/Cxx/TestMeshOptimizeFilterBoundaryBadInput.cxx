// SPDX-License-Identifier: BSD-3-Clause
// The boundary mode Slide of vtkMeshOptimizeFilter: where it cannot be, and geometries that are
// none. One error says what and where.
#include "MeshOptimizeFilterTesting.h"

#include "vtkPolyData.h"

using namespace Testing;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

/**
 * A square whose boundary is to slide, with the algorithm that can do it.
 */
class MeshOptimizeFilterBoundaryBadInput : public testing::Test
{
protected:
  const Grid Square = MakeSquare(4, 0.1, [](double u, double v) { return Point{ { u, v, 0 } }; });
  const std::vector<Point> Corners{ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 1, 1, 0 } },
    { { 0, 1, 0 } } };
  const std::vector<std::vector<vtkIdType>> Around{ { 0, 1, 2, 3, 0 } };

  static void ExpectError(
    vtkUnstructuredGrid* input, const Texts& words, const Prepare& prepare = nullptr)
  {
    ExpectOptimizeError(vtkMeshOptimizeFilter::WorstFirst, input, words,
      [&](vtkMeshOptimizeFilter* f)
      {
        f->SetBoundaryModeToSlide();
        if (prepare)
        {
          prepare(f);
        }
      });
  }

  void ExpectGeometryError(vtkPolyData* geometry, const Texts& words)
  {
    ExpectError(
      this->Square, words, [=](vtkMeshOptimizeFilter* f) { f->SetGeometryData(geometry); });
  }
};

vtkSmartPointer<vtkPolyData> Lines(
  const std::vector<Point>& points, const std::vector<std::vector<vtkIdType>>& lines)
{
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> x;
  x->SetDataTypeToDouble();
  for (const Point& p : points)
  {
    x->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const std::vector<vtkIdType>& line : lines)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
  }
  geometry->SetPoints(x);
  geometry->SetLines(cells);
  return geometry;
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, NeedsWorstFirst)
{
  ExpectOptimizeError(vtkMeshOptimizeFilter::Paper1996, Square, { "Slide", "WorstFirst" },
    [](vtkMeshOptimizeFilter* f) { f->SetBoundaryModeToSlide(); });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, Options)
{
  ExpectError(Square, { "Slide", "OptimizeBelow" },
    [](vtkMeshOptimizeFilter* f) { f->SetOptimizeBelow(0.5); });
  // 4 / sqrt(3) / 1e-12 triangles, 2.3e12
  ExpectError(
    Square, { "1e8", "elements" }, [](vtkMeshOptimizeFilter* f) { f->SetDesiredSize(1e-6); });
  ExpectError(Square, { "target" }, [](vtkMeshOptimizeFilter* f) { f->SetTargetQuality(NaN); });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, CornerArrayMustBeThere)
{
  ExpectError(Square, { "corner array 'c'", "not there" },
    [](vtkMeshOptimizeFilter* f) { f->SetCornerArray("c"); });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, CornerArrayOfTheGeometryMustBeOneNumberAPoint)
{
  for (const int components : { 1, 3 })
  {
    SCOPED_TRACE(std::to_string(components) + " components");
    const vtkSmartPointer<vtkPolyData> marked = Lines(Corners, Around);
    vtkNew<vtkDoubleArray> marks;
    marks->SetName("c");
    marks->SetNumberOfComponents(components);
    marks->SetNumberOfTuples(components == 1 ? 2 : 4);
    marks->Fill(0.0);
    marked->GetPointData()->AddArray(marks);
    ExpectError(Square, { "corner array 'c'", "geometry", components == 1 ? "4 points" : "3 comp" },
      [&](vtkMeshOptimizeFilter* f)
      {
        f->SetGeometryData(marked);
        f->SetCornerArray("c");
      });
  }
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, GeometryMustHaveLines)
{
  ExpectGeometryError(Lines(Corners, {}), { "geometry", "no lines" });
  ExpectGeometryError(vtkSmartPointer<vtkPolyData>::New(), { "geometry", "no lines" });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, GeometryMustBeInThePlane)
{
  std::vector<Point> lifted = Corners;
  lifted[2][2] = 0.1;
  ExpectGeometryError(Lines(lifted, Around), { "Point 2 of the geometry", "plane", "0.1" });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, GeometryMustBeFinite)
{
  for (const double bad : { NaN, Infinity })
  {
    std::vector<Point> broken = Corners;
    broken[3][1] = bad;
    ExpectGeometryError(Lines(broken, Around), { "Point 3 of the geometry", "finite" });
  }
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, PointsOfLinesMustBeThere)
{
  for (const vtkIdType bad : { vtkIdType(4), vtkIdType(-1), vtkIdType(1) << 40 })
  {
    ExpectGeometryError(Lines(Corners, { { 0, 1, 2, bad, 0 } }),
      { "geometry", "point " + std::to_string(bad), "4 points" });
  }
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, CornersMustLieOnTheGeometry)
{
  std::vector<Point> larger = Corners;
  for (Point& x : larger)
  {
    x[0] = 1.2 * x[0] - 0.1;
    x[1] = 1.2 * x[1] - 0.1;
  }
  ExpectGeometryError(Lines(larger, Around), { "geometry", "corner", "point 0" });
}

TEST_F(MeshOptimizeFilterBoundaryBadInput, BoundaryMustLieOnTheGeometry)
{
  // open, and one side only
  for (const std::vector<vtkIdType>& line : { std::vector<vtkIdType>{ 0, 1, 2, 3 }, { 0, 1 } })
  {
    SCOPED_TRACE("points " + testing::PrintToString(line));
    ExpectGeometryError(Lines(Corners, { line }), { "does not lie on the geometry", "point " });
  }
}

TEST(MeshOptimizeFilterBoundarySettings, DefaultsAreAsDocumented)
{
  vtkNew<vtkMeshOptimizeFilter> f;
  EXPECT_EQ(f->GetBoundaryMode(), vtkMeshOptimizeFilter::Fixed);
  EXPECT_EQ(f->GetBoundaryCurve(), vtkMeshOptimizeFilter::BSpline);
  EXPECT_EQ(f->GetCornerAngle(), 45.0);
  EXPECT_EQ(f->GetEdgeLengthShare(), 0.0);
}

TEST(MeshOptimizeFilterBoundarySettings, SettingsOutOfRangeAreClamped)
{
  vtkNew<vtkMeshOptimizeFilter> f;
  f->SetBoundaryMode(9);
  EXPECT_EQ(f->GetBoundaryMode(), vtkMeshOptimizeFilter::Slide);
  f->SetBoundaryCurve(-1);
  EXPECT_EQ(f->GetBoundaryCurve(), vtkMeshOptimizeFilter::Straight);
  f->SetCornerAngle(1000.0);
  EXPECT_EQ(f->GetCornerAngle(), 180.0);
  f->Print(std::cout);
}

} // namespace
