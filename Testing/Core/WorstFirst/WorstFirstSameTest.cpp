// SPDX-License-Identifier: BSD-3-Clause
// The fast engine as a whole: what it must give again.
#include "TestThreads.h"
#include "WorstFirstRuns.h"

using namespace meshopt;

template <class T>
class WorstFirstSame : public ::testing::Test
{
};
TYPED_TEST_SUITE(WorstFirstSame, TestDimensions);

TEST(WorstFirstSame3D, SameBitsForAnyNumberOfThreads)
{
  const SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(24, 0.25)); // 83 k cells: four chunks
  ASSERT_GE(mesh.countCells(), 80000);
  Options options = target(0.45);
  options.effort = Effort::Quick;
  const auto result = [&](const Control& control, int& parallel)
  {
    SimplexMesh<3> copy = mesh;
    Control counted = control;
    if (control.parallelFor)
    {
      counted.parallelFor = [&](int n, const std::function<void(int)>& body)
      {
        parallel = std::max(parallel, n);
        control.parallelFor(n, body);
      };
    }
    NodalMetric<3> metric;
    const Report report = optimize<3>(copy, metric, options, counted);
    EXPECT_GT(report.worstAfter, 0.3);
    EXPECT_TRUE(copy.audit(true).empty());
    MeshBits<3> bits = bitsOf(copy);
    long tries = 0;
    for (const PassRecord& row : report.history)
    {
      bits.coordinates.push_back(row.worst);
      bits.coordinates.push_back(row.mean);
      bits.ids.push_back(Index(row.cells));
      for (int op = 0; op < NumberOfOperations; ++op)
      {
        bits.ids.push_back(Index(row.tried[op]));
        bits.ids.push_back(Index(row.done[op]));
        tries += row.tried[op];
      }
    }
    // A try computes some qualities; hardly any take 10 000.
    EXPECT_GT(report.evaluations, tries);
    EXPECT_LT(report.evaluations, 10000 * tries);
    bits.coordinates.push_back(static_cast<double>(report.evaluations));
    return bits;
  };
  int parallel = 0;
  const MeshBits<3> alone = result({}, parallel);
  for (int n : { 1, 2, 3, 4, 8 })
  {
    EXPECT_TRUE(result(threads(n, n > 2 ? n : 0), parallel) == alone) << n << " threads";
  }
  EXPECT_GE(parallel, 4);
}

TYPED_TEST(WorstFirstSame, SameBitsInTenRuns)
{
  constexpr int D = TypeParam::dimension;
  MeshBits<D> first;
  for (int k = 0; k < 10; ++k)
  {
    SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.35, 7));
    NodalMetric<D> metric;
    optimize<D>(mesh, metric, target(0.5), {});
    if (k == 0)
    {
      first = bitsOf(mesh);
    }
    EXPECT_EQ(bitsOf(mesh), first);
  }
}

TYPED_TEST(WorstFirstSame, PowersOfTwoScaleBitwise)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(5, 0.3, 3);
  SimplexMesh<D> mesh = buildMesh(in);
  run<D>(mesh, target(0.5));
  for (int exponent : { -20, 7 })
  {
    MeshInput<D> scaled = in;
    for (Vec<D>& x : scaled.points)
    {
      x *= std::ldexp(1.0, exponent);
    }
    SimplexMesh<D> other = buildMesh(scaled);
    NodalMetric<D> metric;
    optimize<D>(other, metric, target(0.5), {});
    MeshBits<D> bits = bitsOf(other);
    for (double& x : bits.coordinates)
    {
      x = std::ldexp(x, -exponent);
    }
    EXPECT_EQ(bits, bitsOf(mesh)) << "2^" << exponent;
  }
}

TYPED_TEST(WorstFirstSame, RotationRenumberingAndMirroringChangeLittle)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.3, 5);
  const double goal = D == 3 ? 0.5 : 0.7;
  for (int kind = 0; kind < 4; ++kind)
  {
    MeshInput<D> other = in;
    if (kind == 1) // about an axis, by .5
    {
      for (Vec<D>& x : other.points)
      {
        const double a = x[0], b = x[1];
        x[0] = std::cos(0.5) * a - std::sin(0.5) * b;
        x[1] = std::sin(0.5) * a + std::cos(0.5) * b;
      }
    }
    else if (kind == 2)
    {
      const Index n = Index(in.points.size());
      for (Index p = 0; p < n; ++p)
      {
        other.points[n - 1 - p] = in.points[p];
      }
      for (Simplex<D>& cell : other.cells)
      {
        for (Index& p : cell)
        {
          p = n - 1 - p;
        }
      }
      std::reverse(other.cells.begin(), other.cells.end());
    }
    else if (kind == 3)
    {
      for (Vec<D>& x : other.points)
      {
        x[0] = -x[0];
      }
    }
    SimplexMesh<D> mesh = buildMesh(other);
    EXPECT_EQ(mesh.numberOfReorientedCells(), kind == 3 ? Index(in.cells.size()) : 0);
    const Report report = run<D>(mesh, target(goal));
    EXPECT_GE(report.worstAfter, goal - 0.02) << kind;
    EXPECT_LE(report.worstAfter, goal + 0.05) << kind;
  }
}
