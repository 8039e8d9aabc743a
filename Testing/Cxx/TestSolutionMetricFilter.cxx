// SPDX-License-Identifier: BSD-3-Clause
// vtkSolutionMetricFilter: its arrays on meshes in space and in any plane, what it says of bad
// input, and the way into vtkMeshOptimizeFilter.
#include "FilterTesting.h"

#include "vtkFloatArray.h"
#include "vtkMeshOptimizeFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSolutionMetricFilter.h"
#include "vtkStringArray.h"

using namespace Testing;

namespace
{

using Field = std::function<double(const Point&)>;
using Prepare = std::function<void(vtkSolutionMetricFilter*)>;

const double NaN = std::numeric_limits<double>::quiet_NaN();

double Layer(const Point& x) { return std::tanh(10.0 * (x[0] + 0.3 * x[1] - 0.5)); }

double Quadratic(const Point& x) { return 4.0 * x[0] * x[0] - x[1] * x[1] + 2.0 * x[0] * x[2]; }

Grid WithField(Grid grid, const Field& f, int components = 1, int type = VTK_DOUBLE)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName("u");
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    for (int i = 0; i < components; ++i)
    {
      array->SetComponent(p, i, (i + 1) * f(GetPoint(grid, p)));
    }
  }
  grid->GetPointData()->AddArray(array);
  return grid;
}

Grid WithErrors(Grid grid, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("e");
  array->SetNumberOfTuples(grid->GetNumberOfCells());
  array->Fill(value);
  grid->GetCellData()->AddArray(array);
  return grid;
}

Point Flat(double u, double v) { return { { u, v, 0.0 } }; }

using Six = std::array<double, 6>;

Six MetricAt(vtkUnstructuredGrid* grid, vtkIdType p, const char* name = "Metric")
{
  Six m;
  grid->GetPointData()->GetArray(name)->GetTuple(p, m.data());
  return m;
}

double Determinant(const Six& m)
{
  return m[0] * (m[1] * m[2] - m[4] * m[4]) - m[3] * (m[3] * m[2] - m[4] * m[5]) +
    m[5] * (m[3] * m[4] - m[1] * m[5]);
}

bool IsPositive(const Six& m)
{
  return m[0] > 0.0 && m[0] * m[1] > m[3] * m[3] && Determinant(m) > 0.0;
}

/**
 * e' M e
 */
double Squared(const Six& m, const Point& e)
{
  return m[0] * e[0] * e[0] + m[1] * e[1] * e[1] + m[2] * e[2] * e[2] +
    2.0 * (m[3] * e[0] * e[1] + m[4] * e[1] * e[2] + m[5] * e[0] * e[2]);
}

void Compute(
  vtkSolutionMetricFilter* filter, vtkUnstructuredGrid* grid, const Prepare& prepare = nullptr)
{
  Messages messages(filter);
  filter->SetInputData(grid);
  filter->SetSolutionArray("u");
  filter->SetErrorIndicatorArray("e");
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  EXPECT_EQ(filter->GetErrorCode(), 0);
}

//------------------------------------------------------------------------------
/**
 * The metric of a quadratic is |H|, the same at all points; the number comes out as in closed form.
 */
