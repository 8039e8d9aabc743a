// SPDX-License-Identifier: BSD-3-Clause
// Data arrays through vtkMeshOptimizeFilter: values, names, types, attributes, ids, ghosts.
#include "MeshOptimizeFilterTesting.h"

#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLUnstructuredGridReader.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterData : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterData);

template <class Array>
vtkSmartPointer<Array> NewArray(const char* name, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}

double Linear(const Point& x) { return 3.0 + 2.0 * x[0] - 5.0 * x[1] + 0.25 * x[2]; }

/**
 * Point arrays of many kinds on a box.
 */
Grid BoxWithPointData(int n = 6)
{
  Grid grid = MakeBox(n, 0.3);
  auto constant = NewArray<vtkDoubleArray>("constant");
  auto linear = NewArray<vtkDoubleArray>("linear", 3);
  auto single = NewArray<vtkFloatArray>("single");
  auto half = NewArray<vtkIntArray>("half"); // 0 left, 1 right of the middle
  auto label = NewArray<vtkStringArray>("label");
  auto index = NewArray<vtkLongLongArray>("index");
  linear->SetComponentName(0, "u");
  linear->SetComponentName(2, "w");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(grid, p);
    constant->InsertNextValue(0.1);
    linear->InsertNextTuple3(Linear(x), -Linear(x), x[0]);
    single->InsertNextValue(static_cast<float>(Linear(x)));
    half->InsertNextValue(x[0] > 0.5);
    label->InsertNextValue("point " + std::to_string(p));
    index->InsertNextValue((1LL << 60) + p);
  }
  vtkPointData* data = grid->GetPointData();
  data->SetScalars(constant);
  data->SetVectors(linear);
  data->AddArray(single);
  data->AddArray(half);
  data->AddArray(label);
  data->AddArray(index);
  return grid;
}

/**
 * Input id of each output point that is where a point of the input was, else -1.
 */
std::vector<vtkIdType> FindUnmoved(vtkUnstructuredGrid* before, vtkUnstructuredGrid* after)
{
  std::map<Point, vtkIdType> ids;
  for (vtkIdType p = 0; p < before->GetNumberOfPoints(); ++p)
  {
    ids[GetPoint(before, p)] = p;
  }
  std::vector<vtkIdType> unmoved;
  for (vtkIdType p = 0; p < after->GetNumberOfPoints(); ++p)
  {
    const auto found = ids.find(GetPoint(after, p));
    unmoved.push_back(found == ids.end() ? -1 : found->second);
  }
  return unmoved;
}

void CheckShape(vtkDataSetAttributes* before, vtkDataSetAttributes* after)
{
  for (int i = 0; i < before->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* a = before->GetAbstractArray(i);
    vtkAbstractArray* b = after->GetAbstractArray(a->GetName());
    SCOPED_TRACE(std::string("array ") + a->GetName());
    ASSERT_NE(b, nullptr);
    EXPECT_NE(b, a);
    EXPECT_EQ(b->GetDataType(), a->GetDataType());
    EXPECT_EQ(b->GetNumberOfComponents(), a->GetNumberOfComponents());
    for (int k = 0; k < a->GetNumberOfComponents(); ++k)
    {
      const char *nameA = a->GetComponentName(k), *nameB = b->GetComponentName(k);
      EXPECT_EQ(std::string(nameA ? nameA : "-"), (nameB ? nameB : "-"));
    }
  }
}

TEST_P(MeshOptimizeFilterData, PointDataFollowThePoints)
{
  Grid input = BoxWithPointData();
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkPointData *before = input->GetPointData(), *after = output->GetPointData();
  CheckShape(before, after);
  EXPECT_EQ(after->GetNumberOfArrays(), before->GetNumberOfArrays());
  EXPECT_EQ(after->GetScalars(), after->GetArray("constant"));
  EXPECT_EQ(after->GetVectors(), after->GetArray("linear"));

  const std::vector<vtkIdType> unmoved = FindUnmoved(input, output);
  int moved = 0;
  std::set<std::string> labels;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(output, p);
    moved += unmoved[p] < 0;
    EXPECT_EQ(after->GetArray("constant")->GetComponent(p, 0), 0.1);
    const double* tuple = after->GetArray("linear")->GetTuple3(p);
    EXPECT_NEAR(tuple[0], Linear(x), 1e-12);
    EXPECT_NEAR(tuple[1], -Linear(x), 1e-12);
    EXPECT_NEAR(tuple[2], x[0], 1e-12);
    EXPECT_NEAR(after->GetArray("single")->GetComponent(p, 0), Linear(x), 1e-6);
    const double half = after->GetArray("half")->GetComponent(p, 0);
    EXPECT_TRUE(std::abs(x[0] - 0.5) < 0.15 || half == (x[0] > 0.5)) << half << " at " << x[0];
    labels.insert(after->GetAbstractArray("label")->GetVariantValue(p).ToString());
    if (unmoved[p] >= 0)
    {
      for (int i = 0; i < before->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* a = before->GetAbstractArray(i);
        for (int k = 0; k < a->GetNumberOfComponents(); ++k)
        {
          const int n = a->GetNumberOfComponents();
          EXPECT_EQ(after->GetAbstractArray(i)->GetVariantValue(n * p + k),
            a->GetVariantValue(n * unmoved[p] + k));
        }
      }
    }
  }
  EXPECT_GT(moved, 20);
  EXPECT_EQ(labels.count(""), 0u);
  EXPECT_GT(labels.size(), 200u);
}

