// SPDX-License-Identifier: BSD-3-Clause
// What vtkMeshOptimizeFilter does with bad input: one error that names what and where, and empty
// outputs; or it passes.
#include "MeshOptimizeFilterTesting.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMeshQualityMinMax.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

using namespace Testing;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

class MeshOptimizeFilterBadInput : public BothAlgorithms
{
protected:
  void ExpectError(vtkDataObject* input, const Texts& words, const Prepare& prepare = nullptr)
  {
    ExpectOptimizeError(GetParam(), input, words, prepare);
  }

  /**
   * No error, and the worst quality does not fall.
   */
  void ExpectSuccess(vtkUnstructuredGrid* input, int reason = -1)
  {
    OptimizeFilter filter(GetParam());
    Messages messages(filter);
    filter->SetInputData(input);
    filter->Update();
    EXPECT_EQ(messages.Errors, NoMessages);
    EXPECT_EQ(filter->GetErrorCode(), 0);
    if (reason >= 0)
    {
      EXPECT_EQ(filter->GetStopReason(), reason);
    }
    EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
    EXPECT_EQ(input->GetNumberOfCells() == 0, filter->GetOutput()->GetNumberOfCells() == 0);
    EXPECT_NE(filter->GetOutput()->GetCellData()->GetArray("MeshQuality"), nullptr);
  }
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterBadInput);

Grid OneTetrahedron()
{
  Grid grid = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  return grid;
}

//------------------------------------------------------------------------------
// What passes

TEST_P(MeshOptimizeFilterBadInput, EmptyGridPasses)
{
  ExpectSuccess(Grid::New(), vtkMeshOptimizeFilter::NothingToDo);
}

TEST_P(MeshOptimizeFilterBadInput, PointsWithoutCellsPass)
{
  ExpectSuccess(MakeGrid({ { { 1, 2, 3 } }, { { 4, 5, 6 } } }), vtkMeshOptimizeFilter::NothingToDo);
}

TEST_P(MeshOptimizeFilterBadInput, OneTetrahedronPasses) { ExpectSuccess(OneTetrahedron()); }

TEST_P(MeshOptimizeFilterBadInput, GridWithoutVolumePasses)
{
  Grid flat = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 1, 1, 0 } } });
  AddCell(flat, VTK_TETRA, { 0, 1, 2, 3 });
  ExpectSuccess(flat);
}

TEST_P(MeshOptimizeFilterBadInput, FlatCellBesideAGoodOnePasses)
{
  Grid both = OneTetrahedron();
  both->GetPoints()->InsertNextPoint(0.3, 0.3, 0.0);
  AddCell(both, VTK_TETRA, { 0, 2, 1, 4 });
  ExpectSuccess(both);
}

TEST_P(MeshOptimizeFilterBadInput, TwoPointsAtOnePlacePass)
{
  Grid collapsed = MakeBox(3, 0.2);
  double x[3];
  collapsed->GetPoint(21, x);
  collapsed->GetPoints()->SetPoint(22, x);
  ExpectSuccess(collapsed);
}

/**
 * Two separate tetrahedra whose points lie on each other: a crack, no fault.
 */
TEST_P(MeshOptimizeFilterBadInput, CrackPasses)
{
  Grid crack = OneTetrahedron();
  double x[3];
  for (vtkIdType p = 0; p < 4; ++p)
  {
    crack->GetPoint(p, x);
    crack->GetPoints()->InsertNextPoint(x);
  }
  AddCell(crack, VTK_TETRA, { 4, 5, 6, 7 });
  ExpectSuccess(crack);
}

/**
 * Two that share an edge only: not a manifold, no fault.
 */
TEST_P(MeshOptimizeFilterBadInput, CellsThatShareAnEdgeOnlyPass)
{
  Grid edge = OneTetrahedron();
  edge->GetPoints()->InsertNextPoint(0, -1, 0);
  edge->GetPoints()->InsertNextPoint(0, 0, -1);
  AddCell(edge, VTK_TETRA, { 0, 1, 4, 5 });
  ExpectSuccess(edge);
}

/**
 * Points that no cell uses stay, whatever their coordinates.
 */
