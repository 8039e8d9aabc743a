// SPDX-License-Identifier: BSD-3-Clause
// How many cells may come, and whether something was left out for want of them.
#include "Edit/Growth.h"

#include <gtest/gtest.h>

using namespace meshopt;

TEST(Growth, AllowsWhatIsLeft)
{
  Growth growth;
  growth.left = 5;
  EXPECT_TRUE(growth.allows(5));
  EXPECT_FALSE(growth.isShort);
  EXPECT_FALSE(growth.allows(6));
  EXPECT_TRUE(growth.isShort);
  EXPECT_TRUE(growth.allows(4));
  EXPECT_TRUE(growth.isShort); // what was left out stays left out
}

TEST(Growth, CellsMayAlwaysGo)
{
  Growth growth;
  growth.left = -3; // more have come than were allowed
  EXPECT_TRUE(growth.allows(0));
  EXPECT_TRUE(growth.allows(-1));
  EXPECT_FALSE(growth.isShort);
  EXPECT_FALSE(growth.allows(1));
}

TEST(Growth, NoLimitIsNone)
{
  Growth growth;
  EXPECT_TRUE(growth.allows(AnyGrowth));
  growth.left += AnyGrowth; // as where that many have gone: no overflow
  EXPECT_GT(growth.left, 0);
  EXPECT_FALSE(growth.isShort);
}

TEST(Growth, NodesGoUntilMostIsReached)
{
  Growth growth;
  growth.left = 10;
  growth.most = 12;
  EXPECT_TRUE(growth.mayShrink());
  growth.left = 11;
  EXPECT_TRUE(growth.mayShrink());
  growth.left = 12;
  EXPECT_FALSE(growth.mayShrink());
  growth.left = 13;
  EXPECT_FALSE(growth.mayShrink());
  EXPECT_TRUE(Growth().mayShrink());
}
