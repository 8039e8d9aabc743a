// vtkMeshOptimizeFilter on a box of tetrahedra and on a real pellet: what must get better, what
// must stay, and that the figures it reports are those of its output.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLUnstructuredGridReader.h"

using namespace Testing;

namespace
{

double Figure(vtkUnstructuredGrid* grid, const char* name)
{
  vtkDataArray* array = grid->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : -1e9;
}

void CheckFigures(vtkMeshOptimizeFilter* filter)
{
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkDataArray* quality = output->GetCellData()->GetArray("MeshQuality");
  CHECK(quality && quality->GetDataType() == VTK_DOUBLE);
  CHECK(MinimumOf(quality) == filter->GetWorstQualityAfter());
  CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
  CHECK(filter->GetWorstQualityAfter() <= filter->GetQualityBound());
  double sum = 0.0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    sum += quality->GetComponent(c, 0);
  }
  CHECK(std::abs(sum / output->GetNumberOfCells() - filter->GetMeanQualityAfter()) < 1e-12);
  CHECK(Figure(output, "WorstQualityBefore") == filter->GetWorstQualityBefore());
  CHECK(Figure(output, "WorstQualityAfter") == filter->GetWorstQualityAfter());
  CHECK(Figure(output, "MeanQualityBefore") == filter->GetMeanQualityBefore());
  CHECK(Figure(output, "MeanQualityAfter") == filter->GetMeanQualityAfter());
  CHECK(Figure(output, "QualityBound") == filter->GetQualityBound());
  CHECK(Figure(output, "NumberOfCappedCells") == filter->GetNumberOfCappedCells());
  CHECK(Figure(output, "NumberOfOperations") == filter->GetNumberOfOperations());
  CHECK(output->GetFieldData()->GetAbstractArray("StopReason")->GetVariantValue(0).ToString() ==
    filter->GetStopReasonAsString());
  CHECK(filter->GetStopReason() != vtkMeshOptimizeFilter::NotRun);
  CHECK(filter->GetOptimizeSeconds() > 0.0);
}

void CheckHistory(vtkMeshOptimizeFilter* filter)
{
  auto table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  const vtkIdType rows = table->GetNumberOfRows();
  CHECK(rows >= 2);
  CHECK(table->GetColumnByName("Block") == nullptr);
  CHECK(table->GetValueByName(0, "Stage").ToString() == "input");
  CHECK(table->GetValueByName(0, "Worst").ToDouble() == filter->GetWorstQualityBefore());
  CHECK(table->GetValueByName(rows - 1, "Worst").ToDouble() == filter->GetWorstQualityAfter());
  CHECK(table->GetValueByName(rows - 1, "Mean").ToDouble() == filter->GetMeanQualityAfter());
  CHECK(
    table->GetValueByName(rows - 1, "Cells").ToInt() == filter->GetOutput()->GetNumberOfCells());
  CHECK(
    table->GetValueByName(rows - 1, "Points").ToInt() == filter->GetOutput()->GetNumberOfPoints());
  vtkIdType done = 0;
  for (vtkIdType row = 0; row < rows; ++row)
  {
    CHECK(row == 0 ||
      table->GetValueByName(row, "Worst").ToDouble() >=
        table->GetValueByName(row - 1, "Worst").ToDouble());
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
      CHECK(tried >= succeeded && succeeded >= 0);
      done += succeeded;
    }
  }
  for (const char* name :
    { "NodeMotionTried", "EdgeRemovalTried", "FaceRemovalTried", "EdgeContractionTried",
      "NodeInsertionTried", "NodeReplacementTried", "RetriangulationTried", "LookAheadTried" })
  {
    CHECK(table->GetColumnByName(name) != nullptr);
  }
  CHECK(done == filter->GetNumberOfOperations() && done > 0);
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
    CHECK(SignedVolume(after, c) > 0.0);
    volumeAfter += SignedVolume(after, c);
  }
  CHECK(std::abs(volumeAfter - volumeBefore) < 1e-12 * volumeBefore);
  CHECK(KeptFacets(before) == KeptFacets(after));
}

/**
 * Old points and cells come first and in their old order, with the same coordinates unless moved.
 */
