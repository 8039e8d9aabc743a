// SPDX-License-Identifier: BSD-3-Clause
// OptimizeBelow and NumberOfLayers of vtkMeshOptimizeFilter: what lies outside of the zone stays
// bit for bit, what lies inside gets better, and the figures are those of the whole mesh.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterZone : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterZone);

constexpr double Threshold = 0.3;

/**
 * A good box with two bad places: inner points pushed most of the way onto others.
 */
Grid MakePatchyBox(double push = 0.85)
{
  Grid grid = MakeBox(9, 0.12);
  for (const auto& pair : { std::pair<vtkIdType, vtkIdType>{ 333, 343 }, { 777, 776 } })
  {
    const Point a = GetPoint(grid, pair.first), b = GetPoint(grid, pair.second);
    Point x;
    for (int i = 0; i < 3; ++i)
    {
      x[i] = a[i] + push * (b[i] - a[i]);
    }
    grid->GetPoints()->SetPoint(pair.first, x.data());
  }
  vtkNew<vtkIntArray> cell, point;
  cell->SetName("cell");
  point->SetName("point");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    cell->InsertNextValue(static_cast<int>(c));
  }
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    point->InsertNextValue(static_cast<int>(p));
  }
  grid->GetCellData()->AddArray(cell);
  grid->GetPointData()->AddArray(point);
  return grid;
}

/**
 * The paper's S (2.3), straight from its definition.
 */
double Shape(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  const std::vector<vtkIdType> ids = CellPoints(grid, cell);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      const Point a = GetPoint(grid, ids[i]), b = GetPoint(grid, ids[j]);
      sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  }
  return 1296.0 * std::sqrt(2.0) * SignedVolume(grid, cell) / (sum * sum * sum);
}

/**
 * Cells of the grid that must not change.
 */
std::vector<vtkIdType> FindOutside(vtkUnstructuredGrid* grid, int layers)
{
  std::set<vtkIdType> points, inside;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (Shape(grid, c) < Threshold)
    {
      inside.insert(c);
    }
  }
  for (int layer = 0; layer < layers; ++layer)
  {
    for (const vtkIdType c : inside)
    {
      const std::vector<vtkIdType> ids = CellPoints(grid, c);
      points.insert(ids.begin(), ids.end());
    }
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      for (const vtkIdType p : CellPoints(grid, c))
      {
        if (points.count(p))
        {
          inside.insert(c);
        }
      }
    }
  }
  std::vector<vtkIdType> outside;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (!inside.count(c))
    {
      outside.push_back(c);
    }
  }
  return outside;
}

/**
 * How many of `cells` of the input are not in the output with the same corners in the same order.
 */
int CountChanged(
  vtkUnstructuredGrid* input, vtkUnstructuredGrid* output, const std::vector<vtkIdType>& cells)
{
  std::map<int, vtkIdType> idToCell;
  vtkDataArray* cellIds = output->GetCellData()->GetArray("cell");
  vtkDataArray* pointIds = output->GetPointData()->GetArray("point");
  for (vtkIdType c = output->GetNumberOfCells() - 1; c >= 0; --c) // the first one wins
  {
    idToCell[static_cast<int>(cellIds->GetComponent(c, 0))] = c;
  }
  int changed = 0;
  for (const vtkIdType cell : cells)
  {
    const auto found = idToCell.find(static_cast<int>(cell));
    bool same = found != idToCell.end();
    const std::vector<vtkIdType> before = CellPoints(input, cell);
    for (std::size_t i = 0; i < before.size() && same; ++i)
    {
      const vtkIdType p = CellPoints(output, found->second)[i];
      same = pointIds->GetComponent(p, 0) == before[i] &&
        GetPoint(output, p) == GetPoint(input, before[i]);
    }
    changed += !same;
  }
  return changed;
}

