// SPDX-License-Identifier: BSD-3-Clause
#include "Base/SinceRise.h"

#include <gtest/gtest.h>

using meshopt::SinceRise;

TEST(SinceRise, TheFirstQualityIsARise)
{
  SinceRise since;
  EXPECT_EQ(since.spent(), 0.0);
  since.note(100.0, -0.5); // of an inverted cell
  EXPECT_EQ(since.spent(), 0.0);
}

TEST(SinceRise, WhatIsSpentAddsUpUntilTheQualityRisesClearly)
{
  SinceRise since;
  since.note(100.0, 0.2);
  since.note(10.0, 0.2);
  since.note(10.0, 0.208);
  EXPECT_EQ(since.spent(), 20.0);
  since.note(10.0, 0.1); // undone, say
  EXPECT_EQ(since.spent(), 30.0);
  since.note(10.0, 0.2101); // small rises add up
  EXPECT_EQ(since.spent(), 0.0);
  since.note(10.0, 0.22);
  EXPECT_EQ(since.spent(), 10.0);
}

TEST(SinceRise, NegativeQualitiesRiseTowardsZero)
{
  SinceRise since;
  since.note(1.0, -0.5);
  since.note(1.0, -0.48);
  EXPECT_EQ(since.spent(), 1.0);
  since.note(1.0, -0.47);
  EXPECT_EQ(since.spent(), 0.0);
}
