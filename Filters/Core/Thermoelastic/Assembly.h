// SPDX-License-Identifier: BSD-3-Clause
/// @file Assembly.h
/// From the mesh to the linear system: gradients, sparsity, matrix and right-hand side.
///
/// Rows are gathered point by point from the cells around the point, in ascending order of cell
/// ids. No two threads write the same row, and no sum depends on the distribution of work: the bits
/// do not depend on the number of threads. The matrix is symmetric bit by bit.
#ifndef meshopt_Thermoelastic_Assembly_h
#define meshopt_Thermoelastic_Assembly_h

#include "Base/Control.h"
#include "Mesh/SimplexMesh.h"
#include "Thermoelastic/Problem.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace meshopt::fem
{
/// The geometry that an element's matrix depends on.
template <int D>
struct ElementGeometry
{
  std::array<Vec<D>, D + 1> gradients; ///< of the shape functions, constant in the element
  double volume = 0.0;                 ///< > 0
};

/// Lists of numbers, one list per row: entries offsets[i] .. offsets[i + 1] - 1 of items.
struct Rows
{
  std::vector<Index> offsets, items;
  const Index* begin(Index i) const { return this->items.data() + this->offsets[i]; }
  const Index* end(Index i) const { return this->items.data() + this->offsets[i + 1]; }
};

/// A mesh prepared for finite elements. Matrix, stresses and reactions use the same numbers: where
/// nothing is prescribed, internal forces balance the loads up to the residual of the solver.
template <int D>
struct Discretization
{
  std::vector<ElementGeometry<D>> elements;
  std::vector<Elasticity<D>> materials; ///< one, or one per cell
  std::vector<double> temperatureRise;  ///< mean of each cell above the reference; empty: zero
  Rows cellsOfPoint;                    ///< ascending
  double outOfPlaneStrain = 0.0;

  const Elasticity<D>& elasticity(Index cell) const
  {
    return this->materials.size() == 1 ? this->materials[0] : this->materials[cell];
  }
  double rise(Index cell) const
  {
    return this->temperatureRise.empty() ? 0.0 : this->temperatureRise[cell];
  }
};

/// Precondition: check() has found no error.
template <int D>
Discretization<D> discretize(
  const SimplexMesh<D>& mesh, const Problem<D>& problem, const Control& control);

/// The unknown components of the points.
struct Unknowns
{
  /// D per point: number of the unknown; None if the displacement is prescribed or no cell uses the
  /// point.
  std::vector<Index> numbers;
  std::vector<double> prescribed; ///< D per point; zero where nothing is prescribed
  Index count = 0;
};

/// Unknowns are numbered in the order of points and components. Of several constraints of one
/// component the last counts.
template <int D>
Unknowns numberUnknowns(const SimplexMesh<D>& mesh, const std::vector<Constraint>& constraints);

/// Row major, so that rows can be multiplied in parallel.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

struct LinearSystem
{
  SparseMatrix matrix; ///< symmetric, all entries stored
  Eigen::VectorXd right;
};

/// The equations of the unknowns; prescribed displacements are on the right-hand side. Throws
/// std::bad_alloc if the matrix has 2^31 entries or more.
template <int D>
LinearSystem assemble(const SimplexMesh<D>& mesh, const Discretization<D>& discretization,
  const Unknowns& unknowns, const std::vector<Vec<D>>& forces, const Control& control);

/// Stress of each cell at its centroid.
template <int D>
std::vector<Stress<D>> elementStresses(const SimplexMesh<D>& mesh,
  const Discretization<D>& discretization, const std::vector<Vec<D>>& displacement,
  const Control& control);

/// Forces at each point that are in equilibrium with the element stresses: integral of B' sigma.
template <int D>
std::vector<Vec<D>> internalForces(const SimplexMesh<D>& mesh,
  const Discretization<D>& discretization, const std::vector<Stress<D>>& stress,
  const Control& control);

/// y = A x, row by row.
void multiply(
  const SparseMatrix& a, const Eigen::VectorXd& x, const Control& control, Eigen::VectorXd& y);
}

#endif
