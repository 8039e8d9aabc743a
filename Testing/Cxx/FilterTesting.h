// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of all filters share: meshes, a counter of messages, comparisons.
 */
#ifndef FilterTesting_h
#define FilterTesting_h

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Testing
{

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Point = std::array<double, 3>;

/**
 * The same numbers on every machine, in [-1, 1].
 */
class Random
{
public:
  double operator()()
  {
    this->State = this->State * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(this->State >> 11) / static_cast<double>(1ULL << 52) - 1.0;
  }

private:
  std::uint64_t State = 42;
};

inline Grid MakeGrid(const std::vector<Point>& points, int precision = VTK_DOUBLE)
{
  Grid grid = Grid::New();
  vtkNew<vtkPoints> p;
  p->SetDataType(precision);
  for (const Point& x : points)
  {
    p->InsertNextPoint(x.data());
  }
  grid->SetPoints(p);
  grid->Allocate(100);
  return grid;
}

inline void AddCell(vtkUnstructuredGrid* grid, int type, const std::vector<vtkIdType>& ids)
{
  grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
}

/**
 * The unit cube as n x n x n small ones of six tetrahedra each; its inner points are displaced by
 * up to `jitter` small edges, which inverts some cells if it is greater than about 0.3.
 */
inline Grid MakeBox(int n, double jitter, int precision = VTK_DOUBLE)
{
  std::vector<Point> points;
  Random random;
  const auto inner = [n](int i) { return i > 0 && i < n; };
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        Point x{ { double(i) / n, double(j) / n, double(k) / n } };
        for (double& coordinate : x)
        {
          coordinate += inner(i) && inner(j) && inner(k) ? jitter / n * random() : 0.0;
        }
        points.push_back(x);
      }
    }
  }
  Grid grid = MakeGrid(points, precision);
  static const int paths[6][2] = { { 1, 2 }, { 2, 4 }, { 4, 1 }, { 2, 1 }, { 4, 2 }, { 1, 4 } };
  for (int c = 0; c < n * n * n; ++c)
  {
    const auto corner = [&](int bits) -> vtkIdType
    {
      return (c % n + (bits & 1)) +
        (n + 1) * ((c / n % n + ((bits >> 1) & 1)) + (n + 1) * (c / n / n + (bits >> 2)));
    };
    for (int t = 0; t < 6; ++t)
    {
      const int a = paths[t][0], b = a | paths[t][1];
      // The first three paths turn one way round the diagonal, the others the other way.
      AddCell(grid, VTK_TETRA,
        t < 3 ? std::vector<vtkIdType>{ corner(0), corner(a), corner(b), corner(7) }
              : std::vector<vtkIdType>{ corner(0), corner(b), corner(a), corner(7) });
    }
  }
  return grid;
}

/**
 * The unit square as n x n small ones of two triangles each, jittered, mapped into space.
 */
inline Grid MakeSquare(
  int n, double jitter, const std::function<Point(double, double)>& map, int precision = VTK_DOUBLE)
{
  std::vector<Point> points;
  Random random;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double dx = inner ? jitter / n * random() : 0.0,
                   dy = inner ? jitter / n * random() : 0.0;
      points.push_back(map(double(i) / n + dx, double(j) / n + dy));
    }
  }
  Grid grid = MakeGrid(points, precision);
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const vtkIdType a = i + (n + 1) * j, b = a + 1, c = a + n + 2, d = a + n + 1;
      AddCell(grid, VTK_TRIANGLE, { a, b, c });
      AddCell(grid, VTK_TRIANGLE, { a, c, d });
    }
  }
  return grid;
}

inline std::vector<vtkIdType> CellPoints(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  return std::vector<vtkIdType>(ids->begin(), ids->end());
}

inline Point GetPoint(vtkUnstructuredGrid* grid, vtkIdType p)
{
  Point x;
  grid->GetPoint(p, x.data());
  return x;
}

inline double SignedVolume(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  const std::vector<vtkIdType> ids = CellPoints(grid, cell);
  double e[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      e[i][k] = GetPoint(grid, ids[i + 1])[k] - GetPoint(grid, ids[0])[k];
    }
  }
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
    6.0;
}

