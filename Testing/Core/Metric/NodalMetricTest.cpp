// SPDX-License-Identifier: BSD-3-Clause
// The background mesh, and sizes and metrics sampled on it.
#include "Metric/NodalMetric.h"
#include "Metric/TensorFunctions.h"
#include "Quality/ElementQuality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace meshopt;

namespace
{
template <int D>
MeshInput<D> grid(int n);

template <>
MeshInput<2> grid<2>(int n)
{
  MeshInput<2> in;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      in.points.emplace_back(i / double(n) + 0.02 * std::sin(7.0 * j), j / double(n));
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const Index a = i + (n + 1) * j, b = a + 1, c = a + n + 1, d = c + 1;
      in.cells.push_back({ a, b, d });
      in.cells.push_back({ a, d, c });
    }
  }
  return in;
}

template <>
MeshInput<3> grid<3>(int n)
{
  MeshInput<3> in;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        in.points.emplace_back(
          i / double(n), j / double(n) + 0.02 * std::sin(5.0 * k), k / double(n));
      }
    }
  }
  const int paths[6][2] = { { 1, 3 }, { 5, 1 }, { 3, 2 }, { 2, 6 }, { 4, 5 }, { 6, 4 } };
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const int i = cube % n, j = cube / n % n, k = cube / n / n;
    const auto id = [&](int c)
    {
      return static_cast<Index>(
        i + (c & 1) + (n + 1) * (j + ((c >> 1) & 1) + (n + 1) * (k + (c >> 2))));
    };
    for (const auto& p : paths)
    {
      in.cells.push_back({ id(0), id(p[0]), id(p[1]), id(7) });
    }
  }
  return in;
}

template <int D>
class MetricTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->input_ = grid<D>(5);
    ASSERT_FALSE(SimplexMesh<D>::build(this->input_, this->mesh_));
  }
  double uniform(double a, double b)
  {
    return std::uniform_real_distribution<double>(a, b)(this->random_);
  }
  Vec<D> point(double a, double b)
  {
    Vec<D> x;
    for (int i = 0; i < D; ++i)
    {
      x[i] = this->uniform(a, b);
    }
    return x;
  }
  Tensor<D> tensor()
  {
    Tensor<D> a;
    for (int i = 0; i < D * D; ++i)
    {
      a(i) = this->uniform(-1.0, 1.0);
    }
    return (a * a.transpose() + 0.05 * Tensor<D>::Identity()) * std::exp(this->uniform(-8.0, 8.0));
  }

  MeshInput<D> input_;
  SimplexMesh<D> mesh_;
  std::mt19937 random_{ 6 };
};
}

using Metric2 = MetricTest<2>;
using Metric3 = MetricTest<3>;