void CheckOrder(vtkUnstructuredGrid* before, vtkUnstructuredGrid* after)
{
  vtkDataArray* point = after->GetPointData()->GetArray("point"); // ids of the input, -1: new
  vtkDataArray* cell = after->GetCellData()->GetArray("cell");
  bool isOld = true;
  for (vtkIdType p = 0; p < after->GetNumberOfPoints(); ++p)
  {
    const double id = point->GetComponent(p, 0);
    isOld = isOld && id >= 0;
    CHECK(isOld == (id >= 0));
    CHECK(!isOld || p == 0 || id > point->GetComponent(p - 1, 0));
  }
  isOld = true;
  for (vtkIdType c = 0; c < after->GetNumberOfCells(); ++c)
  {
    const double id = cell->GetComponent(c, 0);
    isOld = isOld && id >= 0;
    CHECK(isOld == (id >= 0));
    CHECK(!isOld || c == 0 || id > cell->GetComponent(c - 1, 0));
    if (isOld)
    {
      std::vector<vtkIdType> now = CellPoints(after, c);
      for (vtkIdType& p : now)
      {
        p = static_cast<vtkIdType>(point->GetComponent(p, 0));
      }
      std::vector<vtkIdType> then = CellPoints(before, static_cast<vtkIdType>(id));
      std::sort(now.begin(), now.end());
      std::sort(then.begin(), then.end());
      CHECK(now == then);
    }
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

void TestBox()
{
  Grid input = MakeBox(6, 0.28);
  AddIds(input->GetPointData(), input->GetNumberOfPoints(), "point");
  AddIds(input->GetCellData(), input->GetNumberOfCells(), "cell");
  Grid copy = Grid::New();
  copy->DeepCopy(input);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  CHECK(messages.Errors.empty() && messages.Warnings.empty());
  CHECK(filter->GetErrorCode() == 0);
  CHECK(SameGrid(input, copy)); // the input is not touched
  CHECK(filter->GetWorstQualityAfter() > filter->GetWorstQualityBefore() + 0.1);
  CheckFigures(filter);
  CheckHistory(filter);
  CheckMesh(input, filter->GetOutput());
  CheckOrder(input, filter->GetOutput());

  // Once more from the beginning: the same bits.
  OptimizeFilter second;
  second->SetInputData(input);
  second->SetNumberOfThreads(1);
  second->Update();
  CHECK(SameGrid(filter->GetOutput(), second->GetOutput()));
  CHECK(SameArrays(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetRowData(),
    vtkTable::SafeDownCast(second->GetOutputDataObject(1))->GetRowData()));

  // Its own output as input: never worse, and the figures take each other's place.
  OptimizeFilter again;
  again->SetInputData(filter->GetOutput());
  again->Update();
  CHECK(again->GetWorstQualityBefore() == filter->GetWorstQualityAfter());
  CHECK(again->GetWorstQualityAfter() >= filter->GetWorstQualityAfter());
  CHECK(Figure(again->GetOutput(), "WorstQualityBefore") == filter->GetWorstQualityAfter());
  CHECK(again->GetOutput()->GetFieldData()->GetNumberOfArrays() ==
    filter->GetOutput()->GetFieldData()->GetNumberOfArrays());
}

/**
 * With every kind of change off the mesh comes out as it went in, and is measured.
 */
void TestMeasureOnly()
{
  Grid input = MakeBox(3, 0.25, VTK_FLOAT);
  OptimizeFilter filter;
  filter->SetInputData(input);
  filter->MoveNodesOff();
  filter->ReconnectOff();
  filter->InsertNodesOff();
  filter->RemoveNodesOff();
  filter->Update();
  CHECK(filter->GetWorstQualityAfter() == filter->GetWorstQualityBefore());
  CHECK(filter->GetNumberOfOperations() == 0);
  CHECK(SameArray(input->GetPoints()->GetData(), filter->GetOutput()->GetPoints()->GetData()));
  CHECK(MinimumOf(filter->GetOutput()->GetCellData()->GetArray("MeshQuality")) ==
    filter->GetWorstQualityAfter());
}

/**
 * Two regions with a crooked interface: its faces stay, and no cell changes sides.
 */
void TestRegions()
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
  OptimizeFilter filter;
  filter->SetInputData(input);
  filter->SetRegionArray("material");
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  CHECK(filter->GetNumberOfOperations() > 0);
  CHECK(KeptFacets(input, "material") == KeptFacets(output, "material"));
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const double value = output->GetCellData()->GetArray("material")->GetComponent(c, 0);
    CHECK(value == 7 || value == -3);
    volume[value == 7] -= SignedVolume(output, c);
  }
  CHECK(std::abs(volume[0]) < 1e-12 && std::abs(volume[1]) < 1e-12);

  // Without the array the interface gives way: the check above can fail.
  filter->SetRegionArray(nullptr);
  filter->Update();
  CHECK(KeptFacets(input, "material") != KeptFacets(filter->GetOutput(), "material"));
}

void TestFixedPoints()
{
  Grid input = MakeBox(5, 0.28);
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName("fixed");
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    mask->InsertNextValue(p % 2);
  }
  input->GetPointData()->AddArray(mask);
  OptimizeFilter filter;
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
  CHECK(filter->GetNumberOfOperations() > 0);
  CHECK(countLost() == 0);
  filter->SetFixedPointArray("");
  filter->Update();
  CHECK(countLost() > 0);
}

/**
 * Inverted cells are worked on, and reversed numbering is not taken for inversion.
 */
