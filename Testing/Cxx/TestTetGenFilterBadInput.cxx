// SPDX-License-Identifier: BSD-3-Clause
// What vtkTetGenFilter says to input it cannot use: one error that says what and where, an empty
// output, and the process lives on.
#include "TetGenFilterTesting.h"

using namespace Testing;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();

/**
 * ExpectError() of FilterTesting.h; the same filter works again.
 */
void ExpectError(vtkPolyData* surface, const Texts& words, const Prepare& prepare = nullptr)
{
  vtkNew<vtkTetGenFilter> filter;
  Testing::ExpectError(filter.Get(), surface, words, prepare);
  filter->SetInputData(MakeBoxSurface(2));
  filter->RemoveAllRegions();
  filter->RemoveAllHoles();
  filter->SetMaximumRadiusEdgeRatio(2);
  filter->SetInteriorPointsData(nullptr);
  filter->Update();
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

Soup Box(int n) { return Soup().AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, n); }

/**
 * A box, something changed in its list of points and cells.
 */
Surface Changed(int n, const std::function<void(Soup&)>& change)
{
  Soup soup = Box(n);
  change(soup);
  return soup.Make();
}

//------------------------------------------------------------------------------
TEST(TetGenFilterBadInput, SurfaceMustHaveFacets)
{
  Surface points = Surface::New();
  points->SetPoints(MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } } })->GetPoints());
  ExpectError(points, { "no facets", "0 cells" });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  points->SetLines(lines);
  ExpectError(points, { "no facets", "1 cells" });
}

TEST(TetGenFilterBadInput, FacetsMustHaveThreePointsThatAreThere)
{
  ExpectError(Changed(2, [](Soup& s) { s.Cells[7] = { 0, 1 }; }), { "Cell 7", "2 points only" });
  ExpectError(
    Changed(2, [](Soup& s) { s.Cells[7][1] = 4711; }), { "Cell 7", "point 4711", "26 points" });
  ExpectError(Changed(2, [](Soup& s) { s.Cells[7][1] = -1; }), { "Cell 7", "point -1" });
  ExpectError(Changed(2, [](Soup& s) { s.Cells[7] = { 3, 5, 3 }; }), { "Cell 7", "point 3 twice" });
}

/**
 * Ids of cells count lines, too.
 */
TEST(TetGenFilterBadInput, ErrorNamesTheCellOfTheSurface)
{
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  Surface both = Changed(2, [](Soup& s) { s.Cells[7] = { 3, 5, 3 }; });
  both->SetLines(lines);
  ExpectError(both, { "Cell 8", "point 3 twice" });
}

/**
 * A bow tie whose arms lie on each other.
 */
TEST(TetGenFilterBadInput, PolygonMustBeOneThatCanBeCut)
{
  ExpectError(MakeSurface({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 2, 0, 0 } }, { { 3, 0, 0 } } },
                { { 0, 2, 1, 3 } }),
    { "Cell 0", "4 points", "cannot be cut" });
}

TEST(TetGenFilterBadInput, PointsMustBeFinite)
{
  for (const double bad : { NaN, std::numeric_limits<double>::infinity() })
  {
    ExpectError(Changed(2, [&](Soup& s) { s.Points[8][1] = bad; }), { "not finite", "point 8 " });
  }
}

TEST(TetGenFilterBadInput, PointsMustNotLieOnEachOther)
{
  ExpectError(Changed(2,
                [](Soup& s)
                {
                  s.Points.push_back(s.Points[4]);
                  s.Cells[20][0] = s.Cells[20][0] == 4 ? 26 : s.Cells[20][0];
                  for (auto& cell : s.Cells)
                  {
                    std::replace(cell.begin(), cell.end(), vtkIdType(4), vtkIdType(26));
                    if (&cell == &s.Cells[0] || &cell == &s.Cells[1] || &cell == &s.Cells[2])
                    {
                      std::replace(cell.begin(), cell.end(), vtkIdType(26), vtkIdType(4));
                    }
                  }
                }),
    { "lie on each other (1 times)", "point 4 (", "point 26", "Clean" });
}

TEST(TetGenFilterBadInput, SurfaceMustNotBeFlat)
{
  Surface flat = Changed(2,
    [](Soup& s)
    {
      for (Point& x : s.Points)
      {
        x[2] = 0.5;
      }
    });
  ExpectError(flat, { "flat", "z is 0.5" });
}

TEST(TetGenFilterBadInput, SurfaceMustBeClosed)
{
  ExpectError(Changed(2, [](Soup& s) { s.Cells.pop_back(); }),
    { "not closed", "3 edges", "from point ", " to point ", "of cell " });
  ExpectError(Changed(2, [](Soup& s) { s.Cells.push_back({ 0, 1, 25 }); }), { "not closed" });
}

