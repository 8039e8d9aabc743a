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

using namespace Testing;

namespace
{

using Prepare = std::function<void(vtkMeshOptimizeFilter*)>;

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

void CheckWords(const std::string& error, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    if (error.find(word) == std::string::npos)
    {
      std::cerr << "no '" << word << "' in: " << error << "\n";
      ++Failures;
    }
  }
}

/**
 * Exactly one error with all of `words` in it, no warning, empty outputs, an error code; and the
 * same filter works again with a good mesh.
 */
void ExpectError(
  vtkDataObject* input, const std::vector<std::string>& words, const Prepare& prepare = nullptr)
{
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputDataObject(input);
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  CHECK(messages.Errors.size() == 1);
  CHECK(messages.Warnings.empty());
  for (const std::string& error : messages.Errors)
  {
    const std::size_t place = error.find("): ");
    std::cout << error.substr(place == std::string::npos ? 0 : place + 3) << std::flush;
    CheckWords(error, words);
  }
  if (messages.Errors.empty())
  {
    std::cerr << "no error about '" << words.front() << "'\n";
  }
  CHECK(filter->GetErrorCode() != 0);
  CHECK(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL) == 0);
  CHECK(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) == 0);
  CHECK(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows() == 0);
  CHECK(filter->GetStopReason() == vtkMeshOptimizeFilter::NotRun);
  CHECK(filter->GetWorstQualityAfter() == 0.0);

  OptimizeFilter healthy;
  healthy->SetInputDataObject(MakeBox(2, 0.2));
  healthy->Update();
  CHECK(healthy->GetOutput()->GetNumberOfCells() > 0);
}

/**
 * No error, and the worst quality does not fall.
 */
void ExpectSuccess(vtkUnstructuredGrid* input, int reason = -1)
{
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(input);
  filter->Update();
  for (const std::string& error : messages.Errors)
  {
    std::cerr << error << "\n";
  }
  CHECK(messages.Errors.empty());
  CHECK(filter->GetErrorCode() == 0);
  CHECK(reason < 0 || filter->GetStopReason() == reason);
  CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
  CHECK((input->GetNumberOfCells() == 0) == (filter->GetOutput()->GetNumberOfCells() == 0));
  CHECK(filter->GetOutput()->GetCellData()->GetArray("MeshQuality") != nullptr);
}

Grid OneTetrahedron()
{
  Grid grid = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  return grid;
}

//------------------------------------------------------------------------------
void TestWhatPasses()
{
  ExpectSuccess(Grid::New(), vtkMeshOptimizeFilter::NothingToDo);
  ExpectSuccess(MakeGrid({ { { 1, 2, 3 } }, { { 4, 5, 6 } } }), vtkMeshOptimizeFilter::NothingToDo);
  ExpectSuccess(OneTetrahedron());

  // No volume at all; a good cell and a flat one beside it; points twice at one place.
  Grid flat = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 1, 1, 0 } } });
  AddCell(flat, VTK_TETRA, { 0, 1, 2, 3 });
  ExpectSuccess(flat);
  Grid both = OneTetrahedron();
  both->GetPoints()->InsertNextPoint(0.3, 0.3, 0.0);
  AddCell(both, VTK_TETRA, { 0, 2, 1, 4 });
  ExpectSuccess(both);
  Grid collapsed = MakeBox(3, 0.2);
  double x[3];
  collapsed->GetPoint(21, x);
  collapsed->GetPoints()->SetPoint(22, x);
  ExpectSuccess(collapsed);

  // Two separate tetrahedra whose points lie on each other: a crack, no fault.
  Grid crack = OneTetrahedron();
  for (vtkIdType p = 0; p < 4; ++p)
  {
    crack->GetPoint(p, x);
    crack->GetPoints()->InsertNextPoint(x);
  }
  AddCell(crack, VTK_TETRA, { 4, 5, 6, 7 });
  ExpectSuccess(crack);
  // Two that share an edge only: not a manifold, no fault.
  Grid edge = OneTetrahedron();
  edge->GetPoints()->InsertNextPoint(0, -1, 0);
  edge->GetPoints()->InsertNextPoint(0, 0, -1);
  AddCell(edge, VTK_TETRA, { 0, 1, 4, 5 });
  ExpectSuccess(edge);
}

/**
 * Points that no cell uses stay, whatever their coordinates.
 */