/**
 * Nothing mutable is shared: writing to the output leaves the input alone.
 */
TEST_P(MeshOptimizeFilterData, OutputSharesNothingWithTheInput)
{
  Grid input = BoxWithPointData(3);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkPointData *before = input->GetPointData(), *after = output->GetPointData();
  after->GetArray("constant")->Fill(7.0);
  output->GetPoints()->SetPoint(0, 9, 9, 9);
  EXPECT_EQ(before->GetArray("constant")->GetComponent(0, 0), 0.1);
  EXPECT_NE(GetPoint(input, 0)[0], 9);
}

/**
 * Linear fields are exact in the flattest cells, too: the pellet begins with cells of quality
 * 0.004.
 */
TEST_P(MeshOptimizeFilterData, LinearFieldIsExactInFlatCells)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(MESHOPTIMIZE_DATA_DIR "/crack40.vtu");
  reader->Update();
  Grid input = Grid::New();
  input->ShallowCopy(reader->GetOutput());
  auto linear = NewArray<vtkDoubleArray>("linear");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    linear->InsertNextValue(Linear(GetPoint(input, p)));
  }
  input->GetPointData()->AddArray(linear);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  double worst = 0.0;
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    const double value = filter->GetOutput()->GetPointData()->GetArray("linear")->GetComponent(
      p, 0);
    worst = std::max(worst, std::abs(value - Linear(GetPoint(filter->GetOutput(), p))));
  }
  std::cout << "greatest error of a linear field: " << worst << "\n";
  EXPECT_LT(worst, 1e-13);
}

/**
 * A NaN far away from a moved point does not reach it.
 */
TEST_P(MeshOptimizeFilterData, NaNDoesNotSpread)
{
  Grid input = MakeBox(4, 0.28);
  auto array = NewArray<vtkDoubleArray>("holes");
  array->SetNumberOfTuples(input->GetNumberOfPoints());
  array->Fill(1.0);
  array->SetValue(0, std::numeric_limits<double>::quiet_NaN());
  input->GetPointData()->AddArray(array);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkDataArray* after = filter->GetOutput()->GetPointData()->GetArray("holes");
  EXPECT_TRUE(std::isnan(after->GetComponent(0, 0)));
  int holes = 0;
  for (vtkIdType p = 0; p < after->GetNumberOfTuples(); ++p)
  {
    holes += std::isnan(after->GetComponent(p, 0));
  }
  EXPECT_LT(holes, 4);
}

/**
 * VTK lets arrays be renamed so that two have one name. (Others of that name it replaces.)
 */
TEST_P(MeshOptimizeFilterData, ArraysOfOneNameAreAllKept)
{
  Grid input = MakeBox(4, 0.28);
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(input->GetPointData()),
         static_cast<vtkDataSetAttributes*>(input->GetCellData()) })
  {
    const vtkIdType n = data == input->GetPointData() ? input->GetNumberOfPoints()
                                                      : input->GetNumberOfCells();
    for (const char* name : { "a", "b", "c" })
    {
      auto array = NewArray<vtkIntArray>(name);
      array->SetNumberOfTuples(n);
      array->Fill(name[0]);
      data->AddArray(array);
    }
    data->GetArray("b")->SetName("a");
  }
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->SetBoundaryMode(GetParam() == vtkMeshOptimizeFilter::WorstFirst
      ? vtkMeshOptimizeFilter::Slide
      : vtkMeshOptimizeFilter::Fixed);
  filter->Update();
  for (vtkDataSetAttributes* data :
    { static_cast<vtkDataSetAttributes*>(filter->GetOutput()->GetPointData()),
      static_cast<vtkDataSetAttributes*>(filter->GetOutput()->GetCellData()) })
  {
    ASSERT_GE(data->GetNumberOfArrays(), 3);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_STREQ(data->GetArrayName(i), i == 2 ? "c" : "a");
      EXPECT_EQ(data->GetArray(i)->GetComponent(0, 0), 'a' + i);
    }
  }
}