TEST(TetGenFilterBadInput, FacetMustNotBeThereTwice)
{
  ExpectError(Changed(2,
                [](Soup& s) {
                  s.Cells.push_back({ s.Cells[5][1], s.Cells[5][2], s.Cells[5][0] });
                }),
    { "there twice", "cell 5 (points", "and cell 48" });
}

/**
 * A point on the edge of a triangle, joined by a triangle without area.
 */
TEST(TetGenFilterBadInput, FacetMustHaveAnArea)
{
  ExpectError(MakeSurface({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } },
                            { { 0.5, 0, 0 } } },
                { { 0, 2, 1 }, { 0, 4, 3 }, { 4, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 }, { 0, 1, 4 } }),
    { "no area", "cell 5 (points 0, 1, 4 around (0.5, 0, 0))" });
}

Surface MakeCrossing()
{
  Soup crossing = Box(1);
  crossing.AddBox({ { 0.3, 0.3, 0.3 } }, { { 1.3, 1.3, 1.3 } }, 1);
  return crossing.Make();
}

TEST(TetGenFilterBadInput, BoxesMustNotCross)
{
  ExpectError(MakeCrossing(), { "intersects itself", "pairs of facets", "cell ", "around (" });
}

TEST(TetGenFilterBadInput, BoxesMustNotCrossOffTheSurfaceAndWithSizesEither)
{
  for (const bool keep : { true, false })
  {
    SCOPED_TRACE(keep ? "on the surface" : "off the surface");
    ExpectError(MakeCrossing(), { "intersects itself" },
      [=](vtkTetGenFilter* f)
      {
        f->SetKeepSurface(keep);
        f->SetMaximumVolume(0.01);
      });
  }
}

/**
 * Two boxes that touch, one face lying inside the other's.
 */
TEST(TetGenFilterBadInput, FaceMustNotLieInsideAnother)
{
  Soup touching = Box(2);
  touching.AddBox({ { 1, 0.3, 0.3 } }, { { 1.5, 0.6, 0.6 } }, 1);
  ExpectError(touching.Make(), { "intersects itself" });
}

/**
 * One point pulled through the opposite wall: the cell ids are known.
 */
TEST(TetGenFilterBadInput, WallsMustNotCross)
{
  Soup dented = Box(2);
  for (Point& x : dented.Points)
  {
    if (x == Point{ { 0.5, 0.5, 0 } })
    {
      x[2] = 1.5;
    }
  }
  ExpectError(dented.Make(), { "intersects itself", "around (" });
}

//------------------------------------------------------------------------------
TEST(TetGenFilterBadInput, Options)
{
  Surface box = MakeBoxSurface(2);
  ExpectError(box, { "MaximumRadiusEdgeRatio is 0.9", "at least 1" },
    [](vtkTetGenFilter* f) { f->SetMaximumRadiusEdgeRatio(0.9); });
  ExpectError(box, { "MaximumRadiusEdgeRatio is not a number" },
    [](vtkTetGenFilter* f) { f->SetMaximumRadiusEdgeRatio(std::nan("")); });
}

TEST(TetGenFilterBadInput, RegionPoints)
{
  Surface box = MakeBoxSurface(2);
  ExpectError(box, { "Region point 1 has a value that is not finite" },
    [](vtkTetGenFilter* f)
    {
      f->AddRegion(0.5, 0.5, 0.5, 1, 0);
      f->AddRegion(NaN, 0.5, 0.5, 1, 0);
    });
  ExpectError(box, { "Region point 0", "attribute 1.5", "whole number" },
    [](vtkTetGenFilter* f) { f->AddRegion(0.5, 0.5, 0.5, 1.5, 0); });
  ExpectError(box, { "Region point 1 (9, 0.5, 0.5) lies outside" },
    [](vtkTetGenFilter* f)
    {
      f->AddRegion(0.5, 0.5, 0.5, 1, 0);
      f->AddRegion(9, 0.5, 0.5, 1, 0);
    });
}

TEST(TetGenFilterBadInput, HolePoints)
{
  Surface box = MakeBoxSurface(2);
  ExpectError(
    box, { "Hole point 0", "not finite" }, [](vtkTetGenFilter* f) { f->AddHole(0.5, NaN, 0.5); });
  ExpectError(box, { "No tetrahedron remains", "hole" },
    [](vtkTetGenFilter* f) { f->AddHole(0.5, 0.5, 0.5); });
}

TEST(TetGenFilterBadInput, InteriorPoints)
{
  Surface box = MakeBoxSurface(2);
  Grid interior = MakeGrid({ { { 0.5, 0.5, 0.5 } }, { { 0.4, NaN, 0.5 } } });
  ExpectError(box, { "Interior point 1", "not finite" },
    [&](vtkTetGenFilter* f) { f->SetInteriorPointsData(interior); });
}
} // namespace
