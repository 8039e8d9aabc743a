// Inverted and flat cells in vtkMeshOptimizeFilter: repaired where the surface allows it; where not,
// one warning says which cells and why.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnsignedCharArray.h"

using namespace Testing;

namespace
{

int CountInverted(vtkUnstructuredGrid* grid)
{
  int inverted = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    inverted += SignedVolume(grid, c) <= 0.0;
  }
  return inverted;
}

void Move(vtkUnstructuredGrid* grid, vtkIdType p, double x, double y, double z)
{
  const Point a = GetPoint(grid, p);
  grid->GetPoints()->SetPoint(p, a[0] + x, a[1] + y, a[2] + z);
}

void AddCellIds(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("cell");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    ids->InsertNextValue(static_cast<int>(c));
  }
  grid->GetCellData()->AddArray(ids);
}

double Figure(vtkUnstructuredGrid* grid, const char* name)
{
  vtkDataArray* array = grid->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : -1.0;
}

/**
 * Runs, and checks what is reported against the volumes of the output. Returns the warning.
 */
std::string Run(vtkMeshOptimizeFilter* filter, vtkUnstructuredGrid* input)
{
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetNumberOfInvertedCellsBefore() == CountInverted(input));
  CHECK(filter->GetNumberOfInvertedCellsAfter() == CountInverted(output));
  CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
  CHECK(Figure(output, "NumberOfInvertedCellsBefore") == filter->GetNumberOfInvertedCellsBefore());
  CHECK(Figure(output, "NumberOfInvertedCellsAfter") == filter->GetNumberOfInvertedCellsAfter());
  CHECK(KeptFacets(input) == KeptFacets(output));
  const bool left = filter->GetNumberOfInvertedCellsAfter() > 0;
  CHECK(messages.Warnings.size() == (left ? 1u : 0u));
  if (messages.Warnings.empty())
  {
    return {};
  }
  const std::string warning = messages.Warnings[0].substr(messages.Warnings[0].find("): ") + 3);
  std::cout << warning << std::flush;
  CHECK(warning.find(std::to_string(filter->GetNumberOfInvertedCellsAfter()) + " cell") == 0);
  return warning;
}

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/**
 * A node inside is far out of its place, or all are: nothing is left, nothing is said.
 */
void TestRepaired()
{
  Grid one = MakeBox(4, 0.0);
  Move(one, 62, 0.6, 0.35, 0.2);
  CHECK(CountInverted(one) > 5);
  OptimizeFilter filter;
  CHECK(Run(filter, one).empty());
  CHECK(filter->GetNumberOfInvertedCellsAfter() == 0);
  CHECK(filter->GetWorstQualityAfter() > 0.3);

  Grid many = MakeBox(5, 0.7);
  CHECK(CountInverted(many) > 10);
  CHECK(Run(filter, many).empty());
  CHECK(filter->GetWorstQualityAfter() > 0.1);
}

/**
 * Nodes thrown about, and the cells that this inverts renumbered: all have a positive volume and
 * lie on each other. The warning says so, nothing is renumbered, and none becomes inverted.
 */
void TestOverlapIsNamed()
{
  Grid grid = MakeBox(3, 0.9);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (SignedVolume(grid, c) < 0.0)
    {
      grid->GetCellPoints(c, ids);
      const vtkIdType swapped[4] = { ids->GetId(0), ids->GetId(1), ids->GetId(3), ids->GetId(2) };
      grid->GetCells()->ReplaceCellAtId(c, 4, swapped);
    }
  }
  CHECK(CountInverted(grid) == 0);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(messages.Warnings.size() == 1);
  CHECK(!messages.Warnings.empty() && Has(messages.Warnings[0], "Cells of the input overlap"));
  CHECK(!messages.Warnings.empty() && Has(messages.Warnings[0], "same side"));
  CHECK(CountInverted(filter->GetOutput()) == 0);
  CHECK(filter->GetWorstQualityBefore() > 0.0);
  CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
}

/**
 * The cells that the warning names are inverted ones: `cell 17` with the id of the input.
 */
void CheckNames(const std::string& warning, vtkUnstructuredGrid* output)
{
  std::set<int> inverted;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    if (SignedVolume(output, c) <= 0.0)
    {
      inverted.insert(
        static_cast<int>(output->GetCellData()->GetArray("cell")->GetComponent(c, 0)));
    }
  }
  int named = 0;
  for (std::size_t place = warning.find("cell "); place != std::string::npos;
       place = warning.find("cell ", place + 1))
  {
    const std::size_t end = warning.find_first_not_of("0123456789", place + 5);
    const int id = std::stoi(warning.substr(place + 5));
    ++named;
    if (warning.compare(end, 14, " of the output") == 0)
    {
      CHECK(SignedVolume(output, id) <= 0.0);
    }
    else
    {
      CHECK(inverted.count(id) == 1);
    }
  }
  CHECK(named > 0);
}

