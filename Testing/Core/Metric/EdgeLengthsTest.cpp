// SPDX-License-Identifier: BSD-3-Clause
// Lengths of edges by what is wanted, the number of elements that follows, and their histogram.
#include "Metric/EdgeLengths.h"
#include "PlaneMeshes.h"

#include <limits>
#include <numeric>

using namespace meshopt;

TEST(EdgeLengths, LogarithmicMean)
{
  EXPECT_DOUBLE_EQ(logMeanLength(2.0, 2.0), 2.0);
  EXPECT_NEAR(logMeanLength(1.0, 4.0), 3.0 / std::log(4.0), 1e-15);
  EXPECT_DOUBLE_EQ(logMeanLength(1.0, 4.0), logMeanLength(4.0, 1.0));
  // no step where the formula changes over
  for (double r : { 0.9e-4, 1.1e-4 })
  {
    const double exact = 1.0 + r / 2.0 + r * r / 6.0; // (e^r - 1) / r
    EXPECT_NEAR(logMeanLength(1.0, std::exp(r)), exact, 2e-9);
  }
  // between the smaller and the arithmetic mean, and by the integral of exp(linear)
  double sum = 0.0;
  for (int k = 0; k < 1000; ++k)
  {
    sum += std::pow(5.0, (k + 0.5) / 1000) / 1000;
  }
  EXPECT_NEAR(logMeanLength(1.0, 5.0), sum, 1e-5);
}

/// Edges without length (two points at one place), and those that a double cannot measure.
TEST(EdgeLengths, NoneAndTooLong)
{
  EXPECT_EQ(logMeanLength(0.0, 0.0), 0.0);
  EXPECT_EQ(logMeanLength(0.0, 1.0), 0.0);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(logMeanLength(infinity, infinity), infinity);
  MeshInput<2> in = twoTriangles();
  in.points[1] = in.points[0];
  for (double size : { 1.0, 1e200, 1e-200 })
  {
    const EdgeLengths l = measureEdges<2>(buildMesh(in), NodalMetric<2>(size));
    EXPECT_EQ(l.edges, 5);
    EXPECT_EQ(std::accumulate(l.histogram.begin(), l.histogram.end(), 0L), 5);
    EXPECT_GE(l.histogram.front(), 1);
  }
}

TEST(EdgeLengths, OfGridsBySizeAndMetric)
{
  const SimplexMesh<2> mesh = buildMesh(jitteredGrid<2>(10, 0.0));
  NodalMetric<2> metric(0.1);
  EXPECT_NEAR(edgeLength<2>(mesh, metric, 0, 1), 1.0, 1e-14);
  EXPECT_NEAR(edgeLength<2>(mesh, metric, 0, 12), std::sqrt(2.0), 1e-14);
  const EdgeLengths l = measureEdges<2>(mesh, NodalMetric<2>(0.12));
  const long edges = 2 * 10 * 11 + 10 * 10; // along the axes, and the diagonals
  EXPECT_EQ(l.edges, edges);
  EXPECT_NEAR(l.shortest, 1.0 / 1.2, 1e-14);
  EXPECT_NEAR(l.longest, std::sqrt(2.0) / 1.2, 1e-14);
  EXPECT_EQ(l.share, 1.0);
  const EdgeLengths shorter = measureEdges<2>(mesh, NodalMetric<2>(0.19));
  EXPECT_NEAR(shorter.share, 100.0 / edges, 1e-14); // only the diagonals, which are .74
  long all = 0;
  for (std::size_t k = 0; k < shorter.histogram.size(); ++k)
  {
    all += shorter.histogram[k];
    EXPECT_NEAR(EdgeLengths::lowerEnd(k), std::exp2(k / 4.0 - 3.0), 1e-15);
  }
  EXPECT_EQ(all, edges);
  EXPECT_EQ(measureEdges<2>(buildMesh(MeshInput<2>()), metric).edges, 0);

  // M = diag(16, 1): x counts four times
  Tensor<2> m = Tensor<2>::Identity();
  m(0, 0) = 16.0;
  NodalMetric<2> stretched(0.1);
  EXPECT_EQ(stretched.set(mesh, {}, std::vector<Tensor<2>>(121, m)), "");
  EXPECT_NEAR(edgeLength<2>(mesh, stretched, 0, 1), 4.0, 1e-13);
  EXPECT_NEAR(edgeLength<2>(mesh, stretched, 0, 11), 1.0, 1e-13);
  EXPECT_NEAR(stretched.unitTensor(5)(0, 0), 1600.0, 1e-10);
  EXPECT_NEAR(stretched.unitTensor(5)(1, 1), 100.0, 1e-11);
  EXPECT_NEAR(stretched.predictedNumberOfElements(mesh), 4.0 * 400.0 / std::sqrt(3.0), 1e-9);
  // sizes that differ: the logarithmic mean
  std::vector<double> sizes(121, 0.1);
  sizes[1] = 0.4;
  NodalMetric<2> sized;
  EXPECT_EQ(sized.set(mesh, sizes, {}), "");
  EXPECT_NEAR(edgeLength<2>(mesh, sized, 0, 1), logMeanLength(1.0, 0.25), 1e-14);
}

TEST(EdgeLengths, PredictedNumbers)
{
  // (4 / sqrt 3) vol / h^2; 6 sqrt 2 vol / h^3
  EXPECT_NEAR(NodalMetric<2>(0.02).predictedNumberOfElements(buildMesh(twoTriangles())),
    4.0 / std::sqrt(3.0) * 2500.0, 1e-8);
  EXPECT_NEAR(NodalMetric<3>(0.1).predictedNumberOfElements(buildMesh(jitteredGrid<3>(2, 0.1))),
    6.0 * std::sqrt(2.0) * 1000.0, 1e-8);
  // regular elements themselves count right
  MeshInput<2> regular;
  regular.points = { { 0, 0 }, { 1, 0 }, { 0.5, std::sqrt(0.75) } };
  regular.cells = { { 0, 1, 2 } };
  EXPECT_NEAR(NodalMetric<2>(1.0).predictedNumberOfElements(buildMesh(regular)), 1.0, 1e-14);
}

TEST(EdgeLengths, SumsOfBlocks)
{
  const EdgeLengths a = measureEdges<2>(buildMesh(jitteredGrid<2>(4, 0.2)), NodalMetric<2>(0.3));
  const EdgeLengths b = measureEdges<2>(buildMesh(jitteredGrid<2>(7, 0.2)), NodalMetric<2>(0.3));
  EdgeLengths sum;
  sum.add(a);
  EXPECT_EQ(sum.share, a.share);
  EXPECT_EQ(sum.shortest, a.shortest);
  sum.add(EdgeLengths());
  sum.add(b);
  EXPECT_EQ(sum.edges, a.edges + b.edges);
  EXPECT_NEAR(sum.share * sum.edges, a.share * a.edges + b.share * b.edges, 1e-9);
  EXPECT_EQ(sum.shortest, std::min(a.shortest, b.shortest));
  EXPECT_EQ(sum.longest, std::max(a.longest, b.longest));
  EXPECT_EQ(sum.histogram[10], a.histogram[10] + b.histogram[10]);
}
