// SPDX-License-Identifier: BSD-3-Clause
// The best fourth node in a cone, against places in it that were tried one by one.
#include "Bound/ApexInCone.h"
#include "Bound/ApexBound.h"
#include "Quality/Shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace meshopt;

namespace
{
using Triangle = std::array<Vec<3>, 3>;

const double Exactly = std::numeric_limits<double>::infinity();
const Vec<3> Middle = Vec<3>::Constant(1.0 / 3.0);

/// A triangle in the plane z = 0, from regular to a needle.
Triangle triangle(double height, double along)
{
  return { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(along, height, 0) };
}

double shapeOf(const Triangle& t, const Vec<3>& apex)
{
  return MeanEdgeShape<3>::value({ t[0], t[1], t[2], apex });
}

TEST(ApexInCone, NoPlaceInTheConeIsBetter)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0), w(0.0, 1.0);
  for (int k = 0; k < 300; ++k)
  {
    const Triangle t = triangle(std::pow(10.0, -2.0 * w(random)), w(random));
    const ApexInCone apex(t, { 0.2, 0.3, 0.5 });
    ASSERT_TRUE(apex.isUsable());
    Cone cone;
    for (Vec<3>& end : cone)
    {
      end = Vec<3>(u(random), u(random), std::fabs(u(random)) * std::pow(10.0, -2.0 * w(random)));
    }
    const ApexInCone::Best best = apex.best(cone, 1e-12, Exactly);
    // Corners and faces of the cone, too: there the best one often is.
    double tried = 0.0;
    for (int j = 0; j < 4000; ++j)
    {
      Vec<3> x = Vec<3>::Zero();
      double sum = j % 2 ? 0.0 : w(random);
      std::array<double, 3> weights;
      for (double& weight : weights)
      {
        weight = j % 5 ? w(random) : std::pow(w(random), 8.0);
        sum += weight;
      }
      for (int i = 0; i < 3; ++i)
      {
        x += weights[i] / sum * cone[i];
      }
      tried = std::max(tried, shapeOf(t, apex.from() + apex.unit() * x));
    }
    EXPECT_GE(best.bound * (1.0 + 1e-12), tried);
    // Not far above: some place in the cone gives nearly as much.
    const double found = shapeOf(t, apex.from() + apex.unit() * best.place);
    EXPECT_NEAR(found, apex.shape(best.place), 1e-12);
    EXPECT_LE(best.bound, found * (1.0 + 2.0 * ApexInCone::Tolerance)) << k;
    // Less is enough: a place with that, and still a bound.
    const ApexInCone::Best half = apex.best(cone, 1e-12, 0.5 * found);
    EXPECT_GE(apex.shape(half.place), 0.5 * found * (1.0 - 1e-12)) << k;
    EXPECT_GE(half.bound * (1.0 + 1e-12), tried) << k;
  }
}

TEST(ApexInCone, IsTheCapWhereTheConeHoldsTheBestPlace)
{
  for (const double height : { 0.8660254037844386, 0.3, 0.01, 1e-4 })
  {
    const Triangle t = triangle(height, 0.4);
    const ApexInCone apex(t, Middle);
    const double cap = facetCap(t[0], t[1], t[2]);
    double most = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const auto end = [](int i) -> Vec<3> {
        return { 9.0 * std::cos(2.0 * i), 9.0 * std::sin(2.0 * i), 0.0 };
      };
      // Three cones around the normal; the last one is a little wider than it needs to be.
      most = std::max(
        most, apex.best({ end(k), end(k + 1), Vec<3>(0, 0, 9.0) }, 1e-12, Exactly).bound);
    }
    EXPECT_GE(most * (1.0 + 1e-12), cap);
    EXPECT_LE(most, cap * (1.0 + 2.0 * ApexInCone::Tolerance));
  }
}

TEST(ApexInCone, NothingBeyondReach)
{
  std::mt19937 random(5);
  std::normal_distribution<double> u;
  for (int k = 0; k < 2000; ++k)
  {
    const Triangle t = triangle(std::pow(10.0, -0.002 * k), 0.1);
    const ApexInCone apex(t, { 0.8, 0.1, 0.1 });
    const double shape = std::pow(10.0, -0.001 * k - 0.3);
    const Vec<3> way = Vec<3>(u(random), u(random), u(random)).normalized();
    EXPECT_LE(apex.shape(1.0001 * apex.reach(shape) * way), shape);
  }
}

TEST(ApexInCone, DoesNotDependOnSizeAndPlace)
{
  const Triangle t = triangle(0.1, 0.7);
  const Cone cone{ Vec<3>(1, 0, 0.1), Vec<3>(0, 1, 0.2), Vec<3>(-0.5, -0.5, 0.3) };
  const double bound = ApexInCone(t, Middle).best(cone, 1e-12, Exactly).bound;
  for (const double scale : { 1e-60, 1e-3, 1e60 })
  {
    const Triangle other{ scale * t[0], scale * t[1], scale * t[2] };
    EXPECT_NEAR(ApexInCone(other, Middle).best(cone, 1e-12, Exactly).bound, bound, 1e-9);
  }
}

TEST(ApexInCone, CollapsedFacetsAreNotUsable)
{
  const double nan = std::nan("");
  EXPECT_FALSE(ApexInCone(triangle(0.0, 0.5), Middle).isUsable());
  EXPECT_FALSE(ApexInCone(triangle(nan, 0.5), Middle).isUsable());
  EXPECT_FALSE(ApexInCone({ Vec<3>::Zero(), Vec<3>::Zero(), Vec<3>::Zero() }, Middle).isUsable());
}

TEST(ApexInCone, AConeInThePlaneOfTheFacetHoldsNothing)
{
  const Cone cone{ Vec<3>(1, 0, 0), Vec<3>(0, 1, 0), Vec<3>(-1, 0, 0) };
  EXPECT_EQ(ApexInCone(triangle(0.5, 0.5), Middle).best(cone, 1e-12, Exactly).bound, 0.0);
}
}
