// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of vtkTetGenFilter share: surfaces.
 */
#ifndef TetGenFilterTesting_h
#define TetGenFilterTesting_h

#include "FilterTesting.h"

#include "vtkPolyData.h"
#include "vtkTetGenFilter.h"

namespace Testing
{

using Surface = vtkSmartPointer<vtkPolyData>;

inline Surface MakeSurface(const std::vector<Point>& points,
  const std::vector<std::vector<vtkIdType>>& cells, int precision = VTK_DOUBLE)
{
  Surface surface = Surface::New();
  vtkNew<vtkPoints> p;
  p->SetDataType(precision);
  for (const Point& x : points)
  {
    p->InsertNextPoint(x.data());
  }
  vtkNew<vtkCellArray> polygons;
  for (const auto& cell : cells)
  {
    polygons->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  surface->SetPoints(p);
  surface->SetPolys(polygons);
  return surface;
}

struct Soup
{
  std::vector<Point> Points;
  std::vector<std::vector<vtkIdType>> Cells;

  /**
   * Adds the surface of a box of n x n x n small ones, two triangles (or one square) to each small
   * face. A point that is there already is used again.
   */
  Soup& AddBox(const Point& from, const Point& to, int n, bool squares = false)
  {
    for (int side = 0; side < 6; ++side)
    {
      const int axis = side % 3;
      for (int c = 0; c < n * n; ++c)
      {
        const auto corner = [&](int u, int v)
        {
          int index[3];
          index[axis] = side < 3 ? 0 : n;
          index[(axis + 1) % 3] = c % n + u;
          index[(axis + 2) % 3] = c / n + v;
          Point x;
          for (int i = 0; i < 3; ++i)
          {
            x[i] = from[i] + (to[i] - from[i]) * index[i] / n;
          }
          return this->Find(x);
        };
        this->AddSquare(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1), squares);
      }
    }
    return *this;
  }

  vtkIdType Find(const Point& x)
  {
    const auto known = this->Ids.emplace(x, static_cast<vtkIdType>(this->Points.size()));
    if (known.second)
    {
      this->Points.push_back(x);
    }
    return known.first->second;
  }

  Surface Make(int precision = VTK_DOUBLE) const
  {
    return MakeSurface(this->Points, this->Cells, precision);
  }

private:
  void AddSquare(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d, bool square)
  {
    const auto add = [&](std::vector<vtkIdType> cell)
    {
      std::vector<vtkIdType> sorted = cell;
      std::sort(sorted.begin(), sorted.end());
      if (this->Known.insert(sorted).second) // a wall between two boxes stands once
      {
        this->Cells.push_back(cell);
      }
    };
    if (square)
    {
      add({ a, b, c, d });
      return;
    }
    add({ a, b, c });
    add({ a, c, d });
  }
  std::map<Point, vtkIdType> Ids;
  std::set<std::vector<vtkIdType>> Known;
};

inline Surface MakeBoxSurface(int n, int precision = VTK_DOUBLE)
{
  return Soup().AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, n).Make(precision);
}

/**
 * The triangles of a surface as sorted exact coordinates, to be compared with KeptFacets().
 */
inline std::set<std::vector<Point>> SurfaceFacets(vtkPolyData* surface)
{
  std::set<std::vector<Point>> facets;
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    surface->GetPolys()->GetCellAtId(i, size, ids);
    std::vector<Point> facet;
    for (vtkIdType k = 0; k < size; ++k)
    {
      Point x;
      surface->GetPoint(ids[k], x.data());
      facet.push_back(x);
    }
    std::sort(facet.begin(), facet.end());
    facets.insert(facet);
  }
  return facets;
}

using Prepare = std::function<void(vtkTetGenFilter*)>;

/**
 * The mesh, and that there was no message but this many warnings.
 */
inline Grid Fill(vtkPolyData* surface, const Prepare& prepare = nullptr, std::size_t warnings = 0)
{
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(surface);
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings.size(), warnings);
  EXPECT_EQ(filter->GetErrorCode(), 0);
  Grid grid = Grid::New();
  grid->DeepCopy(filter->GetOutput());
  return grid;
}

/**
 * Volume of all cells, or of those of one region. Each must be a tetrahedron, none inverted.
 */
inline double VolumeOf(vtkUnstructuredGrid* grid, const int* region = nullptr)
{
  vtkDataArray* regions = grid->GetCellData()->GetArray("Region");
  EXPECT_NE(regions, nullptr);
  EXPECT_EQ(regions->GetDataType(), VTK_INT);
  double volume = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    EXPECT_EQ(grid->GetCellType(c), VTK_TETRA);
    const double one = SignedVolume(grid, c);
    EXPECT_GT(one, -1e-15); // as generated, tetrahedra can be flat to rounding
    volume += !region || regions->GetComponent(c, 0) == *region ? one : 0.0;
  }
  return volume;
}

} // namespace Testing

#endif