TEST_P(MeshOptimizeFilterBadInput, PointsThatNoCellUsesStay)
{
  Grid grid = MakeBox(3, 0.2);
  grid->GetPoints()->InsertNextPoint(5, 5, 5);
  grid->GetPoints()->InsertNextPoint(NaN, 0, Infinity);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  int found = 0;
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    const Point y = GetPoint(filter->GetOutput(), p);
    found += y == Point{ { 5, 5, 5 } } || (std::isnan(y[0]) && y[1] == 0 && y[2] == Infinity);
  }
  EXPECT_EQ(found, 2);
}

//------------------------------------------------------------------------------
// Points and cells

TEST_P(MeshOptimizeFilterBadInput, CoordinatesMustBeFinite)
{
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    Grid grid = MakeBox(2, 0.1);
    grid->GetPoints()->SetPoint(13, 0.5, bad, 0.5);
    ExpectError(grid, { "oint 13", "not finite" });
  }
}

TEST_P(MeshOptimizeFilterBadInput, TrianglesMustBeInOnePlane)
{
  Grid curved = MakeSquare(4, 0.1, [](double u, double v) { return Point{ { u, v, u * u } }; });
  ExpectError(curved, { "not in one plane", "point " });
}

Grid ThreeAtAFace()
{
  Grid three = OneTetrahedron();
  three->GetPoints()->InsertNextPoint(-1, 0, 0);
  three->GetPoints()->InsertNextPoint(2, 2, 2);
  AddCell(three, VTK_TETRA, { 0, 3, 2, 4 });
  AddCell(three, VTK_TETRA, { 0, 2, 3, 5 });
  return three;
}

TEST_P(MeshOptimizeFilterBadInput, FaceMustNotHaveThreeCells)
{
  ExpectError(ThreeAtAFace(), { "more than two cells", "0, 1 and 2" });
}

/**
 * With another cell in front the error must lead to the cell of the grid.
 */
TEST_P(MeshOptimizeFilterBadInput, ErrorNamesTheCellOfTheGrid)
{
  Grid three = ThreeAtAFace(), shifted = MakeGrid({});
  shifted->GetPoints()->DeepCopy(three->GetPoints());
  AddCell(shifted, VTK_VERTEX, { 1 });
  for (vtkIdType c = 0; c < 3; ++c)
  {
    AddCell(shifted, VTK_TETRA, CellPoints(three, c));
  }
  ExpectError(shifted, { "more than two cells", "cell 3 of the grid" });
}

TEST_P(MeshOptimizeFilterBadInput, CellMustNotBeThereTwice)
{
  Grid twice = OneTetrahedron();
  AddCell(twice, VTK_TETRA, { 2, 3, 0, 1 });
  ExpectError(twice, { "0 and 1", "same points" });
}

TEST_P(MeshOptimizeFilterBadInput, CellMustNotHaveAPointTwice)
{
  Grid repeated = MakeBox(1, 0);
  AddCell(repeated, VTK_TETRA, { 0, 1, 1, 3 });
  ExpectError(repeated, { "ell 6", "point 1", "twice" });
}

TEST_P(MeshOptimizeFilterBadInput, PointsOfCellsMustBeThere)
{
  for (const vtkIdType bad : { vtkIdType(8), vtkIdType(-1), vtkIdType(1) << 40 })
  {
    for (const int type : { VTK_TETRA, VTK_QUAD })
    {
      SCOPED_TRACE("cell of type " + std::to_string(type));
      Grid range = MakeBox(1, 0);
      AddCell(range, type, { 0, 1, bad, 3 });
      ExpectError(range, { "ell 6", "point " + std::to_string(bad), "8 points" });
    }
  }
  Grid none = Grid::New();
  none->Allocate(1);
  AddCell(none, VTK_TETRA, { 0, 1, 2, 3 });
  ExpectError(none, { "ell 0", "0 points" });
}

TEST_P(MeshOptimizeFilterBadInput, TetrahedronMustHaveFourPoints)
{
  Grid shortCell = MakeBox(1, 0);
  AddCell(shortCell, VTK_TETRA, { 0, 1, 2 });
  ExpectError(shortCell, { "ell 6", "3 points instead of 4" });
}

