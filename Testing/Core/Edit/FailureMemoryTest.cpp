// SPDX-License-Identifier: BSD-3-Clause
// Which failures count for which demands, by hand.
#include "Edit/FailureMemory.h"

#include <gtest/gtest.h>

namespace
{
using meshopt::Demand;
using meshopt::FailureMemory;

const Demand usual{ 1e-3, 8, 0.3, false };

TEST(FailureMemory, OnlyWhatAskedForMoreIsForgotten)
{
  FailureMemory memory;
  EXPECT_EQ(memory.since(usual), 0u);
  memory.note(usual, 10);
  Demand coarse = usual, fine = usual, few = usual;
  coarse.gain = 1e-2;
  fine.gain = 1e-4;
  few.steps = 4;
  EXPECT_EQ(memory.since(usual), 0u);
  EXPECT_EQ(memory.since(coarse), 0u);
  EXPECT_EQ(memory.since(few), 0u);
  EXPECT_EQ(memory.since(fine), 10u);
  memory.note(coarse, 20);
  EXPECT_EQ(memory.since(usual), 20u);
  EXPECT_EQ(memory.since(few), 20u);
  EXPECT_EQ(memory.since(coarse), 0u); // what failed for less fails for more
  memory.note(few, 30);
  EXPECT_EQ(memory.since(usual), 30u);
  EXPECT_EQ(memory.since(few), 20u);
  memory.note(usual, 40); // again
  EXPECT_EQ(memory.since(fine), 40u);
}

TEST(FailureMemory, AGuardCountsOnlyForItself)
{
  FailureMemory memory;
  Demand guarded = usual, other = usual;
  guarded.guardsAll = other.guardsAll = true;
  other.guard = 0.6;
  memory.note(guarded, 10);
  EXPECT_EQ(memory.since(usual), 10u);
  EXPECT_EQ(memory.since(other), 10u);
  EXPECT_EQ(memory.since(guarded), 0u);
  Demand lower = usual;
  lower.guard = 0.1; // asked of insertions only, which ask again
  memory.note(lower, 20);
  EXPECT_EQ(memory.since(usual), 10u);
  EXPECT_EQ(memory.since(guarded), 0u);
}
}