void CheckFigures(vtkMeshOptimizeFilter* filter, vtkUnstructuredGrid* input)
{
  vtkUnstructuredGrid* output = filter->GetOutput();
  double worst = 1.0, sum = 0.0, sumAfter = 0.0;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    worst = std::min(worst, Shape(input, c));
    sum += Shape(input, c);
  }
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    sumAfter += Shape(output, c);
  }
  const double mean = sum / input->GetNumberOfCells(),
               meanAfter = sumAfter / output->GetNumberOfCells();
  EXPECT_NEAR(filter->GetWorstQualityBefore(), worst, 1e-12);
  EXPECT_NEAR(filter->GetMeanQualityBefore(), mean, 1e-12);
  EXPECT_NEAR(filter->GetMeanQualityAfter(), meanAfter, 1e-12);
  EXPECT_EQ(
    filter->GetWorstQualityAfter(), MinimumOf(output->GetCellData()->GetArray("MeshQuality")));
  EXPECT_GE(filter->GetQualityBound(), filter->GetWorstQualityAfter());
  auto history = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  const vtkIdType last = history->GetNumberOfRows() - 1;
  EXPECT_EQ(history->GetValueByName(0, "Worst").ToDouble(), filter->GetWorstQualityBefore());
  EXPECT_EQ(history->GetValueByName(0, "Cells").ToInt(), input->GetNumberOfCells());
  EXPECT_EQ(history->GetValueByName(0, "Points").ToInt(), input->GetNumberOfPoints());
  EXPECT_EQ(history->GetValueByName(last, "Worst").ToDouble(), filter->GetWorstQualityAfter());
  EXPECT_EQ(history->GetValueByName(last, "Mean").ToDouble(), filter->GetMeanQualityAfter());
  EXPECT_EQ(history->GetValueByName(last, "Cells").ToInt(), output->GetNumberOfCells());
  EXPECT_EQ(history->GetValueByName(last, "Points").ToInt(), output->GetNumberOfPoints());
}

TEST_P(MeshOptimizeFilterZone, OutsideOfTheLayersNothingChanges)
{
  Grid input = MakePatchyBox();
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetOptimizeBelow(Threshold);
  filter->SetTargetQuality(0.45); // time: more is hard to reach where so much is kept
  std::size_t outsideBefore = input->GetNumberOfCells();
  for (const int layers : { 0, 1, 2, 4 })
  {
    SCOPED_TRACE(std::to_string(layers) + " layers");
    const std::vector<vtkIdType> outside = FindOutside(input, layers);
    EXPECT_GT(outside.size(), 1000u);
    EXPECT_LT(outside.size(), outsideBefore);
    outsideBefore = outside.size();
    filter->SetNumberOfLayers(layers);
    filter->Update();
    EXPECT_EQ(CountChanged(input, filter->GetOutput(), outside), 0);
    EXPECT_TRUE(SameFacets(KeptFacets(input), KeptFacets(filter->GetOutput())));
    CheckFigures(filter, input);
    if (layers > 0)
    {
      EXPECT_GT(filter->GetNumberOfOperations(), 0);
      EXPECT_LT(filter->GetWorstQualityBefore(), 0.2);
      EXPECT_GT(filter->GetWorstQualityAfter(), Threshold);
    }
  }
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
}

/**
 * The default is no threshold: cells change that are outside of the zone. The cases above can fail.
 */
TEST_P(MeshOptimizeFilterZone, WithoutAThresholdTheWholeMeshChanges)
{
  Grid input = MakePatchyBox();
  OptimizeFilter plain(GetParam());
  EXPECT_EQ(plain->GetOptimizeBelow(), 0.0);
  EXPECT_EQ(plain->GetNumberOfLayers(), 2);
  plain->SetInputData(input);
  plain->Update();
  EXPECT_GT(CountChanged(input, plain->GetOutput(), FindOutside(input, 2)), 0);
}

TEST_P(MeshOptimizeFilterZone, NoCellUnderTheThresholdLeavesTheMesh)
{
  Grid input = MakePatchyBox();
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->SetOptimizeBelow(0.01);
  filter->Update();
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::NothingToDo);
  EXPECT_EQ(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  CheckFigures(filter, input);
  Grid bare = Grid::New();
  bare->DeepCopy(filter->GetOutput());
  bare->GetCellData()->RemoveArray("MeshQuality");
  bare->GetFieldData()->Initialize();
  EXPECT_TRUE(SameGrid(bare, input));
}

TEST_P(MeshOptimizeFilterZone, EveryCellUnderTheThresholdIsAsWithoutOne)
{
  Grid input = MakePatchyBox();
  OptimizeFilter all(GetParam()), off(GetParam());
  all->SetInputData(input);
  all->SetOptimizeBelow(1.0);
  all->SetTargetQuality(0.5);
  all->Update();
  off->SetInputData(input);
  off->SetTargetQuality(0.5);
  off->Update();
  EXPECT_TRUE(SameGrid(all->GetOutput(), off->GetOutput()));
}

