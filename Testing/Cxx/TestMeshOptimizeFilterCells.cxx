// SPDX-License-Identifier: BSD-3-Clause
// vtkMeshOptimizeFilter and what is not a plain mesh of tetrahedra: planes, mixed cells, blocks,
// precision.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterCells : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterCells);

double SignedArea(vtkUnstructuredGrid* grid, vtkIdType cell, int axis)
{
  const std::vector<vtkIdType> ids = CellPoints(grid, cell);
  const Point a = GetPoint(grid, ids[0]), b = GetPoint(grid, ids[1]), c = GetPoint(grid, ids[2]);
  const int i = (axis + 1) % 3, k = (axis + 2) % 3;
  return 0.5 * ((b[i] - a[i]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[i] - a[i]));
}

/**
 * Maps of the unit square into planes.
 */
const std::vector<std::function<Point(double, double)>> Planes = {
  [](double u, double v) {
    return Point{ { u, v, 0.3 } };
  },
  [](double u, double v) {
    return Point{ { v, u, -1e3 } };
  }, // clockwise
  [](double u, double v) {
    return Point{ { 0.1, u, v } };
  },
  [](double u, double v) {
    return Point{ { u, 2.0, v } };
  },
  [](double u, double v) {
    return Point{ { u, v, 0.5 * u - 0.7 * v + 3.0 } };
  },
  [](double u, double v) {
    return Point{ { u + v, u - v, 1e4 + u } };
  },
};

/**
 * Triangles in any plane; the sense of rotation of the input is kept.
 */
TEST_P(MeshOptimizeFilterCells, TrianglesInAnyPlaneGetBetterAndTurnAsBefore)
{
  std::vector<double> reached;
  for (std::size_t k = 0; k < Planes.size(); ++k)
  {
    SCOPED_TRACE("plane " + std::to_string(k));
    Grid input = MakeSquare(8, 0.35, Planes[k]);
    OptimizeFilter filter(GetParam());
    Messages messages(filter);
    filter->SetInputData(input);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    EXPECT_EQ(messages.Errors, NoMessages);
    EXPECT_EQ(messages.Warnings, NoMessages);
    EXPECT_GT(filter->GetNumberOfOperations(), 0);
    EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore() + 0.05);
    EXPECT_EQ(
      MinimumOf(output->GetCellData()->GetArray("MeshQuality")), filter->GetWorstQualityAfter());
    EXPECT_TRUE(SameFacets(KeptFacets(input), KeptFacets(output)));
    reached.push_back(filter->GetWorstQualityAfter());

    // In the plane, and turning as before. (Every plane here has an area seen along one axis.)
    int axis = 0;
    while (std::abs(SignedArea(input, 0, axis)) < 1e-6)
    {
      ++axis;
    }
    double before = 0.0, after = 0.0;
    for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
    {
      before += SignedArea(input, c, axis);
    }
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      EXPECT_GT(SignedArea(output, c, axis) * before, 0.0);
      after += SignedArea(output, c, axis);
    }
    EXPECT_NEAR(after, before, 1e-11 * std::abs(before));
  }
  // The first four are the same square, seen the same way or from behind.
  for (int i = 1; i < 4; ++i)
  {
    EXPECT_NEAR(reached[i], reached[0], 0.02) << "plane " << i;
  }
}

/**
 * The out of plane coordinate of moved points is exact where the plane is parallel to two axes.
 */
TEST_P(MeshOptimizeFilterCells, PlaneParallelToTwoAxesIsExact)
{
  Grid input = MakeSquare(6, 0.35, [](double u, double v) { return Point{ { u, 0.1, v } }; });
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    EXPECT_EQ(GetPoint(filter->GetOutput(), p)[1], 0.1);
  }
}

/**
 * A square of small triangles and a larger one beside it.
 */
Grid MakeSquareWithLargeTriangle(bool isReversed)
{
  Grid grid = MakeSquare(8, 0.2, [](double u, double v) { return Point{ { u, v, u + v } }; });
  const vtkIdType p = grid->GetPoints()->InsertNextPoint(-3, 0, -3);
  AddCell(grid, VTK_TRIANGLE, { isReversed ? 9 : 0, isReversed ? 0 : 9, p });
  return grid;
}

/**
 * One large triangle that is numbered against all others is the one that is renumbered.
 */