TEST_P(MeshOptimizeFilterBadInput, EachCellMustHaveAType)
{
  Grid grid = MakeBox(2, 0);
  vtkNew<vtkUnsignedCharArray> few;
  few->InsertNextValue(VTK_TETRA);
  vtkNew<vtkCellArray> cells;
  cells->DeepCopy(grid->GetCells());
  grid->SetCells(few, cells);
  ExpectError(grid, { "48 cells", "types of 1 " });
}

//------------------------------------------------------------------------------
// Arrays

template <class Array>
Grid WithArray(bool onCells, const char* name, int components, double value, vtkIdType fewer = 0)
{
  Grid grid = MakeBox(2, 0.1);
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const vtkIdType n = (onCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints()) - fewer;
  array->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n * components; ++i)
  {
    array->SetVariantValue(i, vtkVariant(value));
  }
  vtkDataSetAttributes* attributes = grid->GetPointData();
  if (onCells)
  {
    attributes = grid->GetCellData();
  }
  attributes->AddArray(array);
  return grid;
}

TEST_P(MeshOptimizeFilterBadInput, RegionArray)
{
  const auto region = [](vtkMeshOptimizeFilter* f) { f->SetRegionArray("a"); };
  ExpectError(WithArray<vtkFloatArray>(true, "a", 1, 1), { "region array 'a'", "float" }, region);
  ExpectError(WithArray<vtkStringArray>(true, "a", 1, 1), { "region array 'a'", "string" }, region);
  ExpectError(WithArray<vtkIntArray>(true, "a", 2, 1), { "region array 'a'", "2 comp" }, region);
  ExpectError(WithArray<vtkIntArray>(false, "a", 1, 1), { "region array 'a'", "cell" }, region);
}

TEST_P(MeshOptimizeFilterBadInput, FixedPointArray)
{
  const auto fixed = [](vtkMeshOptimizeFilter* f) { f->SetFixedPointArray("a"); };
  ExpectError(WithArray<vtkIntArray>(true, "a", 1, 1), { "fixed point array 'a'", "point" }, fixed);
  ExpectError(WithArray<vtkStringArray>(false, "a", 1, 1), { "fixed point array 'a'" }, fixed);
  ExpectError(WithArray<vtkFloatArray>(false, "a", 1, std::nan("")),
    { "fixed point array 'a' at point 0 is not a number" }, fixed);
}

TEST_P(MeshOptimizeFilterBadInput, SizeArray)
{
  const auto size = [](vtkMeshOptimizeFilter* f)
  {
    f->SetBeta(1.0);
    f->SetSizeArray("a");
  };
  ExpectError(MakeBox(2, 0.1), { "size array 'a'", "not there" }, size);
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 3, 1), { "size array 'a'", "3 comp" }, size);
  for (const double bad : { 0.0, -1.0, NaN, Infinity })
  {
    SCOPED_TRACE("size " + std::to_string(bad));
    Grid grid = WithArray<vtkDoubleArray>(false, "a", 1, 0.5);
    grid->GetPointData()->GetArray("a")->SetComponent(11, 0, bad);
    ExpectError(grid, { "size", "point 11" }, size);
  }
}

TEST_P(MeshOptimizeFilterBadInput, MetricArray)
{
  const auto metric = [](vtkMeshOptimizeFilter* f) { f->SetMetricArray("a"); };
  ExpectError(
    WithArray<vtkDoubleArray>(false, "a", 5, 1), { "metric array 'a'", "5 comp" }, metric);
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 6, 1), { "metric", "point 0" }, metric);
  Grid skew = WithArray<vtkDoubleArray>(false, "a", 9, 0);
  for (vtkIdType p = 0; p < skew->GetNumberOfPoints(); ++p)
  {
    skew->GetPointData()->GetArray("a")->SetTuple9(p, 1, p == 7 ? 0.5 : 0, 0, 0, 1, 0, 0, 0, 1);
  }
  ExpectError(skew, { "metric", "point 7" }, metric);
}

/**
 * Arrays that nobody asked for, too: they are to be carried along. 27 points, 48 cells.
 */
