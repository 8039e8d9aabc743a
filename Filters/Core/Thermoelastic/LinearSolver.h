// SPDX-License-Identifier: BSD-3-Clause
/// @file LinearSolver.h
/// Solves the assembled system: conjugate gradients, or a factorization.
///
/// The conjugate gradients follow Eigen's class ConjugateGradient step by step. They add what it
/// does not have: the residual after each step, products on several threads, progress, and an end
/// if the matrix turns out to be singular.
#ifndef meshopt_Thermoelastic_LinearSolver_h
#define meshopt_Thermoelastic_LinearSolver_h

#include "Thermoelastic/Assembly.h"

#include <string>
#include <vector>

namespace meshopt::fem
{
enum class Solver
{
  /// Conjugate gradients, preconditioned by the diagonal, as in the paper.
  ConjugateGradient = 0,
  /// The same, preconditioned by Eigen's incomplete Cholesky factorization. Some three times fewer
  /// steps, each twice as long; the preconditioner runs on one thread.
  IncompleteCholesky = 1,
  /// Eigen's SimplicialLDLT. Memory and time grow fast: for up to some ten thousand points in 3D.
  Direct = 2
};

struct SolverOptions
{
  Solver solver = Solver::ConjugateGradient;
  double tolerance = 1e-8; ///< |b - A x| <= tolerance |b|; 0 < tolerance < 1
  int maximumNumberOfIterations = 10000;
};

enum class SolverStatus
{
  NotRun = 0,
  Converged,
  IterationLimit, ///< the tolerance was not reached in this many steps
  /// The matrix is not positive definite up to rounding, or the residual is NaN: no further step is
  /// possible.
  Breakdown,
  Cancelled
};

/// A few words for the user.
const char* toString(SolverStatus status);

struct SolverReport
{
  SolverStatus status = SolverStatus::NotRun;
  /// Steps, that is products with the matrix. (Eigen's iterations() is lower by one on convergence,
  /// since it does not count the last step.) 0 for Solver::Direct.
  int iterations = 0;
  double relativeResidual = 0.0; ///< |b - A x| / |b|; for conjugate gradients by recurrence
  /// Relative residual before the first step and after each step.
  std::vector<double> history;
};

/// The section of the caller's progress that a solution takes.
struct ProgressSection
{
  double first = 0.0, last = 1.0;
};

/// Solves from x = 0. For ConjugateGradient the matrix may be semidefinite if the right-hand side
/// is in its range. `control.progress` gets fractions of the section, and may cancel.
SolverReport solve(const LinearSystem& system, const SolverOptions& options, const Control& control,
  const ProgressSection& section, Eigen::VectorXd& x);
}

#endif