template <int D, class Fixture>
void locatorFinds(Fixture& f, const SimplexMesh<D>& mesh)
{
  const Background<D> background(mesh);
  int outside = 0;
  for (int k = 0; k < 3000; ++k)
  {
    const Vec<D> x = f(-0.2, 1.2);
    const Index hint = k % 3 == 0 ? None : static_cast<Index>(k % background.numberOfCells());
    const Location<D> at = background.locate(x, hint);
    ASSERT_NE(at.cell, None);
    double sum = 0.0;
    for (double w : at.weights)
    {
      EXPECT_GE(w, 0.0);
      EXPECT_LE(w, 1.0);
      sum += w;
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    // linear fields are reproduced inside; outside the distance is to the place that was taken
    const Vec<D> y = Background<D>::interpolate(
      at, [&](Index p) -> Vec<D> { return background.point(p); });
    EXPECT_NEAR((y - x).norm(), at.distance, 1e-12);
    // with and without a hint: equally near
    EXPECT_NEAR(background.locate(x).distance, at.distance, 1e-9);
    outside += at.distance > 0.0;
    // nothing is nearer
    double nearest = 1e30;
    for (Index p = 0; p < background.numberOfPoints(); ++p)
    {
      nearest = std::min(nearest, (background.point(p) - x).norm());
    }
    EXPECT_LE(at.distance, nearest + 1e-12);
    // constants to the last bit
    EXPECT_EQ(Background<D>::interpolate(at, [](Index) { return 0.1; }), 0.1);
  }
  EXPECT_GT(outside, 300);
  Vec<D> bad = Vec<D>::Zero();
  bad[0] = std::nan("");
  EXPECT_EQ(background.locate(bad, 0).cell, None);
}

TEST_F(Metric2, LocatorFinds)
{
  auto points = [this](double a, double b) { return this->point(a, b); };
  locatorFinds<2>(points, this->mesh_);
}
TEST_F(Metric3, LocatorFinds)
{
  auto points = [this](double a, double b) { return this->point(a, b); };
  locatorFinds<3>(points, this->mesh_);
}

TEST_F(Metric3, ExponentialAndLogarithm)
{
  for (int k = 0; k < 500; ++k)
  {
    const Tensor<3> m = this->tensor();
    Tensor<3> l;
    ASSERT_TRUE(logarithm<3>(m, l));
    EXPECT_LT((exponential<3>(l) - m).norm(), 1e-12 * m.norm());
    const Tensor<3> root = exponential<3>((0.5 * l).eval());
    EXPECT_LT((root * root - m).norm(), 1e-12 * m.norm());
    EXPECT_EQ(root, Tensor<3>(root.transpose()));
  }
  Tensor<3> l = Tensor<3>::Identity(), bad = Tensor<3>::Identity();
  bad(1, 1) = -1.0;
  EXPECT_FALSE(logarithm<3>(bad, l));
  bad(1, 1) = std::nan("");
  EXPECT_FALSE(logarithm<3>(bad, l));
  bad = Tensor<3>::Identity();
  bad(0, 1) = 0.5;
  EXPECT_FALSE(logarithm<3>(bad, l)) << "not symmetric";
  EXPECT_EQ(l, Tensor<3>(Tensor<3>::Identity())) << "left alone";
}

TEST_F(Metric3, LogarithmOfWhatHasNoSquare)
{
  for (double scale : { 1e-195, 1e-180, 1e-155, 1e155, 1e180, 1e195 })
  {
    const Tensor<3> m = this->tensor();
    Tensor<3> l, one;
    ASSERT_TRUE(logarithm<3>(scale * m, l)) << scale;
    ASSERT_TRUE(logarithm<3>(m, one));
    EXPECT_LT((l - one - std::log(scale) * Tensor<3>::Identity()).norm(), 1e-11) << scale;
  }
  Tensor<3> l, bad = 1e200 * Tensor<3>::Identity();
  bad(0, 1) = 1e199;
  EXPECT_FALSE(logarithm<3>(bad, l)) << "not symmetric";
  EXPECT_FALSE(logarithm<3>(-1e-200 * Tensor<3>::Identity(), l));
  EXPECT_FALSE(logarithm<3>(Tensor<3>::Zero(), l));
  EXPECT_FALSE(logarithm<3>(1e-220 * Tensor<3>::Identity(), l)) << "volumes underflow";
  EXPECT_FALSE(logarithm<3>(1e300 * Tensor<3>::Identity(), l)) << "volumes overflow";
  EXPECT_FALSE(logarithm<3>(Tensor<3>::Constant(std::numeric_limits<double>::infinity()), l));
}

TEST_F(Metric2, ExponentialAndLogarithm)
{
  for (int k = 0; k < 500; ++k)
  {
    const Tensor<2> m = this->tensor();
    Tensor<2> l;
    ASSERT_TRUE(logarithm<2>(m, l));
    EXPECT_LT((exponential<2>(l) - m).norm(), 1e-12 * m.norm());
  }
}

TEST_F(Metric3, ConstantMetricIsTheMappedMesh)
{
  const Tensor<3> m = this->tensor();
  NodalMetric<3> metric(0.3);
  EXPECT_EQ(metric.set(this->mesh_, {}, std::vector<Tensor<3>>(this->input_.points.size(), m)), "");
  Tensor<3> l;
  logarithm<3>(m, l);
  const Tensor<3> root = exponential<3>((0.5 * l).eval());
  ElementQuality<3, MeanEdgeShape<3>> quality;
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    Corners<3> x = this->mesh_.corners(c), y = x;
    for (Vec<3>& p : y)
    {
      p = root * p;
    }
    const double expected = MeanEdgeShape<3>::value(y);
    EXPECT_NEAR(quality.value(x, metric.element(this->mesh_.nodes(c))), expected, 1e-11);
    EXPECT_EQ(metric.element(this->mesh_.nodes(c)).desiredSize, 0.3);
  }
  // and it stays constant wherever it is sampled
  metric.reserve(this->mesh_.numberOfPointSlots() + 1);
  const Index added = this->mesh_.numberOfPointSlots();
  metric.resample(added, this->point(0.1, 0.9));
  EXPECT_EQ(metric.sample(added).logTensor, metric.sample(0).logTensor);
}

