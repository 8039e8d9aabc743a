// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of boundaries of triangles that slide share.
 */
#ifndef BoundaryTesting_h
#define BoundaryTesting_h

#include "MeshOptimizeFilterTesting.h"

namespace Testing
{

const double Pi = std::acos(-1.0);

/**
 * Boundaries slide with this algorithm only.
 */
class WorstFirst : public OptimizeFilter
{
public:
  WorstFirst()
    : OptimizeFilter(vtkMeshOptimizeFilter::WorstFirst)
  {
  }
};

/**
 * How many equilateral triangles with edges of `size` fill an area.
 */
inline double TrianglesIn(double area, double size)
{
  return 4.0 / std::sqrt(3.0) * area / size / size;
}

inline Point Flat(double u, double v) { return { { u, v, 0 } }; }

/**
 * A disc of n triangles around its centre, radius 1, put into space by `map`.
 */
inline Grid MakeDisc(int n, const std::function<Point(double, double)>& map = Flat)
{
  std::vector<Point> points;
  for (int k = 0; k < n; ++k)
  {
    points.push_back(map(std::cos(2 * Pi * k / n), std::sin(2 * Pi * k / n)));
  }
  points.push_back(map(0, 0));
  Grid grid = MakeGrid(points);
  for (int k = 0; k < n; ++k)
  {
    AddCell(grid, VTK_TRIANGLE, { k, (k + 1) % n, n });
  }
  return grid;
}

inline void Slide(vtkMeshOptimizeFilter* filter, double size)
{
  filter->SetBoundaryModeToSlide();
  filter->SetDesiredSize(size);
}

/**
 * Points at the end of an edge that only one triangle has.
 */
inline std::set<vtkIdType> BoundaryPoints(vtkUnstructuredGrid* grid)
{
  std::map<std::set<vtkIdType>, int> edges;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    for (int i = 0; i < 3 && grid->GetCellType(c) == VTK_TRIANGLE; ++i)
    {
      ++edges[{ ids[i], ids[(i + 1) % 3] }];
    }
  }
  std::set<vtkIdType> points;
  for (const auto& edge : edges)
  {
    if (edge.second == 1)
    {
      points.insert(edge.first.begin(), edge.first.end());
    }
  }
  return points;
}

inline double Norm(const Point& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

inline double OutOfRound(vtkUnstructuredGrid* grid)
{
  double worst = 0.0;
  for (vtkIdType p : BoundaryPoints(grid))
  {
    worst = std::max(worst, std::abs(Norm(GetPoint(grid, p)) - 1.0));
  }
  return worst;
}

} // namespace Testing

#endif