TEST_P(MeshOptimizeFilterCells, LargeReversedTriangleIsRenumberedWithAWarning)
{
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  const auto countReoriented = [&]()
  {
    vtkFieldData* fields = filter->GetOutput()->GetFieldData();
    return fields->GetArray("NumberOfReorientedCells")->GetComponent(0, 0);
  };
  filter->SetInputData(MakeSquareWithLargeTriangle(false));
  filter->Update();
  EXPECT_EQ(countReoriented(), 0);
  filter->SetInputData(MakeSquareWithLargeTriangle(true));
  filter->Update();
  EXPECT_EQ(countReoriented(), 1);
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings.size(), 1u);
}

/**
 * In the plane, lines are kept as edges and quads stay.
 */
TEST_P(MeshOptimizeFilterCells, LinesInThePlaneAreKeptAsEdges)
{
  Grid input = MakeSquare(8, 0.0,
    [](double u, double v) {
      return Point{ { u, v + 0.3 * u, 0 } };
    });
  std::set<std::pair<Point, Point>> wanted;
  for (vtkIdType j = 0; j < 8; ++j) // an oblique path through the middle: the long diagonals
  {
    AddCell(input, VTK_LINE, { 10 * j, 10 * j + 10 });
    wanted.insert({ GetPoint(input, 10 * j), GetPoint(input, 10 * j + 10) });
  }
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->SetTargetQuality(1.0);
  const auto countEdges = [&]()
  {
    vtkUnstructuredGrid* output = filter->GetOutput();
    std::set<std::pair<Point, Point>> found;
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      const std::vector<vtkIdType> ids = CellPoints(output, c);
      for (std::size_t i = 0; ids.size() == 3 && i < 9; ++i)
      {
        const std::pair<Point, Point> edge{ GetPoint(output, ids[i / 3]),
          GetPoint(output, ids[i % 3]) };
        if (wanted.count(edge))
        {
          found.insert(edge);
        }
      }
    }
    return found.size();
  };
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(countEdges(), wanted.size());
  EXPECT_NE(
    filter->GetOutput()->GetCellType(filter->GetOutput()->GetNumberOfCells() - 1), VTK_EMPTY_CELL);
  // Without the lines they go: the check above can fail.
  filter->SetInputData(MakeSquare(8, 0.0,
    [](double u, double v) {
      return Point{ { u, v + 0.3 * u, 0 } };
    }));
  filter->Update();
  EXPECT_LT(countEdges(), wanted.size());
}

/**
 * A box of tetrahedra with one cell of nearly every other kind on it.
 */
Grid MixedBox()
{
  Grid grid = MakeGrid({});
  Grid box = MakeBox(4, 0.28);
  grid->GetPoints()->DeepCopy(box->GetPoints());
  const auto id = [](vtkIdType i, vtkIdType j, vtkIdType k) { return i + 5 * (j + 5 * k); };
  AddCell(grid, VTK_VERTEX, { id(3, 3, 1) });
  AddCell(grid, VTK_LINE, { id(1, 1, 1), id(2, 2, 2) }); // a long edge in the inside
  AddCell(grid, VTK_TRIANGLE, { id(1, 1, 2), id(2, 1, 2), id(2, 2, 3) }); // a face in the inside
  for (vtkIdType c = 0; c < box->GetNumberOfCells(); ++c)
  {
    AddCell(grid, VTK_TETRA, CellPoints(box, c));
    if (c == 100)
    {
      AddCell(grid, VTK_TRIANGLE, { id(0, 0, 0), id(1, 0, 0), id(1, 1, 0) }); // on the surface
      AddCell(grid, VTK_QUAD, { id(0, 0, 0), id(1, 0, 0), id(1, 1, 0), id(0, 1, 0) });
    }
  }
  // A hexahedron, a wedge, a pyramid and a polyhedron on the upper side.
  const vtkIdType first = grid->GetNumberOfPoints();
  for (int k = 0; k < 5; ++k)
  {
    grid->GetPoints()->InsertNextPoint(0.25 * (k % 2), 0.25 * (k / 2), 1.25);
  }
  const vtkIdType a = id(0, 0, 4), b = id(1, 0, 4), c = id(1, 1, 4), d = id(0, 1, 4);
  AddCell(grid, VTK_HEXAHEDRON, { a, b, c, d, first, first + 1, first + 3, first + 2 });
  AddCell(grid, VTK_WEDGE, { d, c, id(0, 2, 4), first + 2, first + 3, first + 4 });
  AddCell(grid, VTK_PYRAMID, { id(2, 2, 4), id(3, 2, 4), id(3, 3, 4), id(2, 3, 4), first });
  const vtkIdType e = first + 1;
  const std::vector<vtkIdType> faces = { 4, 3, b, c, e, 3, c, d, e, 3, d, b, e, 3, b, d, c };
  vtkNew<vtkIdList> stream;
  for (const vtkIdType value : faces)
  {
    stream->InsertNextId(value);
  }
  grid->InsertNextCell(VTK_POLYHEDRON, stream);
  return grid;
}

