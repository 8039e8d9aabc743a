// SPDX-License-Identifier: BSD-3-Clause
// Lines that are cells ride on the surface of tetrahedra that slides.
#include "SlidingTesting.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"

#include <functional>

using namespace Testing;

namespace
{

using Edge = std::array<vtkIdType, 2>;

std::set<Edge> EdgesOf(vtkUnstructuredGrid* grid)
{
  std::set<Edge> edges;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> t = CellPoints(grid, c);
    for (int i = 0; i < 4 && grid->GetCellType(c) == VTK_TETRA; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        edges.insert({ std::min(t[i], t[j]), std::max(t[i], t[j]) });
      }
    }
  }
  return edges;
}

/**
 * Adds a line, with the number id(a, b) in the array "Physical", for each edge of the grid for
 * which it is not 0. Their numbers are in the array "Number", their middles (x) in "Middle".
 */
void AddLines(vtkUnstructuredGrid* grid, const std::function<int(const Point&, const Point&)>& id)
{
  vtkNew<vtkIntArray> ids;
  vtkNew<vtkDoubleArray> numbers;
  ids->SetName("Physical");
  numbers->SetName("Number"); // no integers: they divide nothing
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    ids->InsertNextValue(0);
  }
  for (const Edge& e : EdgesOf(grid))
  {
    const Point a = GetPoint(grid, e[0]), b = GetPoint(grid, e[1]);
    const int value = id(a, b);
    if (value != 0)
    {
      // All in the direction of growing coordinates.
      AddCell(grid, VTK_LINE,
        a < b ? std::vector<vtkIdType>{ e[0], e[1] } : std::vector<vtkIdType>{ e[1], e[0] });
      ids->InsertNextValue(value);
    }
  }
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    numbers->InsertNextValue(static_cast<double>(c));
  }
  grid->GetCellData()->AddArray(ids);
  grid->GetCellData()->AddArray(numbers);
}

/**
 * What must stay of the lines of one id.
 */
struct Chain
{
  double Length = 0.0;
  std::set<Point> Ends; ///< points with other than two lines of this id
};

std::map<int, Chain> ChainsOf(vtkUnstructuredGrid* grid)
{
  const std::set<Edge> edges = EdgesOf(grid);
  std::map<int, Chain> chains;
  std::map<std::pair<int, vtkIdType>, int> degrees;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_LINE)
    {
      const std::vector<vtkIdType> e = CellPoints(grid, c);
      EXPECT_EQ(edges.count({ std::min(e[0], e[1]), std::max(e[0], e[1]) }), 1u);
      const int id = static_cast<int>(
        grid->GetCellData()->GetArray("Physical")->GetComponent(c, 0));
      const Point a = GetPoint(grid, e[0]), b = GetPoint(grid, e[1]);
      chains[id].Length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      ++degrees[{ id, e[0] }];
      ++degrees[{ id, e[1] }];
    }
  }
  for (const auto& [where, degree] : degrees)
  {
    if (degree != 2)
    {
      chains[where.first].Ends.insert(GetPoint(grid, where.second));
    }
  }
  return chains;
}

vtkIdType CountLines(vtkUnstructuredGrid* grid)
{
  vtkIdType count = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    count += grid->GetCellType(c) == VTK_LINE;
  }
  return count;
}

/**
 * Displaces the points of the faces and edges of a box, but those of the lines only along them.
 */
void Displace(vtkUnstructuredGrid* grid, double most)
{
  Random random;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    const Point at = x;
    for (int d = 0; d < 3; ++d)
    {
      // Far along the lines: there they must take part.
      const bool isOnLine = at[2] == 0.0 && (at[0] == 0.5 || at[1] == 0.5);
      const bool isAcross = at[2] == 0.0 && at[d] == 0.5;
      const double move = (isOnLine ? 1.5 : 1.0) * most * random();
      x[d] += at[d] > 0.0 && at[d] < 1.0 && !isAcross ? move : 0.0;
    }
    grid->GetPoints()->SetPoint(p, x.data());
  }
}

/**
 * On the floor of the box: x = 1/2 in two parts (1, 2), y = 1/2 from there to the wall (3), and
 * half of the edge x = 0 (4), which ends where nothing but the lines does.
 */
int FloorId(const Point& a, const Point& b)
{
  const double x = 0.5 * (a[0] + b[0]), y = 0.5 * (a[1] + b[1]);
  const auto isOn = [&](int d, double value) { return a[d] == value && b[d] == value; };
  if (!isOn(2, 0.0))
  {
    return 0;
  }
  if (isOn(0, 0.5))
  {
    return y < 0.5 ? 1 : 2;
  }
  if (isOn(1, 0.5) && x < 0.5)
  {
    return 3;
  }
  return isOn(0, 0.0) && y < 0.5 ? 4 : 0;
}

/**
 * Each line of the output lies where that one lay whose data it has, and runs like it.
 */
void ExpectOwnData(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output)
{
  vtkDataArray* numbers = output->GetCellData()->GetArray("Number");
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    if (output->GetCellType(c) != VTK_LINE)
    {
      continue;
    }
    const auto source = static_cast<vtkIdType>(numbers->GetComponent(c, 0));
    ASSERT_EQ(input->GetCellType(source), VTK_LINE);
    const std::vector<vtkIdType> e = CellPoints(output, c), s = CellPoints(input, source);
    for (int d = 0; d < 3; ++d)
    {
      const double a = GetPoint(output, e[0])[d], b = GetPoint(output, e[1])[d];
      const double low = GetPoint(input, s[0])[d], high = GetPoint(input, s[1])[d];
      EXPECT_GE(0.5 * (a + b), low - 1e-12);
      EXPECT_LE(0.5 * (a + b), high + 1e-12);
      EXPECT_LE(a, b);
    }
  }
}

