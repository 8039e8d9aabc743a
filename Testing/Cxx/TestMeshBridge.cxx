// SPDX-License-Identifier: BSD-3-Clause
// One reader of grids: vtkMeshOptimizeFilter and vtkMeshQualityMinMax say the same about the same
// cells, ghosts, planes, sizes, tensors and regions.
#include "MeshOptimizeFilterTesting.h"

#include "vtkDataSetAttributes.h"
#include "vtkIntArray.h"
#include "vtkMeshQualityMinMax.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

using namespace Testing;

namespace
{

constexpr unsigned char Skipped[] = { vtkDataSetAttributes::DUPLICATECELL,
  vtkDataSetAttributes::REFINEDCELL, vtkDataSetAttributes::HIDDENCELL };
constexpr unsigned char Present[] = { vtkDataSetAttributes::HIGHCONNECTIVITYCELL,
  vtkDataSetAttributes::LOWCONNECTIVITYCELL, vtkDataSetAttributes::EXTERIORCELL };

//------------------------------------------------------------------------------
// Inputs

/// Maps of the unit square into space, and where they lead.
struct Plane
{
  std::string Name;
  std::function<Point(double, double)> Map;
};

const std::vector<Plane> Planes = {
  { "z = 3",
    [](double u, double v) -> Point {
      return { { u, v, 3.0 } };
    } },
  { "y = 0",
    [](double u, double v) -> Point {
      return { { v, 0.0, u } };
    } },
  { "x = -1",
    [](double u, double v) -> Point {
      return { { -1.0, u, v } };
    } },
  { "tilted",
    [](double u, double v) -> Point {
      return { { 5.0 + 0.8 * u - 0.36 * v, 0.6 * u + 0.48 * v, 0.8 * v - 2.0 } };
    } },
  { "z = 3, numbered clockwise",
    [](double u, double v) -> Point {
      return { { v, u, 3.0 } };
    } },
};

template <class Array>
vtkSmartPointer<Array> NewArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

void AddSizes(vtkUnstructuredGrid* grid)
{
  auto sizes = NewArray<vtkDoubleArray>("size", 1, grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    sizes->SetValue(p, 0.2 + 0.1 * GetPoint(grid, p)[0] * GetPoint(grid, p)[0]);
  }
  grid->GetPointData()->AddArray(sizes);
}

/// A metric that varies. Of its 9 components two that should be equal differ by `skew` (relative).
void AddMetric(vtkUnstructuredGrid* grid, int components, double skew = 0.0)
{
  auto metric = NewArray<vtkDoubleArray>("metric", components, grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(grid, p);
    const double xx = 2.0 + x[0] * x[0], yy = 1.5, zz = 1.0 + std::abs(x[2]);
    const double xy = 0.3, yz = -0.2, xz = 0.1;
    const double six[6] = { xx, yy, zz, xy, yz, xz };
    const double nine[9] = { xx, xy + skew * xx, xz, xy, yy, yz, xz, yz, zz };
    metric->SetTuple(p, components == 6 ? six : nine);
  }
  grid->GetPointData()->AddArray(metric);
}

template <class Array>
void AddRegions(vtkUnstructuredGrid* grid, std::initializer_list<long long> values)
{
  auto regions = NewArray<Array>("region", 1, grid->GetNumberOfCells());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const auto k = static_cast<std::size_t>(
      c * static_cast<vtkIdType>(values.size()) / grid->GetNumberOfCells());
    regions->SetValue(c, static_cast<typename Array::ValueType>(values.begin()[k]));
  }
  grid->GetCellData()->AddArray(regions);
}

/// Marks every `period`-th cell, from the last one down.
void AddGhosts(vtkUnstructuredGrid* grid, unsigned char flag, vtkIdType period)
{
  auto ghosts = NewArray<vtkUnsignedCharArray>(
    vtkDataSetAttributes::GhostArrayName(), 1, grid->GetNumberOfCells());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    ghosts->SetValue(c, (grid->GetNumberOfCells() - 1 - c) % period == 0 ? flag : 0);
  }
  grid->GetCellData()->AddArray(ghosts);
}

bool IsSkipped(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  return ghosts &&
    std::any_of(std::begin(Skipped), std::end(Skipped),
      [&](unsigned char flag) { return (ghosts->GetValue(cell) & flag) != 0; });
}

//------------------------------------------------------------------------------
// What a filter says

