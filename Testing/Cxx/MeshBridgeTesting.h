// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of the bridge between grid and core share: grids with all that may come along with
 * them, and what vtkMeshOptimizeFilter and vtkMeshQualityMinMax say about them.
 */
#ifndef MeshBridgeTesting_h
#define MeshBridgeTesting_h

#include "MeshOptimizeFilterTesting.h"

#include "vtkDataSetAttributes.h"
#include "vtkIntArray.h"
#include "vtkMeshQualityMinMax.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

namespace Testing
{

/// Maps of the unit square into space, and where they lead.
struct Plane
{
  std::string Name;
  std::function<Point(double, double)> Map;
};

inline const std::vector<Plane> Planes = {
  { "ZIs3",
    [](double u, double v) -> Point {
      return { { u, v, 3.0 } };
    } },
  { "YIs0",
    [](double u, double v) -> Point {
      return { { v, 0.0, u } };
    } },
  { "XIsMinus1",
    [](double u, double v) -> Point {
      return { { -1.0, u, v } };
    } },
  { "Tilted",
    [](double u, double v) -> Point {
      return { { 5.0 + 0.8 * u - 0.36 * v, 0.6 * u + 0.48 * v, 0.8 * v - 2.0 } };
    } },
  { "Clockwise",
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

inline void AddSizes(vtkUnstructuredGrid* grid)
{
  auto sizes = NewArray<vtkDoubleArray>("size", 1, grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    sizes->SetValue(p, 0.2 + 0.1 * GetPoint(grid, p)[0] * GetPoint(grid, p)[0]);
  }
  grid->GetPointData()->AddArray(sizes);
}

/// A metric that varies. Of its 9 components two that should be equal differ by `skew` (relative).
inline void AddMetric(vtkUnstructuredGrid* grid, int components, double skew = 0.0)
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
inline void AddRegions(vtkUnstructuredGrid* grid, std::initializer_list<long long> values)
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
inline void AddGhosts(vtkUnstructuredGrid* grid, unsigned char flag, vtkIdType period)
{
  auto ghosts = NewArray<vtkUnsignedCharArray>(
    vtkDataSetAttributes::GhostArrayName(), 1, grid->GetNumberOfCells());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    ghosts->SetValue(c, (grid->GetNumberOfCells() - 1 - c) % period == 0 ? flag : 0);
  }
  grid->GetCellData()->AddArray(ghosts);
}

//------------------------------------------------------------------------------
// What a filter says

struct Answer
{
  Texts Errors, Warnings;
  std::vector<double> Quality;
  double Minimum = 0.0, Mean = 0.0, Bound = 0.0;
  vtkIdType Measured = 0, Inverted = 0;
};

template <class Filter>
inline void Choose(vtkUnstructuredGrid* grid, double beta, Filter* filter)
{
  filter->SetInputData(grid);
  filter->SetBeta(beta);
  filter->SetDesiredSize(beta > 0.0 ? 0.3 : 0.0);
  filter->SetSizeArray(grid->GetPointData()->HasArray("size") ? "size" : nullptr);
  filter->SetMetricArray(grid->GetPointData()->HasArray("metric") ? "metric" : nullptr);
  filter->SetRegionArray(grid->GetCellData()->HasArray("region") ? "region" : nullptr);
}

inline void Take(vtkAlgorithm* filter, const Messages& messages, Answer& answer)
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
inline Answer AskOptimize(vtkUnstructuredGrid* grid, double beta)
{
  vtkNew<vtkMeshOptimizeFilter> filter;
  Messages messages(filter);
  Choose(grid, beta, filter.Get());
  ChangeNothing(filter);
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

inline Answer AskMinMax(vtkUnstructuredGrid* grid, double beta)
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

/// Both near each other, or both not a number.
inline testing::AssertionResult IsNear(double a, double b, double tolerance = 1e-12)
{
  const bool isNear = std::abs(a - b) <= tolerance || (std::isnan(a) && std::isnan(b));
  return (isNear ? testing::AssertionSuccess() : testing::AssertionFailure())
    << testing::PrintToString(a) << " and " << testing::PrintToString(b) << " differ by " << a - b;
}

/// All is linear and of one dimension: everything must be the same.
inline void Compare(const std::string& title, vtkUnstructuredGrid* grid, double beta = 0.0)
{
  SCOPED_TRACE(title);
  const Answer optimize = AskOptimize(grid, beta), minMax = AskMinMax(grid, beta);
  EXPECT_EQ(optimize.Errors, NoMessages);
  EXPECT_EQ(minMax.Errors, NoMessages);
  ASSERT_EQ(optimize.Quality.size(), minMax.Quality.size());
  for (std::size_t c = 0; c < optimize.Quality.size(); ++c)
  {
    EXPECT_TRUE(IsNear(optimize.Quality[c], minMax.Quality[c])) << "cell " << c;
  }
  EXPECT_TRUE(IsNear(optimize.Minimum, minMax.Minimum));
  EXPECT_TRUE(IsNear(optimize.Mean, minMax.Mean));
  // Mesh Optimize knows no bound where sizes vary (1). Caps of edges are found to 1e-7.
  const bool isUnknown = beta > 0.0 && grid->GetPointData()->HasArray("size");
  EXPECT_TRUE(IsNear(optimize.Bound, isUnknown ? 1.0 : minMax.Bound, 1e-6));
  EXPECT_EQ(optimize.Measured, minMax.Measured);
  EXPECT_EQ(optimize.Inverted, minMax.Inverted);
}

inline Grid MakeTetrahedra() { return MakeBox(3, 0.4); }

} // namespace Testing

#endif