TEST_P(MeshOptimizeFilterBadInput, AllArraysMustHaveTheRightLength)
{
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 1, 1, 3), { "point array 'a'", "24", "27" });
  ExpectError(WithArray<vtkDoubleArray>(true, "a", 1, 1, 5), { "cell array 'a'", "43", "48" });
}

/**
 * ParaView says "None" for no array; on a grid without cells a missing array is no fault.
 */
TEST_P(MeshOptimizeFilterBadInput, NoArrayIsNoFault)
{
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetRegionArray("None");
  filter->SetInputData(MakeBox(2, 0.1));
  filter->Update();
  filter->SetRegionArray("a");
  filter->SetInputData(Grid::New());
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
}

//------------------------------------------------------------------------------
// Options and inputs

TEST_P(MeshOptimizeFilterBadInput, Options)
{
  const Grid box = MakeBox(2, 0.1);
  ExpectError(box, { "desired size" }, [](vtkMeshOptimizeFilter* f) { f->SetBeta(1.0); });
  ExpectError(box, { "target" }, [](vtkMeshOptimizeFilter* f) { f->SetTargetQuality(0.0); });
  ExpectError(box, { "target" }, [](vtkMeshOptimizeFilter* f) { f->SetTargetQuality(NaN); });
  ExpectError(box, { "beta" }, [](vtkMeshOptimizeFilter* f) { f->SetBeta(NaN); });
  ExpectError(box, { "OptimizeBelow" }, [](vtkMeshOptimizeFilter* f) { f->SetOptimizeBelow(NaN); });
  ExpectError(box, { "time limit" }, [](vtkMeshOptimizeFilter* f) { f->SetTimeLimit(NaN); });
}

TEST_P(MeshOptimizeFilterBadInput, MeasureMustBeOneToOptimize)
{
  const Grid box = MakeBox(2, 0.1);
  for (const int number : { -1, 99 })
  {
    SCOPED_TRACE("measure " + std::to_string(number));
    ExpectError(box, { "quality measure", "none of the known" },
      [=](vtkMeshOptimizeFilter* f) { f->SetQualityMeasure(number); });
  }
  // a measure that can only be reported
  ExpectError(box, { "MinimumDihedralAngle", "not to optimize" },
    [](vtkMeshOptimizeFilter* f)
    { f->SetQualityMeasure(vtkMeshQualityMinMax::MinimumDihedralAngle); });
}

TEST_P(MeshOptimizeFilterBadInput, OptionsOutOfRangeAreClamped)
{
  OptimizeFilter f(GetParam());
  f->SetTargetQuality(7.0);
  EXPECT_EQ(f->GetTargetQuality(), 1.0);
  f->SetNeighborhoodLevel(-1);
  EXPECT_EQ(f->GetNeighborhoodLevel(), 0);
  f->SetEpsilon(-1.0);
  EXPECT_GT(f->GetEpsilon(), 0.0);
  f->SetNumberOfThreads(-4);
  EXPECT_EQ(f->GetNumberOfThreads(), 0);
  f->SetOptimizeBelow(-1.0);
  EXPECT_EQ(f->GetOptimizeBelow(), 0.0);
  f->SetNumberOfLayers(-3);
  EXPECT_EQ(f->GetNumberOfLayers(), 0);
}

/**
 * Nothing connected, nullptr, another type of data: the executive's one error, and no crash.
 */
TEST_P(MeshOptimizeFilterBadInput, NoInputIsOneErrorOfTheExecutive)
{
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 1u);
  filter->SetInputData(static_cast<vtkDataObject*>(nullptr));
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 2u);
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  ASSERT_EQ(messages.Errors.size(), 3u);
  EXPECT_TRUE(Says(messages.Errors.back(), "vtkPolyData"));
  filter->SetInputData(OneTetrahedron());
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 3u);
  ASSERT_TRUE(filter->GetOutput());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 1);
}

/**
 * The error of a block says which; nothing half done comes out.
 */
TEST_P(MeshOptimizeFilterBadInput, ErrorNamesTheBlock)
{
  Grid bad = MakeBox(1, 0);
  AddCell(bad, VTK_TETRA, { 0, 1, 1, 3 });
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBox(2, 0.1));
  blocks->SetBlock(1, bad);
  ExpectError(blocks, { "Block 2", "ell 6", "twice" });
}

} // namespace
