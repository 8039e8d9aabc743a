// SPDX-License-Identifier: BSD-3-Clause
// The least size beside edges that stay: one edge in closed form, many against all of them.
#include "Metric/SizeFloor.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class SizeFloorIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(SizeFloorIn, TestDimensions);

constexpr double Fall = 0.7; // of the size, by distance; see SizeFloor.cpp

template <int D>
Vec<D> axis(int d, double length = 1.0)
{
  Vec<D> x = Vec<D>::Zero();
  x[d] = length;
  return x;
}

template <int D>
typename SizeFloor<D>::Edge edge(const Vec<D>& a, const Vec<D>& b)
{
  return { a, b, Tensor<D>::Identity(), (b - a).norm() };
}
}

TYPED_TEST(SizeFloorIn, FallsFromOneEdge)
{
  constexpr int D = TypeParam::dimension;
  const SizeFloor<D> floor({ edge<D>(Vec<D>::Zero(), axis<D>(0, 2.0)) }, 0.1);
  for (double s : { 0.0, 0.5, 2.0 }) // on it
  {
    EXPECT_NEAR(floor.at(axis<D>(0, s)), 2.0, 1e-15);
  }
  for (double away : { 0.1, 1.0, 2.5 }) // beside it, before and behind it
  {
    EXPECT_NEAR(floor.at(axis<D>(0, 1.0) + axis<D>(1, away)), 2.0 - Fall * away, 1e-14);
    EXPECT_NEAR(floor.at(axis<D>(0, 1.0) - axis<D>(D - 1, away)), 2.0 - Fall * away, 1e-14);
    EXPECT_NEAR(floor.at(axis<D>(0, -away)), 2.0 - Fall * away, 1e-14);
    EXPECT_NEAR(floor.at(axis<D>(0, 2.0 + away)), 2.0 - Fall * away, 1e-14);
  }
  const Vec<D> corner = axis<D>(0, 2.3) + axis<D>(1, -0.4); // .5 from its end
  EXPECT_NEAR(floor.at(corner), 2.0 - Fall * 0.5, 1e-14);
  EXPECT_EQ(floor.at(axis<D>(1, 1e6)), 0.0);
}

/// In a metric lengths and distances are those of the mapped edge.
TYPED_TEST(SizeFloorIn, IsMeasuredInTheMetricOfTheEdge)
{
  constexpr int D = TypeParam::dimension;
  typename SizeFloor<D>::Edge e = edge<D>(Vec<D>::Zero(), axis<D>(0, 2.0));
  e.metric(0, 0) = 4.0;
  e.metric(1, 1) = 9.0;
  e.size = 4.0;
  const SizeFloor<D> floor({ e }, 0.1);
  EXPECT_NEAR(floor.at(axis<D>(0, 1.0)), 4.0, 1e-15);
  EXPECT_NEAR(floor.at(axis<D>(0, 1.0) + axis<D>(1, 0.5)), 4.0 - Fall * 1.5, 1e-14);
  EXPECT_NEAR(floor.at(axis<D>(0, 3.0)), 4.0 - Fall * 2.0, 1e-14);
}

TYPED_TEST(SizeFloorIn, TheGreatestOfAll)
{
  constexpr int D = TypeParam::dimension;
  constexpr double least = 0.02;
  TestRandom random(1);
  const auto point = [&]
  {
    Vec<D> x;
    for (int d = 0; d < D; ++d)
    {
      x[d] = random();
    }
    return x;
  };
  std::vector<typename SizeFloor<D>::Edge> edges;
  for (int k = 0; k < 100; ++k) // short ones and a few long ones
  {
    const Vec<D> a = point();
    edges.push_back(edge<D>(a, a + (k % 25 == 0 ? 0.5 : 0.05) * point()));
  }
  const SizeFloor<D> floor(edges, least);
  int above = 0;
  for (int k = 0; k < 2000; ++k)
  {
    const Vec<D> x = 1.5 * point();
    double wanted = least;
    for (const auto& e : edges)
    {
      const Vec<D> along = e.b - e.a;
      const double t = std::clamp(along.dot(x - e.a) / along.squaredNorm(), 0.0, 1.0);
      wanted = std::max(wanted, e.size - Fall * (x - e.a - t * along).norm());
    }
    EXPECT_NEAR(std::max(least, floor.at(x)), wanted, 1e-14);
    above += wanted > least;
  }
  EXPECT_GT(above, 100);
  EXPECT_LT(above, 1990);
}

TYPED_TEST(SizeFloorIn, NoEdgesNoFloor)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_EQ(SizeFloor<D>({}, 1.0).at(Vec<D>::Ones()), 0.0);
}