void TestIsolatedPoints()
{
  Grid grid = MakeBox(3, 0.2);
  grid->GetPoints()->InsertNextPoint(5, 5, 5);
  grid->GetPoints()->InsertNextPoint(NaN, 0, Infinity);
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetNumberOfOperations() > 0);
  int found = 0;
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    const Point y = GetPoint(filter->GetOutput(), p);
    found += y == Point{ { 5, 5, 5 } } || (std::isnan(y[0]) && y[1] == 0 && y[2] == Infinity);
  }
  CHECK(found == 2);
}

void TestGeometry()
{
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    Grid grid = MakeBox(2, 0.1);
    grid->GetPoints()->SetPoint(13, 0.5, bad, 0.5);
    ExpectError(grid, { "oint 13", "not finite" });
  }
  Grid curved = MakeSquare(4, 0.1, [](double u, double v) { return Point{ { u, v, u * u } }; });
  ExpectError(curved, { "not in one plane", "point " });
}

void TestTopology()
{
  Grid three = OneTetrahedron();
  three->GetPoints()->InsertNextPoint(-1, 0, 0);
  three->GetPoints()->InsertNextPoint(2, 2, 2);
  AddCell(three, VTK_TETRA, { 0, 3, 2, 4 });
  AddCell(three, VTK_TETRA, { 0, 2, 3, 5 });
  ExpectError(three, { "more than two cells", "0, 1 and 2" });

  // The same with another cell in front: the error must lead to the cell of the grid.
  Grid shifted = MakeGrid({});
  shifted->GetPoints()->DeepCopy(three->GetPoints());
  AddCell(shifted, VTK_VERTEX, { 1 });
  for (vtkIdType c = 0; c < 3; ++c)
  {
    AddCell(shifted, VTK_TETRA, CellPoints(three, c));
  }
  ExpectError(shifted, { "more than two cells", "cell 3 of the grid" });

  Grid twice = OneTetrahedron();
  AddCell(twice, VTK_TETRA, { 2, 3, 0, 1 });
  ExpectError(twice, { "0 and 1", "same points" });

  Grid repeated = MakeBox(1, 0);
  AddCell(repeated, VTK_TETRA, { 0, 1, 1, 3 });
  ExpectError(repeated, { "ell 6", "point 1", "twice" });

  for (const vtkIdType bad : { vtkIdType(8), vtkIdType(-1), vtkIdType(1) << 40 })
  {
    for (const int type : { VTK_TETRA, VTK_QUAD })
    {
      Grid range = MakeBox(1, 0);
      AddCell(range, type, { 0, 1, bad, 3 });
      ExpectError(range, { "ell 6", "point " + std::to_string(bad), "8 points" });
    }
  }
  Grid none = Grid::New();
  none->Allocate(1);
  AddCell(none, VTK_TETRA, { 0, 1, 2, 3 });
  ExpectError(none, { "ell 0", "0 points" });
  Grid shortCell = MakeBox(1, 0);
  AddCell(shortCell, VTK_TETRA, { 0, 1, 2 });
  ExpectError(shortCell, { "ell 6", "3 points instead of 4" });
}

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

void TestArrays()
{
  const auto region = [](vtkMeshOptimizeFilter* f) { f->SetRegionArray("a"); };
  const auto fixed = [](vtkMeshOptimizeFilter* f) { f->SetFixedPointArray("a"); };
  const auto size = [](vtkMeshOptimizeFilter* f)
  {
    f->SetBeta(1.0);
    f->SetSizeArray("a");
  };
  const auto metric = [](vtkMeshOptimizeFilter* f) { f->SetMetricArray("a"); };
  ExpectError(WithArray<vtkFloatArray>(true, "a", 1, 1), { "region array 'a'", "float" }, region);
  ExpectError(WithArray<vtkStringArray>(true, "a", 1, 1), { "region array 'a'", "string" }, region);
  ExpectError(WithArray<vtkIntArray>(true, "a", 2, 1), { "region array 'a'", "2 comp" }, region);
  ExpectError(WithArray<vtkIntArray>(false, "a", 1, 1), { "region array 'a'", "cell" }, region);
  ExpectError(WithArray<vtkIntArray>(true, "a", 1, 1), { "fixed point array 'a'", "point" }, fixed);
  ExpectError(WithArray<vtkStringArray>(false, "a", 1, 1), { "fixed point array 'a'" }, fixed);
  ExpectError(MakeBox(2, 0.1), { "size array 'a'", "not there" }, size);
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 3, 1), { "size array 'a'", "3 comp" }, size);
  for (const double bad : { 0.0, -1.0, NaN, Infinity })
  {
    Grid grid = WithArray<vtkDoubleArray>(false, "a", 1, 0.5);
    grid->GetPointData()->GetArray("a")->SetComponent(11, 0, bad);
    ExpectError(grid, { "size", "point 11" }, size);
  }
  ExpectError(
    WithArray<vtkDoubleArray>(false, "a", 5, 1), { "metric array 'a'", "5 comp" }, metric);
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 6, 1), { "metric", "point 0" }, metric);
  Grid skew = WithArray<vtkDoubleArray>(false, "a", 9, 0);
  for (vtkIdType p = 0; p < skew->GetNumberOfPoints(); ++p)
  {
    skew->GetPointData()->GetArray("a")->SetTuple9(p, 1, p == 7 ? 0.5 : 0, 0, 0, 1, 0, 0, 0, 1);
  }
  ExpectError(skew, { "metric", "point 7" }, metric);

  // Arrays that nobody asked for must have the right length, too: they are to be carried along.
  ExpectError(WithArray<vtkDoubleArray>(false, "a", 1, 1, 3), { "point array 'a'", "24", "27" });
  ExpectError(WithArray<vtkDoubleArray>(true, "a", 1, 1, 5), { "cell array 'a'", "43", "48" });
  // ParaView says "None" for no array; on a grid without cells a missing array is no fault.
  OptimizeFilter filter;
  Messages messages(filter);
  filter->SetRegionArray("None");
  filter->SetInputData(MakeBox(2, 0.1));
  filter->Update();
  filter->SetRegionArray("a");
  filter->SetInputData(Grid::New());
  filter->Update();
  CHECK(messages.Errors.empty());
}

