// SPDX-License-Identifier: BSD-3-Clause
/// @file Analysis.h
/// The door of the room: a linear thermoelastic analysis with P1 elements, from mesh and problem to
/// displacement, stress and error estimate.
#ifndef meshopt_Thermoelastic_Analysis_h
#define meshopt_Thermoelastic_Analysis_h

#include "Thermoelastic/LinearSolver.h"
#include "Thermoelastic/Problem.h"
#include "Thermoelastic/StressRecovery.h"

#include <optional>
#include <vector>

namespace meshopt::fem
{
struct AnalysisOptions
{
  SolverOptions solver;
  StressRecovery recovery = StressRecovery::Patch;
  /// A sentence that says which option is unusable and why; empty if all are fine.
  std::string check() const;
};

/// The result. Arrays per point have an entry for every point of the mesh, zero where no cell uses
/// it. All sums are in a fixed order: the same bits for any number of threads.
template <int D>
struct Solution
{
  std::vector<Vec<D>> displacement;
  std::vector<Stress<D>> elementStress; ///< per cell, at its centroid
  std::vector<Stress<D>> stress;        ///< per point; empty if nothing was recovered
  /// Per point: the force that holds it where components are prescribed; zero in the others.
  std::vector<Vec<D>> reaction;
  std::vector<double> strainEnergyDensity; ///< per cell
  /// Per cell, see estimateErrors(); empty if nothing was recovered.
  std::vector<double> errorEstimate;

  double strainEnergy = 0.0; ///< 1/2 integral of sigma : C^-1 : sigma
  /// Energy norm of the whole estimate: root of the sum of squares.
  double totalErrorEstimate = 0.0;
  /// The same over the energy norm of the recovered solution, sqrt(2 energy + estimate^2). About
  /// 0.05 is what one usually wants.
  double relativeErrorEstimate = 0.0;
  SolverReport solver;
  Index numberOfUnknowns = 0;
  std::vector<Constraint> pins; ///< constraints that RigidMotion::Pin has added
  double assemblySeconds = 0.0, solveSeconds = 0.0, recoverySeconds = 0.0;
};

/// Solves. Returns what is wrong with mesh, problem or options, and leaves `solution` empty then. A
/// solver that does not converge is no error here: look at solution.solver.status; the rest is what
/// follows from the displacement reached. After cancelling only `solver` is filled. The cells of
/// `mesh` must be those of its input (no edits). std::bad_alloc may pass through.
template <int D>
std::optional<Error> analyse(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const AnalysisOptions& options, const Control& control, Solution<D>& solution);
}

#endif