struct Answer
{
  std::vector<std::string> Errors, Warnings;
  std::vector<double> Quality;
  double Minimum = 0.0, Mean = 0.0, Bound = 0.0;
  vtkIdType Measured = 0, Inverted = 0;
};

template <class Filter>
void Choose(vtkUnstructuredGrid* grid, double beta, Filter* filter)
{
  filter->SetInputData(grid);
  filter->SetBeta(beta);
  filter->SetDesiredSize(beta > 0.0 ? 0.3 : 0.0);
  filter->SetSizeArray(grid->GetPointData()->HasArray("size") ? "size" : nullptr);
  filter->SetMetricArray(grid->GetPointData()->HasArray("metric") ? "metric" : nullptr);
  filter->SetRegionArray(grid->GetCellData()->HasArray("region") ? "region" : nullptr);
}

void Take(vtkAlgorithm* filter, const Messages& messages, Answer& answer)
{
  answer.Errors = messages.Errors;
  answer.Warnings = messages.Warnings;
  vtkDataArray* quality = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0))
                            ->GetCellData()
                            ->GetArray("MeshQuality");
  for (vtkIdType c = 0; quality && c < quality->GetNumberOfTuples(); ++c)
  {
    answer.Quality.push_back(quality->GetComponent(c, 0));
  }
}

/// Mesh Optimize, which may change nothing.
Answer AskOptimize(vtkUnstructuredGrid* grid, double beta)
{
  vtkNew<vtkMeshOptimizeFilter> filter;
  Messages messages(filter);
  Choose(grid, beta, filter.Get());
  filter->MoveNodesOff();
  filter->ReconnectOff();
  filter->InsertNodesOff();
  filter->RemoveNodesOff();
  filter->Update();
  Answer answer;
  Take(filter, messages, answer);
  answer.Minimum = filter->GetWorstQualityBefore();
  answer.Mean = filter->GetMeanQualityBefore();
  answer.Bound = filter->GetQualityBound();
  answer.Inverted = filter->GetNumberOfInvertedCellsBefore();
  auto history = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  answer.Measured = history->GetNumberOfRows() > 0
    ? history->GetValueByName(0, "Cells").ToTypeInt64()
    : vtkIdType(0);
  return answer;
}

Answer AskMinMax(vtkUnstructuredGrid* grid, double beta)
{
  vtkNew<vtkMeshQualityMinMax> filter;
  Messages messages(filter);
  Choose(grid, beta, filter.Get());
  filter->Update();
  Answer answer;
  Take(filter, messages, answer);
  answer.Minimum = filter->GetMinimumQuality();
  answer.Mean = filter->GetMeanQuality();
  answer.Bound = filter->GetQualityBound();
  answer.Inverted = filter->GetNumberOfInvertedCells();
  answer.Measured = filter->GetNumberOfMeasuredCells();
  return answer;
}

//------------------------------------------------------------------------------
// Agreement

bool IsNear(double a, double b, double tolerance)
{
  return std::abs(a - b) <= tolerance || (std::isnan(a) && std::isnan(b));
}

void CheckNear(const std::string& title, const char* what, double optimize, double minMax,
  double tolerance = 1e-12)
{
  if (!IsNear(optimize, minMax, tolerance))
  {
    std::cerr.precision(17);
    std::cerr << title << ": " << what << " is " << optimize << " to Mesh Optimize, " << minMax
              << " to Min Max\n";
    ++Failures;
  }
}

/// All is linear and of one dimension: everything must be the same.
void Compare(const std::string& title, vtkUnstructuredGrid* grid, double beta = 0.0)
{
  const Answer optimize = AskOptimize(grid, beta), minMax = AskMinMax(grid, beta);
  for (const Answer* answer : { &optimize, &minMax })
  {
    for (const std::string& text : answer->Errors)
    {
      std::cerr << title << ": " << text << "\n";
      ++Failures;
    }
  }
  CHECK(optimize.Quality.size() == minMax.Quality.size());
  for (std::size_t c = 0; c < std::min(optimize.Quality.size(), minMax.Quality.size()); ++c)
  {
    CheckNear(title, "the quality of a cell", optimize.Quality[c], minMax.Quality[c]);
  }
  CheckNear(title, "the worst quality", optimize.Minimum, minMax.Minimum);
  CheckNear(title, "the mean quality", optimize.Mean, minMax.Mean);
  // Mesh Optimize knows no bound where sizes vary (1). Caps of edges are found to 1e-7.
  const bool isUnknown = beta > 0.0 && grid->GetPointData()->HasArray("size");
  CheckNear(title, "the bound", optimize.Bound, isUnknown ? 1.0 : minMax.Bound, 1e-6);
  CheckNear(title, "the number of cells", static_cast<double>(optimize.Measured),
    static_cast<double>(minMax.Measured));
  CheckNear(title, "the number of inverted cells", static_cast<double>(optimize.Inverted),
    static_cast<double>(minMax.Inverted));
}

