// SPDX-License-Identifier: BSD-3-Clause
// What rides on the surface of tetrahedra that slides: triangles with their data, and node sets.
#include "SlidingTesting.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkTriangle.h"

using namespace Testing;

namespace
{

/**
 * Adds the triangles of the faces z = 0 (id 1 where x < 1/2, else 2) and z = 1 (id 3). Tetrahedra
 * have the id 0. The number of each cell is in another array.
 */
void AddTriangles(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkIntArray> ids, numbers;
  ids->SetName("Physical");
  numbers->SetName("Number");
  const vtkIdType n = grid->GetNumberOfCells();
  for (vtkIdType c = 0; c < n; ++c)
  {
    ids->InsertNextValue(0);
  }
  for (vtkIdType c = 0; c < n; ++c)
  {
    const std::vector<vtkIdType> t = CellPoints(grid, c);
    for (int i = 0; i < 4; ++i)
    {
      const std::vector<vtkIdType> face{ t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4] };
      for (double z : { 0.0, 1.0 })
      {
        double x = 0.0;
        bool isIn = true;
        for (vtkIdType p : face)
        {
          isIn = isIn && GetPoint(grid, p)[2] == z;
          x += GetPoint(grid, p)[0] / 3.0;
        }
        if (isIn)
        {
          AddCell(grid, VTK_TRIANGLE, face);
          ids->InsertNextValue(z == 1.0 ? 3 : x < 0.5 ? 1 : 2);
        }
      }
    }
  }
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    numbers->InsertNextValue(static_cast<int>(c));
  }
  grid->GetCellData()->AddArray(ids);
  grid->GetCellData()->AddArray(numbers);
}

double AreaOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  const std::vector<vtkIdType> t = CellPoints(grid, cell);
  return vtkTriangle::TriangleArea(
    GetPoint(grid, t[0]).data(), GetPoint(grid, t[1]).data(), GetPoint(grid, t[2]).data());
}

/**
 * The area of the triangles of each id. Each must be a face of a tetrahedron.
 */
std::map<int, double> AreasOf(vtkUnstructuredGrid* grid)
{
  std::set<std::vector<vtkIdType>> faces;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> t = CellPoints(grid, c);
    for (int i = 0; i < 4 && grid->GetCellType(c) == VTK_TETRA; ++i)
    {
      std::vector<vtkIdType> face{ t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4] };
      std::sort(face.begin(), face.end());
      faces.insert(face);
    }
  }
  std::map<int, double> areas;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_TRIANGLE)
    {
      std::vector<vtkIdType> face = CellPoints(grid, c);
      std::sort(face.begin(), face.end());
      EXPECT_EQ(faces.count(face), 1u);
      areas[static_cast<int>(grid->GetCellData()->GetArray("Physical")->GetComponent(c, 0))] +=
        AreaOf(grid, c);
    }
  }
  return areas;
}

TEST(MeshOptimizeFilterRiding, TrianglesRideOnIt)
{
  Grid grid = MakeBadBox(6, 0.0);
  AddTriangles(grid);
  // The border between the ids 1 and 2 is the line x = 1/2 of the floor. Displace all else.
  Random random;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    const bool isBorder = x[0] == 0.5 && x[2] == 0.0;
    for (double& v : x)
    {
      const double move = 0.05 * random();
      v += v > 0.0 && v < 1.0 && !isBorder ? move : 0.0;
    }
    grid->GetPoints()->SetPoint(p, x.data());
  }
  const std::map<int, double> before = AreasOf(grid);
  Sliding filter(0.0);
  filter->SetPatchArray("Physical");
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
  EXPECT_FALSE(SameFacets(KeptFacets(grid), KeptFacets(output))); // the surface took part
  const std::map<int, double> after = AreasOf(output);
  ASSERT_EQ(after.size(), 3u);
  for (const auto& [id, area] : before)
  {
    EXPECT_NEAR(after.at(id), area, 1e-13) << id;
  }
  // Each triangle of the output has the data of one triangle of the input, and looks the same way.
  vtkDataArray* numbers = output->GetCellData()->GetArray("Number");
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const auto source = static_cast<vtkIdType>(numbers->GetComponent(c, 0));
    EXPECT_EQ(output->GetCellType(c), grid->GetCellType(source));
    if (output->GetCellType(c) == VTK_TRIANGLE)
    {
      double n[3], m[3];
      const std::vector<vtkIdType> t = CellPoints(output, c), s = CellPoints(grid, source);
      vtkTriangle::ComputeNormal(GetPoint(output, t[0]).data(), GetPoint(output, t[1]).data(),
        GetPoint(output, t[2]).data(), n);
      vtkTriangle::ComputeNormal(
        GetPoint(grid, s[0]).data(), GetPoint(grid, s[1]).data(), GetPoint(grid, s[2]).data(), m);
      EXPECT_GT(vtkMath::Dot(n, m), 0.99);
    }
  }
}

TEST(MeshOptimizeFilterRiding, WithoutAPatchArrayAllIntegersCount)
{
  // The array Number is different for each triangle: none of them may change.
  Grid grid = MakeBadBox(4, 0.2);
  AddTriangles(grid);
  Sliding filter(0.0);
  filter->SetInputData(grid);
  filter->Update();
  std::map<int, double> before = AreasOf(grid), after = AreasOf(filter->GetOutput());
  for (const auto& [id, area] : before)
  {
    EXPECT_NEAR(after.at(id), area, 1e-13) << id;
  }
}

/**
 * Adds a point array that is `value(x)` at x.
 */
template <class Array, class F>
void AddPointArray(vtkUnstructuredGrid* grid, const char* name, F&& value)
{
  vtkNew<Array> array;
  array->SetName(name);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    array->InsertNextValue(value(GetPoint(grid, p)));
  }
  grid->GetPointData()->AddArray(array);
}