void TestInverted()
{
  Grid input = MakeBox(4, 0.75);
  int inverted = 0;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    inverted += SignedVolume(input, c) <= 0.0;
  }
  CHECK(inverted > 5);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetWorstQualityBefore() < 0.0);
  CHECK(filter->GetWorstQualityAfter() > filter->GetWorstQualityBefore());

  Grid reversed = MakeBox(3, 0.2);
  for (const vtkIdType c : { 5, 17, 60 })
  {
    std::vector<vtkIdType> ids = CellPoints(reversed, c);
    std::swap(ids[0], ids[1]);
    reversed->GetCells()->ReplaceCellAtId(c, 4, ids.data());
  }
  filter->SetInputData(reversed);
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(messages.Warnings.size() == 1 && messages.Warnings[0].find("3 cells") != std::string::npos);
  CHECK(filter->GetWorstQualityBefore() > 0.0);
  CHECK(Figure(filter->GetOutput(), "NumberOfReorientedCells") == 3);
  for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
  {
    CHECK(SignedVolume(filter->GetOutput(), c) > 0.0);
  }
}

/**
 * Each measure and the size factor reach the optimizer: what is reported differs and gets better.
 */
void TestMeasuresAndSize()
{
  Grid input = MakeBox(4, 0.28);
  OptimizeFilter filter;
  filter->SetInputData(input);
  std::set<double> worst;
  for (int measure = vtkMeshOptimizeFilter::Shape; measure <= vtkMeshOptimizeFilter::VolumeLength;
       ++measure)
  {
    filter->SetQualityMeasure(measure);
    filter->Update();
    worst.insert(filter->GetWorstQualityBefore());
    CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
    CheckFigures(filter);
  }
  CHECK(worst.size() >= 5); // the two sines agree where no angle is obtuse
  filter->SetQualityMeasureToShape();
  filter->SetBeta(0.5);
  filter->SetDesiredSize(0.3);
  filter->Update();
  const double sized = filter->GetWorstQualityBefore();
  CHECK(worst.count(sized) == 0);
  CheckFigures(filter);

  // The same size at every point, as an array, is the same quality; as is the identity as a metric.
  vtkNew<vtkDoubleArray> size, metric;
  size->SetName("h");
  metric->SetName("M");
  metric->SetNumberOfComponents(6);
  for (vtkIdType p = 0; p < input->GetNumberOfPoints(); ++p)
  {
    size->InsertNextValue(0.3);
    metric->InsertNextTuple6(1, 1, 1, 0, 0, 0);
  }
  input->GetPointData()->AddArray(size);
  input->GetPointData()->AddArray(metric);
  filter->SetDesiredSize(0.0);
  filter->SetSizeArray("h");
  filter->SetMetricArray("M");
  filter->Update();
  CHECK(std::abs(filter->GetWorstQualityBefore() - sized) < 1e-12);
  CheckFigures(filter);
}

/**
 * A metric with XX = 4 is a mesh that is twice as long in x; 9 components say the same as 6.
 */
void TestMetricOrder()
{
  Grid plain = MakeBox(3, 0.2), stretched = MakeBox(3, 0.2);
  vtkNew<vtkDoubleArray> six, nine;
  six->SetName("six");
  six->SetNumberOfComponents(6);
  nine->SetName("nine");
  nine->SetNumberOfComponents(9);
  for (vtkIdType p = 0; p < plain->GetNumberOfPoints(); ++p)
  {
    // The map diag(2, 1, 1) times the shear x += y / 2, y += z / 4: M = A' A, XX YY ZZ XY YZ XZ.
    const Point x = GetPoint(plain, p);
    stretched->GetPoints()->SetPoint(p, 2 * x[0] + x[1], x[1] + 0.25 * x[2], x[2]);
    six->InsertNextTuple6(4, 2, 1.0625, 2, 0.25, 0);
    nine->InsertNextTuple9(4, 2, 0, 2, 2, 0.25, 0, 0.25, 1.0625);
  }
  plain->GetPointData()->AddArray(six);
  plain->GetPointData()->AddArray(nine);
  OptimizeFilter filter;
  filter->SetInputData(stretched);
  filter->Update();
  const double wanted = filter->GetWorstQualityBefore();
  filter->SetInputData(plain);
  filter->Update();
  CHECK(std::abs(filter->GetWorstQualityBefore() - wanted) > 0.01);
  for (const char* name : { "six", "nine" })
  {
    filter->SetMetricArray(name);
    filter->Update();
    CHECK(std::abs(filter->GetWorstQualityBefore() - wanted) < 1e-9);
  }
}

/**
 * The small pellet, if the data are there.
 */
void TestPellet(const std::string& file)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(file.c_str()))
  {
    CHECK(!"the data file can be read");
    return;
  }
  reader->SetFileName(file.c_str());
  OptimizeFilter filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->Update();
  CHECK(filter->GetWorstQualityAfter() > 0.2);
  CheckMesh(reader->GetOutput(), filter->GetOutput());
  CheckFigures(filter);
  CheckHistory(filter);
}

} // namespace

int main(int, char*[])
{
  ForBothAlgorithms(
    []()
    {
      TestBox();
      TestMeasureOnly();
      TestRegions();
      TestFixedPoints();
      TestInverted();
      TestMeasuresAndSize();
      TestMetricOrder();
      TestPellet(MESHOPTIMIZE_DATA_DIR "/crack40.vtu");
    });
  return Testing::Failures;
}
