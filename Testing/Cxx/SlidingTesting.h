// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of a surface of tetrahedra that slides share.
 */
#ifndef SlidingTesting_h
#define SlidingTesting_h

#include "MeshOptimizeFilterTesting.h"

namespace Testing
{

class Sliding : public OptimizeFilter
{
public:
  explicit Sliding(double tolerance)
    : OptimizeFilter(vtkMeshOptimizeFilter::WorstFirst)
  {
    (*this)->SetBoundaryModeToSlide();
    (*this)->SetSurfaceTolerance(tolerance);
  }
};

/**
 * A box whose points are displaced inside, in its faces and along its edges.
 */
inline Grid MakeBadBox(int n, double jitter)
{
  Grid grid = MakeBox(n, jitter);
  Random random;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    const bool isInside = std::all_of(
      x.begin(), x.end(), [](double v) { return v > 0.0 && v < 1.0; });
    for (double& v : x)
    {
      const double move = jitter / n * random();
      v += !isInside && v > 0.0 && v < 1.0 ? move : 0.0;
    }
    grid->GetPoints()->SetPoint(p, x.data());
  }
  return grid;
}

} // namespace Testing

#endif
