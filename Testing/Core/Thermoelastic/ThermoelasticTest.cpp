// SPDX-License-Identifier: BSD-3-Clause
// Linear thermoelasticity against solutions that P1 elements represent exactly, and against
// statics: what any correct program must give on any mesh, whatever its size.
#include "Thermoelastic/Loads.h"
#include "ThermoelasticTesting.h"

using namespace meshopt;
using namespace meshopt::fem;

template <class T>
class Thermoelastic : public ::testing::Test
{
};
TYPED_TEST_SUITE(Thermoelastic, TestDimensions);

namespace
{
template <int D>
Tensor<D> someGradient()
{
  Tensor<D> g;
  for (int i = 0; i < D; ++i)
  {
    for (int j = 0; j < D; ++j)
    {
      g(i, j) = 1e-3 * (1.0 + 2.0 * i - 3.0 * j + (i == j ? 1.5 : 0.0) * (i + 1));
    }
  }
  return g;
}

/// Stress by the textbook's form with E and nu, written down a second time.
template <int D>
Stress<D> hooke(const Tensor<D>& g, const Material& m, PlaneState state, double dT)
{
  const double E = m.youngsModulus, nu = m.poissonsRatio, a = m.thermalExpansion * dT;
  const double shear = E / (2.0 * (1.0 + nu));
  Stress<D> s = Stress<D>::Zero();
  if (D == 2 && state == PlaneState::PlaneStress)
  {
    const double x = g(0, 0) - a, y = g(1, 1) - a;
    s[0] = E / (1.0 - nu * nu) * (x + nu * y);
    s[1] = E / (1.0 - nu * nu) * (y + nu * x);
  }
  else
  {
    double e[3] = { g(0, 0) - a, g(1, 1) - a, (D == 3 ? g(D - 1, D - 1) : 0.0) - a };
    for (int i = 0; i < 3; ++i)
    {
      s[i] = E / ((1.0 + nu) * (1.0 - 2.0 * nu)) *
        ((1.0 - nu) * e[i] + nu * (e[(i + 1) % 3] + e[(i + 2) % 3]));
    }
  }
  s[3] = shear * (g(0, 1) + g(1, 0));
  if constexpr (D == 3)
  {
    s[4] = shear * (g(1, 2) + g(2, 1));
    s[5] = shear * (g(0, 2) + g(2, 0));
  }
  return s;
}
}

// A linear displacement on the surface and a uniform temperature: the same linear displacement and
// one stress everywhere.
TYPED_TEST(Thermoelastic, PatchTestIsExact)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(D == 3 ? 4 : 8, 0.15);
  const Tensor<D> g = someGradient<D>();
  for (const PlaneState state : { PlaneState::PlaneStrain, PlaneState::PlaneStress })
  {
    for (const StressRecovery recovery :
      { StressRecovery::Patch, StressRecovery::LocalPatch, StressRecovery::VolumeAverage })
    {
      Problem<D> problem;
      problem.planeState = state;
      problem.materials = { { 3.0, 0.28, 2e-5 } };
      problem.temperature.assign(mesh.numberOfPointSlots(), 70.0);
      problem.referenceTemperature = 20.0;
      prescribeSurface<D>(
        mesh, [&](const Vec<D>& x) { return Vec<D>(g * x); }, problem);
      AnalysisOptions options = precise();
      options.recovery = recovery;
      const Solution<D> s = solveOrFail(mesh, problem, options);
      const Stress<D> exact = hooke<D>(g, problem.materials[0], state, 50.0);
      for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
      {
        EXPECT_LT((s.displacement[p] - g * mesh.point(p)).norm(), 1e-10 * g.norm());
        EXPECT_LT((s.stress[p] - exact).norm(), 1e-10 * exact.norm());
      }
      for (const Stress<D>& stress : s.elementStress)
      {
        EXPECT_LT((stress - exact).norm(), 1e-10 * exact.norm());
      }
      EXPECT_LT(s.relativeErrorEstimate, 1e-10);
    }
  }
}

