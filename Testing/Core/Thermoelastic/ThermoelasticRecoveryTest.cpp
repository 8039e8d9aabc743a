// SPDX-License-Identifier: BSD-3-Clause
// Recovery of nodal stress from element stress, apart from any solution.
#include "ThermoelasticTesting.h"

using namespace meshopt;
using namespace meshopt::fem;

template <class T>
class ThermoelasticRecovery : public ::testing::Test
{
};
TYPED_TEST_SUITE(ThermoelasticRecovery, TestDimensions);

namespace
{
template <int D>
Stress<D> linearField(const Vec<D>& x, double factor)
{
  Stress<D> s;
  for (int i = 0; i < StressSize<D>; ++i)
  {
    s[i] = factor * (1.0 + i);
    for (int k = 0; k < D; ++k)
    {
      s[i] += factor * (2.0 * k - i + 0.5) * x[k];
    }
  }
  return s;
}

template <int D>
std::vector<Stress<D>> atCentroids(
  const SimplexMesh<D>& mesh, const std::function<Stress<D>(const Vec<D>&, Index)>& field)
{
  std::vector<Stress<D>> stress;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    Vec<D> x = Vec<D>::Zero();
    for (Index p : mesh.nodes(c))
    {
      x += mesh.point(p) / (D + 1);
    }
    stress.push_back(field(x, c));
  }
  return stress;
}
}

// Also where only one point is inside (n = 2).
TYPED_TEST(ThermoelasticRecovery, PatchesReproduceLinearStress)
{
  constexpr int D = TypeParam::dimension;
  for (const int n : { 2, 3, 6 })
  {
    const SimplexMesh<D> mesh = box<D>(n, 0.2);
    const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
    ASSERT_EQ(nodes.count(), mesh.numberOfPointSlots());
    const auto stress = atCentroids<D>(
      mesh, [](const Vec<D>& x, Index) { return linearField<D>(x, 1.0); });
    for (const StressRecovery method : { StressRecovery::Patch, StressRecovery::LocalPatch })
    {
      const auto nodal = recoverStress(mesh, nodes, stress, method, {});
      for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
      {
        EXPECT_LT((nodal[p] - linearField<D>(mesh.point(p), 1.0)).norm(), 1e-10)
          << "n " << n << " point " << p;
      }
    }
  }
}

// One element: nothing to fit, its own stress.
TYPED_TEST(ThermoelasticRecovery, OneElement)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in;
  in.points.push_back(Vec<D>::Zero());
  Simplex<D> cell;
  for (int i = 0; i < D; ++i)
  {
    in.points.push_back(Vec<D>::Unit(i));
  }
  for (int i = 0; i <= D; ++i)
  {
    cell[i] = i;
  }
  in.cells.push_back(cell);
  in.points.push_back(Vec<D>::Constant(3.0)); // used by nothing
  const SimplexMesh<D> mesh = buildMesh(in);
  const std::vector<Stress<D>> stress = { linearField<D>(Vec<D>::Constant(0.3), 1.0) };
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  for (const StressRecovery method :
    { StressRecovery::Patch, StressRecovery::LocalPatch, StressRecovery::VolumeAverage })
  {
    const auto points = stressAtPoints(mesh, nodes, recoverStress(mesh, nodes, stress, method, {}));
    ASSERT_EQ(points.size(), in.points.size());
    for (int i = 0; i <= D; ++i)
    {
      EXPECT_LT((points[i] - stress[0]).norm(), 1e-14);
    }
    EXPECT_EQ(points.back().norm(), 0.0);
  }
}

// Two linear fields that jump at the border of the regions: exact on both sides, the mean on it.
TYPED_TEST(ThermoelasticRecovery, DoesNotLookAcrossRegions)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(6, 0.0);
  splitRegions(in);
  const SimplexMesh<D> mesh = buildMesh(in);
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  const Index onBorder = D == 3 ? 49 : 7;
  ASSERT_EQ(nodes.count(), mesh.numberOfPointSlots() + onBorder);
  const auto factor = [](Index region) { return region == 0 ? 1.0 : -3.0; };
  const auto stress = atCentroids<D>(
    mesh, [&](const Vec<D>& x, Index c) { return linearField<D>(x, factor(mesh.region(c))); });
  for (const StressRecovery method : { StressRecovery::Patch, StressRecovery::LocalPatch })
  {
    const auto nodal = recoverStress(mesh, nodes, stress, method, {});
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Stress<D> exact = linearField<D>(
          mesh.point(mesh.nodes(c)[i]), factor(mesh.region(c)));
        EXPECT_LT((nodal[nodes.cells[c][i]] - exact).norm(), 1e-9);
      }
    }
    const auto points = stressAtPoints(mesh, nodes, nodal);
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      const double x = mesh.point(p)[0];
      if (std::abs(x - 0.5) > 0.01)
      {
        EXPECT_LT((points[p] - linearField<D>(mesh.point(p), x < 0.5 ? 1.0 : -3.0)).norm(), 1e-9);
      }
    }
  }
}

// By hand: volume averages, and the estimate of a stress whose error is one constant.
TYPED_TEST(ThermoelasticRecovery, AverageAndEstimateByHand)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.2);
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  const auto stress = atCentroids<D>(
    mesh, [](const Vec<D>&, Index c) { return Stress<D>(Stress<D>::Unit(0) * double(c)); });
  const auto nodal = recoverStress(mesh, nodes, stress, StressRecovery::VolumeAverage, {});
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    double sum = 0.0, volume = 0.0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      const double v = mesh.localIndex(c, p) >= 0 ? signedVolume(mesh.corners(c)) : 0.0;
      sum += v * c;
      volume += v;
    }
    EXPECT_NEAR(nodal[p][0], sum / volume, 1e-10);
  }
  Problem<D> problem;
  problem.materials = { { 4.0, 0.3, 0.0 } };
  const std::vector<Stress<D>> zero(mesh.numberOfCellSlots(), Stress<D>::Zero());
  const std::vector<Stress<D>> pull(nodes.count(), Stress<D>(Stress<D>::Unit(1) * 2.0));
  const auto errors = estimateErrors(
    mesh, problem, discretize(mesh, problem, {}), nodes, zero, pull, {});
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    // sigma : C^-1 : sigma = sigma^2 / E
    EXPECT_NEAR(errors[c], std::sqrt(signedVolume(mesh.corners(c)) * 4.0 / 4.0), 1e-14);
  }
}
