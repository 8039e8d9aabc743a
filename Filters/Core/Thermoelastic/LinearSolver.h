// SPDX-License-Identifier: BSD-3-Clause
/// @file LinearSolver.h
/// Solves the assembled system: conjugate gradients, or a factorization.
///
/// The conjugate gradients are those of Eigen's class ConjugateGradient, step by step, with what it
/// does not give: the residual after each step, products on several threads, progress, an end when
/// the matrix turns out singular.
#ifndef meshopt_Thermoelastic_LinearSolver_h
#define meshopt_Thermoelastic_LinearSolver_h

#include "Thermoelastic/Assembly.h"

#include <string>
#include <vector>

namespace meshopt::fem
{
enum class Solver
{
  /// Conjugate gradients, preconditioned by the diagonal: the paper's.
  ConjugateGradient = 0,
  /// The same, preconditioned by Eigen's incomplete Cholesky factorization: some three times fewer
  /// steps, each twice as long; the preconditioner runs on one thread.
  IncompleteCholesky = 1,
  /// Eigen's SimplicialLDLT. Memory and time grow fast: for some ten thousand points in space.
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
  IterationLimit, ///< the tolerance was not reached in so many steps
  /// The matrix is not positive definite to rounding, or the residual is no number: no further
  /// step is possible.
  Breakdown,
  Cancelled
};

/// A few words for the user.
const char* toString(SolverStatus status);

struct SolverReport
{
  SolverStatus status = SolverStatus::NotRun;
  /// Steps, that is products with the matrix. (Eigen's iterations() is one less when it converges,
  /// since it does not count the step that does.) 0 for Solver::Direct.
  int iterations = 0;
  double relativeResidual = 0.0; ///< |b - A x| / |b|; of conjugate gradients the recurrence's
  /// Relative residual before the first and after each step.
  std::vector<double> history;
};

/// Solves from x = 0. A matrix that is only semidefinite is fine for ConjugateGradient if the right
/// side is in its range. Cancelling: by `control.progress`, which is told a fraction of
/// [first, last].
SolverReport solve(const LinearSystem& system, const SolverOptions& options, const Control& control,
  double first, double last, Eigen::VectorXd& x);
}

#endif
