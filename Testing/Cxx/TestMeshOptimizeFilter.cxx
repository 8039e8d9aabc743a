// SPDX-License-Identifier: BSD-3-Clause
// vtkMeshOptimizeFilter on a box of tetrahedra and on a real pellet: what must get better, what
// must stay, and that the figures it reports are those of its output.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <memory>

using namespace Testing;

namespace
{

void CheckHistory(vtkMeshOptimizeFilter* filter)
{
  auto table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  const vtkIdType rows = table->GetNumberOfRows();
  EXPECT_GE(rows, 2);
  EXPECT_EQ(table->GetColumnByName("Block"), nullptr);
  EXPECT_EQ(table->GetValueByName(0, "Stage").ToString(), "input");
  EXPECT_EQ(table->GetValueByName(0, "Worst").ToDouble(), filter->GetWorstQualityBefore());
  EXPECT_EQ(table->GetValueByName(rows - 1, "Worst").ToDouble(), filter->GetWorstQualityAfter());
  EXPECT_EQ(table->GetValueByName(rows - 1, "Mean").ToDouble(), filter->GetMeanQualityAfter());
  EXPECT_EQ(
    table->GetValueByName(rows - 1, "Cells").ToInt(), filter->GetOutput()->GetNumberOfCells());
  EXPECT_EQ(
    table->GetValueByName(rows - 1, "Points").ToInt(), filter->GetOutput()->GetNumberOfPoints());
  vtkIdType done = 0;
  for (vtkIdType row = 0; row < rows; ++row)
  {
    SCOPED_TRACE("row " + std::to_string(row));
    if (row > 0)
    {
      EXPECT_GE(table->GetValueByName(row, "Worst").ToDouble(),
        table->GetValueByName(row - 1, "Worst").ToDouble());
    }
    for (vtkIdType column = 0; column < table->GetNumberOfColumns(); ++column)
    {
      std::string name = table->GetColumnName(column);
      const std::size_t suffix = name.rfind("Tried");
      if (suffix == std::string::npos)
      {
        continue;
      }
      const int tried = table->GetValue(row, column).ToInt();
      name.replace(suffix, std::string::npos, "Done");
      const int succeeded = table->GetValueByName(row, name.c_str()).ToInt();
      EXPECT_GE(tried, succeeded) << name;
      EXPECT_GE(succeeded, 0) << name;
      done += succeeded;
    }
  }
  for (const char* name :
    { "NodeMotionTried", "EdgeRemovalTried", "FaceRemovalTried", "EdgeContractionTried",
      "NodeInsertionTried", "NodeReplacementTried", "RetriangulationTried", "LookAheadTried" })
  {
    EXPECT_NE(table->GetColumnByName(name), nullptr) << name;
  }
  EXPECT_EQ(done, filter->GetNumberOfOperations());
  EXPECT_GT(done, 0);
}

/**
 * No cell without volume, the same volume as before, the same surface.
 */
void CheckMesh(vtkUnstructuredGrid* before, vtkUnstructuredGrid* after)
{
  double volumeBefore = 0.0, volumeAfter = 0.0;
  for (vtkIdType c = 0; c < before->GetNumberOfCells(); ++c)
  {
    volumeBefore += SignedVolume(before, c);
  }
  for (vtkIdType c = 0; c < after->GetNumberOfCells(); ++c)
  {
    EXPECT_GT(SignedVolume(after, c), 0.0) << "cell " << c;
    volumeAfter += SignedVolume(after, c);
  }
  EXPECT_NEAR(volumeAfter, volumeBefore, 1e-12 * volumeBefore);
  EXPECT_TRUE(SameFacets(KeptFacets(before), KeptFacets(after)));
}

/**
 * Ids of the input come first and in their order, then -1 for what is new.
 */
void CheckIds(vtkDataArray* ids)
{
  bool isOld = true;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    const double id = ids->GetComponent(i, 0);
    isOld = isOld && id >= 0;
    EXPECT_EQ(isOld, id >= 0) << i;
    EXPECT_TRUE(!isOld || i == 0 || id > ids->GetComponent(i - 1, 0)) << i;
  }
}

/**
 * Old points and cells come first and in their old order; old cells have the points they had.
 */
