// SPDX-License-Identifier: BSD-3-Clause
// What a run has to tell before it has run, and the sentences for the user.
#include "Run/Report.h"

#include <gtest/gtest.h>

#include <set>

using namespace meshopt;

TEST(Report, SaysThatNothingHasRun)
{
  const Report report;
  EXPECT_EQ(report.stopReason, StopReason::NotRun);
  EXPECT_STREQ(toString(report.stopReason), "not run");
  EXPECT_TRUE(report.history.empty());
  EXPECT_EQ(report.bound, 1.0);
}

TEST(Report, EachReasonHasASentenceOfItsOwn)
{
  std::set<std::string> sentences;
  for (int k = 0; k <= static_cast<int>(StopReason::GrowthLimit); ++k)
  {
    sentences.insert(toString(static_cast<StopReason>(k)));
  }
  EXPECT_EQ(sentences.size(), static_cast<std::size_t>(StopReason::GrowthLimit) + 1);
  EXPECT_EQ(sentences.count(""), 0u);
}