TEST(SolutionMetricFilter, QuadraticInSpaceHasItsHessianAsMetric)
{
  Grid box = WithField(MakeBox(4, 0.2), Quadratic);
  vtkNew<vtkSolutionMetricFilter> filter;
  Compute(filter, box,
    [](vtkSolutionMetricFilter* f)
    {
      f->SetRecoveryToLeastSquares();
      f->SetDesiredNumberOfElements(5000);
      f->ComputeSizeTensorOn();
    });
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_EQ(output->GetNumberOfCells(), box->GetNumberOfCells());
  EXPECT_EQ(output->GetPointData()->GetArray("u"), box->GetPointData()->GetArray("u"));
  EXPECT_EQ(box->GetPointData()->GetNumberOfArrays(), 1);
  // H = [8 0 2; 0 -2 0; 2 0 0]: eigenvalues 4 +- sqrt(20) and -2
  const double det = (std::sqrt(20.0) + 4.0) * (std::sqrt(20.0) - 4.0) * 2.0;
  const double h = std::cbrt(6.0 * std::sqrt(2.0) * std::sqrt(det) / 5000.0);
  EXPECT_NEAR(filter->GetDesiredSize() / h, 1.0, 1e-4);
  EXPECT_NEAR(filter->GetPredictedNumberOfElements(), 5000.0, 1.0);
  EXPECT_STREQ(output->GetPointData()->GetArray("Metric")->GetComponentName(5), "XZ");
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const Six m = MetricAt(output, p), s = MetricAt(output, p, "SizeTensor");
    EXPECT_NEAR(m[1], 2.0, 1e-9);
    EXPECT_NEAR(m[3], 0.0, 1e-9);
    EXPECT_NEAR(m[4], 0.0, 1e-9);
    // M^2 = H^2 in the plane xz
    EXPECT_NEAR(m[0] * m[0] + m[5] * m[5], 68.0, 1e-8);
    EXPECT_NEAR(m[5] * (m[0] + m[2]), 16.0, 1e-8);
    EXPECT_NEAR(m[2] * m[2] + m[5] * m[5], 4.0, 1e-8);
    EXPECT_TRUE(IsPositive(m));
    EXPECT_TRUE(IsPositive(s));
    EXPECT_NEAR(Determinant(s) * std::sqrt(Determinant(m)) / (h * h * h), 1.0, 1e-3);
    EXPECT_EQ(
      output->GetPointData()->GetArray("DesiredSize")->GetTuple1(p), filter->GetDesiredSize());
  }
}

/**
 * The same mesh in the plane z = 0, in another one parallel to two axes, and in a slanted one:
 * edges have the same lengths in the metric, h* is the same. Also numbered the other way round.
 */
TEST(SolutionMetricFilter, MetricIsTheSameInAnyPlane)
{
  const std::vector<std::function<Point(double, double)>> planes = { Flat,
    [](double u, double v) {
      return Point{ { v, 7.0, u } };
    },
    [](double u, double v) {
      return Point{ { u, v, -3.0 } };
    },
    [](double u, double v) {
      return Point{ { 0.6 * u, v, 0.8 * u + 2.0 } };
    },
    [](double u, double v) {
      return Point{ { 0.6 * u, -v, 0.8 * u } };
    } };
  std::vector<std::vector<double>> lengths;
  std::vector<double> sizes;
  const Grid flat = MakeSquare(8, 0.2, Flat);
  for (const auto& plane : planes)
  {
    SCOPED_TRACE("plane " + std::to_string(sizes.size()));
    Grid grid = MakeSquare(8, 0.2, plane);
    vtkNew<vtkDoubleArray> u;
    u->SetName("u");
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      u->InsertNextValue(Layer(GetPoint(flat, p)));
    }
    grid->GetPointData()->AddArray(u);
    vtkNew<vtkSolutionMetricFilter> filter;
    Compute(filter, grid, [](vtkSolutionMetricFilter* f) { f->SetDesiredNumberOfElements(500); });
    sizes.push_back(filter->GetDesiredSize());
    lengths.emplace_back();
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      const std::vector<vtkIdType> ids = CellPoints(grid, c);
      const Point a = GetPoint(grid, ids[0]), b = GetPoint(grid, ids[1]);
      const Six m = MetricAt(filter->GetOutput(), ids[0]);
      EXPECT_TRUE(IsPositive(m));
      lengths.back().push_back(Squared(m, { { b[0] - a[0], b[1] - a[1], b[2] - a[2] } }));
    }
  }
  for (std::size_t k = 1; k < planes.size(); ++k)
  {
    SCOPED_TRACE("plane " + std::to_string(k));
    EXPECT_NEAR(sizes[k] / sizes[0], 1.0, 1e-6);
    for (std::size_t c = 0; c < lengths[0].size(); ++c)
    {
      EXPECT_NEAR(lengths[k][c] / lengths[0][c], 1.0, 1e-5);
    }
  }
}

/**
 * A field of vectors; by default as many elements as there are, 2 * 16^2.
 */
