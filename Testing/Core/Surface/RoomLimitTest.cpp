// SPDX-License-Identifier: BSD-3-Clause
// How far a point may go towards another sheet: what is left of the distance, measured.
#include "Surface/RoomLimit.h"

#include "SlidingBoxes.h"
#include "Surface/NearestInTriangle.h"
#include "Surface/ReferenceSurface.h"

#include <algorithm>

using namespace meshopt;

namespace
{
std::array<Vec<3>, 3> randomTriangle(TestRandom& random)
{
  std::array<Vec<3>, 3> t;
  for (Vec<3>& x : t)
  {
    x = Vec<3>(random(), random(), random());
  }
  return t;
}
}

/// The limit rests on the nearest point: inside, on each edge and at each corner.
TEST(RoomLimit, TheNearestPointOfATriangleIsTheNearest)
{
  TestRandom random(1);
  std::array<int, 3> kinds{}; // how many barycentric coordinates are 0
  for (int k = 0; k < 3000; ++k)
  {
    const std::array<Vec<3>, 3> t = randomTriangle(random);
    const Vec<3> x = 1.5 * Vec<3>(random(), random(), random());
    const Vec<3> y = nearestInTriangle(t, x);
    EXPECT_NEAR((y - x).norm(), distanceTo(t, x), 1e-12);
    EXPECT_NEAR(distanceTo(t, y), 0.0, 1e-12); // a point of the triangle
    int zeros = 0;
    for (int i = 0; i < 3; ++i)
    {
      const Vec<3> edge = t[(i + 1) % 3] - t[i];
      zeros += edge.cross(y - t[i]).norm() < 1e-12;
    }
    ++kinds[zeros];
  }
  for (int n : kinds)
  {
    EXPECT_GT(n, 100) << "too easy: not all kinds of places";
  }
}

/// Squares of such lengths are 0, and 0 / 0 is no number.
TEST(RoomLimit, ATinyTriangleHasANearestPoint)
{
  TestRandom random(2);
  for (int k = 0; k < 3000; ++k)
  {
    std::array<Vec<3>, 3> t = randomTriangle(random);
    for (Vec<3>& x : t)
    {
      x *= 1e-162;
    }
    const double scale = k % 2 ? 1.0 : 1e-162; // of the other point
    const Vec<3> x = scale * Vec<3>(random(), random(), random());
    EXPECT_LT(nearestInTriangle(t, x).norm(), 1e-160);
  }
}

/// The whole motion if it is within the limit, else as much of it as the limit allows.
TEST(RoomLimit, APartOfTheMotion)
{
  TestRandom random(2);
  for (int k = 0; k < 1000; ++k)
  {
    RoomLimit limit{ Vec<3>(random(), random(), random()), 0.3 * (1.0 + random()) };
    const Vec<3> u = 2.0 * Vec<3>(random(), random(), random());
    for (const bool bothWays : { false, true })
    {
      limit.bothWays = bothWays;
      const double along = u.dot(limit.way);
      const bool isFree = along <= limit.most && (!bothWays || along >= -limit.most);
      const double part = limit.part(u);
      if (isFree)
      {
        EXPECT_EQ(part, 1.0);
      }
      else
      {
        EXPECT_GE(part, 0.0);
        EXPECT_LT(part, 1.0);
        EXPECT_NEAR(std::fabs(part * along), limit.most, 1e-12);
      }
    }
  }
  const RoomLimit limit{ Vec<3>(0, 0, 2), 0.0 };
  EXPECT_EQ(limit.part(Vec<3>(5, -3, 0)), 1.0); // along the other sheet
  EXPECT_EQ(limit.part(Vec<3>(0, 0, -9)), 1.0); // away from it
  EXPECT_EQ(limit.part(Vec<3>(0, 0, 1e-9)), 0.0);
  EXPECT_EQ(limit.part(Vec<3>::Zero()), 1.0);
}