std::vector<Point> Corners(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  std::vector<Point> x;
  for (const vtkIdType p : CellPoints(grid, cell))
  {
    x.push_back(GetPoint(grid, p));
  }
  return x;
}

/**
 * Other cells: the same types, corners and order, as if nothing had happened.
 */
std::vector<std::pair<int, std::vector<Point>>> Others(vtkUnstructuredGrid* grid)
{
  std::vector<std::pair<int, std::vector<Point>>> others;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) != VTK_TETRA)
    {
      others.emplace_back(grid->GetCellType(c), Corners(grid, c));
    }
  }
  return others;
}

bool HasInTetrahedra(vtkUnstructuredGrid* grid, const std::vector<Point>& simplex)
{
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_TETRA)
    {
      std::size_t found = 0;
      const std::vector<Point> corners = Corners(grid, c);
      for (const Point& x : simplex)
      {
        found += std::count(corners.begin(), corners.end(), x);
      }
      if (found == simplex.size())
      {
        return true;
      }
    }
  }
  return false;
}

TEST_P(MeshOptimizeFilterCells, OtherCellsAreKeptAmongTetrahedra)
{
  Grid input = MixedBox();
  EXPECT_TRUE(HasInTetrahedra(input, Corners(input, 1)));
  EXPECT_TRUE(HasInTetrahedra(input, Corners(input, 2)));
  vtkNew<vtkIntArray> id;
  id->SetName("id");
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    id->InsertNextValue(static_cast<int>(c));
  }
  input->GetCellData()->AddArray(id);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetTargetQuality(1.0);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(Others(input), Others(output));
  EXPECT_TRUE(HasInTetrahedra(output, Corners(input, 1))); // the edge
  EXPECT_TRUE(HasInTetrahedra(output, Corners(input, 2))); // the face

  vtkNew<vtkIdList> before, after;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const bool isOther = output->GetCellType(c) != VTK_TETRA;
    const vtkIdType source = static_cast<vtkIdType>(
      output->GetCellData()->GetArray("id")->GetComponent(c, 0));
    EXPECT_EQ(output->GetCellType(c), input->GetCellType(source));
    EXPECT_EQ(
      isOther, std::isnan(output->GetCellData()->GetArray("MeshQuality")->GetComponent(c, 0)));
    if (output->GetCellType(c) == VTK_POLYHEDRON)
    {
      output->GetFaceStream(c, after);
      input->GetFaceStream(source, before);
    }
  }
  ASSERT_EQ(before->GetNumberOfIds(), 17); // four faces: 4 * (1 + 3), and their number
  ASSERT_EQ(after->GetNumberOfIds(), 17);
  for (vtkIdType face = 0; face < 4; ++face)
  {
    for (vtkIdType k = 2; k < 5; ++k)
    {
      EXPECT_EQ(
        GetPoint(output, after->GetId(4 * face + k)), GetPoint(input, before->GetId(4 * face + k)));
    }
  }

  // Without the line and the triangle, edge and face go: the checks above can fail.
  Grid bare = MakeBox(4, 0.28);
  filter->SetInputData(bare);
  filter->Update();
  EXPECT_TRUE(!HasInTetrahedra(filter->GetOutput(), Corners(input, 1)) ||
    !HasInTetrahedra(filter->GetOutput(), Corners(input, 2)));
}

/**
 * Hexahedra with triangles on them: nothing changes, and a warning says so.
 */
TEST_P(MeshOptimizeFilterCells, HexahedraAreLeftWithAWarning)
{
  Grid input = MakeGrid({});
  input->GetPoints()->DeepCopy(MakeBox(1, 0)->GetPoints());
  AddCell(input, VTK_HEXAHEDRON, { 0, 1, 3, 2, 4, 5, 7, 6 });
  AddCell(input, VTK_TRIANGLE, { 0, 1, 3 });
  AddCell(input, VTK_TRIANGLE, { 0, 4, 5 }); // not in one plane: no matter
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "of the 3 cells 2 are triangles"));
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::NothingToDo);
  EXPECT_EQ(Others(input), Others(filter->GetOutput()));
  EXPECT_TRUE(
    std::isnan(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")->GetComponent(0, 0)));
}

TEST_P(MeshOptimizeFilterCells, QuadraticTetrahedraAreLeftWithAWarning)
{
  Grid input = MakeBox(3, 0.28);
  for (int k = 0; k < 10; ++k)
  {
    input->GetPoints()->InsertNextPoint(2 + (k == 1), 2 + (k == 2), 2 + (k == 3));
  }
  const vtkIdType p = 64;
  AddCell(input, VTK_QUADRATIC_TETRA,
    { p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6, p + 7, p + 8, p + 9 });
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "passed through as they are, 1 in all"));
  EXPECT_EQ(Others(input), Others(filter->GetOutput()));
  EXPECT_GT(filter->GetNumberOfOperations(), 0); // the linear ones were optimized
}

