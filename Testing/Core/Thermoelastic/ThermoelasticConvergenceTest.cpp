// SPDX-License-Identifier: BSD-3-Clause
// How fast the solution gets better with the mesh, against exact solutions.
#include "Optimize/Optimizer.h"
#include "ThermoelasticTesting.h"

using namespace meshopt;
using namespace meshopt::fem;

namespace
{
/// u = grad phi satisfies equilibrium without body forces under the temperature
/// dT = (1 - nu) / ((1 + nu) alpha) laplace phi (Goodier's potential); plane strain.
/// phi = sin(a x + b) exp(y) and, in space, cos(z) of it.
template <int D>
struct Goodier
{
  static constexpr double a = 2.0, b = 0.4;
  Material material{ 1.0, 0.3, 1e-3 };

  static double laplacian(const Vec<D>& x)
  {
    return value(x) * (1.0 - a * a - (D == 3 ? 1.0 : 0.0));
  }
  static double value(const Vec<D>& x) { return std::sin(a * x[0] + b) * rest(x); }
  static double rest(const Vec<D>& x)
  {
    return std::exp(x[1]) * (D == 3 ? std::cos(x[D - 1]) : 1.0);
  }
  static Vec<D> displacement(const Vec<D>& x)
  {
    Vec<D> u;
    u[0] = a * std::cos(a * x[0] + b) * rest(x);
    u[1] = value(x);
    if constexpr (D == 3)
    {
      u[2] = -std::sin(a * x[0] + b) * std::exp(x[1]) * std::sin(x[2]);
    }
    return u;
  }
  double temperature(const Vec<D>& x) const
  {
    const double nu = this->material.poissonsRatio;
    return (1.0 - nu) / ((1.0 + nu) * this->material.thermalExpansion) * laplacian(x);
  }
  Stress<D> stress(const Vec<D>& x) const
  {
    Tensor<D> g;
    g(0, 0) = -a * a * value(x);
    g(0, 1) = g(1, 0) = displacement(x)[0];
    g(1, 1) = value(x);
    if constexpr (D == 3)
    {
      g(0, 2) = g(2, 0) = -a * std::cos(a * x[0] + b) * std::exp(x[1]) * std::sin(x[2]);
      g(1, 2) = g(2, 1) = displacement(x)[2];
      g(2, 2) = -value(x);
    }
    return Elasticity<D>(this->material, PlaneState::PlaneStrain)
      .stress(g, this->temperature(x), 0.0);
  }
};

template <int D>
struct Errors
{
  double displacement, patch, average, trueEnergy, estimate;
};

template <int D>
Errors<D> goodierErrors(const SimplexMesh<D>& mesh)
{
  const Goodier<D> exact;
  Problem<D> problem;
  problem.materials = { exact.material };
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    problem.temperature.push_back(exact.temperature(mesh.point(p)));
  }
  prescribeSurface<D>(mesh, Goodier<D>::displacement, problem);
  const Solution<D> s = solveOrFail(mesh, problem, precise(1e-10));
  Errors<D> e;
  e.displacement = l2Error<D, Vec<D>>(mesh, s.displacement, Goodier<D>::displacement);
  const std::function<Stress<D>(const Vec<D>&)> stress = [&](const Vec<D>& x)
  { return exact.stress(x); };
  e.patch = l2Error<D, Stress<D>>(mesh, s.stress, stress);
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  e.average = l2Error<D, Stress<D>>(mesh,
    stressAtPoints(
      mesh, nodes, recoverStress(mesh, nodes, s.elementStress, StressRecovery::VolumeAverage, {})),
    stress);
  // The true error, by the estimator's quadrature with the exact stress at the points.
  std::vector<Stress<D>> nodal;
  for (Index p : nodes.pointOfNode)
  {
    nodal.push_back(exact.stress(mesh.point(p)));
  }
  double squares = 0.0;
  for (double x :
    estimateErrors(mesh, problem, discretize(mesh, problem, {}), nodes, s.elementStress, nodal, {}))
  {
    squares += x * x;
  }
  e.trueEnergy = std::sqrt(squares);
  e.estimate = s.totalErrorEstimate;
  return e;
}
}

namespace
{
double slope(double coarse, double fine) { return std::log2(coarse / fine); }
}

template <class T>
class ThermoelasticConvergence : public ::testing::Test
{
};
TYPED_TEST_SUITE(ThermoelasticConvergence, TestDimensions);

TYPED_TEST(ThermoelasticConvergence, Slopes)
{
  constexpr int D = TypeParam::dimension;
  // Displaced at random by more, patches lose their superconvergence: the noise is of the size of
  // the elements, however fine the mesh.
  const int n = D == 3 ? 8 : 16;
  const Errors<D> coarse = goodierErrors(box<D>(n, 0.1, 7)),
                  fine = goodierErrors(box<D>(2 * n, 0.1, 7));
  std::printf("slopes: displacement %.2f, patch recovery %.2f, volume average %.2f, energy %.2f\n",
    slope(coarse.displacement, fine.displacement), slope(coarse.patch, fine.patch),
    slope(coarse.average, fine.average), slope(coarse.trueEnergy, fine.trueEnergy));
  EXPECT_GT(slope(coarse.displacement, fine.displacement), 1.85);
  EXPECT_LT(slope(coarse.displacement, fine.displacement), 2.3);
  EXPECT_GT(slope(coarse.patch, fine.patch), 1.5);
  EXPECT_GT(slope(coarse.average, fine.average), 0.9);
  EXPECT_NEAR(slope(coarse.trueEnergy, fine.trueEnergy), 1.0, 0.15);
  // The estimate is near the truth, and gets nearer.
  std::printf("effectivity: %.3f, %.3f\n", coarse.estimate / coarse.trueEnergy,
    fine.estimate / fine.trueEnergy);
  EXPECT_NEAR(fine.estimate / fine.trueEnergy, 1.0, 0.1);
  EXPECT_LE(std::abs(fine.estimate / fine.trueEnergy - 1.0),
    std::abs(coarse.estimate / coarse.trueEnergy - 1.0) + 0.01);
}