void TestOptions()
{
  const Grid box = MakeBox(2, 0.1);
  ExpectError(box, { "desired size" }, [](vtkMeshOptimizeFilter* f) { f->SetBeta(1.0); });
  ExpectError(box, { "target" }, [](vtkMeshOptimizeFilter* f) { f->SetTargetQuality(0.0); });
  ExpectError(box, { "target" }, [](vtkMeshOptimizeFilter* f) { f->SetTargetQuality(NaN); });
  ExpectError(box, { "beta" }, [](vtkMeshOptimizeFilter* f) { f->SetBeta(NaN); });
  ExpectError(box, { "OptimizeBelow" }, [](vtkMeshOptimizeFilter* f) { f->SetOptimizeBelow(NaN); });
  for (int number : { -1, 99 })
  {
    ExpectError(box, { "quality measure", "none of the known" },
      [=](vtkMeshOptimizeFilter* f) { f->SetQualityMeasure(number); });
  }
  // a measure that can only be reported
  ExpectError(box, { "MinimumDihedralAngle", "not to optimize" },
    [](vtkMeshOptimizeFilter* f)
    { f->SetQualityMeasure(vtkMeshQualityMinMax::MinimumDihedralAngle); });
  OptimizeFilter f;
  f->SetTargetQuality(7.0);
  CHECK(f->GetTargetQuality() == 1.0);
  f->SetNeighborhoodLevel(-1);
  CHECK(f->GetNeighborhoodLevel() == 0);
  f->SetEpsilon(-1.0);
  CHECK(f->GetEpsilon() > 0.0);
  f->SetNumberOfThreads(-4);
  CHECK(f->GetNumberOfThreads() == 0);
  f->SetOptimizeBelow(-1.0);
  CHECK(f->GetOptimizeBelow() == 0.0);
  f->SetNumberOfLayers(-3);
  CHECK(f->GetNumberOfLayers() == 0);
}

vtkSmartPointer<vtkPolyData> Lines(
  const std::vector<Point>& points, const std::vector<std::vector<vtkIdType>>& lines)
{
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> x;
  x->SetDataTypeToDouble();
  for (const Point& p : points)
  {
    x->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const std::vector<vtkIdType>& line : lines)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
  }
  geometry->SetPoints(x);
  geometry->SetLines(cells);
  return geometry;
}

/**
 * The boundary mode Slide: where it cannot be, and geometries that are none.
 */