/**
 * What an array says on the surface: area of the facets none of whose points has the value 0, and
 * the integral of its interpolant over them.
 */
std::pair<double, double> Held(vtkUnstructuredGrid* grid, const char* name)
{
  std::map<std::vector<vtkIdType>, int> count;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> t = CellPoints(grid, c);
    for (int i = 0; i < 4; ++i)
    {
      std::vector<vtkIdType> face{ t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4] };
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  }
  vtkDataArray* array = grid->GetPointData()->GetArray(name);
  std::pair<double, double> held{ 0.0, 0.0 };
  for (const auto& [f, n] : count)
  {
    double mean = 0.0;
    bool isIn = n == 1;
    for (vtkIdType p : f)
    {
      isIn = isIn && array->GetComponent(p, 0) != 0.0;
      mean += array->GetComponent(p, 0) / 3.0;
    }
    if (isIn)
    {
      const double area = vtkTriangle::TriangleArea(
        GetPoint(grid, f[0]).data(), GetPoint(grid, f[1]).data(), GetPoint(grid, f[2]).data());
      held.first += area;
      held.second += mean * area;
    }
  }
  return held;
}

TEST(MeshOptimizeFilterRiding, AHeldFaceStaysAsGreatAsItWas)
{
  Grid grid = MakeBadBox(6, 0.25);
  AddPointArray<vtkDoubleArray>(
    grid, "Constraint", [](const Point& x) { return x[2] == 0.0 ? 1.0 : 0.0; });
  AddPointArray<vtkDoubleArray>(
    grid, "Traction", [](const Point& x) { return x[2] == 1.0 ? 4.0 + x[0] - 3.0 * x[1] : 0.0; });
  AddPointArray<vtkIntArray>(grid, "Nodes", [](const Point& x) { return x[0] == 0.0 ? 7 : 0; });
  for (double tolerance : { 0.0, 1e-2 })
  {
    Sliding filter(tolerance);
    filter->SetInputData(grid);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    EXPECT_GE(filter->GetWorstQualityAfter(), 0.6);
    for (const char* name : { "Constraint", "Traction", "Nodes" })
    {
      const auto before = Held(grid, name), after = Held(output, name);
      // Facets are flat, but within the tolerance their border may not be.
      EXPECT_NEAR(after.first, before.first, 1e-12 + 4.0 * tolerance * std::sqrt(3.0)) << name;
      EXPECT_NEAR(after.second, before.second, 1e-12 + 40.0 * tolerance) << name;
    }
    EXPECT_FALSE(SameFacets(KeptFacets(grid), KeptFacets(output)));
  }
}

/// Patches with jagged borders on the floor of the box.
bool IsInPatches(const Point& x)
{
  const auto i = std::lround(10.0 * x[0]), j = std::lround(10.0 * x[1]);
  return x[2] == 0.0 && (i * 7 + j * 13 + i * j) % 5 < 3;
}

TEST(MeshOptimizeFilterRiding, ANodeSetInsideAFaceKeepsItsPart)
{
  Grid grid = MakeBadBox(10, 0.0);
  AddPointArray<vtkFloatArray>(
    grid, "Held", [](const Point& x) { return IsInPatches(x) ? 1.0f : 0.0f; });
  AddPointArray<vtkIntArray>(grid, "Two",
    [](const Point& x) {
      return x[2] != 1.0 ? 0 : x[0] <= 0.5 ? 1 : x[0] >= 0.7 ? 2 : 0;
    });
  Random random;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    for (double& v : x)
    {
      const double move = 0.025 * random();
      v += v > 0.0 && v < 1.0 ? move : 0.0;
    }
    grid->GetPoints()->SetPoint(p, x.data());
  }
  for (const char* name : { "Held", "Two" })
  {
    Sliding filter(0.0);
    filter->SetPatchArray(name);
    filter->SetInputData(grid);
    filter->Update();
    const auto before = Held(grid, name), after = Held(filter->GetOutput(), name);
    EXPECT_NEAR(after.first, before.first, 1e-12) << name;
    EXPECT_NEAR(after.second, before.second, 1e-12) << name;
    EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
    EXPECT_FALSE(SameFacets(KeptFacets(grid), KeptFacets(filter->GetOutput())));
    // Said to be at points, it is the same.
    Sliding chosen(0.0);
    chosen->SetInputArrayToProcess(5, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    chosen->SetInputData(grid);
    chosen->Update();
    EXPECT_TRUE(SameFacets(KeptFacets(filter->GetOutput()), KeptFacets(chosen->GetOutput())));
  }
}

TEST(MeshOptimizeFilterRiding, LonePointsOfANodeSetStay)
{
  Grid grid = MakeBadBox(6, 0.3);
  std::vector<Point> lone;
  AddPointArray<vtkIntArray>(grid, "Sensors",
    [&](const Point& x)
    {
      const bool isOne = x[2] == 0.0 && x[0] > 0.3 && x[0] < 0.7 && x[1] > 0.4 && x[1] < 0.6;
      if (isOne)
      {
        lone.push_back(x);
      }
      return isOne ? static_cast<int>(lone.size()) : 0;
    });
  ASSERT_GE(lone.size(), 2u);
  Sliding filter(0.0);
  filter->SetPatchArray("Sensors");
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkDataArray* sensors = output->GetPointData()->GetArray("Sensors");
  std::size_t found = 0;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const auto k = static_cast<std::size_t>(sensors->GetComponent(p, 0));
    if (k > 0)
    {
      ++found;
      EXPECT_EQ(GetPoint(output, p), lone[k - 1]);
    }
  }
  EXPECT_EQ(found, lone.size());
}

} // namespace
