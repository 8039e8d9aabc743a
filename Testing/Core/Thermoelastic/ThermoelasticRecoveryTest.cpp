// SPDX-License-Identifier: BSD-3-Clause
// Recovery of nodal stress from element stress, apart from any solution.
#include "Thermoelastic/StressRecovery.h"
#include "ThermoelasticTesting.h"

#include <Eigen/QR>

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

namespace
{
/// A stress that no linear polynomial is.
template <int D>
Stress<D> wavyField(const Vec<D>& x)
{
  return linearField<D>(x, 1.0) * (1.0 + std::sin(4.0 * x[0]) * x[D - 1]);
}

template <int D>
Vec<D> centroidOf(const SimplexMesh<D>& mesh, Index c)
{
  Vec<D> x = Vec<D>::Zero();
  for (Index p : mesh.nodes(c))
  {
    x += mesh.point(p) / (D + 1);
  }
  return x;
}

/// The value at x of the linear polynomial of least squares: by the dense problem.
template <int D>
Stress<D> leastSquares(const SimplexMesh<D>& mesh, const std::vector<Stress<D>>& stress,
  const std::set<Index>& cells, const Vec<D>& x)
{
  Eigen::MatrixXd a(cells.size(), D + 1), b(cells.size(), StressSize<D>);
  int row = 0;
  for (Index c : cells)
  {
    a.row(row) << 1.0, (centroidOf(mesh, c) - x).transpose();
    b.row(row++) = stress[c].transpose();
  }
  return a.colPivHouseholderQr().solve(b).row(0).transpose();
}

template <int D>
std::set<Index> cellsAt(const SimplexMesh<D>& mesh, Index point)
{
  std::set<Index> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.localIndex(c, point) >= 0)
    {
      cells.insert(c);
    }
  }
  return cells;
}

template <int D>
std::set<Index> nodesOf(const SimplexMesh<D>& mesh, const std::set<Index>& cells)
{
  std::set<Index> nodes;
  for (Index c : cells)
  {
    nodes.insert(mesh.nodes(c).begin(), mesh.nodes(c).end());
  }
  return nodes;
}
}

// Inside, the fit to the cells around; on the surface, the mean of the fits of all points inside
// that share a cell.
TYPED_TEST(ThermoelasticRecovery, PatchIsTheFitByBruteForce)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.2);
  const auto stress = atCentroids<D>(mesh, [](const Vec<D>& x, Index) { return wavyField<D>(x); });
  const auto nodal = recoverStress(mesh, makeRecoveryMesh(mesh), stress, StressRecovery::Patch, {});
  int onSurface = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const std::set<Index> own = cellsAt(mesh, p);
    const Vec<D> x = mesh.point(p);
    Stress<D> sum = Stress<D>::Zero();
    int count = 0;
    for (Index n : nodesOf(mesh, own))
    {
      if (mesh.isBoundary(p) ? !mesh.isBoundary(n) : n == p)
      {
        sum += leastSquares<D>(mesh, stress, cellsAt(mesh, n), x);
        ++count;
      }
    }
    if (count > 0) // not in a corner all cells of which lie on the surface
    {
      EXPECT_LT((nodal[p] - sum / count).norm(), 1e-10) << "point " << p;
      onSurface += mesh.isBoundary(p);
    }
  }
  EXPECT_GT(onSurface, D == 3 ? 50 : 10);
}

// The cells around; where these are fewer than a quadratic polynomial has coefficients, those of
// their nodes too, and so on.
TYPED_TEST(ThermoelasticRecovery, LocalPatchGrowsLayerByLayer)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(4, 0.2);
  const auto stress = atCentroids<D>(mesh, [](const Vec<D>& x, Index) { return wavyField<D>(x); });
  const auto nodal = recoverStress(
    mesh, makeRecoveryMesh(mesh), stress, StressRecovery::LocalPatch, {});
  int grown = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    std::set<Index> cells = cellsAt(mesh, p);
    while (cells.size() < (D == 3 ? 10u : 6u))
    {
      ++grown;
      for (Index n : nodesOf(mesh, std::set<Index>(cells)))
      {
        cells.merge(cellsAt(mesh, n));
      }
    }
    const Vec<D> x = mesh.point(p);
    EXPECT_LT((nodal[p] - leastSquares<D>(mesh, stress, cells, x)).norm(), 1e-9) << "point " << p;
  }
  EXPECT_GT(grown, 4);
}

