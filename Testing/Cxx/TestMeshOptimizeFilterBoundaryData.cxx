// SPDX-License-Identifier: BSD-3-Clause
// Arrays, other cells and blocks, where the boundary slides and sizes are followed.
#include "BoundaryTesting.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"

using namespace Testing;

namespace
{
/**
 * Arrays of all kinds are carried along; lines that pass through keep their points and are kept.
 */
TEST(MeshOptimizeFilterBoundaryData, ArraysAndOtherCellsAreCarriedAlong)
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
TEST(MeshOptimizeFilterBoundaryData, EachBlockFollowsItsSizes)
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

} // namespace
