// SPDX-License-Identifier: BSD-3-Clause
// The linear system and its solvers: against Eigen, against each other, on any number of threads.
#include "ThermoelasticTesting.h"

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>

#include <cstring>

using namespace meshopt;
using namespace meshopt::fem;

template <class T>
class ThermoelasticSolver : public ::testing::Test
{
};
TYPED_TEST_SUITE(ThermoelasticSolver, TestDimensions);

namespace
{
template <int D>
Problem<D> hotBox(const SimplexMesh<D>& mesh, RigidMotion motion = RigidMotion::Forbid)
{
  Problem<D> problem;
  problem.rigidMotion = motion;
  problem.materials = { { 200.0, 0.3, 1e-5 } };
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const Vec<D>& x = mesh.point(p);
    problem.temperature.push_back(1000.0 * x[0] * x[0] + 300.0 * x[1]);
    for (int i = 0; i < D && motion == RigidMotion::Forbid && x[0] == 0.0; ++i)
    {
      problem.constraints.push_back({ p, i, 0.01 * x[1] });
    }
  }
  return problem;
}

template <int D>
LinearSystem systemOf(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  return assemble(mesh, discretize(mesh, problem, {}), numberUnknowns(mesh, problem.constraints),
    problem.forces, {});
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
}

// Entry by entry against elements added up as B' C B, in the textbook's way.
TYPED_TEST(ThermoelasticSolver, MatrixAgainstTextbook)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(2, 0.2);
  Problem<D> problem = hotBox(mesh);
  problem.constraints.clear();
  const Eigen::MatrixXd a = systemOf(mesh, problem).matrix;
  const Elasticity<D> law(problem.materials[0], PlaneState::PlaneStrain);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    Eigen::Matrix<double, D + 1, D + 1> m; // rows (1, x): its inverse holds the shape functions
    for (int i = 0; i <= D; ++i)
    {
      m(i, 0) = 1.0;
      m.row(i).template tail<D>() = mesh.point(mesh.nodes(c)[i]).transpose();
    }
    const Eigen::Matrix<double, D + 1, D + 1> shape = m.inverse();
    for (int i = 0; i <= D; ++i)
    {
      for (int k = 0; k < D; ++k)
      {
        // Stress under a unit displacement of component k of node i, times the gradient of node j.
        Tensor<D> g = Tensor<D>::Zero();
        g.row(k) = shape.col(i).template tail<D>().transpose();
        const Tensor<3> s = toTensor<D>(law.stress(g, 0.0, 0.0));
        for (int j = 0; j <= D; ++j)
        {
          const Vec<D> f = signedVolume(mesh.corners(c)) * s.template topLeftCorner<D, D>() *
            shape.col(j).template tail<D>();
          b.template block<D, 1>(D * mesh.nodes(c)[j], D * mesh.nodes(c)[i] + k) += f;
        }
      }
    }
  }
  EXPECT_LT((a - b).norm(), 1e-13 * b.norm());
  EXPECT_EQ((a - a.transpose()).norm(), 0.0); // bit by bit
  // Rigid motions and no others cost nothing.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
  const int rigid = D == 3 ? 6 : 3;
  EXPECT_LT(eigen.eigenvalues()[rigid - 1], 1e-12 * eigen.eigenvalues()[a.rows() - 1]);
  EXPECT_GT(eigen.eigenvalues()[rigid], 1e-6 * eigen.eigenvalues()[a.rows() - 1]);
}