/**
 * Single precision: double where something moved, with the surface at the very same places.
 */
TEST_P(MeshOptimizeFilterCells, SinglePrecisionBecomesDoubleWhereSomethingMoved)
{
  Grid input = MakeBox(4, 0.28, VTK_FLOAT);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_TRUE(SameFacets(KeptFacets(input), KeptFacets(filter->GetOutput())));
  Grid good = MakeBox(1, 0, VTK_FLOAT);
  filter->SetInputData(good);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
}

/**
 * Block 0 is a volume, 1 a plane, 2 is not optimized: each comes out as if it were alone.
 */
void CheckBlocks(int algorithm, vtkDataObject* input,
  const std::function<vtkDataObject*(vtkDataObject*, int)>& leaf)
{
  OptimizeFilter filter(algorithm);
  Messages messages(filter);
  filter->SetInputDataObject(input);
  filter->SetSizeArray("");
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  vtkDataObject* output = filter->GetOutputDataObject(0);
  EXPECT_EQ(std::string(output->GetClassName()), input->GetClassName());
  double worstBefore = 1.0, worstAfter = 1.0;
  vtkIdType operations = 0;
  for (const int i : { 0, 1 })
  {
    SCOPED_TRACE("block " + std::to_string(i));
    OptimizeFilter alone(algorithm);
    alone->SetInputDataObject(leaf(input, i));
    alone->Update();
    auto grid = vtkUnstructuredGrid::SafeDownCast(leaf(output, i));
    ASSERT_TRUE(grid);
    EXPECT_TRUE(SameGrid(grid, alone->GetOutput()));
    worstBefore = std::min(worstBefore, alone->GetWorstQualityBefore());
    worstAfter = std::min(worstAfter, alone->GetWorstQualityAfter());
    operations += alone->GetNumberOfOperations();
  }
  EXPECT_EQ(filter->GetWorstQualityBefore(), worstBefore);
  EXPECT_EQ(filter->GetWorstQualityAfter(), worstAfter);
  EXPECT_EQ(filter->GetNumberOfOperations(), operations);
  EXPECT_GT(operations, 0);
  EXPECT_NE(vtkPolyData::SafeDownCast(leaf(output, 2)), nullptr); // passed through
  auto history = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  std::set<int> blocks;
  for (vtkIdType row = 0; row < history->GetNumberOfRows(); ++row)
  {
    blocks.insert(history->GetValueByName(row, "Block").ToInt());
  }
  EXPECT_EQ(blocks.size(), 2u);

  // And back to a plain grid with the same filter.
  filter->SetInputDataObject(leaf(input, 0));
  filter->Update();
  ASSERT_NE(filter->GetOutput(), nullptr);
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

struct Blocks
{
  Grid Volume = MakeBox(4, 0.28);
  Grid Plane = MakeSquare(6, 0.35, [](double u, double v) { return Point{ { u, v, 0 } }; });
  vtkNew<vtkPolyData> Other;
};

TEST_P(MeshOptimizeFilterCells, BlocksAreOptimizedOneByOne)
{
  Blocks parts;
  vtkNew<vtkMultiBlockDataSet> inner, blocks;
  inner->SetBlock(0, parts.Plane);
  blocks->SetBlock(0, parts.Volume);
  blocks->SetBlock(1, inner);
  blocks->SetBlock(2, parts.Other);
  blocks->SetBlock(3, nullptr);
  CheckBlocks(GetParam(), blocks,
    [](vtkDataObject* tree, int i)
    {
      auto multi = vtkMultiBlockDataSet::SafeDownCast(tree);
      return i == 1 ? vtkMultiBlockDataSet::SafeDownCast(multi->GetBlock(1))->GetBlock(0)
                    : multi->GetBlock(i);
    });
}

TEST_P(MeshOptimizeFilterCells, PartitionsAreOptimizedOneByOne)
{
  Blocks parts;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, parts.Volume);
  collection->SetPartition(0, 1, parts.Plane);
  collection->SetPartition(1, 0, parts.Other);
  CheckBlocks(GetParam(), collection,
    [](vtkDataObject* tree, int i) -> vtkDataObject*
    { return vtkPartitionedDataSetCollection::SafeDownCast(tree)->GetPartition(i / 2, i % 2); });
}

} // namespace
