// SPDX-License-Identifier: BSD-3-Clause
// The solution-adapted metric: its definition, the number of elements, and each of its limits.
#include "Metric/SolutionMetric.h"
#include "Metric/MetricVolume.h"
#include "Metric/TensorFunctions.h"

#include "TestMeshes.h"

#include <Eigen/LU>

#include <functional>

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

/// A layer: second derivatives from 0 to large, in one direction only.
template <int D>
double layer(const Vec<D>& x)
{
  return std::tanh(20.0 * (x[0] + 0.3 * x[1] - 0.6));
}

template <int D>
std::vector<double> sample(
  const MeshInput<D>& in, const std::function<double(const Vec<D>&)>& f = layer<D>)
{
  std::vector<double> values;
  for (const Vec<D>& x : in.points)
  {
    values.push_back(f(x));
  }
  return values;
}

template <int D>
SolutionMetric<D> metricOf(const MeshInput<D>& in, const std::vector<double>& values,
  const SolutionMetricOptions& options, int components = 1)
{
  SolutionMetric<D> metric;
  EXPECT_EQ(solutionMetric(buildMesh(in), values, components, options, metric), "");
  EXPECT_EQ(metric.tensors.size(), in.points.size());
  return metric;
}

/// Wanted edge lengths in the principal directions at a point, ascending.
template <int D>
Vec<D> lengthsAt(const SolutionMetric<D>& metric, std::size_t p)
{
  return (
    metric.desiredSize * SymmetricEigen<D>::of(metric.tensors[p]).values.cwiseSqrt().cwiseInverse())
    .reverse();
}

/// Elements that the log-Euclidean field stands for, by chance points in each cell.
template <int D>
double countByQuadrature(const MeshInput<D>& in, const SolutionMetric<D>& metric)
{
  TestRandom random(5);
  constexpr int samples = 2000;
  double sum = 0.0;
  for (const Simplex<D>& cell : in.cells)
  {
    Corners<D> x;
    std::array<double, D + 1> f;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = in.points[cell[i]];
      f[i] = 0.5 * std::log(metric.tensors[cell[i]].determinant());
    }
    double mean = 0.0;
    for (int s = 0; s < samples; ++s)
    {
      double total = 0.0, value = 0.0;
      for (int i = 0; i <= D; ++i)
      {
        const double w = -std::log(0.5 + 0.4999999 * random()); // uniform on the simplex
        total += w;
        value += w * f[i];
      }
      mean += std::exp(value / total) / samples;
    }
    sum += std::abs(signedVolume(x)) * mean;
  }
  return (D == 2 ? 4.0 / std::sqrt(3.0) : 6.0 * std::sqrt(2.0)) * sum /
    std::pow(metric.desiredSize, D);
}

}

template <class T>
class SolutionMetricIn : public testing::Test
{
};
TYPED_TEST_SUITE(SolutionMetricIn, TestDimensions);

TYPED_TEST(SolutionMetricIn, AbsoluteValue)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(1);
  for (int k = 0; k < 200; ++k)
  {
    const Tensor<D> h = randomSymmetric<D>(random);
    const SymmetricEigen<D> e = absoluteValue<D>(h);
    const Tensor<D> g = e.compose();
    EXPECT_LT((g * g - h * h).norm(), 1e-13) << "the square is that of H";
    EXPECT_LT((g * h - h * g).norm(), 1e-13) << "the same axes";
    for (int i = 0; i < D; ++i)
    {
      EXPECT_GE(e.values[i], i == 0 ? 0.0 : e.values[i - 1]);
    }
    // one component among zeros, and the same one twice
    const Tensor<D> three[3] = { Tensor<D>::Zero(), h, Tensor<D>::Zero() };
    EXPECT_LT((combinedHessian<D>(three, 3).compose() - g).norm(), 1e-12);
    const Tensor<D> twice[2] = { h, h };
    EXPECT_LT((combinedHessian<D>(twice, 2).compose() - std::sqrt(2.0) * g).norm(), 1e-12);
  }
  // one component, small beside large: not by way of the square
  Tensor<D> flat = Tensor<D>::Zero();
  flat(0, 0) = 1.0;
  flat(1, 1) = -1e-12;
  EXPECT_NEAR(absoluteValue<D>(flat).values[D - 2], 1e-12, 1e-20);
}

TYPED_TEST(SolutionMetricIn, CombinedHessianIsTheRootOfTheSumOfSquares)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(2);
  for (const double scale : { 1.0, 1e-200, 1e200 })
  {
    const Tensor<D> parts[2] = { randomSymmetric<D>(random), randomSymmetric<D>(random) };
    const Tensor<D> scaled[2] = { scale * parts[0], scale * parts[1] };
    const Tensor<D> g = combinedHessian<D>(scaled, 2).compose() / scale;
    EXPECT_LT((g * g - parts[0] * parts[0] - parts[1] * parts[1]).norm(), 1e-12);
  }
}