TEST(SolutionMetricFilter, SizesStayWithinTheLimits)
{
  Grid grid = WithField(MakeSquare(16, 0.2, Flat), Layer, 3, VTK_FLOAT);
  vtkNew<vtkSolutionMetricFilter> filter;
  Compute(filter, grid,
    [](vtkSolutionMetricFilter* f)
    {
      f->SetMinimumSize(0.03);
      f->SetMaximumSize(0.3);
      f->SetMaximumAnisotropy(5.0);
      f->SetGradation(1.4);
    });
  EXPECT_NEAR(filter->GetPredictedNumberOfElements(), 512.0, 2.0);
  const double h2 = filter->GetDesiredSize() * filter->GetDesiredSize();
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const Six m = MetricAt(filter->GetOutput(), p);
    const double mean = 0.5 * (m[0] + m[1]) / h2;
    const double gap = std::hypot(0.5 * (m[0] - m[1]), m[3]) / h2;
    EXPECT_GE(1.0 / std::sqrt(mean + gap), 0.03 * (1 - 1e-9));
    EXPECT_LE(1.0 / std::sqrt(mean - gap), 0.3 * (1 + 1e-9));
    EXPECT_LE(std::sqrt((mean + gap) / (mean - gap)), 5.0 * (1 + 1e-9));
  }
}

TEST(SolutionMetricFilter, ActiveScalarsAreTheDefault)
{
  Grid grid = WithField(MakeSquare(16, 0.2, Flat), Layer, 3, VTK_FLOAT);
  grid->GetPointData()->SetActiveScalars("u");
  vtkNew<vtkSolutionMetricFilter> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_GT(filter->GetDesiredSize(), 0.0);
}

TEST(SolutionMetricFilter, OptionsOutOfRangeAreClamped)
{
  vtkNew<vtkSolutionMetricFilter> other;
  other->SetCriterion(7);
  EXPECT_EQ(other->GetCriterion(), vtkSolutionMetricFilter::ErrorIndicator);
  other->SetDesiredNumberOfElements(-5);
  EXPECT_EQ(other->GetDesiredNumberOfElements(), 0);
  other->SetCountCorrection(0.0);
  EXPECT_EQ(other->GetCountCorrection(), 0.01);
}

/**
 * Even errors on an even mesh: the wanted number, the wanted part of the error. 128 cells.
 */
TEST(SolutionMetricFilter, EvenErrorsGiveEvenSizes)
{
  Grid grid = WithErrors(MakeSquare(8, 0.0, Flat), 0.5);
  vtkNew<vtkSolutionMetricFilter> filter;
  Compute(filter, grid,
    [](vtkSolutionMetricFilter* f)
    {
      f->SetCriterionToErrorIndicator();
      f->SetDesiredNumberOfElements(1000);
    });
  EXPECT_NEAR(filter->GetTotalError(), 0.5 * std::sqrt(128.0), 1e-12);
  EXPECT_EQ(filter->GetDesiredSize(), 0.0);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->GetArray("Metric"));
  vtkDataArray* sizes = filter->GetOutput()->GetPointData()->GetArray("DesiredSize");
  const double h = std::sqrt(4.0 / std::sqrt(3.0) / 1000.0);
  for (vtkIdType p = 0; p < sizes->GetNumberOfTuples(); ++p)
  {
    EXPECT_NEAR(sizes->GetTuple1(p) / h, 1.0, 1e-4);
  }
  filter->SetDesiredErrorFraction(0.25);
  filter->Update();
  EXPECT_NEAR(filter->GetPredictedNumberOfElements(), 16.0 * 128.0, 1e-6);
}

//------------------------------------------------------------------------------
/**
 * ExpectError() of FilterTesting.h, and no leftover results.
 */
void ExpectError(vtkDataObject* input, const Texts& words, const Prepare& prepare = nullptr)
{
  vtkNew<vtkSolutionMetricFilter> filter;
  filter->SetSolutionArray("u");
  filter->SetErrorIndicatorArray("e");
  Testing::ExpectError(filter.Get(), input, words, prepare);
  EXPECT_EQ(filter->GetDesiredSize(), 0.0);
}

TEST(SolutionMetricFilterBadInput, SolutionArrayMustBeChosenAndThere)
{
  ExpectError(MakeBox(2, 0.1), { "solution array 'u'", "not there" });
  ExpectError(MakeBox(2, 0.1), { "No solution array", "active point scalars" },
    [](vtkSolutionMetricFilter* f) { f->SetSolutionArray(nullptr); });
  ExpectError(MakeBox(2, 0.1), { "No solution array is chosen." },
    [](vtkSolutionMetricFilter* f) { f->SetSolutionArray("None"); });
  ExpectError(WithErrors(MakeBox(2, 0.1), 1.0), { "'e' is not there", "cell array of that name" },
    [](vtkSolutionMetricFilter* f) { f->SetSolutionArray("e"); });
}