namespace
{
/// A mesh with bad elements, as the optimizer leaves it.
SimplexMesh<3> optimizedBox(int n)
{
  SimplexMesh<3> mesh = box<3>(n, 0.25, 7);
  Options options;
  options.algorithm = Algorithm::WorstFirst;
  NodalMetric<3> metric(0.0);
  const Report report = optimize<3>(mesh, metric, options, {});
  EXPECT_LT(report.worstBefore, 0.15);
  EXPECT_GT(report.worstAfter, 0.59);
  MeshInput<3> in;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    in.points.push_back(mesh.point(p));
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      in.cells.push_back(mesh.nodes(c));
    }
  }
  return buildMesh(in);
}
}

TEST(ThermoelasticConvergenceOptimized, Slopes)
{
  const Errors<3> coarse = goodierErrors(optimizedBox(10)), fine = goodierErrors(optimizedBox(20));
  std::printf("slopes: displacement %.2f, patch recovery %.2f\n",
    slope(coarse.displacement, fine.displacement), slope(coarse.patch, fine.patch));
  EXPECT_GT(slope(coarse.displacement, fine.displacement), 1.85);
  EXPECT_GT(slope(coarse.patch, fine.patch), 1.5);
}

namespace
{
template <int D>
void setCylinder(const HotCylinder& exact, const SimplexMesh<D>& mesh, Problem<D>& problem)
{
  problem.materials = { exact.material };
  problem.rigidMotion = RigidMotion::Project;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    problem.temperature.push_back(
      exact.temperature(mesh.point(p).template head<2>().squaredNorm()));
  }
  if constexpr (D == 3)
  {
    constrainEnds(mesh, 2, exact.axialStrain(), 1e-6, problem);
  }
  else
  {
    problem.outOfPlaneStrain = exact.axialStrain();
  }
}

template <int D>
SimplexMesh<D> cylinderMesh(const HotCylinder& exact, int n)
{
  if constexpr (D == 3)
  {
    return buildMesh(cylinder(n, n, exact.radius, exact.height));
  }
  else
  {
    return buildMesh(disc(n, exact.radius));
  }
}

/// Errors of displacement and patch-recovered stress, relative to the greatest values.
template <int D>
std::array<double, 2> cylinderErrors(int n)
{
  const HotCylinder exact;
  const SimplexMesh<D> mesh = cylinderMesh<D>(exact, n);
  Problem<D> problem;
  setCylinder(exact, mesh, problem);
  const Solution<D> s = solveOrFail(mesh, problem, precise(1e-10));
  const double end = exact.radialStretch(exact.radius * exact.radius) * exact.radius;
  const double displacement = l2Error<D, Vec<D>>(mesh, s.displacement,
    [&](const Vec<D>& x)
    {
      Vec<D> u = exact.radialStretch(x.template head<2>().squaredNorm()) * x;
      if constexpr (D == 3)
      {
        u[2] = exact.axialStrain() * x[2];
      }
      return u;
    });
  const double stress = l2Error<D, Stress<D>>(
    mesh, s.stress, [&](const Vec<D>& x) { return exact.stress<D>(x); });
  return { displacement / end,
    stress / exact.stress<D>(Vec<D>(exact.radius * Vec<D>::Unit(0)))[1] };
}
}

// Section 9 of the method: the pellet under its parabolic temperature.
TYPED_TEST(ThermoelasticConvergence, HotCylinder)
{
  constexpr int D = TypeParam::dimension;
  const int n = D == 3 ? 6 : 16;
  const std::array<double, 2> coarse = cylinderErrors<D>(n), fine = cylinderErrors<D>(2 * n);
  std::printf("displacement %.2e %.2e, stress %.2e %.2e\n", coarse[0], fine[0], coarse[1], fine[1]);
  EXPECT_GT(std::log2(coarse[0] / fine[0]), 1.8);
  EXPECT_GT(std::log2(coarse[1] / fine[1]), 1.5);
  EXPECT_LT(fine[0], D == 3 ? 4e-3 : 5e-4);
  EXPECT_LT(fine[1], D == 3 ? 0.02 : 0.005);
}

// The strain at which the ends carry no force, from the elements alone, is that of the exact
// solution; and the ends carry none then.
TEST(ThermoelasticConvergenceCylinder, FreeAxialStrain)
{
  const HotCylinder exact;
  const SimplexMesh<3> mesh = buildMesh(cylinder(16, 4, exact.radius, exact.height));
  Problem<3> problem;
  setCylinder(exact, mesh, problem);
  const double strain = freeAxialStrain(mesh, problem);
  EXPECT_NEAR(strain / exact.axialStrain(), 1.0, 2e-3);
  problem.constraints.clear();
  constrainEnds(mesh, 2, strain, 1e-6, problem);
  const Solution<3> s = solveOrFail(mesh, problem, precise(1e-11));
  double pull = 0.0, size = 0.0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    pull += mesh.point(p)[2] == 0.0 ? s.reaction[p][2] : 0.0;
    size += std::abs(s.reaction[p][2]);
  }
  EXPECT_LT(std::abs(pull), 1e-9 * size);
}