/// Motions are within all limits exactly if they are within those that are left.
TEST(RoomLimit, WhatOthersImplyIsNotNeeded)
{
  TestRandom random(5);
  std::size_t all = 0, left = 0;
  for (int k = 0; k < 300; ++k)
  {
    std::vector<RoomLimit> limits, binding;
    for (int i = 0; i < 40; ++i)
    {
      const Vec<3> way(random(), random(), random());
      limits.push_back({ way, 0.2 * way.squaredNorm(), i % 7 == 0 });
    }
    binding = limits;
    const double most = 0.3;
    keepBinding(most, binding);
    all += limits.size();
    left += binding.size();
    const auto part = [](const std::vector<RoomLimit>& of, const Vec<3>& u)
    {
      double result = 1.0;
      for (const RoomLimit& limit : of)
      {
        result = std::min(result, limit.part(u));
      }
      return result;
    };
    for (int i = 0; i < 100; ++i)
    {
      const Vec<3> u = Vec<3>(random(), random(), random()).normalized() * most * 0.5 *
        (1.0 + random());
      EXPECT_EQ(part(limits, u) < 1.0, part(binding, u) < 1.0);
    }
  }
  EXPECT_LT(left, 9 * all / 10);
  EXPECT_GT(left, 300u);
}

/// What the header promises: of the distance from a facet at least the wanted part is left,
/// wherever the point wants to go. Sharp for motions straight to it.
TEST(RoomLimit, ThePartOfTheDistanceIsLeft)
{
  TestRandom random(3);
  for (int k = 0; k < 3000; ++k)
  {
    const std::array<Vec<3>, 3> t = randomTriangle(random);
    const Vec<3> x = Vec<3>(random(), random(), random());
    const Vec<3> way = nearestInTriangle(t, x) - x;
    const double distance = distanceTo(t, x), share = 0.5 * (1.0 + random());
    const RoomLimit limit{ way, share * distance * distance };
    const Vec<3> u = 3.0 * Vec<3>(random(), random(), random());
    EXPECT_GE(distanceTo(t, x + limit.part(u) * u), (1.0 - share) * distance - 1e-12);
    EXPECT_NEAR(
      distanceTo(t, x + limit.part(5.0 * way) * 5.0 * way), (1.0 - share) * distance, 1e-12);
  }
}

/// Among thousands of facets that face it a point gets few limits, which no motion may use to pass
/// one that has been left out. Where there are few facets, and for the smallest motions, all count.
TEST(RoomLimit, AmongManyFacetsThereAreFewLimits)
{
  TestRandom random(6);
  for (const int number : { 40, 3000 })
  {
    ReferenceSurface surface;
    for (int k = 0; k < number; ++k)
    {
      // Seen from the origin face on: near above it, a few far below it.
      const bool isBelow = k % 20 == 0;
      const Vec<3> out = Vec<3>(random(), random(), isBelow ? -1.0 : 1.0).normalized();
      const Vec<3> a = out.unitOrthogonal(), b = out.cross(a);
      const Vec<3> x = (isBelow ? 0.35 + 0.05 * random() : 0.035 + 0.015 * random()) * out;
      surface.add(
        { Vec<3>(x + 1e-3 * a), Vec<3>(x + 1e-3 * b), Vec<3>(x - 1e-3 * (a + b)) }, 0, true, true);
    }
    surface.finish(0.1, 1e-15);
    const Vec<3> centre = Vec<3>::Zero();
    for (const double most : { 0.1, 1e-323 })
    {
      const std::vector<RoomLimit> all = surface.limits(centre, most),
                                   few = surface.fewLimits(centre, most);
      EXPECT_EQ(all.empty(), most < 0.01);
      EXPECT_LE(few.size(), 400u);
      EXPECT_LT(few.size(), all.size() + 1);
      for (int i = 0; i < 1000; ++i)
      {
        const Vec<3> u = Vec<3>(random(), random(), random()).normalized() * most * 0.5 *
          (1.0 + random());
        const auto isWithin = [&](const std::vector<RoomLimit>& limits)
        {
          return std::all_of(limits.begin(), limits.end(),
            [&](const RoomLimit& limit) { return !(limit.part(u) < 1.0); });
        };
        EXPECT_TRUE(!isWithin(few) || isWithin(all));
        EXPECT_TRUE(number > 40 || isWithin(few) == isWithin(all));
      }
    }
  }
}