TYPED_TEST(Thermoelastic, FreeExpansionGivesNoStress)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.15);
  for (const RigidMotion motion : { RigidMotion::Pin, RigidMotion::Project })
  {
    Problem<D> problem;
    problem.planeState = PlaneState::PlaneStress;
    problem.materials = { { 200.0, 0.3, 1e-5 } };
    problem.temperature.assign(mesh.numberOfPointSlots(), 1000.0);
    problem.rigidMotion = motion;
    const Solution<D> s = solveOrFail(mesh, problem, precise());
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      EXPECT_LT(s.elementStress[c].norm(), 1e-10 * 200.0 * 0.01);
    }
    EXPECT_LT(s.strainEnergy, 1e-20);
    // Distances grow by alpha dT, whichever way it lies.
    const Vec<D> grown = s.displacement[mesh.numberOfPointSlots() - 1] - s.displacement[0];
    const Vec<D> across = mesh.point(mesh.numberOfPointSlots() - 1) - mesh.point(0);
    EXPECT_NEAR(grown.dot(across) / across.squaredNorm(), 0.01, 1e-11);
    if (motion == RigidMotion::Project)
    {
      // The centre stays.
      for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
      {
        const Vec<D> r = mesh.point(p) - Vec<D>::Constant(0.5);
        EXPECT_LT(
          (s.displacement[p] - 0.01 * r).norm(), 2e-4); // centre of volume of jittered points
      }
    }
    else
    {
      EXPECT_EQ(s.pins.size(), D == 3 ? 6u : 3u);
    }
  }
}

// Pressure all around: sigma = -p I, from the consistent forces alone.
TYPED_TEST(Thermoelastic, PressureAllAround)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.15);
  Problem<D> problem;
  problem.materials = { { 10.0, 0.25, 0.0 } };
  problem.planeState = PlaneState::PlaneStress;
  problem.rigidMotion = RigidMotion::Project;
  problem.forces.assign(mesh.numberOfPointSlots(), Vec<D>::Zero());
  for (const Facet<D>& facet : surfaceFacets(mesh))
  {
    std::array<double, D> pressure;
    pressure.fill(0.7);
    addPressure<D>(mesh, facet, pressure, problem.forces);
  }
  const Solution<D> s = solveOrFail(mesh, problem, precise());
  Stress<D> exact = Stress<D>::Zero();
  exact.template head<D>().setConstant(-0.7);
  for (const Stress<D>& stress : s.elementStress)
  {
    EXPECT_LT((stress - exact).norm(), 1e-10);
  }
}

// Two materials in a row, pulled: each has its own strain, both have one stress; statics and
// energy.
TYPED_TEST(Thermoelastic, TwoMaterialsInARow)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  splitRegions(in);
  const SimplexMesh<D> mesh = buildMesh(in);
  Problem<D> problem;
  problem.planeState = PlaneState::PlaneStress;
  problem.materials.clear();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    problem.materials.push_back({ mesh.region(c) == 0 ? 1.0 : 4.0, 0.0, 0.0 });
  }
  problem.forces.assign(mesh.numberOfPointSlots(), Vec<D>::Zero());
  for (const Facet<D>& facet : surfaceFacets(mesh))
  {
    const auto x = facetCorners<D>(mesh, facet);
    if (std::all_of(x.begin(), x.end(), [](const Vec<D>& y) { return y[0] == 1.0; }))
    {
      std::array<Vec<D>, D> traction;
      traction.fill(2.0 * Vec<D>::Unit(0));
      addTraction<D>(mesh, facet, traction, problem.forces);
    }
  }
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    for (int i = 0; i < D && mesh.point(p)[0] == 0.0; ++i)
    {
      problem.constraints.push_back({ p, i, 0.0 });
    }
  }
  const Solution<D> s = solveOrFail(mesh, problem, precise());
  Vec<D> reaction = Vec<D>::Zero();
  double work = 0.0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const double x = mesh.point(p)[0];
    EXPECT_NEAR(s.displacement[p][0], x < 0.5 ? 2.0 * x : 1.0 + 0.5 * (x - 0.5), 1e-11);
    EXPECT_NEAR(s.stress[p][0], 2.0, 1e-10);
    if (x > 0.0)
    {
      EXPECT_EQ(s.reaction[p].norm(), 0.0);
    }
    reaction += s.reaction[p];
    work += 0.5 * problem.forces[p].dot(s.displacement[p]);
  }
  EXPECT_LT((reaction + 2.0 * Vec<D>::Unit(0)).norm(), 1e-11);
  EXPECT_NEAR(s.strainEnergy, work, 1e-11);
  EXPECT_NEAR(s.strainEnergy, 0.5 * 2.0 * (1.0 + 0.25), 1e-11);
  EXPECT_LT(s.relativeErrorEstimate, 1e-10);
}

