// SPDX-License-Identifier: BSD-3-Clause
// vtkTetGenFilter on good surfaces: volumes, the surface kept bit for bit, sizes, regions, holes,
// interior points, data.
#include "TetGenFilterTesting.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkStringArray.h"
#include "vtkTetra.h"

using namespace Testing;

namespace
{

/**
 * Points of the surface come first, same ids, same bits; the mesh has these triangles as its
 * boundary (and as faces between regions) and no others.
 */
void CheckKept(vtkPolyData* surface, vtkUnstructuredGrid* grid)
{
  EXPECT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_GE(grid->GetNumberOfPoints(), surface->GetNumberOfPoints());
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    Point x;
    surface->GetPoint(p, x.data());
    const Point y = GetPoint(grid, p);
    EXPECT_EQ(std::memcmp(x.data(), y.data(), sizeof x), 0) << "point " << p;
  }
  EXPECT_TRUE(SameFacets(KeptFacets(grid, "Region"), SurfaceFacets(surface)));
}

/**
 * Of all cells, or of those of one region.
 */
double LargestVolume(vtkUnstructuredGrid* grid, const int* region = nullptr)
{
  vtkDataArray* regions = grid->GetCellData()->GetArray("Region");
  double largest = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const bool counts = !region || regions->GetComponent(c, 0) == *region;
    largest = counts ? std::max(largest, SignedVolume(grid, c)) : largest;
  }
  return largest;
}

//------------------------------------------------------------------------------
TEST(TetGenFilter, SurfaceOfABoxIsKept)
{
  for (const int precision : { VTK_DOUBLE, VTK_FLOAT })
  {
    SCOPED_TRACE(precision == VTK_FLOAT ? "float" : "double");
    Surface box = MakeBoxSurface(5, precision);
    Grid grid = Fill(box, [](vtkTetGenFilter* f) { f->SetMaximumVolume(1e-3); });
    CheckKept(box, grid);
    EXPECT_NEAR(VolumeOf(grid), 1.0, 1e-7); // float: corners are not exactly on the planes
    EXPECT_GT(grid->GetNumberOfCells(), Fill(box)->GetNumberOfCells()); // so it was refined
    EXPECT_GT(grid->GetNumberOfPoints(), box->GetNumberOfPoints());
  }
}

/**
 * A ball of uneven triangles.
 */
Surface MakeBall()
{
  std::vector<Point> points;
  std::vector<std::vector<vtkIdType>> cells;
  const int n = 24;
  points.push_back({ { 0, 0, 1 } });
  points.push_back({ { 0, 0, -1 } });
  const auto id = [&](int i, int j) { return vtkIdType(2 + (i - 1) * n + (j + n) % n); };
  for (int i = 1; i < n / 2; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const double t = vtkMath::Pi() * i / (n / 2), f = 2 * vtkMath::Pi() * j / n;
      points.push_back({ { std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t) } });
      if (i > 1)
      {
        cells.push_back({ id(i - 1, j), id(i, j), id(i, j + 1) });
        cells.push_back({ id(i - 1, j), id(i, j + 1), id(i - 1, j + 1) });
      }
    }
  }
  for (int j = 0; j < n; ++j)
  {
    cells.push_back({ 0, id(1, j), id(1, j + 1) });
    cells.push_back({ 1, id(n / 2 - 1, j + 1), id(n / 2 - 1, j) });
  }
  return MakeSurface(points, cells);
}

TEST(TetGenFilter, SurfaceOfABallIsKept)
{
  Surface ball = MakeBall();
  for (const int level : { 0, 2, 10 })
  {
    SCOPED_TRACE("level " + std::to_string(level));
    Grid grid = Fill(ball,
      [=](vtkTetGenFilter* f)
      {
        f->SetOptimizationLevel(level);
        f->SetMaximumVolume(2e-3);
        f->SetMaximumRadiusEdgeRatio(1.5);
      });
    CheckKept(ball, grid);
    const double volume = VolumeOf(grid);
    EXPECT_GT(volume, 4.0);
    EXPECT_LT(volume, 4.0 / 3.0 * vtkMath::Pi());
  }
}