/**
 * Facets that one simplex alone has, or two of different regions: as sorted exact coordinates.
 */
inline std::set<std::vector<Point>> KeptFacets(
  vtkUnstructuredGrid* grid, const char* region = nullptr)
{
  struct Sides
  {
    int Count = 0;
    bool IsInterface = false;
    double Region = 0.0;
  };
  std::map<std::vector<Point>, Sides> facets;
  vtkDataArray* regions = region ? grid->GetCellData()->GetArray(region) : nullptr;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type != VTK_TETRA && type != VTK_TRIANGLE)
    {
      continue;
    }
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    for (std::size_t leftOut = 0; leftOut < ids.size(); ++leftOut)
    {
      std::vector<Point> facet;
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        if (i != leftOut)
        {
          facet.push_back(GetPoint(grid, ids[i]));
        }
      }
      std::sort(facet.begin(), facet.end());
      Sides& sides = facets[facet];
      const double value = regions ? regions->GetComponent(c, 0) : 0.0;
      sides.IsInterface = sides.Count > 0 && value != sides.Region;
      sides.Region = value;
      ++sides.Count;
    }
  }
  std::set<std::vector<Point>> kept;
  for (const auto& facet : facets)
  {
    if (facet.second.Count == 1 || facet.second.IsInterface)
    {
      kept.insert(facet.first);
    }
  }
  return kept;
}

/**
 * The facets of KeptFacets() that only one of two grids has: none?
 */
inline testing::AssertionResult SameFacets(
  const std::set<std::vector<Point>>& before, const std::set<std::vector<Point>>& after)
{
  std::vector<std::vector<Point>> lost, added;
  std::set_difference(
    before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(lost));
  std::set_difference(
    after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(added));
  if (lost.empty() && added.empty())
  {
    return testing::AssertionSuccess() << "the same " << before.size() << " facets";
  }
  return testing::AssertionFailure()
    << "of " << before.size() << " facets " << lost.size() << " are lost, " << added.size()
    << " are new; one of them: "
    << testing::PrintToString(lost.empty() ? added.front() : lost.front());
}

/**
 * The same bits in both arrays (NaN included), and the same type, name and shape?
 */
inline testing::AssertionResult SameArray(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b)
  {
    return testing::AssertionFailure() << "there is no " << (a ? "second" : "first") << " array";
  }
  const std::string name = a->GetName() ? a->GetName() : "";
  if (name != (b->GetName() ? b->GetName() : ""))
  {
    return testing::AssertionFailure() << "'" << name << "' is not '" << b->GetName() << "'";
  }
  if (a->GetDataType() != b->GetDataType() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
    a->GetNumberOfTuples() != b->GetNumberOfTuples())
  {
    return testing::AssertionFailure() << "array '" << name << "' has another type or shape";
  }
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    const vtkVariant x = a->GetVariantValue(i), y = b->GetVariantValue(i);
    const double numberX = x.IsNumeric() ? x.ToDouble() : 0.0;
    const double numberY = y.IsNumeric() ? y.ToDouble() : 0.0;
    if (std::memcmp(&numberX, &numberY, sizeof(double)) != 0 ||
      (!x.IsNumeric() && x.ToString() != y.ToString()))
    {
      return testing::AssertionFailure() << "value " << i << " of array '" << name << "' is "
                                         << x.ToString() << ", and " << y.ToString();
    }
  }
  return testing::AssertionSuccess() << "array '" << name << "' is the same";
}

inline testing::AssertionResult SameArrays(vtkFieldData* a, vtkFieldData* b)
{
  if (a->GetNumberOfArrays() != b->GetNumberOfArrays())
  {
    return testing::AssertionFailure()
      << a->GetNumberOfArrays() << " arrays, and " << b->GetNumberOfArrays();
  }
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    const auto same = SameArray(a->GetAbstractArray(i), b->GetAbstractArray(i));
    if (!same)
    {
      return same;
    }
  }
  return testing::AssertionSuccess() << "all arrays are the same";
}

