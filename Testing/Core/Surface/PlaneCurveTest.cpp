// SPDX-License-Identifier: BSD-3-Clause
// Curves through points: where they go, what is nearest, how far from the chord.
#include "Surface/PlaneCurve.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
std::vector<Vec<2>> wave(int n)
{
  std::vector<Vec<2>> points;
  for (int k = 0; k < n; ++k)
  {
    const double x = k / (n - 1.0) + 0.3 / n * std::sin(5.0 * k); // not evenly spaced
    points.emplace_back(x, 0.2 * std::sin(2.0 * Pi * x));
  }
  return points;
}

/// Nearest of many points of the curve.
double bruteForce(const PlaneCurve& curve, const Vec<2>& x)
{
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 20000; ++k)
  {
    least = std::min(least, (curve.at(curve.length() * k / 20000) - x).norm());
  }
  return least;
}
}

TEST(PlaneCurve, SixteenPointsMakeACircle)
{
  const double radius = 3.0;
  const PlaneCurve curve(circle(16, radius), true, true);
  EXPECT_TRUE(curve.isClosed());
  EXPECT_NEAR(curve.length(), 32 * radius * std::sin(Pi / 16), 1e-12);
  double worst = 0.0;
  for (int k = 0; k < 5000; ++k)
  {
    worst = std::max(worst, std::fabs(curve.at(curve.length() * k / 5000).norm() / radius - 1.0));
  }
  EXPECT_LT(worst, 1e-4);
}

TEST(PlaneCurve, ClosesSmoothlyAndIsPeriodic)
{
  std::vector<Vec<2>> points = circle(11);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    points[k] *= 1.0 + 0.2 * std::sin(3.0 * k);
  }
  const PlaneCurve curve(points, true, true);
  const double all = curve.length(), h = 1e-4;
  for (double s : { 0.0, 0.3, 2.0 })
  {
    for (double turns : { -2.0, -1.0, 1.0, 3.0 })
    {
      EXPECT_LT((curve.at(s + turns * all) - curve.at(s)).norm(), 1e-12);
    }
  }
  // first and second derivative from both sides of where it closes
  const auto d1 = [&](double s, double step) -> Vec<2>
  { return (-1.5 * curve.at(s) + 2.0 * curve.at(s + step) - 0.5 * curve.at(s + 2 * step)) / step; };
  const auto d2 = [&](double s, double step) -> Vec<2>
  { return (curve.at(s) - 2.0 * curve.at(s + step) + curve.at(s + 2 * step)) / (step * step); };
  EXPECT_LT((d1(0.0, h) - d1(all, -h)).norm(), 1e-5);
  EXPECT_LT((d2(0.0, h) - d2(all, -h)).norm(), 1e-2 * d2(0.0, h).norm() + 1e-2);
}

TEST(PlaneCurve, GoesThroughItsPoints)
{
  for (bool closed : { false, true })
  {
    for (bool spline : { false, true })
    {
      for (int n : { 2, 3, 4, 5, 40 })
      {
        if (closed && n < 3)
        {
          continue;
        }
        const std::vector<Vec<2>> points = closed ? circle(n) : wave(n);
        const PlaneCurve curve(points, closed, spline);
        EXPECT_EQ(curve.isClosed(), closed);
        for (int k = 0; k < n; ++k)
        {
          EXPECT_LT((curve.at(curve.parameter(k)) - points[k]).norm(), 1e-13) << n << " " << k;
          double distance = 1.0;
          EXPECT_LT((curve.at(curve.closest(points[k], distance)) - points[k]).norm(), 1e-12);
          EXPECT_LT(distance, 1e-12);
        }
      }
    }
  }
}

TEST(PlaneCurve, CollinearPointsStayStraight)
{
  const Vec<2> origin(1.0, -2.0), direction(0.6, 0.8);
  std::vector<Vec<2>> points;
  for (double t : { 0.0, 0.1, 0.5, 0.51, 2.0, 2.5 })
  {
    points.push_back(origin + t * direction);
  }
  for (bool spline : { false, true })
  {
    const PlaneCurve curve(points, false, spline);
    double last = -1.0;
    for (int k = 0; k <= 1000; ++k)
    {
      const Vec<2> d = curve.at(curve.length() * k / 1000) - origin;
      EXPECT_NEAR(d[0] * direction[1] - d[1] * direction[0], 0.0, 1e-13);
      EXPECT_GT(d.dot(direction), last); // and goes forward only
      last = d.dot(direction);
    }
    EXPECT_LT(curve.sagitta(0.0, curve.length()), 1e-13);
  }
}

