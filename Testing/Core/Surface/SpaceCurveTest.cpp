// SPDX-License-Identifier: BSD-3-Clause
// Polylines in space: places by length, nearest points, and how far chords are from them.
#include "Surface/SpaceCurve.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
SpaceCurve zigzag(bool isClosed)
{
  return SpaceCurve({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 }, { 0, 2, 1 } }, isClosed);
}

TEST(SpaceCurve, TheParameterIsTheLength)
{
  const SpaceCurve curve = zigzag(false);
  EXPECT_DOUBLE_EQ(curve.length(), 3.0 + std::sqrt(2.0));
  EXPECT_EQ(curve.parameter(2), 3.0);
  EXPECT_EQ(curve.at(0.25), Vec<3>(0.25, 0, 0));
  EXPECT_EQ(curve.at(1.5), Vec<3>(1, 0.5, 0));
  EXPECT_EQ(curve.at(-1.0), Vec<3>(0, 0, 0)); // it ends there
  EXPECT_EQ(curve.direction(0.5), Vec<3>(1, 0, 0));
  EXPECT_EQ(curve.direction(1.0), Vec<3>(0, 1, 0)); // of the second line
}

TEST(SpaceCurve, AClosedCurveIsPeriodic)
{
  const SpaceCurve curve = zigzag(true);
  const double around = curve.length();
  EXPECT_DOUBLE_EQ(around, 3.0 + std::sqrt(2.0) + std::sqrt(5.0));
  for (double s : { 0.3, 1.7, 4.0, 6.0 })
  {
    EXPECT_LT((curve.at(s) - curve.at(s + around)).norm(), 1e-14);
    EXPECT_LT((curve.at(s) - curve.at(s - 2 * around)).norm(), 1e-14);
  }
}

TEST(SpaceCurve, TheNearestPointIsFoundFromHereOn)
{
  for (bool isClosed : { false, true })
  {
    const SpaceCurve curve = zigzag(isClosed);
    TestRandom random(3);
    for (int k = 0; k < 200; ++k)
    {
      const double s = 0.5 * (1.0 + random()) * curve.length();
      const double near = s + 0.05 * random();
      EXPECT_LT((curve.at(curve.closest(curve.at(s), near)) - curve.at(s)).norm(), 1e-12);
      // never farther than where the search began
      const Vec<3> x = curve.at(s) + 0.3 * Vec<3>(random(), random(), random());
      EXPECT_LE((curve.at(curve.closest(x, s)) - x).norm(), (curve.at(s) - x).norm() + 1e-15);
    }
  }
  const SpaceCurve curve = zigzag(true);
  const double s = curve.closest(curve.at(0.2), curve.length() - 0.1); // over the first point
  EXPECT_NEAR(s, curve.length() + 0.2, 1e-12);
}

TEST(SpaceCurve, DeviationAgainstBruteForce)
{
  std::vector<Vec<3>> points;
  for (int k = 0; k <= 40; ++k)
  {
    const double t = 0.05 * k;
    points.push_back(Vec<3>(std::cos(t), std::sin(t), 0.2 * t));
  }
  const SpaceCurve helix(points, false);
  TestRandom random(5);
  for (int k = 0; k < 100; ++k)
  {
    const double from = 0.5 * (1.0 + random()) * helix.length();
    const double to = 0.5 * (1.0 + random()) * helix.length();
    const double proved = helix.deviation(from, to);
    EXPECT_EQ(proved, helix.deviation(to, from));
    const Vec<3> a = helix.at(from), d = helix.at(to) - a;
    double sampled = 0.0;
    for (int i = 0; i <= 400; ++i)
    {
      const Vec<3> x = helix.at(from + i / 400.0 * (to - from));
      const double t = std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      sampled = std::max(sampled, (a + t * d - x).norm());
    }
    EXPECT_GE(proved, sampled - 1e-12);
    EXPECT_LE(proved, sampled + 1e-3);
  }
}

TEST(SpaceCurve, WhereItTurnsBackNothingIsProved)
{
  const SpaceCurve hairpin({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0.1, 0 } }, false);
  EXPECT_TRUE(std::isinf(hairpin.deviation(0.0, hairpin.length())));
  EXPECT_EQ(hairpin.deviation(0.1, 1.9), 0.0);
  const SpaceCurve loop = zigzag(true);
  EXPECT_TRUE(std::isinf(loop.deviation(0.0, loop.length()))); // its chord has no length
}

TEST(SpaceCurve, ChordsKeepTheLimitsOfThePointsBetween)
{
  const auto leavesRoom = [](const SpaceCurve& curve, double from, double to)
  { return curve.leavesRoom(from, to, curve.at(from), curve.at(to)); };
  SpaceCurve bend({ { 0, 0, 0 }, { 1, 0.1, 0 }, { 2, 0, 0 }, { 3, 0, 0 } }, false);
  const double first = bend.parameter(1), second = bend.parameter(2);
  EXPECT_TRUE(leavesRoom(bend, 0.0, second));
  // The chord passes below the bend, by 0.1.
  for (const double most : { 0.05, 0.15 })
  {
    std::vector<std::vector<RoomLimit>> limits(4);
    limits[1] = { { Vec<3>(0, -1, 0), most } };
    bend.setLimits(limits);
    EXPECT_EQ(leavesRoom(bend, 0.0, second), most > 0.1);
    EXPECT_EQ(leavesRoom(bend, second, 0.0), most > 0.1);
    EXPECT_TRUE(leavesRoom(bend, 0.0, first)); // nothing is between
    EXPECT_TRUE(leavesRoom(bend, first, second));
  }
  std::vector<std::vector<RoomLimit>> above(4);
  above[1] = { { Vec<3>(0, 1, 0), 0.05 } };
  bend.setLimits(above);
  EXPECT_TRUE(leavesRoom(bend, 0.0, second)); // away from it
  const Vec<3> up(0.0, 0.17, 0.0);            // now the line passes above the bend, by 0.07
  EXPECT_FALSE(bend.leavesRoom(0.0, second, up, bend.at(second) + up));
  EXPECT_NEAR(bend.deviation(0.0, second, up, bend.at(second) + up), 0.17, 1e-15);
  EXPECT_NEAR(bend.deviation(0.0, second, 0.3 * up, bend.at(second) + 0.3 * up), 0.051, 1e-15);
  // Closed, across the first point.
  SpaceCurve closed({ { 0, 0.1, 0 }, { 1, 0, 0 }, { 0, -5, 0 }, { -1, 0, 0 } }, true);
  std::vector<std::vector<RoomLimit>> limits(4);
  limits[0] = { { Vec<3>(0, -1, 0), 0.05 } };
  closed.setLimits(limits);
  EXPECT_FALSE(leavesRoom(closed, closed.parameter(3), closed.length() + closed.parameter(1)));
  EXPECT_TRUE(leavesRoom(closed, closed.parameter(1), closed.parameter(3)));
}
}
