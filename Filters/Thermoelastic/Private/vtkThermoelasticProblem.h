// SPDX-License-Identifier: BSD-3-Clause
/**
 * grid -> core: material, temperature, constraints and loads of a grid as the core's Problem.
 */
#ifndef vtkThermoelasticProblem_h
#define vtkThermoelasticProblem_h

#include "vtkMeshBridgeCells.h"
#include "vtkMeshBridgeFrame.h"
#include "vtkThermoelasticArrays.h"
#include "vtkThermoelasticRun.h"

#include "Thermoelastic/Problem.h"

namespace vtkThermoelasticBridge
{

/**
 * A grid on its way into the core.
 */
template <int D>
struct Model
{
  vtkUnstructuredGrid* Grid = nullptr;
  vtkMeshBridge::Cells Cells;
  vtkMeshBridge::Frame<D> Frame;
  InputArrays Arrays{};
  meshopt::SimplexMesh<D> Mesh;
  meshopt::fem::Problem<D> Problem;
};

/**
 * A vector of the grid in the frame of the core.
 */
inline meshopt::Vec<3> VectorToCore(const vtkMeshBridge::Frame<3>&, const double x[3])
{
  return { x[0], x[1], x[2] };
}
inline meshopt::Vec<2> VectorToCore(const vtkMeshBridge::Frame<2>& frame, const double x[3])
{
  const meshopt::Vec<3> v(x[0], x[1], x[2]);
  return { frame.Axes[0].dot(v), frame.Axes[1].dot(v) };
}

/**
 * Fills model.Problem from the arrays and the request. Returns an empty string, or a sentence about
 * the first unusable thing. `axialStrain` receives the strain prescribed along the axis.
 */
template <int D>
std::string MakeProblem(const Request& request, Model<D>& model, double& axialStrain);

} // namespace vtkThermoelasticBridge

#endif
