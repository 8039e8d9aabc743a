// vtkMeshQualityMinMax on mixed and broken cells, on blocks, with ghosts, with unusable arrays, and with several threads.
#include "vtkMeshQualityMinMax.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

int failures = 0;

void Check(bool condition, const std::string& what)
{
  if (!condition)
  {
    ++failures;
    std::cerr << "FAILED: " << what << "\n";
  }
}

/**
 * Counts errors and keeps the last text.
 */
class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    ++this->Count;
    this->Text = static_cast<const char*>(data);
  }
  int Count = 0;
  std::string Text;
};

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

Grid MakeGrid(const std::vector<std::array<double, 3>>& points)
{
  Grid grid = Grid::New();
  vtkNew<vtkPoints> p;
  p->SetDataTypeToDouble();
  for (const auto& x : points)
  {
    p->InsertNextPoint(x.data());
  }
  grid->SetPoints(p);
  grid->Allocate(10);
  return grid;
}

void Add(vtkUnstructuredGrid* grid, int type, const std::vector<vtkIdType>& ids)
{
  grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
}

/**
 * n tetrahedra with nodes at random; every fifth is inverted or nearly flat.
 */
Grid MakeRandom(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<std::array<double, 3>> points(4 * n);
  for (auto& x : points)
  {
    x = { { u(random), u(random), u(random) } };
  }
  Grid grid = MakeGrid(points);
  for (vtkIdType c = 0; c < n; ++c)
  {
    Add(grid, VTK_TETRA, { 4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3 });
  }
  return grid;
}

const std::vector<std::array<double, 3>> Regular = { { { 0, 0, 0 } }, { { 1, 0, 0 } },
  { { 0.5, std::sqrt(0.75), 0 } }, { { 0.5, std::sqrt(3.0) / 6.0, std::sqrt(2.0 / 3.0) } } };

double QualityOf(vtkMeshQualityMinMax* filter, vtkIdType cell)
{
  return vtkDoubleArray::SafeDownCast(filter->GetOutput()->GetCellData()->GetArray("MeshQuality"))
    ->GetValue(cell);
}