TEST(PlaneCurve, StraightLinesBetweenPoints)
{
  const PlaneCurve curve({ { 0, 0 }, { 1, 0 }, { 1, 2 } }, false, false);
  EXPECT_EQ(curve.length(), 3.0);
  EXPECT_EQ(curve.at(0.25), Vec<2>(0.25, 0.0));
  EXPECT_EQ(curve.at(1.0), Vec<2>(1.0, 0.0));
  EXPECT_EQ(curve.at(2.5), Vec<2>(1.0, 1.5));
  EXPECT_EQ(curve.at(-1.0), Vec<2>(0.0, 0.0)); // an open curve ends at its ends
  EXPECT_EQ(curve.at(9.0), Vec<2>(1.0, 2.0));
  EXPECT_EQ(curve.sagitta(0.0, 1.0), 0.0);
  EXPECT_GT(curve.sagitta(0.0, 3.0), 0.5);
  double distance = 0.0;
  EXPECT_EQ(curve.closest(Vec<2>(0.5, -3.0), distance), 0.5);
  EXPECT_EQ(distance, 3.0);
  EXPECT_EQ(curve.closest(Vec<2>(5.0, 5.0), distance), 3.0);
  EXPECT_EQ(distance, 5.0);
}

TEST(PlaneCurve, ClosestIsTheNearestPoint)
{
  TestRandom random(3);
  for (bool closed : { false, true })
  {
    const PlaneCurve curve(closed ? circle(12) : wave(12), closed, true);
    for (int k = 0; k < 20; ++k)
    {
      const Vec<2> x(1.5 * random(), 1.5 * random());
      double distance = 0.0;
      const double s = curve.closest(x, distance);
      EXPECT_GE(s, 0.0);
      EXPECT_LE(s, curve.length());
      EXPECT_DOUBLE_EQ(distance, (curve.at(s) - x).norm());
      EXPECT_LE(distance, bruteForce(curve, x) + 1e-9) << x.transpose();
    }
  }
  // a foot of a perpendicular is found again
  const PlaneCurve curve(circle(16), true, true);
  for (double s : { 0.1, 1.7, 4.0, 6.1 })
  {
    double distance = 0.0;
    EXPECT_NEAR(curve.closest(1.01 * curve.at(s), distance), s, 1e-3);
    EXPECT_NEAR(curve.closest(curve.at(s), distance), s, 1e-6);
  }
}

TEST(PlaneCurve, Sagitta)
{
  const PlaneCurve curve(circle(16, 2.0), true, true);
  EXPECT_NEAR(curve.sagitta(0.0, curve.length() / 4), 2.0 * (1.0 - std::cos(Pi / 4)), 1e-3);
  EXPECT_NEAR(curve.sagitta(curve.length() / 4, 0.0), 2.0 * (1.0 - std::cos(Pi / 4)), 1e-3);
  EXPECT_NEAR(curve.sagitta(0.0, curve.length()), 4.0, 1e-3); // all around
  EXPECT_EQ(curve.sagitta(1.0, 1.0), 0.0);
}

TEST(PlaneCurve, PowersOfTwoScaleBitwise)
{
  const std::vector<Vec<2>> points = wave(9);
  const PlaneCurve curve(points, false, true);
  for (int exponent : { -30, 12 })
  {
    const double f = std::ldexp(1.0, exponent);
    std::vector<Vec<2>> scaled = points;
    for (Vec<2>& x : scaled)
    {
      x *= f;
    }
    const PlaneCurve other(scaled, false, true);
    for (int k = 0; k <= 50; ++k)
    {
      const double s = curve.length() * k / 50;
      EXPECT_EQ(Vec<2>(other.at(f * s)), Vec<2>(f * curve.at(s)));
    }
  }
}

/// Against differences, for curves of both kinds, open and closed.
TEST(PlaneCurve, DirectionIsTheDerivative)
{
  constexpr double step = 1e-6;
  for (bool spline : { false, true })
  {
    const PlaneCurve curves[] = { PlaneCurve(wave(9), false, spline),
      PlaneCurve(circle(16, 2.0), true, spline),
      PlaneCurve({ { 0, 0 }, { 3, 4 } }, false, spline) };
    for (const PlaneCurve& curve : curves)
    {
      for (int k = 0; k < 200; ++k)
      {
        const double s = curve.length() * (k + 0.37) / 200;
        const Vec<2> d = curve.at(s + step) - curve.at(s - step);
        EXPECT_NEAR(curve.direction(s).norm(), 1.0, 1e-14);
        EXPECT_LT((curve.direction(s) - d.normalized()).norm(), 1e-8) << s;
      }
    }
  }
}

TEST(PlaneCurve, DirectionAtEndsAndBetweenLines)
{
  const std::vector<Vec<2>> points{ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 0, 1 } };
  const PlaneCurve open(points, false, false), closed(points, true, false);
  const Vec<2> east(1, 0), north(0, 1), south(0, -1);
  for (const PlaneCurve* curve : { &open, &closed })
  {
    EXPECT_EQ(curve->direction(0.0), east);
    EXPECT_EQ(curve->direction(2.0), north); // that of the line after the point
    EXPECT_EQ(curve->direction(3.0), -east);
  }
  EXPECT_EQ(open.direction(5.0), -east); // the end: there is none after it
  EXPECT_EQ(open.direction(9.0), -east);
  EXPECT_EQ(closed.direction(5.0), south);
  EXPECT_EQ(closed.direction(5.5), south);
  EXPECT_EQ(closed.direction(6.0), east); // and around again
  EXPECT_EQ(closed.direction(-0.5), south);
}
