// SPDX-License-Identifier: BSD-3-Clause
/// @file Analysis.h
/// The entry point: a linear thermoelastic analysis with P1 elements, from mesh and problem to
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
  /// One sentence about the first unusable option and the reason; empty if all are fine.
  std::string check() const;
};

/// The result. Arrays per point have an entry for every point of the mesh; it is zero if no cell
/// uses the point. All sums are in a fixed order, so that the bits do not depend on the number of
/// threads.
template <int D>
struct Solution
{
  std::vector<Vec<D>> displacement;
  std::vector<Stress<D>> elementStress; ///< per cell, at its centroid
  std::vector<Stress<D>> stress;        ///< per point; empty if nothing was recovered
  /// Per point: the force that holds its prescribed components; zero in the others.
  std::vector<Vec<D>> reaction;
  std::vector<double> strainEnergyDensity; ///< per cell
  /// Per cell, see estimateErrors(); empty if nothing was recovered.
  std::vector<double> errorEstimate;

  double strainEnergy = 0.0; ///< 1/2 integral of sigma : C^-1 : sigma
  /// Energy norm of the whole estimate: root of the sum of squares.
  double totalErrorEstimate = 0.0;
  /// The same, relative to the energy norm of the recovered solution, sqrt(2 energy + estimate^2).
  /// About 0.05 is the usual goal.
  double relativeErrorEstimate = 0.0;
  SolverReport solver;
  Index numberOfUnknowns = 0;
  std::vector<Constraint> pins; ///< constraints added for RigidMotion::Pin
  double assemblySeconds = 0.0, solveSeconds = 0.0, recoverySeconds = 0.0;
};

/// Solves the problem. If mesh, problem or options are unusable, returns the reason and leaves
/// `solution` empty. A solver that does not converge is no error: see solution.solver.status; all
/// other results then follow from the displacement reached. After cancelling only `solver` is
/// filled. The cells of `mesh` must be those of its input (no edits). std::bad_alloc may pass
/// through.
template <int D>
std::optional<Error> analyse(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const AnalysisOptions& options, const Control& control, Solution<D>& solution);
}

#endif