void TestMixedCells()
{
  Grid grid = MakeGrid({ Regular[0], Regular[1], Regular[2], Regular[3], { { 0, 0, 1 } },
    { { 1, 1, std::nan("") } } });
  Add(grid, VTK_TETRA, { 0, 1, 2, 3 });
  Add(grid, VTK_TRIANGLE, { 0, 2, 1 });
  Add(grid, VTK_LINE, { 0, 1 });
  Add(grid, VTK_TETRA, { 1, 0, 2, 3 }); // inverted
  Add(grid, VTK_TETRA, { 0, 0, 0, 0 }); // collapsed
  Add(grid, VTK_TETRA, { 0, 1, 2, 5 }); // not a number
  Add(grid, VTK_QUADRATIC_TETRA, { 0, 1, 2, 3, 4, 4, 4, 4, 4, 4 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  Check(std::abs(QualityOf(filter, 0) - 1.0) < 1e-14, "the regular tetrahedron is 1");
  Check(std::abs(QualityOf(filter, 1) - 1.0) < 1e-14, "a triangle among tetrahedra has no sign");
  Check(std::isnan(QualityOf(filter, 2)), "a line is not measured");
  Check(std::abs(QualityOf(filter, 3) + 1.0) < 1e-14, "the inverted tetrahedron is -1");
  Check(QualityOf(filter, 4) == 0.0, "a collapsed one is 0");
  Check(std::isnan(QualityOf(filter, 5)), "a coordinate that is not a number");
  Check(std::abs(QualityOf(filter, 6) - 1.0) < 1e-14, "quadratic: by the corners");
  Check(filter->GetNumberOfMeasuredCells() == 5, "five measured");
  Check(filter->GetNumberOfInvertedCells() == 1, "one inverted");
  Check(filter->GetNumberOfNotMeasurableCells() == 1, "one not measurable");
  Check(filter->GetNumberOfOtherCells() == 1, "one other");
  Check(filter->GetWorstCellId() == 3, "the inverted one is the worst");
  Check(!grid->GetCellData()->GetArray("MeshQuality"), "the input is not modified");
  auto* worst = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(3));
  Check(worst->GetNumberOfCells() == 5 &&
      worst->GetCellData()->GetArray("OriginalCellIds")->GetComponent(1, 0) == 4,
    "worst cells in order");
}

void TestBrokenCells()
{
  // ids out of range, and a facet with three cells: measured as they are, no crash
  Grid grid = MakeGrid({ Regular[0], Regular[1], Regular[2], Regular[3], { { 0.5, 0.3, -0.8 } },
    { { 0.5, 0.3, 2 } } });
  Add(grid, VTK_TETRA, { 0, 1, 2, 3 });
  Add(grid, VTK_TETRA, { 0, 2, 1, 4 });
  Add(grid, VTK_TETRA, { 0, 1, 2, 5 });
  Add(grid, VTK_TETRA, { 0, 1, 2, 77 });
  Add(grid, VTK_TETRA, { 0, -1, 2, 3 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  Check(filter->GetNumberOfMeasuredCells() == 3 && filter->GetNumberOfNotMeasurableCells() == 2,
    "cells with points that are not there");
  Check(filter->GetMinimumQuality() <= filter->GetQualityBound(), "bound of a broken mesh");
}

void TestEmpty()
{
  vtkNew<vtkUnstructuredGrid> empty;
  vtkNew<ErrorCounter> errors;
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->SetInputData(empty);
  filter->Update();
  Check(errors->Count == 0 && std::isnan(filter->GetMinimumQuality()) &&
      filter->GetNumberOfMeasuredCells() == 0 && filter->GetWorstCellId() == -1,
    "an empty grid is no error");
  Check(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows() == 1,
    "one row of summary");
}

void TestFlatTriangles()
{
  Grid grid = MakeGrid({ { { 0, 0, 3 } }, { { 1, 0, 3 } }, { { 0.5, std::sqrt(0.75), 3 } } });
  Add(grid, VTK_TRIANGLE, { 0, 1, 2 });
  Add(grid, VTK_TRIANGLE, { 0, 2, 1 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->Update();
  Check(
    std::abs(QualityOf(filter, 0) - 1.0) < 1e-14 && std::abs(QualityOf(filter, 1) + 1.0) < 1e-14,
    "triangles in a plane have a sign");
  grid->GetPoints()->SetPoint(2, 0.5, 0.0, 3.0 + std::sqrt(0.75));
  grid->GetPoints()->Modified();
  grid->Modified();
  filter->Update();
  Check(
    std::abs(QualityOf(filter, 0) - 1.0) < 1e-14 && std::abs(QualityOf(filter, 1) + 1.0) < 1e-14,
    "in any plane");
  grid->GetPoints()->InsertNextPoint(0.5, 1.0, 3.0);
  Add(grid, VTK_TRIANGLE, { 0, 1, 3 });
  grid->Modified();
  filter->Update();
  Check(
    std::abs(QualityOf(filter, 0) - 1.0) < 1e-14 && std::abs(QualityOf(filter, 1) - 1.0) < 1e-14,
    "triangles in space have none");
}

void TestBlocksAndGhosts()
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
  Check(filter->GetMinimumQuality() == minima[k], "minimum over blocks");
  Check(filter->GetMaximumQuality() == std::max(maxima[0], maxima[1]), "maximum over blocks");
  Check(std::abs(filter->GetMeanQuality() - (500 * means[0] + 700 * means[1]) / 1200) < 1e-14,
    "mean over blocks");
  Check(filter->GetWorstCellId() == ids[k] && filter->GetWorstCellBlock() == (k ? 3 : 1),
    "worst cell's block");
  auto* out = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  Check(out && out->GetNumberOfBlocks() == 3, "blocks are kept");
  auto* worst = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(3));
  Check(worst->GetNumberOfCells() == 10 && worst->GetCellData()->GetArray("Block"),
    "worst of all blocks");

  // the worst cell is a ghost: measured, not counted
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  ghosts->SetNumberOfValues(500);
  ghosts->FillValue(0);
  ghosts->SetValue(ids[0], 1);
  a->GetCellData()->AddArray(ghosts);
  filter->SetInputData(a);
  filter->Update();
  Check(filter->GetNumberOfMeasuredCells() == 499 && filter->GetMinimumQuality() > minima[0] &&
      filter->GetWorstCellId() != ids[0],
    "ghosts are not counted");
  Check(QualityOf(filter, ids[0]) == minima[0], "ghosts are measured");
}

void TestErrors()
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
    vtkNew<vtkMeshQualityMinMax> filter;
    vtkNew<ErrorCounter> errors;
    filter->AddObserver(vtkCommand::ErrorEvent, errors);
    filter->SetInputData(grid);
    filter->SetBeta(c.Beta);
    if (c.Array)
    {
      filter->SetInputArrayToProcess(c.Index, 0, 0, c.Association, c.Array);
    }
    filter->Update();
    Check(errors->Count == 1, std::string("one error that says ") + c.Says);
    Check(errors->Text.find(c.Says) != std::string::npos,
      "says " + std::string(c.Says) + ": " + errors->Text);
  }
  for (int number : { -1, vtkMeshQualityMinMax::MinimumDihedralAngle + 1 })
  {
    vtkNew<vtkMeshQualityMinMax> filter;
    vtkNew<ErrorCounter> errors;
    filter->AddObserver(vtkCommand::ErrorEvent, errors);
    filter->SetInputData(grid);
    filter->SetQualityMeasure(number);
    filter->Update();
    Check(errors->Count == 1, "one error for a measure that is none");
    Check(errors->Text.find("QualityMeasure is " + std::to_string(number)) != std::string::npos,
      "names the measure: " + errors->Text);
  }
}

void TestThreads()
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
  for (int threads : { 1, 2, 3, 8 })
  {
    vtkNew<vtkMeshQualityMinMax> filter;
    filter->SetInputData(grid);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "region");
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ threads, threads == 1 ? "Sequential" : "STDThread", false },
      [&] { filter->Update(); });
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    Check(table->GetNumberOfRows() == 8, "a row for each region and one for all");
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
    Check(std::memcmp(first.data(), figures.data(), sizeof(double) * figures.size()) == 0,
      "the same bits with " + std::to_string(threads) + " threads");
  }
}

} // namespace

int main(int, char**)
{
  TestMixedCells();
  TestBrokenCells();
  TestEmpty();
  TestFlatTriangles();
  TestBlocksAndGhosts();
  TestErrors();
  TestThreads();
  return failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