/**
 * A node of the upper side is moved along it past the next one, or pushed down through the lower.
 */
void TestSurfaceAtFault()
{
  OptimizeFilter filter;
  Grid folded = MakeBox(4, 0.0);
  AddCellIds(folded);
  Move(folded, 112, 0.33, 0.02, 0.0);
  const std::string aboutFold = Run(filter, folded);
  CHECK(filter->GetNumberOfInvertedCellsAfter() > 0);
  CHECK(Has(aboutFold, "folded onto each other (points of the input ") && Has(aboutFold, "112"));
  CheckNames(aboutFold, filter->GetOutput());

  Grid crossing = MakeBox(2, 0.0);
  AddCellIds(crossing);
  Move(crossing, 22, 0.07, 0.04, -1.2);
  const std::string aboutCrossing = Run(filter, crossing);
  CHECK(Has(aboutCrossing, "pass through each other (points of the input "));
  CHECK(Has(aboutCrossing, "22"));
  CheckNames(aboutCrossing, filter->GetOutput());

  Grid line = MakeGrid(
    { { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 3, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } });
  AddCell(line, VTK_TETRA, { 0, 1, 2, 4 });
  AddCell(line, VTK_TETRA, { 0, 2, 3, 4 });
  AddCellIds(line);
  const std::string aboutLine = Run(filter, line);
  CHECK(Has(aboutLine,
    "1 with a face without area on the kept surface (points of the input 0 1 2), cell 0."));

  Grid plane = MakeSquare(4, 0.0, [](double u, double v) { return Point{ { u, v, 0 } }; });
  Move(plane, 22, 0.3, 0.0, 0.0);
  Messages messages(filter);
  filter->SetInputData(plane);
  filter->Update();
  CHECK(filter->GetNumberOfInvertedCellsAfter() > 0);
  CHECK(messages.Warnings.size() == 1 &&
    Has(messages.Warnings[0], "kept edges are folded onto each other") &&
    Has(messages.Warnings[0], "22"));
}

/**
 * The surface is sound but nothing may change, or there is no time.
 */
void TestNotAllowed()
{
  Grid input = MakeBox(4, 0.0);
  AddCellIds(input);
  Move(input, 62, 0.6, 0.35, 0.2);
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName("fixed");
  mask->SetNumberOfValues(input->GetNumberOfPoints());
  mask->Fill(1);
  input->GetPointData()->AddArray(mask);
  OptimizeFilter fixed;
  fixed->SetFixedPointArray("fixed");
  fixed->ReconnectOff();
  fixed->InsertNodesOff();
  fixed->RemoveNodesOff();
  const std::string aboutFixed = Run(fixed, input);
  CHECK(Has(aboutFixed, "with no node that may move"));
  CHECK(Has(aboutFixed, ", ...")); // there are more than five
  CheckNames(aboutFixed, fixed->GetOutput());

  OptimizeFilter none;
  none->MoveNodesOff();
  none->ReconnectOff();
  none->InsertNodesOff();
  none->RemoveNodesOff();
  CHECK(Has(Run(none, input), "that nothing tried could repair"));

  OptimizeFilter hurried;
  hurried->SetTimeLimit(1e-9);
  const std::string aboutTime = Run(hurried, input);
  CHECK(hurried->GetStopReason() == vtkMeshOptimizeFilter::TimeLimitReached);
  CHECK(aboutTime.empty() || Has(aboutTime, "left because the run was ended early"));
}

/**
 * All blocks in one warning, each by its index.
 */
void TestBlocks()
{
  Grid folded = MakeBox(4, 0.0);
  Move(folded, 112, 0.33, 0.02, 0.0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, folded);
  blocks->SetBlock(1, MakeBox(2, 0.1));
  blocks->SetBlock(2, folded);
  OptimizeFilter filter, alone;
  Messages messages(filter);
  filter->SetInputDataObject(blocks);
  filter->Update();
  Run(alone, folded);
  CHECK(messages.Warnings.size() == 1 && Has(messages.Warnings[0], "Block 1: ") &&
    !Has(messages.Warnings[0], "Block 2: ") && Has(messages.Warnings[0], "Block 3: "));
  CHECK(filter->GetNumberOfInvertedCellsBefore() == 2 * alone->GetNumberOfInvertedCellsBefore());
  CHECK(filter->GetNumberOfInvertedCellsAfter() == 2 * alone->GetNumberOfInvertedCellsAfter());
}

} // namespace

int main(int, char*[])
{
  ForBothAlgorithms(
    []()
    {
      TestRepaired();
      TestOverlapIsNamed();
      TestSurfaceAtFault();
      TestNotAllowed();
      TestBlocks();
    });
  return Testing::Failures;
}
