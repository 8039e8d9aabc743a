// SPDX-License-Identifier: BSD-3-Clause
// Inverted and flat cells in vtkMeshOptimizeFilter: repaired where the surface allows it; where
// not, one warning says which cells and why.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnsignedCharArray.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterTangle : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterTangle);

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

/**
 * Runs, and checks what is reported against the volumes of the output. Returns the warning.
 */
std::string WarningOf(vtkMeshOptimizeFilter* filter, vtkUnstructuredGrid* input)
{
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(filter->GetNumberOfInvertedCellsBefore(), CountInverted(input));
  EXPECT_EQ(filter->GetNumberOfInvertedCellsAfter(), CountInverted(output));
  EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  EXPECT_EQ(
    Figure(output, "NumberOfInvertedCellsBefore"), filter->GetNumberOfInvertedCellsBefore());
  EXPECT_EQ(Figure(output, "NumberOfInvertedCellsAfter"), filter->GetNumberOfInvertedCellsAfter());
  EXPECT_TRUE(SameFacets(KeptFacets(input), KeptFacets(output)));
  const bool left = filter->GetNumberOfInvertedCellsAfter() > 0;
  EXPECT_EQ(messages.Warnings.size(), left ? 1u : 0u);
  if (messages.Warnings.empty())
  {
    return {};
  }
  const std::string warning = messages.Warnings[0].substr(messages.Warnings[0].find("): ") + 3);
  std::cout << warning << std::flush;
  EXPECT_EQ(warning.find(std::to_string(filter->GetNumberOfInvertedCellsAfter()) + " cell"), 0u)
    << warning;
  return warning;
}

/**
 * Nothing is left, so nothing is said.
 */
TEST_P(MeshOptimizeFilterTangle, OneNodeFarOutOfItsPlaceIsRepaired)
{
  Grid input = MakeBox(4, 0.0);
  Move(input, 62, 0.6, 0.35, 0.2);
  EXPECT_GT(CountInverted(input), 5);
  OptimizeFilter filter(GetParam());
  EXPECT_EQ(WarningOf(filter, input), "");
  EXPECT_EQ(filter->GetNumberOfInvertedCellsAfter(), 0);
  EXPECT_GT(filter->GetWorstQualityAfter(), 0.3);
}

TEST_P(MeshOptimizeFilterTangle, AllNodesOutOfTheirPlacesAreRepaired)
{
  Grid input = MakeBox(5, 0.7);
  EXPECT_GT(CountInverted(input), 10);
  OptimizeFilter filter(GetParam());
  EXPECT_EQ(WarningOf(filter, input), "");
  EXPECT_GT(filter->GetWorstQualityAfter(), 0.1);
}

/**
 * Nodes thrown about, and the cells that this inverts renumbered: all have a positive volume and
 * lie on each other. The warning says so, nothing is renumbered, and none becomes inverted.
 */
TEST_P(MeshOptimizeFilterTangle, CellsThatOverlapAreNamed)
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
  EXPECT_EQ(CountInverted(grid), 0);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "Cells of the input overlap"));
  EXPECT_TRUE(Says(messages.Warnings[0], "same side"));
  EXPECT_EQ(CountInverted(filter->GetOutput()), 0);
  EXPECT_GT(filter->GetWorstQualityBefore(), 0.0);
  EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
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
      EXPECT_LE(SignedVolume(output, id), 0.0) << "cell " << id;
    }
    else
    {
      EXPECT_EQ(inverted.count(id), 1u) << "cell " << id;
    }
  }
  EXPECT_GT(named, 0);
}

/**
 * A node of the upper side is moved along it past the next one.
 */
TEST_P(MeshOptimizeFilterTangle, FoldedSurfaceIsNamed)
{
  Grid input = MakeBox(4, 0.0);
  AddCellIds(input);
  Move(input, 112, 0.33, 0.02, 0.0);
  OptimizeFilter filter(GetParam());
  const std::string warning = WarningOf(filter, input);
  EXPECT_GT(filter->GetNumberOfInvertedCellsAfter(), 0);
  EXPECT_TRUE(Says(warning, "folded onto each other (points of the input "));
  EXPECT_TRUE(Says(warning, "112"));
  CheckNames(warning, filter->GetOutput());
}

/**
 * A node of the upper side is pushed down through the lower one.
 */