void CheckOrder(vtkUnstructuredGrid* before, vtkUnstructuredGrid* after)
{
  vtkDataArray* point = after->GetPointData()->GetArray("point");
  vtkDataArray* cell = after->GetCellData()->GetArray("cell");
  CheckIds(point);
  CheckIds(cell);
  for (vtkIdType c = 0; c < after->GetNumberOfCells() && cell->GetComponent(c, 0) >= 0; ++c)
  {
    std::vector<vtkIdType> now = CellPoints(after, c);
    for (vtkIdType& p : now)
    {
      p = static_cast<vtkIdType>(point->GetComponent(p, 0));
    }
    std::vector<vtkIdType> then = CellPoints(
      before, static_cast<vtkIdType>(cell->GetComponent(c, 0)));
    std::sort(now.begin(), now.end());
    std::sort(then.begin(), then.end());
    EXPECT_EQ(now, then) << "cell " << c;
  }
}

void AddIds(vtkDataSetAttributes* attributes, vtkIdType n, const char* name)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName(name);
  for (vtkIdType i = 0; i < n; ++i)
  {
    ids->InsertNextValue(static_cast<int>(i));
  }
  attributes->SetGlobalIds(ids);
}

/**
 * A box of tetrahedra, and what comes out.
 */
struct OptimizedBox
{
  Grid Input = MakeBox(6, 0.28), Copy = Grid::New();
  OptimizeFilter Filter;
  Texts Errors, Warnings;

  explicit OptimizedBox(int algorithm)
    : Filter(algorithm)
  {
    AddIds(this->Input->GetPointData(), this->Input->GetNumberOfPoints(), "point");
    AddIds(this->Input->GetCellData(), this->Input->GetNumberOfCells(), "cell");
    this->Copy->DeepCopy(this->Input);
    Messages messages(this->Filter);
    this->Filter->SetInputData(this->Input);
    this->Filter->Update();
    this->Errors = messages.Errors;
    this->Warnings = messages.Warnings;
  }
};

class MeshOptimizeFilter : public BothAlgorithms
{
protected:
  /// To be read only: it is optimized once for all cases.
  static const OptimizedBox& Box()
  {
    std::unique_ptr<OptimizedBox>& box = Boxes[GetParam()];
    if (!box)
    {
      box = std::make_unique<OptimizedBox>(GetParam());
    }
    return *box;
  }
  static void TearDownTestSuite() { Boxes.clear(); }

private:
  static inline std::map<int, std::unique_ptr<OptimizedBox>> Boxes;
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilter);

//------------------------------------------------------------------------------
TEST_P(MeshOptimizeFilter, BoxGetsBetterWithoutAMessage)
{
  EXPECT_EQ(Box().Errors, NoMessages);
  EXPECT_EQ(Box().Warnings, NoMessages);
  EXPECT_EQ(Box().Filter->GetErrorCode(), 0u);
  EXPECT_GT(Box().Filter->GetWorstQualityAfter(), Box().Filter->GetWorstQualityBefore() + 0.1);
}

TEST_P(MeshOptimizeFilter, InputIsNotTouched) { EXPECT_TRUE(SameGrid(Box().Input, Box().Copy)); }

TEST_P(MeshOptimizeFilter, FiguresAreThoseOfTheOutput) { CheckFieldData(Box().Filter); }

TEST_P(MeshOptimizeFilter, HistoryLeadsFromTheInputToTheOutput) { CheckHistory(Box().Filter); }

TEST_P(MeshOptimizeFilter, VolumeAndSurfaceStay)
{
  CheckMesh(Box().Input, Box().Filter->GetOutput());
}

TEST_P(MeshOptimizeFilter, OldPointsAndCellsComeFirst)
{
  CheckOrder(Box().Input, Box().Filter->GetOutput());
}

TEST_P(MeshOptimizeFilter, OnceMoreWithOneThreadGivesTheSameBits)
{
  OptimizeFilter second(GetParam());
  second->SetInputData(Box().Input);
  second->SetNumberOfThreads(1);
  second->Update();
  EXPECT_TRUE(SameGrid(Box().Filter->GetOutput(), second->GetOutput()));
  EXPECT_TRUE(SameArrays(vtkTable::SafeDownCast(Box().Filter->GetOutputDataObject(1))->GetRowData(),
    vtkTable::SafeDownCast(second->GetOutputDataObject(1))->GetRowData()));
}

/**
 * Its own output as input: never worse, and the figures take each other's place.
 */