TEST(SolutionMetricFilterBadInput, SolutionArrayMustBeNumbersOfAllPoints)
{
  Grid grid = MakeBox(2, 0.1);
  vtkNew<vtkStringArray> words;
  words->SetName("u");
  words->SetNumberOfValues(grid->GetNumberOfPoints());
  grid->GetPointData()->AddArray(words);
  ExpectError(grid, { "solution array 'u'", "string" });
  grid = MakeBox(2, 0.1);
  vtkNew<vtkDoubleArray> shorter;
  shorter->SetName("u");
  shorter->SetNumberOfTuples(20);
  grid->GetPointData()->AddArray(shorter);
  ExpectError(grid, { "'u'", "20", "27" });
}

TEST(SolutionMetricFilterBadInput, SolutionMustBeFinite)
{
  Grid grid = WithField(MakeBox(3, 0.1), Layer, 3);
  grid->GetPointData()->GetArray("u")->SetComponent(17, 1, NaN);
  ExpectError(grid, { "point 17", "not finite", "component 1" });
  grid->GetPointData()->GetArray("u")->SetComponent(17, 1, 1.0 / 0.0);
  ExpectError(grid, { "point 17", "not finite" });
}

TEST(SolutionMetricFilterBadInput, ErrorIndicatorMustBeThereAndNotNegative)
{
  const Prepare byErrors = [](vtkSolutionMetricFilter* f) { f->SetCriterionToErrorIndicator(); };
  ExpectError(MakeBox(2, 0.1), { "error indicator array 'e'", "not there" }, byErrors);
  for (const double bad : { NaN, -1.0 })
  {
    SCOPED_TRACE("error " + std::to_string(bad));
    Grid grid = WithErrors(MakeBox(2, 0.1), 1.0);
    grid->GetCellData()->GetArray("e")->SetComponent(11, 0, bad);
    ExpectError(grid, { "cell 11", "not negative" }, byErrors);
  }
}

TEST(SolutionMetricFilterBadInput, CellsMustBeTrianglesOrTetrahedra)
{
  Grid mixed = MakeBox(3, 0.1);
  AddCell(mixed, VTK_HEXAHEDRON, { 0, 1, 5, 4, 16, 17, 21, 20 });
  ExpectError(
    WithField(mixed, Layer), { "Cell 162", "vtkHexahedron", "Tetrahedralize" }); // 6 * 3^3
  Grid quads = MakeGrid({ Flat(0, 0), Flat(1, 0), Flat(1, 1), Flat(0, 1) });
  AddCell(quads, VTK_QUAD, { 0, 1, 2, 3 });
  ExpectError(WithField(quads, Layer), { "Cell 0", "vtkQuad" });
  Grid lines = MakeGrid({ Flat(0, 0), Flat(1, 0) });
  AddCell(lines, VTK_LINE, { 0, 1 });
  ExpectError(WithField(lines, Layer), { "neither triangles nor tetrahedra" });
}

TEST(SolutionMetricFilterBadInput, TrianglesMustBeInOnePlane)
{
  Grid curved = MakeSquare(4, 0.1, [](double u, double v) { return Point{ { u, v, u * u } }; });
  ExpectError(WithField(curved, Layer), { "not in one plane", "point" });
}

TEST(SolutionMetricFilterBadInput, MeshMustHaveInteriorPointsAndEachCellOnce)
{
  ExpectError(WithField(MakeBox(1, 0.0), Layer), { "Point 0", "interior" });
  Grid twice = WithField(MakeBox(2, 0.0), Layer);
  AddCell(twice, VTK_TETRA, CellPoints(twice, 3));
  ExpectError(twice, { "same points" });
}

TEST(SolutionMetricFilterBadInput, Options)
{
  const Grid good = WithField(MakeBox(3, 0.1), Layer);
  ExpectError(good, { "minimum size 2", "maximum size 1" },
    [](vtkSolutionMetricFilter* f)
    {
      f->SetMinimumSize(2.0);
      f->SetMaximumSize(1.0);
    });
  ExpectError(
    good, { "anisotropy" }, [](vtkSolutionMetricFilter* f) { f->SetMaximumAnisotropy(0.5); });
  ExpectError(good, { "gradation" }, [](vtkSolutionMetricFilter* f) { f->SetGradation(1.0); });
}

