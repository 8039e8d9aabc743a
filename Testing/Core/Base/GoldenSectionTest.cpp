// SPDX-License-Identifier: BSD-3-Clause
// The golden section against functions whose greatest value is known.
#include "Base/GoldenSection.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace meshopt;

namespace
{
/// What is left of an interval after so many steps.
double leftOf(double length, int steps)
{
  return length * std::pow(0.5 * (std::sqrt(5.0) - 1.0), steps);
}
}

TEST(GoldenSection, FindsTheTopWhereverItIs)
{
  constexpr double low = -1.0, high = 2.0;
  for (int steps : { 5, 14, 30 })
  {
    for (double top = low; top <= high; top += 0.0625)
    {
      const auto smooth = [top](double x) { return 3.0 - (x - top) * (x - top); };
      const auto sharp = [top](double x)
      { return 3.0 - (x > top ? 2.0 : 0.5) * std::fabs(x - top); };
      const double tolerance = leftOf(high - low, steps) + 1e-7; // smooth tops are flat in rounding
      double best = 0.0;
      double x = goldenSection(low, high, steps, smooth, best);
      EXPECT_NEAR(x, top, tolerance);
      EXPECT_EQ(best, smooth(x));
      x = goldenSection(low, high, steps, sharp, best);
      EXPECT_NEAR(x, top, tolerance);
      EXPECT_EQ(best, sharp(x));
      x = goldenSection(high, low, steps, sharp, best); // from the other end
      EXPECT_NEAR(x, top, tolerance);
    }
  }
}

TEST(GoldenSection, GoesToTheEndOfWhatOnlyRisesOrFalls)
{
  const auto rising = [](double x) { return x; };
  const auto falling = [](double x) { return -x; };
  double best = 0.0;
  const double tolerance = leftOf(1.0, 20);
  EXPECT_NEAR(goldenSection(4.0, 5.0, 20, rising, best), 5.0, tolerance);
  EXPECT_NEAR(best, 5.0, tolerance);
  EXPECT_NEAR(goldenSection(4.0, 5.0, 20, falling, best), 4.0, tolerance);
  EXPECT_NEAR(best, -4.0, tolerance);
}

TEST(GoldenSection, AsksTwiceAndOnceAStep)
{
  for (int steps : { 0, 1, 14 })
  {
    int asked = 0;
    double best = 0.0;
    goldenSection(
      0.0, 1.0, steps,
      [&asked](double x)
      {
        ++asked;
        EXPECT_GE(x, 0.0);
        EXPECT_LE(x, 1.0);
        return -x * x;
      },
      best);
    EXPECT_EQ(asked, 2 + steps);
  }
}
