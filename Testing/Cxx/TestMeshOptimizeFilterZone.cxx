// OptimizeBelow and NumberOfLayers of vtkMeshOptimizeFilter: what lies outside of the zone stays bit
// for bit, what lies inside gets better, and the figures are those of the whole mesh.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"

using namespace Testing;

namespace
{

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
  CHECK(std::abs(filter->GetWorstQualityBefore() - worst) < 1e-12);
  CHECK(std::abs(filter->GetMeanQualityBefore() - mean) < 1e-12);
  CHECK(std::abs(filter->GetMeanQualityAfter() - meanAfter) < 1e-12);
  CHECK(
    filter->GetWorstQualityAfter() == MinimumOf(output->GetCellData()->GetArray("MeshQuality")));
  CHECK(filter->GetQualityBound() >= filter->GetWorstQualityAfter());
  auto history = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  const vtkIdType last = history->GetNumberOfRows() - 1;
  CHECK(history->GetValueByName(0, "Worst").ToDouble() == filter->GetWorstQualityBefore());
  CHECK(history->GetValueByName(0, "Cells").ToInt() == input->GetNumberOfCells());
  CHECK(history->GetValueByName(0, "Points").ToInt() == input->GetNumberOfPoints());
  CHECK(history->GetValueByName(last, "Worst").ToDouble() == filter->GetWorstQualityAfter());
  CHECK(history->GetValueByName(last, "Mean").ToDouble() == filter->GetMeanQualityAfter());
  CHECK(history->GetValueByName(last, "Cells").ToInt() == output->GetNumberOfCells());
  CHECK(history->GetValueByName(last, "Points").ToInt() == output->GetNumberOfPoints());
}

void TestLayers()
{
  Grid input = MakePatchyBox();
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetOptimizeBelow(Threshold);
  filter->SetTargetQuality(0.45); // time: more is hard to reach where so much is kept
  std::size_t outsideBefore = input->GetNumberOfCells();
  for (const int layers : { 0, 1, 2, 4 })
  {
    const std::vector<vtkIdType> outside = FindOutside(input, layers);
    CHECK(outside.size() > 1000 && outside.size() < outsideBefore);
    outsideBefore = outside.size();
    filter->SetNumberOfLayers(layers);
    filter->Update();
    CHECK(CountChanged(input, filter->GetOutput(), outside) == 0);
    CHECK(KeptFacets(input) == KeptFacets(filter->GetOutput()));
    CheckFigures(filter, input);
    if (layers > 0)
    {
      CHECK(filter->GetNumberOfOperations() > 0);
      CHECK(filter->GetWorstQualityBefore() < 0.2);
      CHECK(filter->GetWorstQualityAfter() > Threshold);
    }
  }
  CHECK(messages.Errors.empty() && messages.Warnings.empty());
  // The default is two layers; and without a threshold cells change that were outside of it.
  OptimizeFilter plain;
  CHECK(plain->GetOptimizeBelow() == 0.0 && plain->GetNumberOfLayers() == 2);
  plain->SetInputData(input);
  plain->Update();
  CHECK(CountChanged(input, plain->GetOutput(), FindOutside(input, 2)) > 0);
}

/**
 * No cell under the threshold: all stays. Every cell under it: as if there were none.
 */
void TestNoneAndAll()
{
  Grid input = MakePatchyBox();
  OptimizeFilter filter;
  filter->SetInputData(input);
  filter->SetOptimizeBelow(0.01);
  filter->Update();
  CHECK(filter->GetStopReason() == vtkMeshOptimizeFilter::NothingToDo);
  CHECK(filter->GetNumberOfOperations() == 0);
  CHECK(filter->GetWorstQualityAfter() == filter->GetWorstQualityBefore());
  CheckFigures(filter, input);
  Grid bare = Grid::New();
  bare->DeepCopy(filter->GetOutput());
  bare->GetCellData()->RemoveArray("MeshQuality");
  bare->GetFieldData()->Initialize();
  CHECK(SameGrid(bare, input));

  OptimizeFilter all, off;
  all->SetInputData(input);
  all->SetOptimizeBelow(1.0);
  all->SetTargetQuality(0.5);
  all->Update();
  off->SetInputData(input);
  off->SetTargetQuality(0.5);
  off->Update();
  CHECK(SameGrid(all->GetOutput(), off->GetOutput()));
}

