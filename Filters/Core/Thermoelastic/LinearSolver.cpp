// SPDX-License-Identifier: BSD-3-Clause
// Three solvers behind one function. Conjugate gradients are written out, since Eigen's report
// nothing between start and end.
#include "Thermoelastic/LinearSolver.h"

#include "Base/Progress.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <cstdint>
#include <limits>

namespace meshopt::fem
{
namespace
{
using Eigen::VectorXd;

/// Jacobi's: cheap, and it evens out elements of very different size or stiffness.
class DiagonalPreconditioner
{
public:
  /// The diagonal is positive, since no element is flat or inverted.
  explicit DiagonalPreconditioner(const SparseMatrix& a)
    : inverse_(a.diagonal().cwiseInverse())
  {
  }
  void apply(const VectorXd& r, VectorXd& z) const { z = this->inverse_.cwiseProduct(r); }

private:
  VectorXd inverse_;
};

/// Costs more memory and time for each step than the diagonal, and needs fewer steps.
class CholeskyPreconditioner
{
public:
  explicit CholeskyPreconditioner(const SparseMatrix& a)
  {
    // Eigen's factorization reads one triangle only.
    const Eigen::SparseMatrix<double> lower = a.triangularView<Eigen::Lower>();
    this->factor_.compute(lower);
  }
  void apply(const VectorXd& r, VectorXd& z) const { z = this->factor_.solve(r); }

private:
  Eigen::IncompleteCholesky<double, Eigen::Lower> factor_;
};

/// Part to which a residual that is computed anew has to fall from one time to the next.
constexpr double HalvedAtLeast = 0.5;

/// Progress, from the logarithm of the residual.
double fractionDone(double residual, double tolerance)
{
  // The residual falls by about the same factor in each step, so that its logarithm is a fair
  // clock. One that rises above the first counts as no progress.
  const double f = std::log(residual) / std::log(tolerance);
  return std::isfinite(f) ? std::min(1.0, std::max(0.0, f)) : 0.0;
}

/// The residual comes from the recurrence. Rounding takes it away from the true one, by orders on
/// very flat elements: so it is computed anew where it would end the iteration, which goes on from
/// there as long as that helps.
template <class Preconditioner>
SolverReport conjugateGradient(const SparseMatrix& matrix, const VectorXd& b,
  const SolverOptions& options, const Control& control, const ProgressSection& section, VectorXd& x)
{
  SolverReport report;
  const double norm2 = b.squaredNorm();
  double verified = std::numeric_limits<double>::infinity(); // the last residual computed anew
  const double goal = options.tolerance * options.tolerance;
  const Preconditioner preconditioner(matrix);
  // From x = 0: the first residual is the load.
  VectorXd r = b, p(b.size()), z(b.size()), product(b.size());
  // The first direction is that of the preconditioned residual.
  preconditioner.apply(r, p);
  double rz = r.dot(p);
  report.history.push_back(1.0);
  Progress progress(control);
  while (report.status == SolverStatus::NotRun)
  {
    if (report.iterations == options.maximumNumberOfIterations)
    {
      report.status = SolverStatus::IterationLimit;
      break;
    }
    // By the caller's threads, row by row: the same bits for any number of them.
    multiply(matrix, p, control, product);
    const double curvature = p.dot(product);
    const double step = rz / curvature;
    if (!(curvature > 0.0) || !std::isfinite(step))
    {
      // The matrix is singular or indefinite up to rounding.
      report.status = SolverStatus::Breakdown;
      break;
    }
    x += step * p;
    r -= step * product;
    ++report.iterations;
    const double residual2 = r.squaredNorm() / norm2;
    report.history.push_back(std::sqrt(residual2));
    if (residual2 < goal)
    {
      multiply(matrix, x, control, product);
      r = b - product;
      const double residual = r.norm() / std::sqrt(norm2);
      report.history.back() = residual;
      if (residual < options.tolerance || !(residual < HalvedAtLeast * verified))
      {
        report.status = residual < options.tolerance ? SolverStatus::Converged
                                                     : SolverStatus::IterationLimit;
        break;
      }
      verified = residual;
      preconditioner.apply(r, p);
      rz = r.dot(p);
      continue;
    }
    preconditioner.apply(r, z);
    // Conjugate to all directions before, by recurrence with the last one alone.
    const double before = rz;
    rz = r.dot(z);
    p = z + rz / before * p;
    const double done = fractionDone(report.history.back(), options.tolerance);
    // Between assembly and recovery, whose shares of the bar are fixed.
    const bool goOn = progress.report(section.first + (section.last - section.first) * done,
      [&] { return "Solving, step " + std::to_string(report.iterations); });
    report.status = goOn ? report.status : SolverStatus::Cancelled;
  }
  report.relativeResidual = report.history.back();
  return report;
}

/// There are no steps: the history has the residual before and after.
SolverReport factorize(
  const SparseMatrix& matrix, const VectorXd& b, const SolverOptions& options, VectorXd& x)
{
  SolverReport report;
  // 64 bits, since the factor can have far more entries than the matrix.
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;
  const Matrix lower = matrix.triangularView<Eigen::Lower>();
  // The order decides about the fill-in: by minimum degree (AMD).
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<std::int64_t>> factor(lower);
  if (factor.info() == Eigen::Success)
  {
    x = factor.solve(b);
    // Computed anew: a factorization has no recurrence, and its rounding is what one wants to see.
    report.relativeResidual = (b - matrix * x).norm() / b.norm();
    report.history.push_back(1.0);
    report.history.push_back(report.relativeResidual);
  }
  const bool solved = factor.info() == Eigen::Success && std::isfinite(report.relativeResidual);
  // A solution that misses the tolerance is reported like too few iterations: the user's choices
  // are the same.
  report.status = !solved                          ? SolverStatus::Breakdown
    : report.relativeResidual <= options.tolerance ? SolverStatus::Converged
                                                   : SolverStatus::IterationLimit;
  return report;
}
}

const char* toString(SolverStatus status)
{
  switch (status)
  {
    case SolverStatus::NotRun:
      return "not run";
    case SolverStatus::Converged:
      return "converged";
    case SolverStatus::IterationLimit:
      return "tolerance not reached";
    case SolverStatus::Breakdown:
      return "broke down";
    case SolverStatus::Cancelled:
      return "aborted";
  }
  return "";
}

SolverReport solve(const LinearSystem& system, const SolverOptions& options, const Control& control,
  const ProgressSection& section, VectorXd& x)
{
  x = VectorXd::Zero(system.right.size());
  if (system.right.size() == 0 || (system.right.array() == 0.0).all())
  {
    // Residuals are relative to the load: without one there is nothing to solve.
    SolverReport report;
    report.status = SolverStatus::Converged;
    report.history.push_back(0.0);
    return report;
  }
  // By a power of 2, so that no bit of the solution changes: squares of loads must neither overflow
  // nor vanish.
  const double scale = std::exp2(std::ilogb(system.right.cwiseAbs().maxCoeff()));
  const VectorXd load = system.right / scale;
  SolverReport report;
  switch (options.solver)
  {
    case Solver::IncompleteCholesky:
      report = conjugateGradient<CholeskyPreconditioner>(
        system.matrix, load, options, control, section, x);
      break;
    case Solver::Direct:
      report = factorize(system.matrix, load, options, x);
      break;
    case Solver::ConjugateGradient:
      report = conjugateGradient<DiagonalPreconditioner>(
        system.matrix, load, options, control, section, x);
      break;
  }
  x *= scale;
  return report;
}
}
