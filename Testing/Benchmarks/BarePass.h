// SPDX-License-Identifier: BSD-3-Clause
// The unit of the benchmarks: one bare pass over a grid of tetrahedra, on one thread.
#ifndef meshopt_Testing_BarePass_h
#define meshopt_Testing_BarePass_h

#include "Quality/Shape.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <vector>

struct BarePass
{
  double Seconds = std::numeric_limits<double>::infinity(); ///< processor time, the best of several
  double Minimum = std::numeric_limits<double>::infinity(); ///< worst S
};

/**
 * Loads the four corners of each cell, computes S and stores it, `repeats` times. The grid must
 * hold tetrahedra only. What is not stored as double coordinates and 64-bit ids is copied so first;
 * that is not counted.
 */
inline BarePass MeasureBarePass(vtkUnstructuredGrid* grid, int repeats)
{
  const std::size_t n = static_cast<std::size_t>(grid->GetNumberOfCells());
  std::vector<double> x(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    grid->GetPoint(p, x.data() + 3 * p);
  }
  std::vector<vtkIdType> ids(4 * n);
  for (std::size_t c = 0; c < n; ++c)
  {
    vtkIdType size = 0;
    const vtkIdType* nodes = nullptr;
    grid->GetCellPoints(static_cast<vtkIdType>(c), size, nodes);
    std::copy(nodes, nodes + 4, ids.begin() + 4 * c);
  }
  std::vector<double> values(n);
  BarePass pass;
  for (int k = 0; k < repeats; ++k)
  {
    const std::clock_t start = std::clock();
    for (std::size_t c = 0; c < n; ++c)
    {
      meshopt::Corners<3> corners;
      for (int i = 0; i < 4; ++i)
      {
        const double* p = x.data() + 3 * ids[4 * c + i];
        corners[i] = meshopt::Vec<3>(p[0], p[1], p[2]);
      }
      values[c] = meshopt::MeanEdgeShape<3>::value(corners);
    }
    pass.Seconds = std::min(pass.Seconds, double(std::clock() - start) / CLOCKS_PER_SEC);
    pass.Minimum = *std::min_element(values.begin(), values.end());
  }
  return pass;
}

#endif