/**
 * The lines took part: they have points where the input had none.
 */
void ExpectNewPoints(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output)
{
  std::set<Point> before, after;
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    before.insert(GetPoint(input, p));
  }
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    for (int k = 0; k < 2 && output->GetCellType(c) == VTK_LINE; ++k)
    {
      after.insert(GetPoint(output, CellPoints(output, c)[k]));
    }
  }
  EXPECT_FALSE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
}

TEST(MeshOptimizeFilterRidingLines, LinesOnFlatFacesKeepLengthsAndEnds)
{
  Grid grid = MakeBox(6, 0.3);
  AddLines(grid, FloorId);
  Displace(grid, 0.3 / 6);
  const std::map<int, Chain> before = ChainsOf(grid);
  ASSERT_EQ(before.size(), 4u);
  for (double tolerance : { 0.0, 1e-4 })
  {
    Sliding filter(tolerance);
    filter->SetPatchArray("Physical");
    filter->SetInputData(grid);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
    ExpectNewPoints(grid, output);
    const std::map<int, Chain> after = ChainsOf(output);
    ASSERT_EQ(after.size(), 4u);
    const double allowed = tolerance * std::sqrt(3.0);
    for (const auto& [id, chain] : before)
    {
      EXPECT_NEAR(after.at(id).Length, chain.Length, 1e-13 + 2.0 * allowed) << id;
      ASSERT_EQ(after.at(id).Ends.size(), chain.Ends.size()) << id;
      for (auto a = chain.Ends.begin(), b = after.at(id).Ends.begin(); a != chain.Ends.end();
           ++a, ++b)
      {
        EXPECT_LE(std::hypot((*a)[0] - (*b)[0], (*a)[1] - (*b)[1], (*a)[2] - (*b)[2]), allowed);
      }
    }
    if (tolerance == 0.0)
    {
      ExpectOwnData(grid, output);
    }
  }
}

/**
 * The box bent to a quarter of a tube; on its outer side a line along the bend.
 */
TEST(MeshOptimizeFilterRidingLines, LinesOnACurvedFaceAreDividedAndJoined)
{
  Grid grid = MakeBox(8, 0.0);
  AddLines(grid,
    [](const Point& a, const Point& b)
    { return a[2] == 1.0 && b[2] == 1.0 && a[1] == 0.5 && b[1] == 0.5 ? 5 : 0; });
  ASSERT_EQ(CountLines(grid), 8);
  Random random;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    for (int d = 0; d < 3; ++d)
    {
      const double move = 0.25 / 8 * random();
      const bool isOnLine = x[2] == 1.0 && x[1] == 0.5;
      x[d] += x[d] > 0.0 && x[d] < 1.0 && !(isOnLine && d == 1) ? move : 0.0;
    }
    const double angle = 1.5707963267948966 * x[0], radius = 2.0 + x[2];
    grid->GetPoints()->SetPoint(p, radius * std::sin(angle), x[1], radius * std::cos(angle));
  }
  const std::map<int, Chain> before = ChainsOf(grid);
  Sliding filter(1e-2);
  filter->SetPatchArray("Physical");
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  const std::map<int, Chain> after = ChainsOf(output);
  EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_NEAR(after.at(5).Length, before.at(5).Length, 0.02 * before.at(5).Length);
  EXPECT_LE(filter->GetSurfaceDistance(), 1e-2 * std::sqrt(9.0 + 1.0 + 9.0));
  EXPECT_EQ(after.at(5).Ends.size(), 2u);
  ExpectNewPoints(grid, output);
}

TEST(MeshOptimizeFilterRidingLines, LinesInsideAndDoubledLinesHoldTheirPoints)
{
  Grid grid = MakeBox(4, 0.0);
  AddLines(grid,
    [](const Point& a, const Point& b)
    {
      const auto isOn = [&](int d, double value) { return a[d] == value && b[d] == value; };
      const bool isInside = isOn(0, 0.5) && isOn(1, 0.5); // its ends are on the surface
      return isInside ? 1 : isOn(2, 0.0) && isOn(0, 0.25) ? 2 : 0;
    });
  // All lines of the second number once more.
  vtkCellData* data = grid->GetCellData();
  for (vtkIdType c = 0, n = grid->GetNumberOfCells(); c < n; ++c)
  {
    if (data->GetArray("Physical")->GetComponent(c, 0) == 2.0)
    {
      AddCell(grid, VTK_LINE, CellPoints(grid, c));
      data->GetArray("Physical")->InsertNextTuple1(2.0);
      data->GetArray("Number")->InsertNextTuple1(-1.0);
    }
  }
  ASSERT_EQ(CountLines(grid), 4 + 2 * 4);
  std::vector<std::vector<Point>> lines[2];
  Displace(grid, 0.3 / 4);
  Sliding filter(1e-2);
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* grids[2] = { grid, filter->GetOutput() };
  for (int k = 0; k < 2; ++k)
  {
    for (vtkIdType c = 0; c < grids[k]->GetNumberOfCells(); ++c)
    {
      if (grids[k]->GetCellType(c) == VTK_LINE)
      {
        const std::vector<vtkIdType> e = CellPoints(grids[k], c);
        lines[k].push_back({ GetPoint(grids[k], e[0]), GetPoint(grids[k], e[1]) });
      }
    }
  }
  EXPECT_EQ(lines[0], lines[1]);
  EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
}

} // namespace
