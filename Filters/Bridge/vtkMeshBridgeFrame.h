// SPDX-License-Identifier: BSD-3-Clause
/**
 * From the coordinates of a grid to those of the core, and back. In space they are the same; a
 * plane gets two axes.
 */
#ifndef vtkMeshBridgeFrame_h
#define vtkMeshBridgeFrame_h

#include "vtkMeshBridgeCells.h"

#include "Mesh/Types.h"

#include <string>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

template <int D>
struct Frame;

template <>
struct Frame<3>
{
  meshopt::Vec<3> ToCore(const double x[3]) const { return { x[0], x[1], x[2] }; }
  void ToGrid(const meshopt::Vec<3>& u, double x[3]) const
  {
    x[0] = u[0];
    x[1] = u[1];
    x[2] = u[2];
  }
  meshopt::Tensor<3> ToCore(const meshopt::Tensor<3>& m) const { return m; }
};

template <>
struct Frame<2>
{
  meshopt::Vec<3> Origin = meshopt::Vec<3>::Zero();
  meshopt::Vec<3> Axes[2] = { meshopt::Vec<3>::UnitX(), meshopt::Vec<3>::UnitY() };

  /// Coordinates that serve as they are where the plane is parallel to two axes: no rounding at all
  /// then. Else -1.
  int Direct[2] = { 0, 1 };

  meshopt::Vec<2> ToCore(const double x[3]) const;
  void ToGrid(const meshopt::Vec<2>& u, double x[3]) const;
  meshopt::Tensor<2> ToCore(const meshopt::Tensor<3>& m) const;
};

/**
 * A sentence if a mesh from `low` to `high` is so large or so small that its cubed lengths leave the
 * range of double precision; else, and where a bound is not finite, an empty string.
 */
std::string CheckExtent(const meshopt::Vec<3>& low, const meshopt::Vec<3>& high);

/**
 * Nothing to find in space; the extent is checked.
 */
std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<3>& frame);

/**
 * The plane of all triangles, turned such that most of their area is positive: a mesh that is
 * numbered clockwise about z stays so. Returns a sentence if they are not in one plane, to 1e-6 of
 * their extent and to what the type of the coordinates can express.
 */
std::string FindFrame(vtkUnstructuredGrid* grid, const Cells& cells, Frame<2>& frame);

} // namespace vtkMeshOptimizeBridge

#endif