/**
 * New cells take the data of an input cell in whose place they stand: their centres are near it.
 */
TEST_P(MeshOptimizeFilterData, CellDataAreThoseOfACellInTheSamePlace)
{
  Grid input = MakeBox(6, 0.28);
  auto id = NewArray<vtkIntArray>("id");
  auto name = NewArray<vtkStringArray>("name");
  auto stress = NewArray<vtkFloatArray>("stress", 6);
  auto old = NewArray<vtkIntArray>("MeshQuality"); // something else of that name
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    id->InsertNextValue(static_cast<int>(c));
    name->InsertNextValue("cell " + std::to_string(c));
    stress->InsertNextTuple6(c, 1, 2, 3, 4, 5);
    old->InsertNextValue(1);
  }
  input->GetCellData()->SetScalars(id);
  input->GetCellData()->AddArray(name);
  input->GetCellData()->SetTensors(stress);
  input->GetCellData()->AddArray(old);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkCellData* after = output->GetCellData();
  EXPECT_EQ(after->GetNumberOfArrays(), 4);
  EXPECT_EQ(after->GetScalars(), after->GetArray("id"));
  EXPECT_EQ(after->GetTensors(), after->GetArray("stress"));
  EXPECT_EQ(after->GetArray("MeshQuality")->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(after->GetArray("id")->GetDataType(), VTK_INT);
  double farthest = 0.0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const vtkIdType parent = static_cast<vtkIdType>(after->GetArray("id")->GetComponent(c, 0));
    EXPECT_EQ(after->GetAbstractArray("name")->GetVariantValue(c).ToString(),
      "cell " + std::to_string(parent));
    EXPECT_EQ(after->GetArray("stress")->GetComponent(c, 0), parent);
    Point a{ { 0, 0, 0 } }, b{ { 0, 0, 0 } };
    for (int i = 0; i < 4; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        a[k] += 0.25 * GetPoint(output, CellPoints(output, c)[i])[k];
        b[k] += 0.25 * GetPoint(input, CellPoints(input, parent)[i])[k];
      }
    }
    farthest = std::max(farthest, std::hypot(std::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
  }
  EXPECT_LT(farthest, 2.0 / 6.0);
}

TEST_P(MeshOptimizeFilterData, FieldDataAreCopiedOrTakenOver)
{
  Grid input = MakeBox(2, 0.2);
  auto time = NewArray<vtkDoubleArray>("TimeValue");
  time->InsertNextValue(4.5);
  auto title = NewArray<vtkStringArray>("title");
  title->InsertNextValue("a box");
  auto reason = NewArray<vtkIntArray>("StopReason"); // will be taken over
  reason->InsertNextValue(3);
  input->GetFieldData()->AddArray(time);
  input->GetFieldData()->AddArray(title);
  input->GetFieldData()->AddArray(reason);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkFieldData* after = filter->GetOutput()->GetFieldData();
  EXPECT_TRUE(SameArray(time, after->GetAbstractArray("TimeValue")));
  EXPECT_TRUE(SameArray(title, after->GetAbstractArray("title")));
  EXPECT_NE(after->GetAbstractArray("TimeValue"), time.Get());
  EXPECT_EQ(after->GetAbstractArray("StopReason")->GetDataType(), VTK_STRING);
  EXPECT_TRUE(SameArray(reason, input->GetFieldData()->GetAbstractArray("StopReason")));
}

/**
 * Global ids: survivors keep theirs, new ones have -1, and nothing is active. Pedigree ids stay
 * active.
 */
TEST_P(MeshOptimizeFilterData, SurvivorsKeepTheirIds)
{
  Grid input = MakeBox(5, 0.3);
  auto global = NewArray<vtkIdTypeArray>("global");
  auto pedigree = NewArray<vtkIdTypeArray>("pedigree");
  auto globalCell = NewArray<vtkIdTypeArray>("globalCell");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    global->InsertNextValue(1000 + p);
    pedigree->InsertNextValue(2000 + p);
  }
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    globalCell->InsertNextValue(3000 + c);
  }
  input->GetPointData()->SetGlobalIds(global);
  input->GetPointData()->SetPedigreeIds(pedigree);
  input->GetCellData()->SetGlobalIds(globalCell);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkPointData* after = output->GetPointData();
  EXPECT_EQ(after->GetGlobalIds(), nullptr);
  EXPECT_EQ(output->GetCellData()->GetGlobalIds(), nullptr);
  EXPECT_EQ(after->GetPedigreeIds(), after->GetArray("pedigree"));
  std::set<double> seen;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const double id = after->GetArray("global")->GetComponent(p, 0);
    const double origin = after->GetArray("pedigree")->GetComponent(p, 0);
    if (id != -1)
    {
      EXPECT_TRUE(seen.insert(id).second) << id << " is there twice";
      EXPECT_EQ(origin, id + 1000);
    }
    EXPECT_GE(origin, 2000);
  }
  int freshCells = 0;
  seen.clear();
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const double id = output->GetCellData()->GetArray("globalCell")->GetComponent(c, 0);
    freshCells += id == -1;
    EXPECT_TRUE(id == -1 || seen.insert(id).second) << id << " is there twice";
  }
  EXPECT_GT(freshCells, 0);
}