TEST_P(MeshOptimizeFilterTangle, CrossingSurfaceIsNamed)
{
  Grid input = MakeBox(2, 0.0);
  AddCellIds(input);
  Move(input, 22, 0.07, 0.04, -1.2);
  OptimizeFilter filter(GetParam());
  const std::string warning = WarningOf(filter, input);
  EXPECT_TRUE(Says(warning, "pass through each other (points of the input "));
  EXPECT_TRUE(Says(warning, "22"));
  CheckNames(warning, filter->GetOutput());
}

TEST_P(MeshOptimizeFilterTangle, SurfaceWithoutAreaIsNamed)
{
  Grid input = MakeGrid(
    { { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 3, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } });
  AddCell(input, VTK_TETRA, { 0, 1, 2, 4 });
  AddCell(input, VTK_TETRA, { 0, 2, 3, 4 });
  AddCellIds(input);
  OptimizeFilter filter(GetParam());
  EXPECT_TRUE(Says(WarningOf(filter, input),
    "1 with a face without area on the kept surface (points of the input 0 1 2), cell 0."));
}

TEST_P(MeshOptimizeFilterTangle, FoldedEdgesInThePlaneAreNamed)
{
  Grid input = MakeSquare(4, 0.0, [](double u, double v) { return Point{ { u, v, 0 } }; });
  Move(input, 22, 0.3, 0.0, 0.0);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_GT(filter->GetNumberOfInvertedCellsAfter(), 0);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "kept edges are folded onto each other"));
  EXPECT_TRUE(Says(messages.Warnings[0], "22"));
}

/**
 * The surface is sound, a node inside is not.
 */
Grid MakeTangled()
{
  Grid grid = MakeBox(4, 0.0);
  AddCellIds(grid);
  Move(grid, 62, 0.6, 0.35, 0.2);
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName("fixed");
  mask->SetNumberOfValues(grid->GetNumberOfPoints());
  mask->Fill(1);
  grid->GetPointData()->AddArray(mask);
  return grid;
}

TEST_P(MeshOptimizeFilterTangle, SaysThatNoNodeMayMove)
{
  OptimizeFilter filter(GetParam());
  filter->SetFixedPointArray("fixed");
  filter->ReconnectOff();
  filter->InsertNodesOff();
  filter->RemoveNodesOff();
  const std::string warning = WarningOf(filter, MakeTangled());
  EXPECT_TRUE(Says(warning, "with no node that may move"));
  EXPECT_TRUE(Says(warning, ", ...")); // there are more than five
  CheckNames(warning, filter->GetOutput());
}

TEST_P(MeshOptimizeFilterTangle, SaysThatNothingTriedCouldRepair)
{
  OptimizeFilter filter(GetParam());
  ChangeNothing(filter);
  EXPECT_TRUE(Says(WarningOf(filter, MakeTangled()), "that nothing tried could repair"));
}

TEST_P(MeshOptimizeFilterTangle, SaysThatTheRunWasEndedEarly)
{
  OptimizeFilter filter(GetParam());
  filter->SetTimeLimit(1e-9);
  const std::string warning = WarningOf(filter, MakeTangled());
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::TimeLimitReached);
  EXPECT_TRUE(warning.empty() || Says(warning, "left because the run was ended early")) << warning;
}

/**
 * All blocks in one warning, each by its index.
 */
TEST_P(MeshOptimizeFilterTangle, BlocksAreNamedInOneWarning)
{
  Grid folded = MakeBox(4, 0.0);
  Move(folded, 112, 0.33, 0.02, 0.0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, folded);
  blocks->SetBlock(1, MakeBox(2, 0.1));
  blocks->SetBlock(2, folded);
  OptimizeFilter filter(GetParam()), alone(GetParam());
  Messages messages(filter);
  filter->SetInputDataObject(blocks);
  filter->Update();
  WarningOf(alone, folded);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "Block 1: "));
  EXPECT_FALSE(Says(messages.Warnings[0], "Block 2: "));
  EXPECT_TRUE(Says(messages.Warnings[0], "Block 3: "));
  EXPECT_EQ(filter->GetNumberOfInvertedCellsBefore(), 2 * alone->GetNumberOfInvertedCellsBefore());
  EXPECT_EQ(filter->GetNumberOfInvertedCellsAfter(), 2 * alone->GetNumberOfInvertedCellsAfter());
}

} // namespace
