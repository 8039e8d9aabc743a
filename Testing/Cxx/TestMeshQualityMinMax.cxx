// SPDX-License-Identifier: BSD-3-Clause
// vtkMeshQualityMinMax on mixed and broken cells, on blocks, with ghosts, with unusable arrays, and
// with several threads.
#include "FilterTesting.h"

#include "vtkIntArray.h"
#include "vtkMeshQualityMinMax.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <random>

using namespace Testing;

namespace
{

/**
 * n tetrahedra with nodes at random; every fifth is inverted or nearly flat.
 */
Grid MakeRandom(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<Point> points(4 * n);
  for (auto& x : points)
  {
    x = { { u(random), u(random), u(random) } };
  }
  Grid grid = MakeGrid(points);
  for (vtkIdType c = 0; c < n; ++c)
  {
    AddCell(grid, VTK_TETRA, { 4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3 });
  }
  return grid;
}

const std::vector<Point> Regular = { { { 0, 0, 0 } }, { { 1, 0, 0 } },
  { { 0.5, std::sqrt(0.75), 0 } }, { { 0.5, std::sqrt(3.0) / 6.0, std::sqrt(2.0 / 3.0) } } };

double QualityOf(vtkMeshQualityMinMax* filter, vtkIdType cell)
{
  return vtkDoubleArray::SafeDownCast(filter->GetOutput()->GetCellData()->GetArray("MeshQuality"))
    ->GetValue(cell);
}

TEST(MeshQualityMinMax, CellsOfEachKindHaveTheirQuality)
{
  Grid grid = MakeGrid({ Regular[0], Regular[1], Regular[2], Regular[3], { { 0, 0, 1 } },
    { { 1, 1, std::nan("") } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  AddCell(grid, VTK_TRIANGLE, { 0, 2, 1 });
  AddCell(grid, VTK_LINE, { 0, 1 });
  AddCell(grid, VTK_TETRA, { 1, 0, 2, 3 }); // inverted
  AddCell(grid, VTK_TETRA, { 0, 0, 0, 0 }); // collapsed
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 5 }); // not a number
  AddCell(grid, VTK_QUADRATIC_TETRA, { 0, 1, 2, 3, 4, 4, 4, 4, 4, 4 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_NEAR(QualityOf(filter, 0), 1.0, 1e-14) << "the regular tetrahedron is 1";
  EXPECT_NEAR(QualityOf(filter, 1), 1.0, 1e-14) << "a triangle among tetrahedra has no sign";
  EXPECT_TRUE(std::isnan(QualityOf(filter, 2))) << "a line is not measured";
  EXPECT_NEAR(QualityOf(filter, 3), -1.0, 1e-14) << "the inverted tetrahedron is -1";
  EXPECT_EQ(QualityOf(filter, 4), 0.0) << "a collapsed one is 0";
  EXPECT_TRUE(std::isnan(QualityOf(filter, 5))) << "a coordinate that is not a number";
  EXPECT_NEAR(QualityOf(filter, 6), 1.0, 1e-14) << "quadratic: by the corners";
  EXPECT_EQ(filter->GetNumberOfMeasuredCells(), 5);
  EXPECT_EQ(filter->GetNumberOfInvertedCells(), 1);
  EXPECT_EQ(filter->GetNumberOfNotMeasurableCells(), 1);
  EXPECT_EQ(filter->GetNumberOfOtherCells(), 1);
  EXPECT_EQ(filter->GetWorstCellId(), 3) << "the inverted one is the worst";
  EXPECT_FALSE(grid->GetCellData()->GetArray("MeshQuality")) << "the input is not modified";
  auto* worst = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(3));
  EXPECT_EQ(worst->GetNumberOfCells(), 5) << "worst cells in order";
  EXPECT_EQ(worst->GetCellData()->GetArray("OriginalCellIds")->GetComponent(1, 0), 4)
    << "worst cells in order";
}

TEST(MeshQualityMinMax, BrokenCellsAreMeasuredAsTheyAre)
{
  // ids out of range, and a facet with three cells: measured as they are, no crash
  Grid grid = MakeGrid({ Regular[0], Regular[1], Regular[2], Regular[3], { { 0.5, 0.3, -0.8 } },
    { { 0.5, 0.3, 2 } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  AddCell(grid, VTK_TETRA, { 0, 2, 1, 4 });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 5 });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 77 });
  AddCell(grid, VTK_TETRA, { 0, -1, 2, 3 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfMeasuredCells(), 3);
  EXPECT_EQ(filter->GetNumberOfNotMeasurableCells(), 2);
  EXPECT_LE(filter->GetMinimumQuality(), filter->GetQualityBound()) << "bound of a broken mesh";
}

TEST(MeshQualityMinMax, EmptyGridIsNoError)
{
  vtkNew<vtkUnstructuredGrid> empty;
  vtkNew<vtkMeshQualityMinMax> filter;
  const Messages messages(filter);
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_TRUE(std::isnan(filter->GetMinimumQuality()));
  EXPECT_EQ(filter->GetNumberOfMeasuredCells(), 0);
  EXPECT_EQ(filter->GetWorstCellId(), -1);
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows(), 1)
    << "one row of summary";
}

TEST(MeshQualityMinMax, TrianglesHaveASignInAnyPlane)
{
  Grid grid = MakeGrid({ { { 0, 0, 3 } }, { { 1, 0, 3 } }, { { 0.5, std::sqrt(0.75), 3 } } });
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 2 });
  AddCell(grid, VTK_TRIANGLE, { 0, 2, 1 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_NEAR(QualityOf(filter, 0), 1.0, 1e-14);
  EXPECT_NEAR(QualityOf(filter, 1), -1.0, 1e-14);
  grid->GetPoints()->SetPoint(2, 0.5, 0.0, 3.0 + std::sqrt(0.75));
  grid->GetPoints()->Modified();
  grid->Modified();
  filter->Update();
  EXPECT_NEAR(QualityOf(filter, 0), 1.0, 1e-14) << "in any plane";
  EXPECT_NEAR(QualityOf(filter, 1), -1.0, 1e-14) << "in any plane";
}

TEST(MeshQualityMinMax, TrianglesInSpaceHaveNoSign)
{
  Grid grid = MakeGrid({ { { 0, 0, 3 } }, { { 1, 0, 3 } }, { { 0.5, 0.0, 3 + std::sqrt(0.75) } } });
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 2 });
  AddCell(grid, VTK_TRIANGLE, { 0, 2, 1 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_NEAR(QualityOf(filter, 1), -1.0, 1e-14) << "they still are in a plane";
  grid->GetPoints()->InsertNextPoint(0.5, 1.0, 3.0);
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 3 });
  grid->Modified();
  filter->Update();
  EXPECT_NEAR(QualityOf(filter, 0), 1.0, 1e-14);
  EXPECT_NEAR(QualityOf(filter, 1), 1.0, 1e-14);
}