// A fan has no more cells than those around its centre: six determine a local fit, five do not.
TEST(ThermoelasticRecovery2D, LocalPatchNeedsSixCells)
{
  for (int n : { 5, 6, 7 })
  {
    MeshInput<2> in;
    in.points.push_back(Vec<2>::Zero());
    for (int k = 0; k < n; ++k)
    {
      const double angle = 2.0 * M_PI * k / n, radius = 1.0 + 0.1 * k;
      in.points.push_back(radius * Vec<2>(std::cos(angle), std::sin(angle)));
      in.cells.push_back({ 0, 1 + k, 1 + (k + 1) % n });
    }
    const SimplexMesh<2> mesh = buildMesh(in);
    const RecoveryMesh<2> nodes = makeRecoveryMesh(mesh);
    const auto stress = atCentroids<2>(
      mesh, [](const Vec<2>& x, Index) { return wavyField<2>(x); });
    const auto at = [&](StressRecovery method)
    { return recoverStress(mesh, nodes, stress, method, {})[0]; };
    const Stress<2> fit = leastSquares<2>(mesh, stress, cellsAt(mesh, 0), mesh.point(0));
    const Stress<2> mean = at(StressRecovery::VolumeAverage);
    ASSERT_GT((fit - mean).norm(), 1e-3);
    EXPECT_LT((at(StressRecovery::LocalPatch) - (n < 6 ? mean : fit)).norm(), 1e-12) << n;
    EXPECT_LT((at(StressRecovery::Patch) - fit).norm(), 1e-12) << n;
  }
}

// Where regions meet, the mean by volume of what they say.
TYPED_TEST(ThermoelasticRecovery, PointsTakeTheMeanOfTheirRegionsByVolume)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  splitRegions(in);
  const SimplexMesh<D> mesh = buildMesh(in);
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  const auto ofRegion = [](Index region)
  { return linearField<D>(Vec<D>::Zero(), region == 0 ? 1.0 : -3.0); };
  const auto stress = atCentroids<D>(
    mesh, [&](const Vec<D>&, Index c) { return ofRegion(mesh.region(c)); });
  const auto points = stressAtPoints(
    mesh, nodes, recoverStress(mesh, nodes, stress, StressRecovery::VolumeAverage, {}));
  int mixed = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    double volume[2] = { 0.0, 0.0 };
    for (Index c : cellsAt(mesh, p))
    {
      volume[mesh.region(c)] += signedVolume(mesh.corners(c));
    }
    const Stress<D> mean = (volume[0] * ofRegion(0) + volume[1] * ofRegion(1)) /
      (volume[0] + volume[1]);
    EXPECT_LT((points[p] - mean).norm(), 1e-12 * mean.norm() + 1e-12);
    mixed += volume[0] > 0.0 && volume[1] > 0.0;
  }
  EXPECT_GT(mixed, D == 3 ? 20 : 4);
}

// Any recovered stress and temperature: the integral by a quadrature that is exact for squares of
// linear functions.
TYPED_TEST(ThermoelasticRecovery, EstimateIsTheIntegralOfTheDifference)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.2);
  const RecoveryMesh<D> nodes = makeRecoveryMesh(mesh);
  TestRandom random(5);
  Problem<D> problem;
  problem.materials = { { 4.0, 0.3, 0.02 } };
  problem.referenceTemperature = 7.0;
  std::vector<Stress<D>> nodal(nodes.count()), element(mesh.numberOfCellSlots());
  for (auto* list : { &nodal, &element })
  {
    for (Stress<D>& s : *list)
    {
      for (int i = 0; i < StressSize<D>; ++i)
      {
        s[i] = random();
      }
    }
  }
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    problem.temperature.push_back(20.0 * random());
  }
  const auto errors = estimateErrors(
    mesh, problem, discretize(mesh, problem, {}), nodes, element, nodal, {});
  const Elasticity<D> law(problem.materials[0], problem.planeState);
  const double high = D == 3 ? (5.0 + 3.0 * std::sqrt(5.0)) / 20.0 : 2.0 / 3.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    double mean = 0.0;
    for (Index p : mesh.nodes(c))
    {
      mean += problem.temperature[p] / (D + 1);
    }
    double sum = 0.0;
    for (int i = 0; i <= D; ++i)
    {
      Stress<D> recovered = Stress<D>::Zero();
      double temperature = 0.0;
      for (int k = 0; k <= D; ++k)
      {
        const double weight = k == i ? high : (1.0 - high) / D;
        recovered += weight * nodal[nodes.cells[c][k]];
        temperature += weight * problem.temperature[mesh.nodes(c)[k]];
      }
      // The strain is constant: the stress of the solution differs from that of the centroid by
      // what the temperature does.
      const Stress<D> e = recovered - element[c] - law.thermalStress(temperature - mean);
      sum += law.energyProduct(e) / (D + 1);
    }
    EXPECT_NEAR(errors[c], std::sqrt(signedVolume(mesh.corners(c)) * sum), 1e-12);
  }
}