inline testing::AssertionResult SameCells(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  if (a->GetNumberOfCells() != b->GetNumberOfCells() ||
    a->GetNumberOfPoints() != b->GetNumberOfPoints())
  {
    return testing::AssertionFailure()
      << a->GetNumberOfCells() << " cells and " << a->GetNumberOfPoints() << " points; "
      << b->GetNumberOfCells() << " cells and " << b->GetNumberOfPoints() << " points";
  }
  for (vtkIdType c = 0; c < a->GetNumberOfCells(); ++c)
  {
    if (a->GetCellType(c) != b->GetCellType(c) || CellPoints(a, c) != CellPoints(b, c))
    {
      return testing::AssertionFailure() << "cell " << c << " differs";
    }
  }
  return testing::AssertionSuccess() << "the cells are the same";
}

/**
 * The same cells, the same bits in all points and arrays?
 */
inline testing::AssertionResult SameGrid(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  auto same = SameCells(a, b);
  if (same && a->GetPoints())
  {
    same = SameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData());
  }
  for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
  {
    if (same)
    {
      same = SameArrays(a->GetAttributesAsFieldData(type), b->GetAttributesAsFieldData(type));
    }
  }
  return same;
}

using Texts = std::vector<std::string>;
inline const Texts NoMessages;

/**
 * Collects the errors and warnings of a filter and of its executive, which are then not printed.
 */
class Messages
{
public:
  explicit Messages(vtkAlgorithm* filter)
  {
    this->Watch(filter);
    this->Watch(filter->GetExecutive());
  }
  ~Messages()
  {
    for (const auto& watch : this->Watches)
    {
      watch.first->RemoveObserver(watch.second);
    }
  }
  Messages(const Messages&) = delete;
  void operator=(const Messages&) = delete;
  Texts Errors, Warnings;

private:
  void Watch(vtkObject* object)
  {
    for (const auto event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
    {
      vtkNew<vtkCallbackCommand> observer;
      observer->SetClientData(this);
      observer->SetCallback(
        [](vtkObject*, unsigned long which, void* self, void* text)
        {
          auto mine = static_cast<Messages*>(self);
          (which == vtkCommand::ErrorEvent ? mine->Errors : mine->Warnings)
            .emplace_back(static_cast<const char*>(text));
        });
      this->Watches.emplace_back(object, object->AddObserver(event, observer));
    }
  }
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> Watches;
};

/**
 * Is `part` in the text?
 */
inline testing::AssertionResult Says(const std::string& text, const std::string& part)
{
  return (text.find(part) != std::string::npos ? testing::AssertionSuccess()
                                               : testing::AssertionFailure())
    << "looked for '" << part << "' in: " << text;
}

/**
 * Gives a filter an input, prepares and updates it. It must report exactly one error, with all of
 * `words` in it, no warning and an error code; the first output must be empty.
 */
template <class Filter>
void ExpectError(Filter* filter, vtkDataObject* input, const Texts& words,
  const std::function<void(Filter*)>& prepare)
{
  SCOPED_TRACE("an error that says " + testing::PrintToString(words));
  Messages messages(filter);
  filter->SetInputDataObject(input);
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  EXPECT_EQ(messages.Errors.size(), 1u);
  EXPECT_EQ(messages.Warnings, NoMessages);
  for (const std::string& error : messages.Errors)
  {
    const std::size_t place = error.find("): ");
    std::cout << error.substr(place == std::string::npos ? 0 : place + 3) << std::flush;
    for (const std::string& word : words)
    {
      EXPECT_TRUE(Says(error, word));
    }
  }
  EXPECT_NE(filter->GetErrorCode(), 0u);
  vtkDataObject* output = filter->GetOutputDataObject(0);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::CELL), 0);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::POINT), 0);
}

inline double MinimumOf(vtkDataArray* array)
{
  double least = std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    least = std::min(least, array->GetComponent(i, 0)); // NaN never wins
  }
  return least;
}

} // namespace Testing

#endif
