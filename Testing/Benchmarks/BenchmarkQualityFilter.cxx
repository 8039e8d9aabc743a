// SPDX-License-Identifier: BSD-3-Clause
// How much vtkMeshQualityMinMax costs on top of the arithmetic: seconds of a whole update divided
// by those of one bare pass (load the corners, S of each tetrahedron, store it) over the same grid
// in the same run, on one thread.
//
//   BenchmarkQualityFilter [millions of tetrahedra] [greatest ratio allowed]
//
// Prints the ratios with and without the bound; fails if one is above the limit (default 5).
#include "vtkMeshQualityMinMax.h"

#include "BarePassOfGrid.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <random>

namespace
{

/// Processor time: a wall clock would count what else the machine does.
double Now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/**
 * A cube of n^3 cells, six tetrahedra each, nodes moved at random by up to a fifth of the spacing.
 */
void MakeCube(int n, vtkUnstructuredGrid* grid)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        points->InsertNextPoint(i + shift(random), j + shift(random), k + shift(random));
      }
    }
  }
  const auto id = [n](int i, int j, int k)
  { return vtkIdType(i) + (n + 1) * (j + vtkIdType(n + 1) * k); };
  const int paths[6][2] = { { 1, 3 }, { 1, 5 }, { 2, 3 }, { 2, 6 }, { 4, 5 }, { 4, 6 } };
  vtkNew<vtkTypeInt64Array> ids;
  ids->SetNumberOfValues(vtkIdType(n) * n * n * 24);
  vtkIdType at = 0;
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const auto corner = [&](int c)
        { return id(i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1)); };
        for (int p = 0; p < 6; ++p)
        {
          // odd permutations of the axes give the mirrored tetrahedron
          const bool odd = p == 1 || p == 2 || p == 5;
          const vtkIdType tet[4] = { corner(0), corner(paths[p][odd ? 1 : 0]),
            corner(paths[p][odd ? 0 : 1]), corner(7) };
          std::for_each(tet, tet + 4, [&](vtkIdType x) { ids->SetValue(at++, x); });
        }
      }
    }
  }
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(at / 4 + 1);
  for (vtkIdType c = 0; c <= at / 4; ++c)
  {
    offsets->SetValue(c, 4 * c);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, ids);
  grid->SetPoints(points);
  grid->SetCells(10, cells);
}

/**
 * Best of several, since the machine may have other things to do.
 */
template <class F>
double Best(F&& run)
{
  double best = 1e30;
  for (int k = 0; k < 7; ++k)
  {
    const double start = Now();
    run();
    best = std::min(best, Now() - start);
  }
  return best;
}

} // namespace

int main(int argc, char** argv)
{
  const double millions = argc > 1 ? std::atof(argv[1]) : 1.0;
  const double limit = argc > 2 ? std::atof(argv[2]) : 5.0;
  vtkNew<vtkUnstructuredGrid> grid;
  MakeCube(static_cast<int>(std::ceil(std::cbrt(millions * 1e6 / 6.0))), grid);
  const vtkIdType n = grid->GetNumberOfCells();
  const BarePass pass = MeasureBarePass(grid, 7);
  const double bare = pass.Seconds, minimum = pass.Minimum;
  std::cout << n << " tetrahedra; bare pass " << bare * 1e3 << " ms, minimum " << minimum << "\n";
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  bool good = true;
  for (bool bound : { false, true })
  {
    filter->SetComputeBound(bound);
    const double seconds = Best(
      [&]
      {
        filter->Modified();
        filter->Update();
      });
    std::cout << (bound ? "with" : "without") << " bound: " << seconds * 1e3 << " ms, ratio "
              << seconds / bare << ", threads " << vtkSMPTools::GetEstimatedNumberOfThreads()
              << "\n";
    good = good && seconds <= limit * bare && filter->GetMinimumQuality() == minimum;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