/**
 * "As generated" is Delaunay: no node inside the circumsphere of a cell of a convex body.
 */
int CountSpheresWithNodes(vtkUnstructuredGrid* grid)
{
  int count = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    Point x[4], centre;
    for (int i = 0; i < 4; ++i)
    {
      x[i] = GetPoint(grid, ids[i]);
    }
    const double radius2 = vtkTetra::Circumsphere(
      x[0].data(), x[1].data(), x[2].data(), x[3].data(), centre.data());
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      if (vtkMath::Distance2BetweenPoints(GetPoint(grid, p).data(), centre.data()) <
        radius2 * (1.0 - 1e-9))
      {
        ++count;
        break;
      }
    }
  }
  return count;
}

/**
 * Circumradius over shortest edge, the greatest of all cells.
 */
double LargestRadiusEdgeRatio(vtkUnstructuredGrid* grid)
{
  double largest2 = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    Point x[4], centre;
    double shortest2 = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4; ++i)
    {
      x[i] = GetPoint(grid, ids[i]);
      for (int k = 0; k < i; ++k)
      {
        shortest2 = std::min(shortest2, vtkMath::Distance2BetweenPoints(x[i].data(), x[k].data()));
      }
    }
    const double radius2 = vtkTetra::Circumsphere(
      x[0].data(), x[1].data(), x[2].data(), x[3].data(), centre.data());
    largest2 = std::max(largest2, radius2 / shortest2);
  }
  return std::sqrt(largest2);
}

/**
 * A unit cube with limits, and something more.
 */
Grid Refine(const Prepare& more = nullptr)
{
  return Fill(MakeBoxSurface(1),
    [&](vtkTetGenFilter* f)
    {
      f->SetKeepSurface(false);
      f->SetMaximumVolume(1e-3);
      f->SetMaximumRadiusEdgeRatio(1.4);
      f->SetOptimizationLevel(0);
      if (more)
      {
        more(f);
      }
    });
}

TEST(TetGenFilter, LimitsAreKept)
{
  Grid grid = Refine();
  EXPECT_NEAR(VolumeOf(grid), 1.0, 1e-12);
  EXPECT_LE(LargestVolume(grid), 1e-3);
  EXPECT_LE(LargestRadiusEdgeRatio(grid), 1.4 * (1 + 1e-9));
  EXPECT_GT(KeptFacets(grid).size(), SurfaceFacets(MakeBoxSurface(1)).size()); // cut
}

/**
 * Level 0 leaves the mesh as it was generated, level 2 does not.
 */
TEST(TetGenFilter, OptimizationLevelCounts)
{
  Grid grid = Refine();
  EXPECT_EQ(CountSpheresWithNodes(grid), 0);
  Grid optimized = Refine([](vtkTetGenFilter* f) { f->SetOptimizationLevel(2); });
  EXPECT_FALSE(SameGrid(grid, optimized));
  EXPECT_GT(CountSpheresWithNodes(optimized), 0);
}

TEST(TetGenFilter, LimitOnAnglesAddsNodes)
{
  Grid angles = Refine([](vtkTetGenFilter* f) { f->SetMinimumDihedralAngle(12); });
  EXPECT_GT(angles->GetNumberOfPoints(), Refine()->GetNumberOfPoints());
}

TEST(TetGenFilter, WithoutLimitsNothingIsAdded)
{
  Surface box = MakeBoxSurface(1);
  Grid bare = Fill(box, [](vtkTetGenFilter* f) { f->SetMaximumRadiusEdgeRatio(0); });
  EXPECT_EQ(bare->GetNumberOfPoints(), box->GetNumberOfPoints());
}

//------------------------------------------------------------------------------
/**
 * Two boxes with a wall between them, and a cavity in the first one.
 */
Surface MakeCompartments()
{
  Soup soup;
  soup.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 4).AddBox({ { 1, 0, 0 } }, { { 2, 1, 1 } }, 4);
  soup.AddBox({ { 0.25, 0.25, 0.25 } }, { { 0.75, 0.75, 0.75 } }, 2);
  return soup.Make();
}

