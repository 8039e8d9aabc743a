/**
 * What the tests of vtkMeshOptimizeFilter share: meshes, a counter of messages, comparisons.
 */
#ifndef MeshOptimizeFilterTesting_h
#define MeshOptimizeFilterTesting_h

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
#include "vtkMeshOptimizeFilter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

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

inline int Failures = 0;

#define CHECK(condition)                                                              \
  do                                                                                  \
  {                                                                                   \
    if (!(condition))                                                                 \
    {                                                                                 \
      std::cerr << __FILE__ << ":" << __LINE__ << ": not so: " << #condition << "\n"; \
      ++Testing::Failures;                                                            \
    }                                                                                 \
  } while (false)

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Point = std::array<double, 3>;

/**
 * What the filters of a test run.
 */
inline int Algorithm = vtkMeshOptimizeFilter::WorstFirst;

template <class Tests>
void ForBothAlgorithms(const Tests& tests)
{
  for (const int algorithm :
    { vtkMeshOptimizeFilter::Paper1996, vtkMeshOptimizeFilter::WorstFirst })
  {
    Algorithm = algorithm;
    const int before = Failures;
    tests();
    if (Failures > before)
    {
      std::cerr << Failures - before << " failures with algorithm " << algorithm << "\n";
    }
  }
}

/**
 * A filter that runs it.
 */
class OptimizeFilter : public vtkNew<vtkMeshOptimizeFilter>
{
public:
  OptimizeFilter() { this->Get()->SetAlgorithm(Algorithm); }
};

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
 * The same bits in both arrays (NaN included), and the same type, name and shape?
 */
inline bool SameArray(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b || a->GetDataType() != b->GetDataType() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
    a->GetNumberOfTuples() != b->GetNumberOfTuples() ||
    std::string(a->GetName() ? a->GetName() : "") != (b->GetName() ? b->GetName() : ""))
  {
    return false;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    const vtkVariant x = a->GetVariantValue(i), y = b->GetVariantValue(i);
    const double numberX = x.IsNumeric() ? x.ToDouble() : 0.0;
    const double numberY = y.IsNumeric() ? y.ToDouble() : 0.0;
    if (std::memcmp(&numberX, &numberY, sizeof(double)) != 0 ||
      (!x.IsNumeric() && x.ToString() != y.ToString()))
    {
      return false;
    }
  }
  return true;
}

inline bool SameArrays(vtkFieldData* a, vtkFieldData* b)
{
  bool same = a->GetNumberOfArrays() == b->GetNumberOfArrays();
  for (int i = 0; same && i < a->GetNumberOfArrays(); ++i)
  {
    same = SameArray(a->GetAbstractArray(i), b->GetAbstractArray(i));
  }
  return same;
}

inline bool SameGrid(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  bool same = a->GetNumberOfCells() == b->GetNumberOfCells() &&
    a->GetNumberOfPoints() == b->GetNumberOfPoints();
  for (vtkIdType c = 0; same && c < a->GetNumberOfCells(); ++c)
  {
    same = a->GetCellType(c) == b->GetCellType(c) && CellPoints(a, c) == CellPoints(b, c);
  }
  return same &&
    (!a->GetPoints() || SameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData())) &&
    SameArrays(a->GetPointData(), b->GetPointData()) &&
    SameArrays(a->GetCellData(), b->GetCellData()) &&
    SameArrays(a->GetFieldData(), b->GetFieldData());
}

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
  std::vector<std::string> Errors, Warnings;

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