// All displacement prevented, temperature linear: sigma = -beta dT(x), which the recovered stress
// has exactly, and which the estimate must not take for an error.
TYPED_TEST(Thermoelastic, PreventedExpansionUnderLinearTemperature)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.15);
  Problem<D> problem;
  problem.materials = { { 5.0, 0.3, 1e-3 } };
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    problem.temperature.push_back(10.0 + 3.0 * mesh.point(p)[0] - mesh.point(p)[1]);
    for (int i = 0; i < D; ++i)
    {
      problem.constraints.push_back({ p, i, 0.0 });
    }
  }
  const Solution<D> s = solveOrFail(mesh, problem);
  EXPECT_EQ(s.numberOfUnknowns, 0);
  const double beta = 5.0 / (1.0 - 0.6) * 1e-3;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(s.stress[p][i], -beta * problem.temperature[p], 1e-12);
    }
  }
  EXPECT_LT(s.relativeErrorEstimate, 1e-12);
}

// Ends held and pulled along an axis, uniform temperature: u_z = eps z, sides free.
TYPED_TEST(Thermoelastic, EndsAlongAnAxis)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.15);
  for (int axis = 0; axis < D; ++axis)
  {
    Problem<D> problem;
    problem.planeState = PlaneState::PlaneStress;
    problem.materials = { { 2.0, 0.3, 1e-4 } };
    problem.temperature.assign(mesh.numberOfPointSlots(), 100.0);
    problem.rigidMotion = RigidMotion::Pin;
    EXPECT_NEAR(freeAxialStrain(mesh, problem), 0.01, 1e-15);
    constrainEnds(mesh, axis, 0.03, 1e-6, problem);
    const Solution<D> s = solveOrFail(mesh, problem, precise());
    EXPECT_EQ(s.pins.size(), D == 3 ? 3u : 1u);
    Stress<D> exact = Stress<D>::Zero();
    exact[axis] = 2.0 * (0.03 - 0.01);
    for (const Stress<D>& stress : s.elementStress)
    {
      EXPECT_LT((stress - exact).norm(), 1e-11);
    }
  }
}

TEST(ThermoelasticPlane, StrainOutOfThePlane)
{
  const SimplexMesh<2> mesh = box<2>(4, 0.15);
  Problem<2> problem;
  problem.materials = { { 2.0, 0.3, 1e-4 } };
  problem.temperature.assign(mesh.numberOfPointSlots(), 100.0);
  problem.rigidMotion = RigidMotion::Project;
  problem.outOfPlaneStrain = 0.03;
  const Solution<2> s = solveOrFail(mesh, problem, precise());
  for (const Stress<2>& stress : s.elementStress)
  {
    EXPECT_LT((stress - Stress<2>(0.0, 0.0, 0.04, 0.0)).norm(), 1e-11);
  }
}

TEST(ThermoelasticStress, VonMisesAndPrincipalStresses)
{
  Stress<3> s;
  s << 3.0, 1.0, -2.0, 0.5, -1.5, 2.5;
  const Vec<3> p = principalStresses<3>(s);
  EXPECT_GE(p[0], p[1]);
  EXPECT_GE(p[1], p[2]);
  const Tensor<3> t = toTensor<3>(s);
  EXPECT_NEAR(p.sum(), t.trace(), 1e-13);
  EXPECT_NEAR(p.prod(), Eigen::Matrix3d(t).determinant(), 1e-12);
  EXPECT_NEAR(p.squaredNorm(), squaredNorm<3>(s), 1e-12);
  const double mises = std::sqrt(
    0.5 * (std::pow(p[0] - p[1], 2) + std::pow(p[1] - p[2], 2) + std::pow(p[2] - p[0], 2)));
  EXPECT_NEAR(vonMises<3>(s), mises, 1e-13);
  EXPECT_NEAR(vonMises<3>(Stress<3>(Stress<3>::Unit(0) * -7.0)), 7.0, 1e-13);
  EXPECT_NEAR(vonMises<2>(Stress<2>(0.0, 0.0, 0.0, 2.0)), 2.0 * std::sqrt(3.0), 1e-13);
  EXPECT_EQ(vonMises<3>(Stress<3>(Stress<3>::Zero())), 0.0);
  EXPECT_NEAR(principalStresses<2>(Stress<2>(1.0, 1.0, 5.0, 2.0))[0], 5.0, 1e-13);
  EXPECT_NEAR(principalStresses<2>(Stress<2>(1.0, 1.0, 5.0, 2.0))[2], -1.0, 1e-13);
}