void TestSlide()
{
  const auto slide = [](vtkMeshOptimizeFilter* f) { f->SetBoundaryModeToSlide(); };
  const auto flat = [](double u, double v) { return Point{ { u, v, 0 } }; };
  const Grid square = MakeSquare(4, 0.1, flat);
  if (Algorithm == vtkMeshOptimizeFilter::Paper1996)
  {
    ExpectError(square, { "Slide", "WorstFirst" }, slide);
    return;
  }
  ExpectError(MakeBox(2, 0.1), { "Slide", "tetrahedra" }, slide);
  ExpectError(square, { "Slide", "OptimizeBelow" },
    [&](vtkMeshOptimizeFilter* f)
    {
      slide(f);
      f->SetOptimizeBelow(0.5);
    });
  ExpectError(square, { "corner array 'c'", "not there" },
    [&](vtkMeshOptimizeFilter* f)
    {
      slide(f);
      f->SetCornerArray("c");
    });
  ExpectError(square, { "1e8", "elements" },
    [&](vtkMeshOptimizeFilter* f)
    {
      slide(f);
      f->SetDesiredSize(1e-6); // 2.3e12 of them
    });
  ExpectError(square, { "target" },
    [&](vtkMeshOptimizeFilter* f)
    {
      slide(f);
      f->SetTargetQuality(NaN);
    });

  const auto along = [&](vtkPolyData* geometry)
  {
    return [=](vtkMeshOptimizeFilter* f)
    {
      f->SetBoundaryModeToSlide();
      f->SetGeometryData(geometry);
    };
  };
  const std::vector<Point> corners{ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 1, 1, 0 } },
    { { 0, 1, 0 } } };
  const std::vector<std::vector<vtkIdType>> around{ { 0, 1, 2, 3, 0 } };
  ExpectError(square, { "geometry", "no lines" }, along(Lines(corners, {})));
  ExpectError(square, { "geometry", "no lines" }, along(vtkSmartPointer<vtkPolyData>::New()));
  std::vector<Point> lifted = corners;
  lifted[2][2] = 0.1;
  ExpectError(square, { "Point 2 of the geometry", "plane", "0.1" }, along(Lines(lifted, around)));
  for (const double bad : { NaN, Infinity })
  {
    std::vector<Point> broken = corners;
    broken[3][1] = bad;
    ExpectError(square, { "Point 3 of the geometry", "finite" }, along(Lines(broken, around)));
  }
  for (const vtkIdType bad : { vtkIdType(4), vtkIdType(-1), vtkIdType(1) << 40 })
  {
    ExpectError(square, { "geometry", "point " + std::to_string(bad), "4 points" },
      along(Lines(corners, { { 0, 1, 2, bad, 0 } })));
  }
  std::vector<Point> larger = corners;
  for (Point& x : larger)
  {
    x[0] = 1.2 * x[0] - 0.1;
    x[1] = 1.2 * x[1] - 0.1;
  }
  ExpectError(square, { "geometry", "corner", "point 0" }, along(Lines(larger, around)));
  ExpectError(square, { "does not lie on the geometry", "point " },
    along(Lines(corners, { { 0, 1, 2, 3 } }))); // open
  for (const int components : { 1, 3 })
  {
    const vtkSmartPointer<vtkPolyData> marked = Lines(corners, around);
    vtkNew<vtkDoubleArray> marks;
    marks->SetName("c");
    marks->SetNumberOfComponents(components);
    marks->SetNumberOfTuples(components == 1 ? 2 : 4);
    marks->Fill(0.0);
    marked->GetPointData()->AddArray(marks);
    ExpectError(square, { "corner array 'c'", "geometry", components == 1 ? "4 points" : "3 comp" },
      [&](vtkMeshOptimizeFilter* f)
      {
        along(marked)(f);
        f->SetCornerArray("c");
      });
  }
  ExpectError(
    square, { "does not lie on the geometry", "point " }, along(Lines(corners, { { 0, 1 } })));
}

/**
 * Nothing connected, nullptr, another type of data: the executive's one error, and no crash.
 */
void TestNoInput()
{
  OptimizeFilter filter;
  Messages messages(filter);
  filter->Update();
  CHECK(messages.Errors.size() == 1);
  filter->SetInputData(static_cast<vtkDataObject*>(nullptr));
  filter->Update();
  CHECK(messages.Errors.size() == 2);
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  CHECK(messages.Errors.size() == 3);
  CheckWords(messages.Errors.back(), { "vtkPolyData" });
  filter->SetInputData(OneTetrahedron());
  filter->Update();
  CHECK(messages.Errors.size() == 3);
  CHECK(filter->GetOutput() && filter->GetOutput()->GetNumberOfCells() == 1);
}

/**
 * The error of a block says which; nothing half done comes out.
 */
void TestBlock()
{
  Grid bad = MakeBox(1, 0);
  AddCell(bad, VTK_TETRA, { 0, 1, 1, 3 });
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBox(2, 0.1));
  blocks->SetBlock(1, bad);
  ExpectError(blocks, { "Block 2", "ell 6", "twice" });
}

} // namespace

int main(int, char*[])
{
  ForBothAlgorithms(
    []()
    {
      TestWhatPasses();
      TestIsolatedPoints();
      TestGeometry();
      TestTopology();
      TestArrays();
      TestOptions();
      TestSlide();
      TestNoInput();
      TestBlock();
    });
  return Testing::Failures;
}
