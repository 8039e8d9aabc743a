// SPDX-License-Identifier: BSD-3-Clause
// The limit on how fast a metric changes, and the intersection of metrics that it is made with.
#include "Metric/Gradation.h"
#include "Metric/SolutionMetric.h"
#include "Metric/TensorFunctions.h"

#include "TestMeshes.h"

#include <Eigen/LU>

using namespace meshopt;

namespace
{
template <int D>
Tensor<D> randomSymmetric(TestRandom& random)
{
  Tensor<D> t;
  for (int i = 0; i < D * D; ++i)
  {
    t(i) = random();
  }
  return t + t.transpose();
}

template <int D>
Tensor<D> randomMetric(TestRandom& random)
{
  return exponential<D>(Tensor<D>(2.0 * randomSymmetric<D>(random)));
}

/// A layer: second derivatives from 0 to large, in one direction only.
template <int D>
double layer(const Vec<D>& x)
{
  return std::tanh(20.0 * (x[0] + 0.3 * x[1] - 0.6));
}

template <int D>
SolutionMetric<D> metricOf(const MeshInput<D>& in, const SolutionMetricOptions& options)
{
  std::vector<double> values;
  for (const Vec<D>& x : in.points)
  {
    values.push_back(layer<D>(x));
  }
  SolutionMetric<D> metric;
  EXPECT_EQ(solutionMetric(buildMesh(in), values, 1, options, metric), "");
  return metric;
}

}

template <class T>
class Gradation : public testing::Test
{
};
TYPED_TEST_SUITE(Gradation, TestDimensions);

TYPED_TEST(Gradation, IntersectionIsAtLeastBoth)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(3);
  for (int k = 0; k < 300; ++k)
  {
    const Tensor<D> a = randomMetric<D>(random), b = randomMetric<D>(random);
    const Tensor<D> m = intersection<D>(a, b);
    const double tolerance = 1e-12 * m.norm();
    EXPECT_GT(SymmetricEigen<D>::of(Tensor<D>(m - a)).values[0], -tolerance);
    EXPECT_GT(SymmetricEigen<D>::of(Tensor<D>(m - b)).values[0], -tolerance);
    EXPECT_LT((m - intersection<D>(b, a)).norm(), 1e-10 * m.norm());
    // no more than needed: in each of the common axes it is the one or the other
    EXPECT_LT(((m - a) * m.inverse() * (m - b)).norm(), 1e-9 * m.norm());
    EXPECT_LT((intersection<D>(a, Tensor<D>(0.5 * a)) - a).norm(), 1e-12 * a.norm());
  }
}

/// What the fixpoint means, on each edge and both ways: no point asks for more than 1 + l ln g of
/// its neighbour's lengths.
TYPED_TEST(Gradation, GradationHoldsOnEveryEdge)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 2 ? 16 : 8, 0.25);
  const SimplexMesh<D> mesh = buildMesh(in);
  SolutionMetricOptions options;
  options.desiredCount = 2000.0;
  const SolutionMetric<D> free = metricOf<D>(in, options);
  const double gradation = 1.3;
  options.limits.gradation = gradation;
  const SolutionMetric<D> metric = metricOf<D>(in, options);
  const auto missing = [&](const SolutionMetric<D>& m)
  {
    double most = 0.0;
    const double h2 = std::pow(m.desiredSize, 2);
    for (const Simplex<D>& cell : in.cells)
    {
      for (Index p : cell)
      {
        for (Index q : cell)
        {
          const Vec<D> edge = in.points[q] - in.points[p];
          const Tensor<D> unit = m.tensors[p] / h2;
          const double growth = 1.0 + std::sqrt(edge.dot(unit * edge)) * std::log(gradation);
          const Tensor<D> least = unit / (growth * growth), there = m.tensors[q] / h2;
          // how much greater than there, in the worst direction
          Tensor<D> ln;
          EXPECT_TRUE(logarithm<D>(there, ln));
          const Tensor<D> root = exponential<D>(Tensor<D>(-0.5 * ln));
          const Tensor<D> ratio = root * least * root;
          most = std::max(most, SymmetricEigen<D>::of(ratio).values[D - 1] - 1.0);
        }
      }
    }
    return most;
  };
  EXPECT_GT(missing(free), 0.1) << "or the test shows nothing";
  EXPECT_LE(missing(metric), 1.01e-3);
  EXPECT_NEAR(metric.predictedCount, 2000.0, 3.0);
  // and nothing was made weaker than without
  std::vector<Tensor<D>> same(in.points.size(), Tensor<D>(3.0 * Tensor<D>::Identity()));
  EXPECT_EQ(limitGradation(mesh, PointGraph::of(mesh), gradation, same), 1);
}