// Step for step Eigen's conjugate gradients. Eigen does not count the step that converges.
TYPED_TEST(ThermoelasticSolver, SameStepsAsEigen)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(D == 3 ? 6 : 20, 0.2);
  const LinearSystem system = systemOf(mesh, hotBox(mesh));
  for (const double tolerance : { 1e-3, 1e-6, 1e-10 })
  {
    SolverOptions options;
    options.tolerance = tolerance;
    Eigen::VectorXd x;
    const SolverReport report = fem::solve(system, options, {}, {}, x);
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> eigen(system.matrix);
    eigen.setTolerance(tolerance);
    const Eigen::VectorXd y = eigen.solve(system.right);
    EXPECT_EQ(report.status, SolverStatus::Converged);
    EXPECT_EQ(report.iterations, eigen.iterations() + 1);
    EXPECT_NEAR(report.relativeResidual / eigen.error(), 1.0, 1e-3); // Eigen's is not the true one
    EXPECT_LT((x - y).norm(), 1e-12 * y.norm());
    ASSERT_EQ(static_cast<int>(report.history.size()), report.iterations + 1);
    EXPECT_EQ(report.history.front(), 1.0);
    EXPECT_EQ(report.history.back(), report.relativeResidual);
    EXPECT_LE(report.relativeResidual, tolerance);
    EXPECT_GT(report.history[report.iterations - 1], tolerance);
    EXPECT_NEAR(
      (system.right - system.matrix * x).norm() / system.right.norm() / report.relativeResidual,
      1.0, 1e-10);
  }
}

// On flat elements the recurrence says 1e-12 where 1e-7 and worse is true.
TYPED_TEST(ThermoelasticSolver, TheResidualIsTheTrueOne)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = box<D>(D == 3 ? 5 : 16, 0.2);
  MeshEditor<D> editor(mesh);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    Vec<D> x = mesh.point(p);
    x[D - 1] *= 1e-3;
    editor.movePoint(p, x, mesh.nodes(0)[0]);
  }
  const LinearSystem system = systemOf(mesh, hotBox(mesh));
  for (const Solver solver :
    { Solver::ConjugateGradient, Solver::IncompleteCholesky, Solver::Direct })
  {
    SolverOptions options;
    options.solver = solver;
    options.tolerance = 1e-12;
    Eigen::VectorXd x;
    const SolverReport report = fem::solve(system, options, {}, {}, x);
    const double residual = (system.right - system.matrix * x).norm() / system.right.norm();
    EXPECT_NEAR(report.relativeResidual / residual, 1.0, 0.1);
    EXPECT_EQ(report.status == SolverStatus::Converged, residual <= options.tolerance);
    // As if the units were others: no square of a load overflows, and none is lost.
    for (const double factor : { 0x1p500, 0x1p-500 })
    {
      Eigen::VectorXd scaled;
      fem::solve({ system.matrix, factor * system.right }, options, {}, {}, scaled);
      EXPECT_EQ(scaled / factor, x);
    }
  }
}

TYPED_TEST(ThermoelasticSolver, AllSolversAgree)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(D == 3 ? 5 : 12, 0.2);
  for (const RigidMotion motion : { RigidMotion::Forbid, RigidMotion::Pin, RigidMotion::Project })
  {
    const Problem<D> problem = hotBox(mesh, motion);
    std::vector<Solution<D>> solutions;
    for (const Solver solver :
      { Solver::ConjugateGradient, Solver::IncompleteCholesky, Solver::Direct })
    {
      AnalysisOptions options = precise(1e-12);
      options.solver.solver = solver;
      solutions.push_back(solveOrFail(mesh, problem, options));
      EXPECT_LT(largestDifference(solutions[0].displacement, solutions.back().displacement), 1e-11);
      EXPECT_LT(largestDifference(solutions[0].stress, solutions.back().stress), 1e-8);
    }
    EXPECT_LT(solutions[1].solver.iterations, solutions[0].solver.iterations);
    EXPECT_EQ(solutions[2].solver.iterations, 0);
  }
}