TEST(MeshQualityMinMax, FiguresAreThoseOfAllBlocks)
{
  Grid a = MakeRandom(500, 1), b = MakeRandom(700, 2);
  vtkNew<vtkMeshQualityMinMax> filter;
  double minima[2], maxima[2], means[2];
  vtkIdType ids[2];
  for (int k = 0; k < 2; ++k)
  {
    filter->SetInputData(k ? b : a);
    filter->Update();
    minima[k] = filter->GetMinimumQuality();
    maxima[k] = filter->GetMaximumQuality();
    means[k] = filter->GetMeanQuality();
    ids[k] = filter->GetWorstCellId();
  }
  vtkNew<vtkMultiBlockDataSet> blocks, inner;
  blocks->SetBlock(0, a);
  blocks->SetBlock(1, inner);
  blocks->SetBlock(2, nullptr);
  inner->SetBlock(0, b);
  filter->SetInputDataObject(blocks);
  filter->Update();
  const int k = minima[0] <= minima[1] ? 0 : 1;
  EXPECT_EQ(filter->GetMinimumQuality(), minima[k]);
  EXPECT_EQ(filter->GetMaximumQuality(), std::max(maxima[0], maxima[1]));
  EXPECT_NEAR(filter->GetMeanQuality(), (500 * means[0] + 700 * means[1]) / 1200, 1e-14);
  EXPECT_EQ(filter->GetWorstCellId(), ids[k]);
  EXPECT_EQ(filter->GetWorstCellBlock(), (k ? 3 : 1));
  auto* out = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(out);
  EXPECT_EQ(out->GetNumberOfBlocks(), 3);
  auto* worst = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(3));
  EXPECT_EQ(worst->GetNumberOfCells(), 10);
  EXPECT_TRUE(worst->GetCellData()->GetArray("Block"));
}

/**
 * The worst cell is a ghost: measured, not counted.
 */
TEST(MeshQualityMinMax, GhostsAreMeasuredButNotCounted)
{
  Grid grid = MakeRandom(500, 1);
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  const double minimum = filter->GetMinimumQuality();
  const vtkIdType worst = filter->GetWorstCellId();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  ghosts->SetNumberOfValues(500);
  ghosts->FillValue(0);
  ghosts->SetValue(worst, 1);
  grid->GetCellData()->AddArray(ghosts);
  grid->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfMeasuredCells(), 499);
  EXPECT_GT(filter->GetMinimumQuality(), minimum);
  EXPECT_NE(filter->GetWorstCellId(), worst);
  EXPECT_EQ(QualityOf(filter, worst), minimum);
}