/**
 * Inverted cells are cells under any threshold and keep their orientation, though the zone's own
 * volume may be negative.
 */
TEST_P(MeshOptimizeFilterZone, InvertedCellsAreUnderAnyThreshold)
{
  Grid input = MakePatchyBox(1.3);
  int inverted = 0;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    inverted += SignedVolume(input, c) < 0.0;
  }
  EXPECT_GT(inverted, 3);
  for (const int layers : { 0, 2 })
  {
    SCOPED_TRACE(std::to_string(layers) + " layers");
    OptimizeFilter filter(GetParam());
    Messages messages(filter);
    filter->SetInputData(input);
    filter->SetOptimizeBelow(1e-6);
    filter->SetTargetQuality(0.4);
    filter->SetNumberOfLayers(layers);
    filter->Update();
    EXPECT_EQ(messages.Errors, NoMessages);
    double volume = 0.0;
    int still = 0;
    for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
    {
      const double v = SignedVolume(filter->GetOutput(), c);
      volume += v;
      still += v <= 0.0;
    }
    EXPECT_NEAR(volume, 1.0, 1e-12);
    EXPECT_TRUE(layers == 0 || still == 0);
    CheckFigures(filter, input);
  }
}

TEST_P(MeshOptimizeFilterZone, ReversedCellsAreFoundOutsideOfTheZone)
{
  Grid reversed = MakePatchyBox();
  std::vector<vtkIdType> ids = CellPoints(reversed, 4000);
  std::swap(ids[0], ids[1]);
  reversed->GetCells()->ReplaceCellAtId(4000, 4, ids.data());
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(reversed);
  filter->SetOptimizeBelow(Threshold);
  filter->SetTargetQuality(0.45);
  filter->Update();
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "renumbered, 1 in all"));
  EXPECT_GT(filter->GetWorstQualityAfter(), Threshold);
  EXPECT_EQ(filter->GetWorstQualityAfter(),
    MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")));
}

/**
 * Triangles, with a size that differs from place to place: qualities outside are right as well.
 */
TEST_P(MeshOptimizeFilterZone, TrianglesOutsideKeepTheirQualities)
{
  Grid input = MakeSquare(12, 0.1, [](double u, double v) { return Point{ { u, v, u - v } }; });
  const Point a = GetPoint(input, 84), b = GetPoint(input, 85);
  input->GetPoints()->SetPoint(
    84, 0.2 * a[0] + 0.8 * b[0], 0.2 * a[1] + 0.8 * b[1], 0.2 * a[2] + 0.8 * b[2]);
  vtkNew<vtkDoubleArray> size;
  size->SetName("h");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    size->InsertNextValue(0.15 * (1.0 + 0.3 * GetPoint(input, p)[0]));
  }
  input->GetPointData()->AddArray(size);
  OptimizeFilter measure(GetParam()), filter(GetParam());
  for (vtkMeshOptimizeFilter* f : { measure.Get(), filter.Get() })
  {
    f->SetInputData(input);
    f->SetBeta(0.3);
    f->SetSizeArray("h");
  }
  ChangeNothing(measure);
  measure->Update();
  filter->SetOptimizeBelow(0.4);
  filter->SetNumberOfLayers(1);
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(filter->GetWorstQualityBefore(), measure->GetWorstQualityBefore());
  EXPECT_NEAR(filter->GetMeanQualityBefore(), measure->GetMeanQualityBefore(), 1e-12);
  EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore() + 0.1);
  // What has been left out comes first and has its quality of before, to the last bit.
  vtkDataArray* before = measure->GetOutput()->GetCellData()->GetArray("MeshQuality");
  vtkDataArray* after = filter->GetOutput()->GetCellData()->GetArray("MeshQuality");
  EXPECT_EQ(MinimumOf(after), filter->GetWorstQualityAfter());
  int same = 0;
  for (vtkIdType c = 0; c < 100; ++c)
  {
    same += before->GetComponent(c, 0) == after->GetComponent(c, 0);
  }
  EXPECT_EQ(same, 100);
}

} // namespace