Grid MakeTetrahedra() { return MakeBox(3, 0.4); }

/// The same mesh with everything that may come along with it.
void CompareVariants(const std::string& title, const std::function<Grid()>& make)
{
  Compare(title, make());
  Compare(title + ", one size", make(), 0.7);
  Grid sizes = make();
  AddSizes(sizes);
  Compare(title + ", sizes", sizes, 0.7);
  for (int components : { 6, 9 })
  {
    Grid metric = make();
    AddMetric(metric, components);
    const std::string name = title + ", metric of " + std::to_string(components);
    Compare(name, metric);
    AddSizes(metric);
    Compare(name + ", sizes", metric, 0.7);
  }
  Grid regions = make();
  AddRegions<vtkIntArray>(regions, { 7, -2, 5 });
  Compare(title + ", regions", regions);
  Grid large = make();
  const long long far = 1LL << 60; // a double does not tell it from the next one
  AddRegions<vtkTypeInt64Array>(large, { far, far + 1, -far, far + 1 });
  Compare(title + ", regions of 64 bits", large);
}

void TestSameAnswers()
{
  CompareVariants("tetrahedra", MakeTetrahedra);
  CompareVariants("tetrahedra in single precision", [] { return MakeBox(3, 0.4, VTK_FLOAT); });
  for (const Plane& plane : Planes)
  {
    CompareVariants("triangles, " + plane.Name, [&plane] { return MakeSquare(5, 0.6, plane.Map); });
  }
  CompareVariants("triangles in single precision, tilted",
    [] { return MakeSquare(5, 0.6, Planes[3].Map, VTK_FLOAT); });
}

/**
 * Regions that a double does not tell apart are regions all the same.
 */
