// SPDX-License-Identifier: BSD-3-Clause
// The bare pass over a grid.
#ifndef meshopt_Testing_BarePassOfGrid_h
#define meshopt_Testing_BarePassOfGrid_h

#include "BarePass.h"

#include "vtkUnstructuredGrid.h"

/**
 * Copies coordinates and ids of a grid of tetrahedra, which is not counted, and measures.
 */
inline BarePass MeasureBarePass(vtkUnstructuredGrid* grid, int repeats)
{
  std::vector<double> x(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    grid->GetPoint(p, x.data() + 3 * p);
  }
  std::vector<std::int64_t> ids(4 * static_cast<std::size_t>(grid->GetNumberOfCells()));
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    vtkIdType size = 0;
    const vtkIdType* nodes = nullptr;
    grid->GetCellPoints(c, size, nodes);
    std::copy(nodes, nodes + 4, ids.begin() + 4 * c);
  }
  return measureBarePass(x, ids, repeats);
}

#endif