TYPED_TEST(SolutionMetricIn, MeanOfExponential)
{
  constexpr int D = TypeParam::dimension;
  std::array<double, D + 1> a;
  a.fill(-3.0);
  EXPECT_NEAR(meanOfExponential<D>(a), std::exp(-3.0), 1e-16);
  // f = x: int of x^k exp(x) over the simplex, in closed form
  a.fill(0.0);
  a[1] = 1.0;
  const double e = std::exp(1.0);
  EXPECT_NEAR(meanOfExponential<D>(a), D == 2 ? 2.0 * (e - 2.0) : 6.0 * (e - 2.5), 1e-14);
  // continuous where the formula changes, and in all magnitudes
  for (const double spread : { 1e-9, 1e-3, 0.5, 0.999999, 1.000001, 3.0, 30.0 })
  {
    std::array<double, D + 1> b;
    for (int i = 0; i <= D; ++i)
    {
      b[i] = 100.0 - spread * ((i * 2) % (D + 1)) / D;
    }
    // the halves of the simplex, cut at the middle of an edge, agree with the whole
    std::array<double, D + 1> left = b, right = b;
    left[1] = right[0] = 0.5 * (b[0] + b[1]);
    EXPECT_NEAR(
      0.5 * (meanOfExponential<D>(left) + meanOfExponential<D>(right)) / meanOfExponential<D>(b),
      1.0, 1e-12)
      << spread;
  }
}

/// A quadratic has the same Hessian everywhere: h* in closed form.
TYPED_TEST(SolutionMetricIn, CountOnAConstantMetric)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  const std::vector<double> values = sample<D>(in,
    [](const Vec<D>& x) { return 8.0 * x[0] * x[0] - x[1] * x[1] + 2.0 * x[D - 1] * x[D - 1]; });
  SolutionMetricOptions options;
  options.recovery = Recovery::LeastSquares;
  options.desiredCount = 5000.0;
  const double root = std::sqrt(D == 2 ? 16.0 * 2.0 : 16.0 * 2.0 * 4.0); // of det |H|
  for (const double correction : { 1.0, 1.3 })
  {
    options.countCorrection = correction;
    const SolutionMetric<D> metric = metricOf<D>(in, values, options);
    const double perVolume = D == 2 ? 4.0 / std::sqrt(3.0) : 6.0 * std::sqrt(2.0);
    EXPECT_NEAR(
      metric.desiredSize / std::pow(correction * perVolume * root / 5000.0, 1.0 / D), 1.0, 1e-4);
    EXPECT_NEAR(metric.predictedCount, 5000.0, 1.0);
    EXPECT_TRUE(metric.isCountReached);
    EXPECT_FALSE(metric.isLinear);
    for (const Tensor<D>& m : metric.tensors)
    {
      EXPECT_NEAR(m(0, 0), 16.0, 1e-9);
      EXPECT_NEAR(m(1, 1), 2.0, 1e-9);
      EXPECT_NEAR(m(0, 1), 0.0, 1e-9);
    }
  }
}

TYPED_TEST(SolutionMetricIn, CountIsThatOfTheInterpolatedMetric)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 2 ? 12 : 6, 0.2);
  SolutionMetricOptions options;
  options.desiredCount = 3000.0;
  for (const double gradation : { 0.0, 1.5 })
  {
    options.limits.gradation = gradation;
    const SolutionMetric<D> metric = metricOf<D>(in, sample<D>(in), options);
    EXPECT_NEAR(metric.predictedCount, 3000.0, 4.0);
    EXPECT_NEAR(countByQuadrature<D>(in, metric), 3000.0, 60.0);
  }
}

TYPED_TEST(SolutionMetricIn, TheUnitOfTheFieldDoesNotMatter)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.2);
  std::vector<double> values = sample<D>(in);
  SolutionMetricOptions options;
  options.desiredCount = 1000.0;
  const SolutionMetric<D> one = metricOf<D>(in, values, options);
  for (double& v : values)
  {
    v *= 1e9;
  }
  const SolutionMetric<D> other = metricOf<D>(in, values, options);
  for (std::size_t p = 0; p < one.tensors.size(); ++p)
  {
    const Tensor<D> a = one.tensors[p] / std::pow(one.desiredSize, 2);
    const Tensor<D> b = other.tensors[p] / std::pow(other.desiredSize, 2);
    EXPECT_LT((a - b).norm(), 1e-9 * a.norm());
  }
}