void TestLargeRegions()
{
  Grid grid = MakeTetrahedra();
  const long long far = 1LL << 60;
  AddRegions<vtkTypeInt64Array>(grid, { far, far + 1 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->SetRegionArray("region");
  filter->Update();
  auto table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  CHECK(table->GetNumberOfRows() == 3);
  CHECK(table->GetValueByName(1, "Region").ToString() == std::to_string(far + 1));
}

/**
 * The same triangles in any plane: one bound, and the same signs.
 */
void TestPlanes()
{
  Answer first;
  for (const Plane& plane : Planes)
  {
    const Answer answer = AskMinMax(MakeSquare(6, 0.3, plane.Map), 0.0);
    first = &plane == &Planes.front() ? answer : first;
    CHECK(answer.Bound < 0.97); // right angles at the corners, or triangles that halve them
    CHECK(IsNear(answer.Bound, first.Bound, 1e-9));
    CHECK(answer.Inverted == first.Inverted && IsNear(answer.Minimum, first.Minimum, 1e-9));
  }
  for (const Plane& plane : Planes)
  {
    Grid turned = MakeSquare(4, 0.0, plane.Map);
    const std::vector<vtkIdType> ids = CellPoints(turned, 7);
    const vtkIdType other[3] = { ids[1], ids[0], ids[2] };
    turned->GetCells()->ReplaceCellAtId(7, 3, other);
    const Answer answer = AskMinMax(turned, 0.0);
    CHECK(answer.Inverted == 1 && answer.Quality[7] < 0.0 && answer.Quality[6] > 0.0);
  }
  // No plane: no sign, no bound.
  const Answer curved = AskMinMax(MakeSquare(4, 0.0,
                                    [](double u, double v) -> Point {
                                      return { { u, v, u * v } };
                                    }),
    0.0);
  CHECK(curved.Bound == 1.0 && curved.Inverted == 0);
}

//------------------------------------------------------------------------------
/**
 * A tensor that was rounded to single precision is a metric, one that is really skew is not.
 */
void TestSkewMetric()
{
  for (const bool isSolid : { true, false })
  {
    const auto make = [&](double skew)
    {
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(4, 0.5, Planes[3].Map);
      AddMetric(grid, 9, skew);
      return grid;
    };
    Compare("metric skew by 1e-7", make(1e-7));
    CHECK(IsNear(AskMinMax(make(1e-7), 0.0).Mean, AskMinMax(make(0.0), 0.0).Mean, 1e-6));
    for (const Answer& answer : { AskOptimize(make(1e-4), 0.0), AskMinMax(make(1e-4), 0.0) })
    {
      CHECK(answer.Errors.size() == 1 &&
        answer.Errors[0].find("not symmetric") != std::string::npos &&
        answer.Errors[0].find("at point 0") != std::string::npos);
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Duplicates, refined and hidden cells are not counted; the other flags only say how a cell lies.
 */
void TestGhostFlags()
{
  for (const bool isSolid : { true, false })
  {
    const auto make = [&](unsigned char flag, vtkIdType period)
    {
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(5, 0.6, Planes[3].Map);
      AddGhosts(grid, flag, period);
      return grid;
    };
    const vtkIdType all = make(0, 1)->GetNumberOfCells();
    for (const unsigned char flag : Present)
    {
      Compare("all cells flagged " + std::to_string(flag), make(flag, 1));
      const Answer answer = AskOptimize(make(flag, 1), 0.0);
      CHECK(answer.Warnings.empty() && answer.Measured == all);
      CHECK(AskMinMax(make(flag, 1), 0.0).Measured == all);
    }
    for (const unsigned char flag : Skipped)
    {
      const Answer none = AskOptimize(make(flag, 1), 0.0), nothing = AskMinMax(make(flag, 1), 0.0);
      CHECK(none.Measured == 0 && nothing.Measured == 0);
      for (const Answer& answer : { none, nothing })
      {
        CHECK(answer.Warnings.size() == 1 &&
          answer.Warnings[0].find("ghost cells") != std::string::npos &&
          answer.Warnings[0].find("none of") == std::string::npos);
      }
    }
  }
}

/**
 * Some ghosts: what is counted is the same, and ghosts are measured in the same way. The border to
 * them is a surface that Mesh Optimize keeps; to Min Max it is inside, and no bound.
 */
void TestSomeGhosts()
{
  for (const bool hasValues : { false, true })
  {
    for (const bool isSolid : { true, false })
    {
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(5, 0.5, Planes[3].Map);
      AddGhosts(grid, vtkDataSetAttributes::DUPLICATECELL, 9);
      if (hasValues)
      {
        AddSizes(grid);
        AddMetric(grid, 6);
      }
      const double beta = hasValues ? 0.7 : 0.0;
      const Answer optimize = AskOptimize(grid, beta), minMax = AskMinMax(grid, beta);
      CHECK(optimize.Errors.empty() && minMax.Errors.empty());
      CHECK(optimize.Measured == minMax.Measured && optimize.Inverted == minMax.Inverted);
      CHECK(optimize.Measured == grid->GetNumberOfCells() - (grid->GetNumberOfCells() + 8) / 9);
      CHECK(IsNear(optimize.Minimum, minMax.Minimum, 1e-12));
      CHECK(IsNear(optimize.Mean, minMax.Mean, 1e-12));
      CHECK(optimize.Bound <= minMax.Bound + 1e-12);
      for (std::size_t c = 0; c < optimize.Quality.size(); ++c)
      {
        CheckNear(
          "a grid with ghosts", "the quality of a cell", optimize.Quality[c], minMax.Quality[c]);
      }
    }
  }
}

/**
 * What only ghosts need may be anything: another process checks it.
 */
void TestValuesOfGhosts()
{
  Grid grid = MakeGrid(
    { { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } }, { { 0, 0, -1 } } });
  AddCell(grid, VTK_TETRA, { 0, 1, 2, 3 });
  AddCell(grid, VTK_TETRA, { 0, 2, 1, 4 });
  AddGhosts(grid, vtkDataSetAttributes::DUPLICATECELL, 2);
  CHECK(IsSkipped(grid, 1) && !IsSkipped(grid, 0));
  AddSizes(grid);
  AddMetric(grid, 9);
  grid->GetPointData()->GetArray("size")->SetComponent(4, 0, -1.0);
  grid->GetPointData()->GetArray("metric")->SetComponent(4, 0, -1.0);
  for (const Answer& answer : { AskOptimize(grid, 0.7), AskMinMax(grid, 0.7) })
  {
    CHECK(answer.Errors.empty() && answer.Measured == 1);
    CHECK(answer.Quality[0] > 0.0 && std::isnan(answer.Quality[1]));
  }
}

//------------------------------------------------------------------------------
/**
 * Quadratic cells, cells of other kinds and of lower dimension: those that both measure are
 * measured alike; Min Max says how many there are besides.
 */
void TestMixedCells()
{
  Grid grid = MakeBox(2, 0.3);
  const vtkIdType simplices = grid->GetNumberOfCells();
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 4 }); // of the surface
  AddCell(grid, VTK_LINE, { 0, 1 });
  AddCell(grid, VTK_VERTEX, { 3 });
  for (int k = 0; k < 10; ++k)
  {
    grid->GetPoints()->InsertNextPoint(2 + (k == 1), 2 + (k == 2), 2 + (k == 3));
  }
  const vtkIdType p = 27;
  AddCell(grid, VTK_QUADRATIC_TETRA,
    { p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6, p + 7, p + 8, p + 9 });
  AddCell(grid, VTK_PYRAMID, { p, p + 1, p + 2, p + 3, p + 4 });
  const Answer optimize = AskOptimize(grid, 0.0), minMax = AskMinMax(grid, 0.0);
  CHECK(optimize.Errors.empty() && minMax.Errors.empty() && minMax.Warnings.empty());
  CHECK(
    optimize.Warnings.size() == 1 && optimize.Warnings[0].find("1 quadratic") != std::string::npos);
  CHECK(optimize.Measured == simplices && minMax.Measured == simplices + 2);
  for (std::size_t c = 0; c < optimize.Quality.size(); ++c)
  {
    const int type = grid->GetCellType(static_cast<vtkIdType>(c));
    CHECK(std::isnan(optimize.Quality[c]) == (type != VTK_TETRA));
    CHECK(std::isnan(minMax.Quality[c]) ==
      (type != VTK_TETRA && type != VTK_TRIANGLE && type != VTK_QUADRATIC_TETRA));
    CHECK(std::isnan(optimize.Quality[c]) || optimize.Quality[c] == minMax.Quality[c]);
  }
}

/**
 * Broken grids: Min Max measures what can be measured, and never reads out of an array.
 */
void TestBrokenGrids()
{
  for (const Plane& plane : Planes)
  {
    Grid grid = MakeSquare(3, 0.0, plane.Map);
    const Answer whole = AskMinMax(grid, 0.0);
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 77 });
    AddCell(grid, VTK_TRIANGLE, { 0, -1, 2 });
    grid->GetPoints()->InsertNextPoint(std::nan(""), 1.0, 0.0);
    grid->GetPoints()->InsertNextPoint(1.0, std::numeric_limits<double>::infinity(), 0.0);
    grid->GetPoints()->InsertNextPoint(1.0, 0.0, std::nan(""));
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 16 });
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 17 });
    AddCell(grid, VTK_TRIANGLE, { 0, 1, 18 });
    const Answer answer = AskMinMax(grid, 0.0);
    CHECK(answer.Errors.empty() && answer.Measured == whole.Measured);
    CHECK(answer.Minimum == whole.Minimum && answer.Inverted == 0);
    CHECK(IsNear(answer.Bound, whole.Bound, 1e-9));
  }
  // Cells with too few points, and no points at all.
  Grid bare = MakeGrid({});
  AddCell(bare, VTK_TETRA, {});
  AddCell(bare, VTK_TRIANGLE, {});
  CHECK(AskMinMax(bare, 0.0).Errors.empty() && AskMinMax(bare, 0.0).Measured == 0);
  bare = MakeTetrahedra();
  const vtkIdType all = bare->GetNumberOfCells();
  AddCell(bare, VTK_TETRA, { 0, 1 });
  AddCell(bare, VTK_QUADRATIC_TETRA, { 0, 1, 2 });
  CHECK(AskMinMax(bare, 0.0).Errors.empty() && AskMinMax(bare, 0.0).Measured == all);
  // A ghost array that is too short says nothing.
  Grid grid = MakeTetrahedra();
  auto ghosts = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 1, 3);
  ghosts->FillValue(vtkDataSetAttributes::DUPLICATECELL);
  grid->GetCellData()->AddArray(ghosts);
  CHECK(AskMinMax(grid, 0.0).Measured == grid->GetNumberOfCells());
}

} // namespace

int main(int, char**)
{
  TestSameAnswers();
  TestLargeRegions();
  TestPlanes();
  TestSkewMetric();
  TestGhostFlags();
  TestSomeGhosts();
  TestValuesOfGhosts();
  TestMixedCells();
  TestBrokenGrids();
  return Failures > 0;
}