TEST(TetGenFilter, CompartmentsAreNumberedFromOne)
{
  Surface surface = MakeCompartments();
  Grid grid = Fill(surface);
  CheckKept(surface, grid);
  EXPECT_NEAR(VolumeOf(grid), 2.0, 1e-12);
  std::set<int> numbers;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    numbers.insert(static_cast<int>(grid->GetCellData()->GetArray("Region")->GetComponent(c, 0)));
  }
  EXPECT_EQ(numbers, (std::set<int>{ 1, 2, 3 }));
}

TEST(TetGenFilter, RegionsHaveTheirNumbersAndSizesAndHolesAreEmpty)
{
  Surface surface = MakeCompartments();
  constexpr double most = 5e-4;
  const auto mark = [](vtkTetGenFilter* f)
  {
    f->AddRegion(0.1, 0.1, 0.1, -5, 0);
    f->AddRegion(1.5, 0.5, 0.5, 40, most);
    f->AddHole(0.5, 0.5, 0.5);
    f->AddHole(9, 9, 9); // outside: does nothing
    EXPECT_EQ(f->GetNumberOfRegions(), 2);
    EXPECT_EQ(f->GetNumberOfHoles(), 2);
  };
  Grid marked = Fill(surface, mark);
  CheckKept(surface, marked);
  const int first = -5, second = 40;
  EXPECT_NEAR(VolumeOf(marked, &first), 1.0 - 0.125, 1e-12); // the hole is a cube of 1/2
  EXPECT_NEAR(VolumeOf(marked, &second), 1.0, 1e-12);
  EXPECT_NEAR(VolumeOf(marked), 2.0 - 0.125, 1e-12);
  // The limit holds everywhere where the surface, which is coarser, may be cut; in its own region.
  Grid cut = Fill(surface,
    [&](vtkTetGenFilter* f)
    {
      mark(f);
      f->SetKeepSurface(false);
    });
  EXPECT_LE(LargestVolume(cut, &second), most);
  EXPECT_GT(LargestVolume(cut, &first), most);
}

/**
 * In no tetrahedron, and twice in one compartment: a warning each.
 */
TEST(TetGenFilter, RegionsThatAreNoneAreWarnings)
{
  Fill(
    MakeCompartments(),
    [](vtkTetGenFilter* f)
    {
      f->AddRegion(0.5, 0.5, 0.5, 3, 0);
      f->AddHole(0.5, 0.5, 0.5);
      f->AddRegion(0.1, 0.1, 0.1, 4, 0);
      f->AddRegion(0.9, 0.9, 0.9, 5, 0);
    },
    2);
}

TEST(TetGenFilter, RegionsAndHolesCanBeRemoved)
{
  vtkNew<vtkTetGenFilter> filter;
  filter->AddRegion(0, 0, 0, 0, 0);
  filter->AddHole(0, 0, 0);
  filter->RemoveAllRegions();
  filter->RemoveAllHoles();
  EXPECT_EQ(filter->GetNumberOfRegions(), 0);
  EXPECT_EQ(filter->GetNumberOfHoles(), 0);
}

//------------------------------------------------------------------------------
TEST(TetGenFilter, PointsInsideBecomeNodesAndOthersDoNot)
{
  const std::vector<Point> wanted = { { { 0.41, 0.52, 0.43 } }, { { 0.3, 0.6, 0.7 } },
    { { 0.55, 0.45, 0.35 } } };
  std::vector<Point> given = wanted;
  given.push_back({ { 5, 5, 5 } });         // outside
  given.push_back({ { 0.125, 0.125, 1 } }); // on a facet
  given.push_back({ { 0.25, 0.25, 0 } });   // on a point of the surface
  Grid interior = MakeGrid(given);
  Surface box = MakeBoxSurface(4);
  Grid grid = Fill(box,
    [&](vtkTetGenFilter* f)
    {
      f->SetInteriorPointsData(interior);
      f->SetMaximumRadiusEdgeRatio(0);
      f->SetOptimizationLevel(0);
    });
  CheckKept(box, grid);
  EXPECT_NEAR(VolumeOf(grid), 1.0, 1e-12);
  EXPECT_EQ(CountSpheresWithNodes(grid), 0); // level 0 here, too
  std::set<Point> nodes;
  for (vtkIdType p = box->GetNumberOfPoints(); p < grid->GetNumberOfPoints(); ++p)
  {
    nodes.insert(GetPoint(grid, p));
  }
  EXPECT_EQ(nodes, std::set<Point>(wanted.begin(), wanted.end()));
}