TEST(MeshQualityMinMax, UnusableArraysAreOneError)
{
  Grid grid = MakeRandom(20, 3);
  vtkNew<vtkDoubleArray> size;
  size->SetName("size");
  size->SetNumberOfValues(80);
  size->FillValue(1.0);
  size->SetValue(41, -1.0);
  grid->GetPointData()->AddArray(size);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(80);
  vectors->Fill(0.0);
  grid->GetPointData()->AddArray(vectors);
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS,
            cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const struct
  {
    int Index, Association;
    const char* Array;
    double Beta;
    const char* Says;
  } cases[] = { { 0, cells, nullptr, 1.0, "Beta" }, { 2, points, "size", 1.0, "point 41" },
    { 2, points, "nothing", 1.0, "'nothing'" }, { 2, points, "vectors", 1.0, "3 components" },
    { 3, points, "vectors", 0.0, "3 components" }, { 0, cells, "absent", 0.0, "'absent'" } };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(std::string("an error that says ") + c.Says);
    vtkNew<vtkMeshQualityMinMax> filter;
    const Messages messages(filter);
    filter->SetInputData(grid);
    filter->SetBeta(c.Beta);
    if (c.Array)
    {
      filter->SetInputArrayToProcess(c.Index, 0, 0, c.Association, c.Array);
    }
    filter->Update();
    ASSERT_EQ(messages.Errors.size(), 1u);
    EXPECT_TRUE(Says(messages.Errors[0], c.Says));
  }
}

TEST(MeshQualityMinMax, MeasureMustBeOneOfTheTable)
{
  Grid grid = MakeRandom(20, 3);
  for (const int number : { -1, vtkMeshQualityMinMax::MinimumDihedralAngle + 1 })
  {
    SCOPED_TRACE("measure " + std::to_string(number));
    vtkNew<vtkMeshQualityMinMax> filter;
    const Messages messages(filter);
    filter->SetInputData(grid);
    filter->SetQualityMeasure(number);
    filter->Update();
    ASSERT_EQ(messages.Errors.size(), 1u);
    EXPECT_TRUE(Says(messages.Errors[0], "QualityMeasure is " + std::to_string(number)));
  }
}

TEST(MeshQualityMinMax, NumbersThatAreNoneAreOneError)
{
  Grid grid = MakeRandom(20, 3);
  using Set = void (vtkMeshQualityMinMax::*)(double);
  const std::pair<const char*, Set> cases[] = { { "Beta", &vtkMeshQualityMinMax::SetBeta },
    { "DesiredSize", &vtkMeshQualityMinMax::SetDesiredSize },
    { "TargetQuality", &vtkMeshQualityMinMax::SetTargetQuality } };
  for (const auto& [name, set] : cases)
  {
    SCOPED_TRACE(name);
    vtkNew<vtkMeshQualityMinMax> filter;
    const Messages messages(filter);
    filter->SetInputData(grid);
    (filter->*set)(std::nan(""));
    filter->Update();
    ASSERT_EQ(messages.Errors.size(), 1u);
    EXPECT_TRUE(Says(messages.Errors[0], std::string(name) + " is not a number"));
  }
}

TEST(MeshQualityMinMax, MetricsBeyondTheRangeOfNumbersAreAnError)
{
  Grid grid = MakeRandom(20, 3);
  vtkNew<vtkDoubleArray> metric;
  metric->SetName("metric");
  metric->SetNumberOfComponents(6);
  metric->SetNumberOfTuples(80);
  for (int i = 0; i < 6; ++i)
  {
    metric->FillComponent(i, i < 3 ? 1.0 : 0.0);
  }
  // volumes in it are 0
  metric->SetTuple6(17, 1e-250, 1e-250, 1e-250, 0, 0, 0);
  grid->GetPointData()->AddArray(metric);
  vtkNew<vtkMeshQualityMinMax> filter;
  const Messages messages(filter);
  filter->SetInputData(grid);
  filter->SetMetricArray("metric");
  filter->Update();
  ASSERT_EQ(messages.Errors.size(), 1u);
  EXPECT_TRUE(Says(messages.Errors[0], "at point 17"));
}

TEST(MeshQualityMinMax, SameBitsWithAnyNumberOfThreads)
{
  Grid grid = MakeRandom(50000, 4);
  vtkNew<vtkIntArray> region;
  region->SetName("region");
  for (int c = 0; c < 50000; ++c)
  {
    region->InsertNextValue(c % 7);
  }
  grid->GetCellData()->AddArray(region);
  std::vector<double> first;
  for (const int threads : { 1, 2, 3, 8 })
  {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    vtkNew<vtkMeshQualityMinMax> filter;
    filter->SetInputData(grid);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "region");
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ threads, threads == 1 ? "Sequential" : "STDThread", false },
      [&] { filter->Update(); });
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    EXPECT_EQ(table->GetNumberOfRows(), 8) << "a row for each region and one for all";
    std::vector<double> figures = { filter->GetMinimumQuality(), filter->GetMaximumQuality(),
      filter->GetMeanQuality(), filter->GetStandardDeviation(), filter->GetQualityBound(),
      double(filter->GetNumberOfCappedCells()) };
    for (const char* column : { "Mean", "StandardDeviation", "Bound", "CappedCells", "Count" })
    {
      for (vtkIdType r = 0; r < table->GetNumberOfRows(); ++r)
      {
        figures.push_back(table->GetValueByName(r, column).ToDouble());
      }
    }
    first = first.empty() ? figures : first;
    EXPECT_EQ(std::memcmp(first.data(), figures.data(), sizeof(double) * figures.size()), 0);
  }
}

} // namespace