TEST_F(Metric3, LogEuclideanAndSizes)
{
  // ln h* and ln M linear in x: interpolation reproduces them anywhere
  Tensor<3> slope;
  slope << 1.0, 0.3, 0.1, 0.3, -1.0, 0.2, 0.1, 0.2, 0.5;
  std::vector<double> sizes;
  std::vector<Tensor<3>> tensors;
  for (const Vec<3>& x : this->input_.points)
  {
    sizes.push_back(std::exp(2.0 * x[0] - x[2]));
    tensors.push_back(exponential<3>((x[1] * slope).eval()));
  }
  NodalMetric<3> metric;
  EXPECT_TRUE(metric.isTrivial());
  ASSERT_EQ(metric.set(this->mesh_, sizes, tensors), "");
  EXPECT_TRUE(metric.hasSizes());
  EXPECT_FALSE(metric.isTrivial());
  for (int k = 0; k < 200; ++k)
  {
    const Vec<3> x = this->point(0.1, 0.9);
    const auto before = metric.sample(7);
    metric.resample(7, x);
    EXPECT_NEAR(metric.sample(7).logSize, 2.0 * x[0] - x[2], 1e-12);
    EXPECT_LT((metric.sample(7).logTensor - x[1] * slope).norm(), 1e-11);
    metric.setSample(7, before);
  }
  // an element takes the mean of the logarithms
  const Simplex<3>& nodes = this->mesh_.nodes(11);
  Vec<3> centre = Vec<3>::Zero();
  for (Index p : nodes)
  {
    centre += this->mesh_.point(p) / 4.0;
  }
  NodalMetric<3> fresh;
  ASSERT_EQ(fresh.set(this->mesh_, sizes, tensors), "");
  const ElementMetric<3> m = fresh.element(nodes);
  EXPECT_NEAR(m.desiredSize, std::exp(2.0 * centre[0] - centre[2]), 1e-12);
  EXPECT_LT((m.map - exponential<3>((0.5 * centre[1] * slope).eval())).norm(), 1e-12);
  EXPECT_FALSE(m.euclidean);
}

TEST_F(Metric2, ErrorsNameThePoint)
{
  const std::size_t n = this->input_.points.size();
  NodalMetric<2> metric(0.5);
  std::vector<double> sizes(n, 1.0);
  sizes[17] = -2.0;
  EXPECT_NE(metric.set(this->mesh_, sizes, {}).find("point 17"), std::string::npos);
  EXPECT_TRUE(metric.isTrivial()) << "an error changes nothing";
  sizes.pop_back();
  EXPECT_NE(metric.set(this->mesh_, sizes, {}).find(std::to_string(n)), std::string::npos);
  std::vector<Tensor<2>> tensors(n, Tensor<2>::Identity());
  tensors[3](0, 0) = 0.0;
  EXPECT_NE(metric.set(this->mesh_, {}, tensors).find("point 3"), std::string::npos);
  EXPECT_EQ(metric.element(this->mesh_.nodes(0)).desiredSize, 0.5);
  EXPECT_TRUE(metric.element(this->mesh_.nodes(0)).euclidean);
}

/// What many edges ask for is found without looking at all of them; sizes are raised to it
/// everywhere.
TEST(NodalMetric, RaisedToAFloor)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<SizeFloor<2>::Edge> edges;
  for (int k = 0; k < 300; ++k)
  {
    const Vec<2> a(uniform(random), uniform(random));
    const double length = k % 100 == 0 ? 0.5 : 0.002 + 0.03 * uniform(random);
    SizeFloor<2>::Edge e{ a, a + length * Vec<2>(uniform(random), uniform(random)),
      Tensor<2>::Identity(), 0.0 };
    e.metric.diagonal() << 1.0, k % 3 == 0 ? 4.0 : 1.0;
    e.size = std::sqrt((e.b - e.a).dot(e.metric * (e.b - e.a)));
    edges.push_back(e);
  }
  const double least = 0.01;
  const auto floor = std::make_shared<const SizeFloor<2>>(edges, least);
  SimplexMesh<2> mesh;
  ASSERT_FALSE(SimplexMesh<2>::build(grid<2>(4), mesh));
  NodalMetric<2> raised = NodalMetric<2>(least).raised(mesh, floor);
  EXPECT_TRUE(raised.isRaised());
  for (int k = 0; k < 500; ++k)
  {
    const Vec<2> x(uniform(random), uniform(random));
    double best = least;
    for (const SizeFloor<2>::Edge& e : edges)
    {
      double nearest = 1e9; // along the edge, step by step
      for (int s = 0; s <= 1000; ++s)
      {
        const Vec<2> d = x - e.a - s / 1000.0 * (e.b - e.a);
        nearest = std::min(nearest, d.dot(e.metric * d));
      }
      best = std::max(best, e.size - 0.7 * std::sqrt(nearest));
    }
    EXPECT_NEAR(std::max(least, floor->at(x)), best, 1e-3);
    raised.resample(3, x);
    EXPECT_NEAR(std::exp(raised.sample(3).logSize), best, 1e-3);
  }
}
