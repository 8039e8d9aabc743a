// SPDX-License-Identifier: BSD-3-Clause
// One reader of grids, for grids of all kinds: vtkMeshOptimizeFilter and vtkMeshQualityMinMax say
// the same about ghosts, mixed cells and broken grids.
#include "MeshBridgeTesting.h"

using namespace Testing;

namespace
{

constexpr unsigned char Skipped[] = { vtkDataSetAttributes::DUPLICATECELL,
  vtkDataSetAttributes::REFINEDCELL, vtkDataSetAttributes::HIDDENCELL };
constexpr unsigned char Present[] = { vtkDataSetAttributes::HIGHCONNECTIVITYCELL,
  vtkDataSetAttributes::LOWCONNECTIVITYCELL, vtkDataSetAttributes::EXTERIORCELL };

bool IsGhost(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  return ghosts &&
    std::any_of(std::begin(Skipped), std::end(Skipped),
      [&](unsigned char flag) { return (ghosts->GetValue(cell) & flag) != 0; });
}

//------------------------------------------------------------------------------
/**
 * Duplicates, refined and hidden cells are not counted; the other flags only say how a cell lies.
 */
TEST(MeshBridgeCells, OnlyDuplicateRefinedAndHiddenCellsAreSkipped)
{
  for (const bool isSolid : { true, false })
  {
    SCOPED_TRACE(isSolid ? "tetrahedra" : "triangles");
    const auto make = [&](unsigned char flag, vtkIdType period)
    {
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(5, 0.6, Planes[3].Map);
      AddGhosts(grid, flag, period);
      return grid;
    };
    const vtkIdType all = make(0, 1)->GetNumberOfCells();
    for (const unsigned char flag : Present)
    {
      SCOPED_TRACE("flag " + std::to_string(flag));
      Compare("all cells flagged " + std::to_string(flag), make(flag, 1));
      const Answer answer = AskOptimize(make(flag, 1), 0.0);
      EXPECT_EQ(answer.Warnings, NoMessages);
      EXPECT_EQ(answer.Measured, all);
      EXPECT_EQ(AskMinMax(make(flag, 1), 0.0).Measured, all);
    }
    for (const unsigned char flag : Skipped)
    {
      SCOPED_TRACE("flag " + std::to_string(flag));
      const Answer none = AskOptimize(make(flag, 1), 0.0), nothing = AskMinMax(make(flag, 1), 0.0);
      EXPECT_EQ(none.Measured, 0);
      EXPECT_EQ(nothing.Measured, 0);
      for (const Answer& answer : { none, nothing })
      {
        ASSERT_EQ(answer.Warnings.size(), 1u);
        EXPECT_TRUE(Says(answer.Warnings[0], "ghost cells"));
        EXPECT_FALSE(Says(answer.Warnings[0], "none of"));
      }
    }
  }
}

/**
 * Some ghosts: what is counted is the same, and ghosts are measured in the same way. The border to
 * them is a surface that Mesh Optimize keeps; to Min Max it is inside, and no bound.
 */
TEST(MeshBridgeCells, GhostsAreMeasuredButNotCounted)
{
  for (const bool hasValues : { false, true })
  {
    SCOPED_TRACE(hasValues ? "with sizes and a metric" : "plain");
    for (const bool isSolid : { true, false })
    {
      SCOPED_TRACE(isSolid ? "tetrahedra" : "triangles");
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(5, 0.5, Planes[3].Map);
      AddGhosts(grid, vtkDataSetAttributes::DUPLICATECELL, 9);
      if (hasValues)
      {
        AddSizes(grid);
        AddMetric(grid, 6);
      }
      const double beta = hasValues ? 0.7 : 0.0;
      const Answer optimize = AskOptimize(grid, beta), minMax = AskMinMax(grid, beta);
      EXPECT_EQ(optimize.Errors, NoMessages);
      EXPECT_EQ(minMax.Errors, NoMessages);
      EXPECT_EQ(optimize.Measured, minMax.Measured);
      EXPECT_EQ(optimize.Inverted, minMax.Inverted);
      EXPECT_EQ(optimize.Measured, grid->GetNumberOfCells() - (grid->GetNumberOfCells() + 8) / 9);
      EXPECT_TRUE(IsNear(optimize.Minimum, minMax.Minimum, 1e-12));
      EXPECT_TRUE(IsNear(optimize.Mean, minMax.Mean, 1e-12));
      EXPECT_LE(optimize.Bound, minMax.Bound + 1e-12);
      for (std::size_t c = 0; c < optimize.Quality.size(); ++c)
      {
        EXPECT_TRUE(IsNear(optimize.Quality[c], minMax.Quality[c])) << "cell " << c;
      }
    }
  }
}

/**
 * What only ghosts need may be anything: another process checks it.
 */
TEST(MeshBridgeCells, WhatOnlyGhostsNeedMayBeAnything)
{
  Grid grid = MakeGrid(
    { { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } }, { { 0, 0, -1 } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  AddCell(grid, VTK_TETRA, { 0, 2, 1, 4 });
  AddGhosts(grid, vtkDataSetAttributes::DUPLICATECELL, 2);
  EXPECT_TRUE(IsGhost(grid, 1));
  EXPECT_FALSE(IsGhost(grid, 0));
  AddSizes(grid);
  AddMetric(grid, 9);
  grid->GetPointData()->GetArray("size")->SetComponent(4, 0, -1.0);
  grid->GetPointData()->GetArray("metric")->SetComponent(4, 0, -1.0);
  for (const Answer& answer : { AskOptimize(grid, 0.7), AskMinMax(grid, 0.7) })
  {
    EXPECT_EQ(answer.Errors, NoMessages);
    EXPECT_EQ(answer.Measured, 1);
    EXPECT_GT(answer.Quality[0], 0.0);
    EXPECT_TRUE(std::isnan(answer.Quality[1]));
  }
}

//------------------------------------------------------------------------------
/**
 * Quadratic cells, cells of other kinds and of lower dimension: those that both measure are
 * measured alike; Min Max says how many there are besides.
 */
TEST(MeshBridgeCells, CellsThatBothMeasureAreMeasuredAlike)
{
  Grid grid = MakeBox(2, 0.3);
  const vtkIdType simplices = grid->GetNumberOfCells();
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 4 }); // of the surface
  AddCell(grid, VTK_LINE, { 0, 1 });
  AddCell(grid, VTK_VERTEX, { 3 });
  for (int k = 0; k < 10; ++k)
  {
    grid->GetPoints()->InsertNextPoint(2 + (k == 1), 2 + (k == 2), 2 + (k == 3));
  }
  const vtkIdType p = 27;
  AddCell(grid, VTK_QUADRATIC_TETRA,
    { p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6, p + 7, p + 8, p + 9 });
  AddCell(grid, VTK_PYRAMID, { p, p + 1, p + 2, p + 3, p + 4 });
  const Answer optimize = AskOptimize(grid, 0.0), minMax = AskMinMax(grid, 0.0);
  EXPECT_EQ(optimize.Errors, NoMessages);
  EXPECT_EQ(minMax.Errors, NoMessages);
  EXPECT_EQ(minMax.Warnings, NoMessages);
  ASSERT_EQ(optimize.Warnings.size(), 1u);
  EXPECT_TRUE(Says(optimize.Warnings[0], "passed through as they are, 1 in all"));
  EXPECT_EQ(optimize.Measured, simplices);
  EXPECT_EQ(minMax.Measured, simplices + 2);
  for (std::size_t c = 0; c < optimize.Quality.size(); ++c)
  {
    const int type = grid->GetCellType(static_cast<vtkIdType>(c));
    EXPECT_EQ(std::isnan(optimize.Quality[c]), type != VTK_TETRA) << "cell " << c;
    EXPECT_EQ(std::isnan(minMax.Quality[c]),
      (type != VTK_TETRA && type != VTK_TRIANGLE && type != VTK_QUADRATIC_TETRA));
    EXPECT_TRUE(std::isnan(optimize.Quality[c]) || optimize.Quality[c] == minMax.Quality[c]);
  }
}

// Broken grids: Min Max measures what can be measured, and never reads out of an array.

TEST(MeshBridgeCells, PointsThatAreNotThereOrNotFiniteAreLeftOut)
{
  for (const Plane& plane : Planes)
  {
    SCOPED_TRACE(plane.Name);
    Grid grid = MakeSquare(3, 0.0, plane.Map);
    const Answer whole = AskMinMax(grid, 0.0);
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 77 });
    AddCell(grid, VTK_TRIANGLE, { 0, -1, 2 });
    grid->GetPoints()->InsertNextPoint(std::nan(""), 1.0, 0.0);
    grid->GetPoints()->InsertNextPoint(1.0, std::numeric_limits<double>::infinity(), 0.0);
    grid->GetPoints()->InsertNextPoint(1.0, 0.0, std::nan(""));
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 16 });
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 17 });
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 18 });
    const Answer answer = AskMinMax(grid, 0.0);
    EXPECT_EQ(answer.Errors, NoMessages);
    EXPECT_EQ(answer.Measured, whole.Measured);
    EXPECT_EQ(answer.Minimum, whole.Minimum);
    EXPECT_EQ(answer.Inverted, 0);
    EXPECT_TRUE(IsNear(answer.Bound, whole.Bound, 1e-9));
  }
}