//------------------------------------------------------------------------------
// No error

TEST(SolutionMetricFilter, EmptyGridPasses)
{
  vtkNew<vtkSolutionMetricFilter> filter;
  Compute(filter, Grid::New());
}

/**
 * The metric is the identity then, in single precision, too.
 */
TEST(SolutionMetricFilter, LinearSolutionIsAWarning)
{
  for (const int type : { VTK_DOUBLE, VTK_FLOAT })
  {
    SCOPED_TRACE(type == VTK_FLOAT ? "float" : "double");
    vtkNew<vtkSolutionMetricFilter> filter;
    Messages messages(filter);
    filter->SetSolutionArray("u");
    filter->SetInputData(WithField(
      MakeBox(3, 0.1), [](const Point& x) { return 3.0 * x[0]; }, 1, type));
    filter->Update();
    EXPECT_EQ(messages.Errors, NoMessages);
    EXPECT_EQ(messages.Warnings.size(), 1u);
    EXPECT_NEAR(MetricAt(filter->GetOutput(), 5)[0], 1.0, 1e-12);
  }
}

/**
 * Faces of tetrahedra as cells, vertices, and points that no cell uses. 6 * 3^3 tetrahedra.
 */
Grid MakeMixed()
{
  Grid grid = MakeBox(3, 0.1);
  AddCell(grid, VTK_TRIANGLE, { 0, 1, 5 });
  AddCell(grid, VTK_VERTEX, { 3 });
  grid->GetPoints()->InsertNextPoint(NaN, 0, 0);
  return WithField(grid, Layer);
}

TEST(SolutionMetricFilter, OtherCellsPassThrough)
{
  vtkNew<vtkSolutionMetricFilter> filter;
  Compute(filter, MakeMixed());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 6 * 27 + 2);
  EXPECT_TRUE(IsPositive(MetricAt(filter->GetOutput(), 5)));
}

TEST(SolutionMetricFilter, NumberThatTheLimitsForbidIsAWarning)
{
  vtkNew<vtkSolutionMetricFilter> filter;
  Messages messages(filter);
  filter->SetSolutionArray("u");
  filter->SetInputData(MakeMixed());
  filter->SetMaximumSize(0.1);
  filter->SetDesiredNumberOfElements(10);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings.size(), 1u);
  EXPECT_GT(filter->GetPredictedNumberOfElements(), 8000.0); // 6 * sqrt(2) / 0.1^3 is 8485
  EXPECT_GT(filter->GetDesiredSize(), 0.0);
}

/**
 * Blocks, each by itself; and what comes out is what vtkMeshOptimizeFilter takes.
 */
TEST(SolutionMetricFilter, BlocksGoOnToMeshOptimize)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, WithField(MakeBox(3, 0.1), Layer));
  blocks->SetBlock(1, WithField(MakeSquare(6, 0.1, Flat), Layer));
  vtkNew<vtkSolutionMetricFilter> metric;
  metric->SetSolutionArray("u");
  metric->SetMaximumAnisotropy(4.0);
  metric->SetInputDataObject(blocks);
  vtkNew<vtkMeshOptimizeFilter> optimize;
  Messages first(metric), second(optimize);
  optimize->SetInputConnection(metric->GetOutputPort());
  optimize->SetMetricArray("Metric");
  optimize->SetSizeArray("DesiredSize");
  optimize->SetBeta(0.5);
  optimize->MoveNodesOff(); // measured only: what it reaches is for the tests of the engine
  optimize->ReconnectOff();
  optimize->InsertNodesOff();
  optimize->RemoveNodesOff();
  optimize->Update();
  EXPECT_EQ(first.Errors, NoMessages);
  EXPECT_EQ(second.Errors, NoMessages);
  auto output = vtkMultiBlockDataSet::SafeDownCast(optimize->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  for (int b = 0; b < 2; ++b)
  {
    SCOPED_TRACE("block " + std::to_string(b));
    auto grid = vtkUnstructuredGrid::SafeDownCast(output->GetBlock(b));
    ASSERT_TRUE(grid);
    EXPECT_GT(grid->GetNumberOfCells(), 0);
    EXPECT_TRUE(grid->GetPointData()->GetArray("Metric"));
  }
  EXPECT_GT(optimize->GetWorstQualityAfter(), 0.0);
}

} // namespace