//------------------------------------------------------------------------------
TEST(TetGenFilter, CellsOfAllKindsAreFacetsAndDataAreCarriedAlong)
{
  // Squares, a strip, vertices, lines; a point that nothing uses.
  Soup soup;
  soup.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 2, true);
  soup.Points.insert(soup.Points.begin() + 3, Point{ { 7, 7, 7 } });
  for (auto& cell : soup.Cells)
  {
    for (vtkIdType& p : cell)
    {
      p += p >= 3 ? 1 : 0;
    }
  }
  const std::vector<vtkIdType> square = soup.Cells.back();
  soup.Cells.pop_back();
  Surface surface = soup.Make();
  vtkNew<vtkCellArray> strips, verts, lines;
  strips->InsertNextCell({ square[0], square[1], square[3], square[2] });
  verts->InsertNextCell({ 0 });
  lines->InsertNextCell({ 0, 1 });
  surface->SetStrips(strips);
  surface->SetVerts(verts);
  surface->SetLines(lines);

  const vtkIdType n = surface->GetNumberOfPoints();
  vtkNew<vtkFloatArray> heat;
  heat->SetName("Heat");
  heat->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> mark;
  mark->SetName("Mark");
  for (vtkIdType p = 0; p < n; ++p)
  {
    heat->InsertNextTuple2(p, -p);
    mark->InsertNextValue(static_cast<int>(p + 1));
  }
  surface->GetPointData()->AddArray(heat);
  surface->GetPointData()->SetScalars(mark);
  vtkNew<vtkStringArray> title;
  title->SetName("Title");
  title->InsertNextValue("box");
  surface->GetFieldData()->AddArray(title);
  const std::vector<Point> inside = { { { 0.5, 0.45, 0.55 } } };
  Grid interior = MakeGrid(inside);
  Grid grid = Fill(surface, [&](vtkTetGenFilter* f) { f->SetInteriorPointsData(interior); });

  EXPECT_NEAR(VolumeOf(grid), 1.0, 1e-12);
  EXPECT_EQ(GetPoint(grid, 3), (Point{ { 7, 7, 7 } }));
  EXPECT_GT(grid->GetNumberOfPoints(), n);
  vtkDataArray* heatOut = grid->GetPointData()->GetArray("Heat");
  vtkDataArray* markOut = grid->GetPointData()->GetScalars();
  ASSERT_TRUE(heatOut);
  EXPECT_EQ(heatOut->GetDataType(), VTK_FLOAT);
  ASSERT_TRUE(markOut);
  EXPECT_EQ(std::string(markOut->GetName()), "Mark");
  EXPECT_EQ(markOut->GetDataType(), VTK_INT);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double value = heatOut->GetComponent(p, 1);
    EXPECT_TRUE(p < n ? value == -static_cast<double>(p) : std::isnan(value)) << value;
    EXPECT_EQ(markOut->GetComponent(p, 0), p < n ? static_cast<double>(p + 1) : 0.0);
  }
  EXPECT_NE(grid->GetFieldData()->GetAbstractArray("Title"), nullptr);
}

TEST(TetGenFilter, EmptySurfaceIsNoError)
{
  Grid nothing = Fill(Surface::New());
  EXPECT_EQ(nothing->GetNumberOfCells(), 0);
  EXPECT_EQ(nothing->GetNumberOfPoints(), 0);
}

} // namespace
