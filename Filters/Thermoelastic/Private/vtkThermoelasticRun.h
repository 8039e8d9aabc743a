// SPDX-License-Identifier: BSD-3-Clause
/**
 * The work of vtkThermoelasticFilter on a grid, from import to export.
 */
#ifndef vtkThermoelasticRun_h
#define vtkThermoelasticRun_h

#include "Base/Control.h"
#include "Thermoelastic/Analysis.h"

#include "vtkType.h"

#include <string>

class vtkAlgorithm;
class vtkTable;
class vtkUnstructuredGrid;

namespace vtkThermoelasticBridge
{

/**
 * The filter's properties. Numbers are those of the enums of vtkThermoelasticFilter.
 */
struct Request
{
  vtkAlgorithm* Filter = nullptr; ///< has the choice of arrays
  int TemperatureMode = 0;
  double UniformTemperature = 0.0;
  double AxisTemperature = 0.0;
  double RadialCoefficient = 0.0;
  double ReferenceTemperature = 0.0;
  meshopt::fem::Material Material;
  meshopt::fem::PlaneState PlaneState = meshopt::fem::PlaneState::PlaneStrain;
  bool GeneralizedPlaneStrain = false;
  int Axis = 2;
  bool IsAxialStrainGiven = false;
  double AxialStrain = 0.0;
  double SurfacePressure = 0.0;
  meshopt::fem::RigidMotion RigidMotion = meshopt::fem::RigidMotion::Forbid;
  meshopt::fem::AnalysisOptions Options;
  meshopt::Control Control;
};

/**
 * The figures of a run.
 */
struct Outcome
{
  bool HasSolved = false; ///< false: there was nothing to solve
  meshopt::fem::SolverReport Solver;
  vtkIdType NumberOfUnknowns = 0;
  double StrainEnergy = 0.0;
  double ErrorEstimate = 0.0;
  double RelativeErrorEstimate = 0.0;
  double AxialStrain = 0.0; ///< the prescribed strain
  double AssemblySeconds = 0.0, SolveSeconds = 0.0, RecoverySeconds = 0.0;
};

/**
 * Solves on the tetrahedra of `input`, or on its triangles if it has no tetrahedra. `output`
 * becomes a copy with the results, `history` receives the residuals. Returns an empty string, or a
 * sentence about what is wrong. After an abort `output` and `history` are empty.
 */
std::string SolveGrid(vtkUnstructuredGrid* input, const Request& request,
  vtkUnstructuredGrid* output, vtkTable* history, Outcome& outcome);

} // namespace vtkThermoelasticBridge

#endif