// Pinned or projected: the same stresses; pins take no load.
TYPED_TEST(ThermoelasticSolver, RigidMotionChangesNoStress)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(5, 0.2);
  const Solution<D> pinned = solveOrFail(mesh, hotBox(mesh, RigidMotion::Pin), precise());
  const Solution<D> projected = solveOrFail(mesh, hotBox(mesh, RigidMotion::Project), precise());
  EXPECT_LT(largestDifference(pinned.elementStress, projected.elementStress), 1e-9);
  EXPECT_NEAR(pinned.strainEnergy / projected.strainEnergy, 1.0, 1e-10);
  for (const Constraint& pin : pinned.pins)
  {
    EXPECT_EQ(pinned.displacement[pin.point][pin.component], 0.0);
    EXPECT_LT(pinned.reaction[pin.point].norm(), 1e-10);
  }
  Vec<D> mean = Vec<D>::Zero();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (Index p : mesh.nodes(c))
    {
      mean += signedVolume(mesh.corners(c)) * projected.displacement[p];
    }
  }
  EXPECT_LT(mean.norm(), 1e-14);
}

TYPED_TEST(ThermoelasticSolver, SameBitsForAnyNumberOfThreads)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(D == 3 ? 12 : 40, 0.2);
  const Problem<D> problem = hotBox(mesh, RigidMotion::Project);
  for (const StressRecovery recovery : { StressRecovery::Patch, StressRecovery::VolumeAverage })
  {
    AnalysisOptions options;
    options.recovery = recovery;
    const Solution<D> one = solveOrFail(mesh, problem, options);
    for (const int n : { 1, 2, 3, 4 })
    {
      const Solution<D> many = solveOrFail(mesh, problem, options, threads(n));
      EXPECT_TRUE(sameBits(one.displacement, many.displacement));
      EXPECT_TRUE(sameBits(one.elementStress, many.elementStress));
      EXPECT_TRUE(sameBits(one.stress, many.stress));
      EXPECT_TRUE(sameBits(one.reaction, many.reaction));
      EXPECT_TRUE(sameBits(one.errorEstimate, many.errorEstimate));
      EXPECT_TRUE(sameBits(one.strainEnergyDensity, many.strainEnergyDensity));
      EXPECT_TRUE(sameBits(one.solver.history, many.solver.history));
      EXPECT_EQ(one.strainEnergy, many.strainEnergy);
    }
  }
}

TYPED_TEST(ThermoelasticSolver, EndsWithoutConvergence)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(5, 0.2);
  const Problem<D> problem = hotBox(mesh);
  AnalysisOptions options;
  options.solver.maximumNumberOfIterations = 3;
  Solution<D> s;
  EXPECT_FALSE(analyse(mesh, problem, options, {}, s));
  EXPECT_EQ(s.solver.status, SolverStatus::IterationLimit);
  EXPECT_EQ(s.solver.iterations, 3);
  EXPECT_GT(s.solver.relativeResidual, options.solver.tolerance);
  EXPECT_FALSE(s.stress.empty()); // what has been reached

  Control cancel;
  cancel.progress = [](double, const std::string&) { return false; };
  options.solver.maximumNumberOfIterations = 10000;
  EXPECT_FALSE(analyse(mesh, problem, options, cancel, s));
  EXPECT_EQ(s.solver.status, SolverStatus::Cancelled);
  EXPECT_EQ(s.solver.iterations, 1);
  EXPECT_TRUE(s.stress.empty());

  // A tolerance that rounding does not allow ends by the limit or by a breakdown, not never.
  options.solver.tolerance = 1e-300;
  options.solver.maximumNumberOfIterations = 5000;
  EXPECT_FALSE(analyse(mesh, problem, options, {}, s));
  EXPECT_NE(s.solver.status, SolverStatus::Converged);
  EXPECT_TRUE(std::isfinite(s.strainEnergy));
}

// Nothing to solve: zero load.
TYPED_TEST(ThermoelasticSolver, ZeroLoad)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.2);
  Problem<D> problem;
  problem.rigidMotion = RigidMotion::Pin;
  const Solution<D> s = solveOrFail(mesh, problem);
  EXPECT_EQ(s.solver.iterations, 0);
  EXPECT_EQ(s.strainEnergy, 0.0);
  EXPECT_EQ(s.relativeErrorEstimate, 0.0);
  for (const Vec<D>& u : s.displacement)
  {
    EXPECT_EQ(u.norm(), 0.0);
  }
}