TYPED_TEST(SolutionMetricIn, SizesAreWithinTheirLimits)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(8, 0.2);
  SolutionMetricOptions options;
  options.desiredCount = 4000.0;
  const SolutionMetric<D> free = metricOf<D>(in, sample<D>(in), options);
  double shortest = 1.0, longest = 0.0;
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    shortest = std::min(shortest, lengthsAt(free, p)[0]);
    longest = std::max(longest, lengthsAt(free, p)[D - 1]);
  }
  EXPECT_LE(longest, std::sqrt(double(D)) * (1.0 + 1e-9)) << "the diagonal of the mesh";
  options.limits.minimumSize = 2.0 * shortest;
  options.limits.maximumSize = 0.2;
  for (const double gradation : { 0.0, 1.3 })
  {
    options.limits.gradation = gradation;
    const SolutionMetric<D> metric = metricOf<D>(in, sample<D>(in), options);
    for (std::size_t p = 0; p < in.points.size(); ++p)
    {
      EXPECT_GE(lengthsAt(metric, p)[0], 2.0 * shortest * (1.0 - 1e-9));
      EXPECT_LE(lengthsAt(metric, p)[D - 1], 0.2 * (1.0 + 1e-9));
    }
    EXPECT_TRUE(metric.isCountReached);
    EXPECT_NEAR(metric.predictedCount, 4000.0, 6.0);
  }
}

TYPED_TEST(SolutionMetricIn, ACountOutOfTheLimitsIsTold)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.2);
  const double perVolume = D == 2 ? 4.0 / std::sqrt(3.0) : 6.0 * std::sqrt(2.0);
  SolutionMetricOptions options;
  options.desiredCount = 10.0;
  options.limits.maximumSize = 0.1;
  SolutionMetric<D> metric = metricOf<D>(in, sample<D>(in), options);
  EXPECT_FALSE(metric.isCountReached);
  EXPECT_NEAR(metric.predictedCount / (perVolume * std::pow(10.0, D)), 1.0, 1e-3);
  options.limits.minimumSize = 0.05;
  options.desiredCount = 1e9;
  metric = metricOf<D>(in, sample<D>(in), options);
  EXPECT_FALSE(metric.isCountReached);
  EXPECT_NEAR(metric.predictedCount / (perVolume * std::pow(20.0, D)), 1.0, 1e-3);
  // both the same: uniform, whatever is wanted
  options.limits.minimumSize = 0.1;
  metric = metricOf<D>(in, sample<D>(in), options);
  EXPECT_FALSE(metric.isCountReached);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    EXPECT_NEAR(lengthsAt(metric, p)[0], 0.1, 1e-9);
    EXPECT_NEAR(lengthsAt(metric, p)[D - 1], 0.1, 1e-9);
  }
}

TYPED_TEST(SolutionMetricIn, AnisotropyIsCapped)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(8, 0.2);
  SolutionMetricOptions options;
  options.desiredCount = 2000.0;
  options.limits.maximumAnisotropy = 4.0;
  double greatest = 0.0;
  const SolutionMetric<D> metric = metricOf<D>(in, sample<D>(in), options);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    const Vec<D> lengths = lengthsAt(metric, p);
    greatest = std::max(greatest, lengths[D - 1] / lengths[0]);
  }
  EXPECT_NEAR(greatest, 4.0, 1e-6);
  options.limits.maximumAnisotropy = 1.0;
  for (const Tensor<D>& m : metricOf<D>(in, sample<D>(in), options).tensors)
  {
    EXPECT_LT((m - m(0, 0) * Tensor<D>::Identity()).norm(), 1e-9 * m(0, 0));
  }
}

/// det(G)^(-1 / (2p + D)) G at each point, where no limit is at work.
TYPED_TEST(SolutionMetricIn, NormOrder)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(5, 0.2);
  const std::vector<double> values = sample<D>(in,
    [](const Vec<D>& x)
    { return std::exp(x[0]) + std::exp(2.0 * x[1]) + 0.5 * x[D - 1] * x[D - 1]; });
  SolutionMetricOptions options;
  options.recovery = Recovery::LeastSquares;
  options.desiredCount = 20000.0;
  const SolutionMetric<D> infinity = metricOf<D>(in, values, options);
  options.normOrder = 2.0;
  const SolutionMetric<D> two = metricOf<D>(in, values, options);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    const Tensor<D>& g = infinity.tensors[p];
    const Tensor<D> expected = std::pow(g.determinant(), -1.0 / (4.0 + D)) * g;
    EXPECT_LT((two.tensors[p] - expected).norm(), 1e-9 * expected.norm());
  }
  EXPECT_NEAR(two.predictedCount, 20000.0, 3.0);
}

