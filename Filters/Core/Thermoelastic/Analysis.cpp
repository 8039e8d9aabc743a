// SPDX-License-Identifier: BSD-3-Clause
// The analysis step by step. What the steps share is in Analyst, so that each is a short function.
#include "Thermoelastic/Analysis.h"

#include "Thermoelastic/RigidModes.h"

#include <chrono>
#include <cmath>

namespace meshopt::fem
{
namespace
{
/// Loads are in equilibrium if their resultant along a free motion is less than this fraction of
/// their sum. Rounding in coordinates and loads is smaller.
constexpr double Equilibrium = 1e-6;

/// Where the parts of the work end, as fractions of the progress. The solver takes most of the
/// time.
constexpr double AfterAssembly = 0.05, AfterSolve = 0.95;

class Stopwatch
{
public:
  /// Seconds since the last call, or since construction.
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> spent = now - this->last_;
    this->last_ = now;
    return spent.count();
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

template <int D>
class Analyst
{
public:
  Analyst(const SimplexMesh<D>& mesh, const Problem<D>& problem, const AnalysisOptions& options,
    const Control& control, Solution<D>& solution)
    : mesh_(mesh)
    , problem_(problem)
    , options_(options)
    , control_(control)
    , solution_(solution)
    // A copy: pins are added to it.
    , constraints_(problem.constraints)
  {
  }

  std::optional<Error> run()
  {
    Stopwatch watch;
    std::optional<Error> error = this->checkAll();
    // Before any matrix is made: a body that can move freely has a singular one.
    if (!error)
    {
      error = this->handleRigidMotions();
    }
    if (error)
    {
      return error;
    }
    this->d_ = discretize(this->mesh_, this->problem_, this->control_);
    this->assembleAndSolve(watch);
    // Nothing follows from a solution that was cut short.
    if (this->solution_.solver.status != SolverStatus::Cancelled)
    {
      this->findStresses();
      this->recover();
      this->solution_.recoverySeconds = watch.lap();
    }
    return std::nullopt;
  }

private:
  /// Options first: they cost nothing, while the problem is looked at point by point.
  std::optional<Error> checkAll() const
  {
    const std::string text = this->options_.check();
    return text.empty() ? check(this->mesh_, this->problem_) : Error{ text };
  }

  /// Free rigid motions are an error unless the problem says how to handle them.
  std::optional<Error> handleRigidMotions()
  {
    // With the constraints that are really there; pins come later.
    this->modes_ = findRigidModes(this->mesh_, this->constraints_);
    if (this->modes_.count() == 0)
    {
      return std::nullopt;
    }
    if (this->problem_.rigidMotion == RigidMotion::Forbid)
    {
      const std::string begin = this->constraints_.empty()
        ? "There are no constraints, so the solution is not unique: "
        : "There are too few constraints, so the solution is not unique: ";
      return Error{ begin + this->modes_.describe() +
        ". Constrain it, or have rigid motion pinned or projected out." };
    }
    // A body that may move freely is at rest only if its loads are in equilibrium.
    const std::string imbalance = findImbalance(
      this->mesh_, this->modes_, this->problem_.forces, Equilibrium);
    if (!imbalance.empty())
    {
      return Error{
        "The loads are not in equilibrium, and no constraint balances them: " + imbalance + "."
      };
    }
    // Conjugate gradients stay orthogonal to the free motions by themselves. The factorizations
    // need a regular matrix.
    if (this->problem_.rigidMotion == RigidMotion::Pin ||
      this->options_.solver.solver != Solver::ConjugateGradient)
    {
      // Pins carry no force, since the loads are in equilibrium: strain and stress stay the same.
      this->solution_.pins = pinRigidMotions(this->mesh_, this->modes_);
      this->constraints_.insert(
        this->constraints_.end(), this->solution_.pins.begin(), this->solution_.pins.end());
    }
    return std::nullopt;
  }

  /// Displacements of all points: those that are solved for, and those that are prescribed.
  void assembleAndSolve(Stopwatch& watch)
  {
    const Unknowns unknowns = numberUnknowns(this->mesh_, this->constraints_);
    const LinearSystem system = assemble(
      this->mesh_, this->d_, unknowns, this->problem_.forces, this->control_);
    this->solution_.numberOfUnknowns = unknowns.count;
    this->solution_.assemblySeconds = watch.lap();
    Eigen::VectorXd x;
    this->solution_.solver = solve(
      system, this->options_.solver, this->control_, { AfterAssembly, AfterSolve }, x);
    this->solution_.solveSeconds = watch.lap();
    std::vector<Vec<D>>& u = this->solution_.displacement;
    // Slots that no cell uses stay at rest.
    u.assign(this->mesh_.numberOfPointSlots(), Vec<D>::Zero());
    // Component i of point p is number D p + i.
    for (std::size_t dof = 0; dof < unknowns.numbers.size(); ++dof)
    {
      const Index number = unknowns.numbers[dof];
      u[dof / D][static_cast<int>(dof % D)] = number == None ? unknowns.prescribed[dof] : x[number];
    }
    // Whichever solver ran: with pins or without, solutions differ by a free motion only.
    if (this->problem_.rigidMotion == RigidMotion::Project)
    {
      // Weighted by volume: the motion of the body counts, however its points are spread.
      removeRigidMotions(this->mesh_, this->modes_, this->pointVolumes(), u);
    }
  }