TEST_P(MeshOptimizeFilter, OwnOutputDoesNotGetWorse)
{
  const OptimizeFilter& first = Box().Filter;
  OptimizeFilter again(GetParam());
  again->SetInputData(first->GetOutput());
  again->Update();
  EXPECT_EQ(again->GetWorstQualityBefore(), first->GetWorstQualityAfter());
  EXPECT_GE(again->GetWorstQualityAfter(), first->GetWorstQualityAfter());
  EXPECT_EQ(Figure(again->GetOutput(), "WorstQualityBefore"), first->GetWorstQualityAfter());
  EXPECT_EQ(again->GetOutput()->GetFieldData()->GetNumberOfArrays(),
    first->GetOutput()->GetFieldData()->GetNumberOfArrays());
}

/**
 * Two regions with a crooked interface: its faces stay, and no cell changes sides.
 */
TEST_P(MeshOptimizeFilter, InterfaceOfRegionsStays)
{
  Grid input = MakeBox(5, 0.28);
  vtkNew<vtkIntArray> region;
  region->SetName("material");
  double volume[2] = { 0.0, 0.0 };
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    const int value = c / 6 % 5 < 2 + c / 30 % 2 ? 7 : -3;
    region->InsertNextValue(value);
    volume[value == 7] += SignedVolume(input, c);
  }
  input->GetCellData()->AddArray(region);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->SetRegionArray("material");
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_TRUE(SameFacets(KeptFacets(input, "material"), KeptFacets(output, "material")));
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const double value = output->GetCellData()->GetArray("material")->GetComponent(c, 0);
    EXPECT_TRUE(value == 7 || value == -3);
    volume[value == 7] -= SignedVolume(output, c);
  }
  EXPECT_NEAR(volume[0], 0.0, 1e-12);
  EXPECT_NEAR(volume[1], 0.0, 1e-12);

  // Without the array the interface gives way: the check above can fail.
  filter->SetRegionArray(nullptr);
  filter->Update();
  EXPECT_FALSE(
    SameFacets(KeptFacets(input, "material"), KeptFacets(filter->GetOutput(), "material")));
}

TEST_P(MeshOptimizeFilter, FixedPointsStay)
{
  Grid input = MakeBox(5, 0.28);
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName("fixed");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    mask->InsertNextValue(p % 2);
  }
  input->GetPointData()->AddArray(mask);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  const auto countLost = [&]()
  {
    std::set<Point> there;
    for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
    {
      there.insert(GetPoint(filter->GetOutput(), p));
    }
    int lost = 0;
    for (vtkIdType p = 1; p < input->GetNumberOfPoints(); p += 2)
    {
      lost += there.count(GetPoint(input, p)) == 0;
    }
    return lost;
  };
  filter->SetFixedPointArray("fixed");
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  EXPECT_EQ(countLost(), 0);
  filter->SetFixedPointArray("");
  filter->Update();
  EXPECT_GT(countLost(), 0);
}

TEST_P(MeshOptimizeFilter, InvertedCellsGetBetter)
{
  Grid input = MakeBox(4, 0.75);
  int inverted = 0;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    inverted += SignedVolume(input, c) <= 0.0;
  }
  EXPECT_GT(inverted, 5);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_LT(filter->GetWorstQualityBefore(), 0.0);
  EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
}

TEST_P(MeshOptimizeFilter, ReversedNumberingIsNotTakenForInversion)
{
  Grid reversed = MakeBox(3, 0.2);
  for (const vtkIdType c : { 5, 17, 60 })
  {
    std::vector<vtkIdType> ids = CellPoints(reversed, c);
    std::swap(ids[0], ids[1]);
    reversed->GetCells()->ReplaceCellAtId(c, 4, ids.data());
  }
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(reversed);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "renumbered, 3 in all"));
  EXPECT_GT(filter->GetWorstQualityBefore(), 0.0);
  EXPECT_EQ(Figure(filter->GetOutput(), "NumberOfReorientedCells"), 3);
  for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
  {
    EXPECT_GT(SignedVolume(filter->GetOutput(), c), 0.0);
  }
}

TEST_P(MeshOptimizeFilter, PelletGetsBetter)
{
  const char* file = MESHOPTIMIZE_DATA_DIR "/crack40.vtu";
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  ASSERT_TRUE(reader->CanReadFile(file)) << file;
  reader->SetFileName(file);
  OptimizeFilter filter(GetParam());
  filter->SetInputConnection(reader->GetOutputPort());
  filter->Update();
  EXPECT_GT(filter->GetWorstQualityAfter(), 0.2);
  CheckMesh(reader->GetOutput(), filter->GetOutput());
  CheckFieldData(filter);
  CheckHistory(filter);
}

} // namespace