/**
 * Inverted cells are cells under any threshold and keep their orientation, though the zone's own
 * volume may be negative; reversed ones are found wherever they are.
 */
void TestInvertedAndReversed()
{
  Grid input = MakePatchyBox(1.3);
  int inverted = 0;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    inverted += SignedVolume(input, c) < 0.0;
  }
  CHECK(inverted > 3);
  for (const int layers : { 0, 2 })
  {
    OptimizeFilter filter;
    Messages messages(filter);
    filter->SetInputData(input);
    filter->SetOptimizeBelow(1e-6);
    filter->SetTargetQuality(0.4);
    filter->SetNumberOfLayers(layers);
    filter->Update();
    CHECK(messages.Errors.empty());
    double volume = 0.0;
    int still = 0;
    for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
    {
      const double v = SignedVolume(filter->GetOutput(), c);
      volume += v;
      still += v <= 0.0;
    }
    CHECK(std::abs(volume - 1.0) < 1e-12);
    CHECK(layers == 0 || still == 0);
    CheckFigures(filter, input);
  }

  Grid reversed = MakePatchyBox();
  std::vector<vtkIdType> ids = CellPoints(reversed, 4000);
  std::swap(ids[0], ids[1]);
  reversed->GetCells()->ReplaceCellAtId(4000, 4, ids.data());
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(reversed);
  filter->SetOptimizeBelow(Threshold);
  filter->SetTargetQuality(0.45);
  filter->Update();
  CHECK(messages.Warnings.size() == 1 && messages.Warnings[0].find("1 cells") != std::string::npos);
  CHECK(filter->GetWorstQualityAfter() > Threshold);
  CHECK(filter->GetWorstQualityAfter() ==
    MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")));
}

/**
 * Triangles, with a size that differs from place to place: qualities outside are right as well.
 */
void TestPlane()
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
  OptimizeFilter measure, filter;
  for (vtkMeshOptimizeFilter* f : { measure.Get(), filter.Get() })
  {
    f->SetInputData(input);
    f->SetBeta(0.3);
    f->SetSizeArray("h");
  }
  measure->SetMoveNodes(false);
  measure->SetReconnect(false);
  measure->SetInsertNodes(false);
  measure->SetRemoveNodes(false);
  measure->Update();
  filter->SetOptimizeBelow(0.4);
  filter->SetNumberOfLayers(1);
  filter->Update();
  CHECK(filter->GetNumberOfOperations() > 0);
  CHECK(filter->GetWorstQualityBefore() == measure->GetWorstQualityBefore());
  CHECK(std::abs(filter->GetMeanQualityBefore() - measure->GetMeanQualityBefore()) < 1e-12);
  CHECK(filter->GetWorstQualityAfter() > filter->GetWorstQualityBefore() + 0.1);
  // What has been left out comes first and has its quality of before, to the last bit.
  vtkDataArray* before = measure->GetOutput()->GetCellData()->GetArray("MeshQuality");
  vtkDataArray* after = filter->GetOutput()->GetCellData()->GetArray("MeshQuality");
  CHECK(MinimumOf(after) == filter->GetWorstQualityAfter());
  int same = 0;
  for (vtkIdType c = 0; c < 100; ++c)
  {
    same += before->GetComponent(c, 0) == after->GetComponent(c, 0);
  }
  CHECK(same == 100);
}

} // namespace

int main(int, char*[])
{
  ForBothAlgorithms(
    []()
    {
      TestLayers();
      TestNoneAndAll();
      TestInvertedAndReversed();
      TestPlane();
    });
  return Testing::Failures;
}