  /// As weights of the points: only their ratios count.
  std::vector<double> pointVolumes() const
  {
    std::vector<double> volumes(this->mesh_.numberOfPointSlots(), 0.0);
    // Each node gets the whole volume of its cells: the same factor for all cancels.
    for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
    {
      for (Index p : this->mesh_.nodes(c))
      {
        volumes[p] += this->d_.elements[c].volume;
      }
    }
    return volumes;
  }

  /// In the order of the cells, so that the energy has the same bits in each run.
  void findStresses()
  {
    Solution<D>& s = this->solution_;
    s.elementStress = elementStresses(this->mesh_, this->d_, s.displacement, this->control_);
    s.strainEnergyDensity.resize(s.elementStress.size());
    for (std::size_t c = 0; c < s.elementStress.size(); ++c)
    {
      const Index cell = static_cast<Index>(c);
      // For constant stress in a cell the energy density is the same everywhere in it.
      // The stress is the mechanical one: strain that comes from temperature alone has no energy.
      s.strainEnergyDensity[c] = 0.5 * this->d_.elasticity(cell).energyProduct(s.elementStress[c]);
      s.strainEnergy += this->d_.elements[c].volume * s.strainEnergyDensity[c];
    }
    // Internal forces minus loads: only where a component is prescribed is the rest a reaction.
    const std::vector<Vec<D>> internal = internalForces(
      this->mesh_, this->d_, s.elementStress, this->control_);
    s.reaction.assign(internal.size(), Vec<D>::Zero());
    for (const Constraint& c : this->constraints_)
    {
      const double load = this->problem_.forces.empty()
        ? 0.0
        : this->problem_.forces[c.point][c.component];
      // Where no cell is, a constraint holds nothing.
      if (this->mesh_.isPointAlive(c.point))
      {
        s.reaction[c.point][c.component] = internal[c.point][c.component] - load;
      }
    }
  }

  /// Nodal stresses and the error estimate, unless the caller wants none.
  void recover()
  {
    Solution<D>& s = this->solution_;
    if (this->options_.recovery == StressRecovery::None)
    {
      return;
    }
    // Values per node, not per point: the estimate must not see a jump between materials as error.
    const RecoveryMesh<D> nodes = makeRecoveryMesh(this->mesh_);
    const std::vector<Stress<D>> nodal = recoverStress(
      this->mesh_, nodes, s.elementStress, this->options_.recovery, this->control_);
    s.stress = stressAtPoints(this->mesh_, nodes, nodal);
    s.errorEstimate = estimateErrors(
      this->mesh_, this->problem_, this->d_, nodes, s.elementStress, nodal, this->control_);
    double squares = 0.0;
    for (double e : s.errorEstimate)
    {
      // Energies of cells add up, and norms are their roots.
      squares += e * e;
    }
    s.totalErrorEstimate = std::sqrt(squares);
    // The recovered solution has about the energy of the computed one plus that of the error.
    const double norm2 = 2.0 * s.strainEnergy + squares;
    s.relativeErrorEstimate = norm2 > 0.0 ? std::sqrt(squares / norm2) : 0.0;
  }

  const SimplexMesh<D>& mesh_;
  const Problem<D>& problem_;
  const AnalysisOptions& options_;
  const Control& control_;
  Solution<D>& solution_;
  std::vector<Constraint> constraints_;
  RigidModes<D> modes_;
  Discretization<D> d_;
};
}

std::string AnalysisOptions::check() const
{
  if (!(this->solver.tolerance > 0.0) || !(this->solver.tolerance < 1.0))
  {
    return "The tolerance of the solver is " + std::to_string(this->solver.tolerance) +
      "; it must be greater than 0 and less than 1.";
  }
  if (this->solver.maximumNumberOfIterations < 1)
  {
    return "The solver needs at least one iteration.";
  }
  return {};
}

template <int D>
std::optional<Error> analyse(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const AnalysisOptions& options, const Control& control, Solution<D>& solution)
{
  // Also after an error nothing of an earlier analysis may be left.
  solution = Solution<D>();
  return Analyst<D>(mesh, problem, options, control, solution).run();
}

template std::optional<Error> analyse<2>(
  const SimplexMesh<2>&, const Problem<2>&, const AnalysisOptions&, const Control&, Solution<2>&);
template std::optional<Error> analyse<3>(
  const SimplexMesh<3>&, const Problem<3>&, const AnalysisOptions&, const Control&, Solution<3>&);
}