/**
 * Where nothing is optimized, nothing is bound: the figure is that of the filter.
 */
TEST_P(MeshOptimizeFilterData, WhereAllCellsAreGhostsTheBoundIsNone)
{
  Grid input = MakeBox(2, 0.1);
  auto ghost = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName());
  ghost->SetNumberOfTuples(input->GetNumberOfCells());
  ghost->FillValue(vtkDataSetAttributes::DUPLICATECELL);
  input->GetCellData()->AddArray(ghost);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(filter->GetQualityBound(), 0.0);
  EXPECT_EQ(Figure(filter->GetOutput(), "QualityBound"), 0.0);
}

/**
 * Ghost cells come out as they went in, once each, and what touches them stays; new points are no
 * ghosts.
 */
TEST_P(MeshOptimizeFilterData, GhostCellsComeOutAsTheyWentIn)
{
  Grid input = MakeBox(5, 0.28);
  auto ghost = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName());
  auto ghostPoint = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName());
  ghostPoint->SetNumberOfTuples(input->GetNumberOfPoints());
  ghostPoint->FillValue(vtkDataSetAttributes::DUPLICATEPOINT); // new points must not be such
  std::vector<std::vector<Point>> wanted;
  const auto corners = [](vtkUnstructuredGrid* grid, vtkIdType c)
  {
    std::vector<Point> x;
    for (const vtkIdType p : CellPoints(grid, c))
    {
      x.push_back(GetPoint(grid, p));
    }
    return x;
  };
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    const bool isGhost = c >= 4 * 150;
    ghost->InsertNextValue(isGhost ? vtkDataSetAttributes::DUPLICATECELL : 0);
    if (isGhost)
    {
      wanted.push_back(corners(input, c));
    }
  }
  input->GetCellData()->AddArray(ghost);
  input->GetPointData()->AddArray(ghostPoint);
  OptimizeFilter filter(GetParam());
  filter->SetInputData(input);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_GT(filter->GetNumberOfOperations(), 0);
  vtkUnsignedCharArray* after = output->GetCellGhostArray();
  ASSERT_NE(after, nullptr);
  std::vector<std::vector<Point>> found;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    EXPECT_FALSE(std::isnan(output->GetCellData()->GetArray("MeshQuality")->GetComponent(c, 0)));
    if (after->GetValue(c) != 0)
    {
      found.push_back(corners(output, c));
    }
  }
  EXPECT_EQ(found, wanted);
  const std::vector<vtkIdType> unmoved = FindUnmoved(input, output);
  int fresh = 0;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const int flag = output->GetPointGhostArray()->GetValue(p);
    fresh += flag == 0;
    EXPECT_TRUE(unmoved[p] < 0 || flag == 1) << "point " << p;
  }
  EXPECT_GT(fresh, 0);
  EXPECT_TRUE(
    SameFacets(KeptFacets(input), KeptFacets(output))); // ghosts and the others still fit together
}

// vtkStringArray::GetTuples() loses the second value of each tuple.
TEST_P(MeshOptimizeFilterData, PairsOfStringsStay)
{
  Grid input = MakeBox(3, 0.2);
  auto pairs = NewArray<vtkStringArray>("pairs", 2);
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    pairs->InsertNextValue("first " + std::to_string(c));
    pairs->InsertNextValue("second " + std::to_string(c));
  }
  input->GetCellData()->AddArray(pairs);
  OptimizeFilter filter(GetParam());
  ChangeNothing(filter.Get());
  filter->SetInputData(input);
  filter->Update();
  auto after = filter->GetOutput()->GetCellData()->GetAbstractArray("pairs");
  ASSERT_EQ(after->GetNumberOfValues(), pairs->GetNumberOfValues());
  for (vtkIdType i = 0; i < pairs->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(after->GetVariantValue(i).ToString(), pairs->GetValue(i));
  }
}

} // namespace