TYPED_TEST(SolutionMetricIn, Vectors)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.2);
  const std::vector<double> scalar = sample<D>(in);
  std::vector<double> vector;
  for (double v : scalar)
  {
    vector.insert(vector.end(), { 3.0 * v, 7.0, -4.0 * v });
  }
  SolutionMetricOptions options;
  options.desiredCount = 1000.0;
  const SolutionMetric<D> one = metricOf<D>(in, scalar, options);
  const SolutionMetric<D> three = metricOf<D>(in, vector, options, 3);
  EXPECT_NEAR(three.desiredSize, std::sqrt(5.0) * one.desiredSize, 1e-6 * three.desiredSize);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    EXPECT_LT((three.tensors[p] - 5.0 * one.tensors[p]).norm(), 1e-6 * three.tensors[p].norm());
  }
}

/// Nothing to adapt to: the Euclidean metric, and the right number all the same.
TYPED_TEST(SolutionMetricIn, LinearFields)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.2);
  SolutionMetricOptions options;
  options.desiredCount = 1000.0;
  const double perVolume = D == 2 ? 4.0 / std::sqrt(3.0) : 6.0 * std::sqrt(2.0);
  for (const double slope : { 0.0, 1.0, 1e6 })
  {
    for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
    {
      options.recovery = recovery;
      const SolutionMetric<D> metric = metricOf<D>(in,
        sample<D>(in, [slope](const Vec<D>& x) { return 1e3 + slope * (x[0] - x[1]); }), options);
      EXPECT_TRUE(metric.isLinear);
      EXPECT_NEAR(metric.desiredSize / std::pow(perVolume / 1000.0, 1.0 / D), 1.0, 1e-4);
      for (const Tensor<D>& m : metric.tensors)
      {
        EXPECT_LT((m - Tensor<D>::Identity()).norm(), 1e-12);
      }
    }
  }
}

TEST(SolutionMetricOptions, WhatIsUnusableIsNamed)
{
  const auto complaint = [](const std::function<void(SolutionMetricOptions&)>& change)
  {
    SolutionMetricOptions options;
    options.desiredCount = 100.0;
    change(options);
    const MeshInput<2> in = jitteredGrid<2>(4, 0.1);
    SolutionMetric<2> metric;
    return solutionMetric(buildMesh(in), sample<2>(in), 1, options, metric);
  };
  const double nan = std::nan("");
  using O = SolutionMetricOptions;
  EXPECT_EQ(complaint([](O&) {}), "");
  for (const double bad : { 0.0, -1.0, nan })
  {
    EXPECT_NE(
      complaint([=](O& o) { o.desiredCount = bad; }).find("number of elements"), std::string::npos);
    EXPECT_NE(
      complaint([=](O& o) { o.countCorrection = bad; }).find("correction"), std::string::npos);
  }
  EXPECT_NE(complaint([=](O& o) { o.normOrder = -1.0; }).find("norm"), std::string::npos);
  EXPECT_NE(complaint([=](O& o) { o.limits.minimumSize = nan; }).find("size"), std::string::npos);
  EXPECT_NE(complaint([=](O& o) { o.limits.maximumSize = -1.0; }).find("size"), std::string::npos);
  EXPECT_NE(complaint(
              [=](O& o)
              {
                o.limits.minimumSize = 2.0;
                o.limits.maximumSize = 1.0;
              })
              .find("above the maximum"),
    std::string::npos);
  EXPECT_NE(complaint([=](O& o) { o.limits.maximumAnisotropy = 0.5; }).find("anisotropy"),
    std::string::npos);
  EXPECT_NE(
    complaint([=](O& o) { o.limits.gradation = 1.0; }).find("gradation"), std::string::npos);
}

/// Either a metric that can be used, or a sentence.
TEST(SolutionMetricOptions, VeryLargeAndVerySmallSolutions)
{
  const MeshInput<2> in = jitteredGrid<2>(6, 0.1);
  const SimplexMesh<2> mesh = buildMesh(in);
  for (double scale : { 1e-310, 1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300 })
  {
    std::vector<double> values = sample<2>(in);
    for (double& v : values)
    {
      v *= scale;
    }
    for (double order : { 0.0, 1.0, 100.0, 1e300 })
    {
      SolutionMetricOptions options;
      options.desiredCount = 100.0;
      options.normOrder = order;
      SolutionMetric<2> metric;
      const std::string error = solutionMetric(mesh, values, 1, options, metric);
      for (std::size_t p = 0; p < in.points.size() && error.empty(); ++p)
      {
        Tensor<2> l;
        EXPECT_TRUE(logarithm<2>(metric.tensors[p], l)) << scale << " " << order;
      }
      EXPECT_TRUE(error.empty() || error.find("Multiply") != std::string::npos) << error;
      EXPECT_TRUE(error.empty() || scale < 1e-99 || scale > 1e199) << scale << error;
    }
  }
}