TEST(MeshBridgeCells, CellsWithTooFewPointsAreLeftOut)
{
  Grid bare = MakeGrid({});
  AddCell(bare, VTK_TETRA, {});
  AddCell(bare, VTK_TRIANGLE, {});
  EXPECT_EQ(AskMinMax(bare, 0.0).Errors, NoMessages);
  EXPECT_EQ(AskMinMax(bare, 0.0).Measured, 0);
  bare = MakeTetrahedra();
  const vtkIdType all = bare->GetNumberOfCells();
  AddCell(bare, VTK_TETRA, { 0, 1 });
  AddCell(bare, VTK_QUADRATIC_TETRA, { 0, 1, 2 });
  EXPECT_EQ(AskMinMax(bare, 0.0).Errors, NoMessages);
  EXPECT_EQ(AskMinMax(bare, 0.0).Measured, all);
}

TEST(MeshBridgeCells, GhostArrayThatIsTooShortSaysNothing)
{
  Grid grid = MakeTetrahedra();
  auto ghosts = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 1, 3);
  ghosts->FillValue(vtkDataSetAttributes::DUPLICATECELL);
  grid->GetCellData()->AddArray(ghosts);
  EXPECT_EQ(AskMinMax(grid, 0.0).Measured, grid->GetNumberOfCells());
}

} // namespace
