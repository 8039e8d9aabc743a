// SPDX-License-Identifier: BSD-3-Clause
// What a run has to tell before it has run, and the sentences for the user.
#include "Run/Report.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace meshopt;

TEST(Report, SaysThatNothingHasRun)
{
  const Report report;
  EXPECT_EQ(report.stopReason, StopReason::NotRun);
  EXPECT_EQ(describeStop(report), "not run");
  EXPECT_TRUE(report.history.empty());
  EXPECT_EQ(report.bound, 1.0);
}

TEST(Report, EachReasonHasASentenceOfItsOwn)
{
  std::set<std::string> sentences;
  for (int k = 0; k <= static_cast<int>(StopReason::GrowthLimit); ++k)
  {
    Report report;
    report.stopReason = static_cast<StopReason>(k);
    sentences.insert(describeStop(report));
  }
  EXPECT_EQ(sentences.size(), static_cast<std::size_t>(StopReason::GrowthLimit) + 1);
  EXPECT_EQ(sentences.count(""), 0u);
}

TEST(Report, SaysHowNearTheBoundIsWhereTheSurfaceWasKept)
{
  Report report;
  report.worstAfter = 0.079;
  for (const auto& [reason, sentence] : std::map<StopReason, std::string>{
         { StopReason::NoFurtherGain, "no operation improves the worst cells any more" },
         { StopReason::GrowthLimit, "growth budget used up: what would help needs more cells" } })
  {
    report.stopReason = reason;
    report.bound = 1.0; // nothing is known
    EXPECT_EQ(describeStop(report), sentence);
    report.bound = 0.09; // too far away to be what holds it
    EXPECT_EQ(describeStop(report), sentence);
    report.bound = 0.08;
    EXPECT_EQ(describeStop(report), sentence + "; what is kept allows no more than 0.08");
  }
  // The worst one is at the bound: more cells would not help it.
  report.stopReason = StopReason::GrowthLimit;
  report.worstAfter = report.bound = 0.08;
  EXPECT_EQ(describeStop(report),
    "growth budget used up, and the worst cell is as good as it can be; what is kept "
    "allows no more than 0.08");
  // Where another reason ended the run, the bound is not it.
  for (const StopReason reason : { StopReason::TimeLimit, StopReason::CappedBySurface })
  {
    report.stopReason = reason;
    EXPECT_EQ(describeStop(report).find("allows"), std::string::npos);
  }
}

TEST(Report, SaysWhereTheWorstCellIsIfTheSurfaceTookPart)
{
  Report report;
  report.stopReason = StopReason::NoFurtherGain;
  report.worstNodes[static_cast<int>(Freedom::Corner)] = 1;
  report.worstNodes[static_cast<int>(Freedom::Fixed)] = 1;
  report.worstNodes[static_cast<int>(Freedom::Free)] = 2;
  EXPECT_EQ(describeStop(report),
    "no operation improves the worst cells any more; nodes of the worst one: 2 at corners, 2 "
    "inside");
  report.bound = 0.5;
  report.worstAfter = 0.4;
  EXPECT_EQ(describeStop(report).find("held"), std::string::npos);
  report.worstAfter = 0.49;
  EXPECT_EQ(describeStop(report),
    "no operation improves the worst cells any more; nodes of the worst one: 2 at corners, 2 "
    "inside; held by the angles of ridges and corners: they allow no more than 0.5000");
  report.stopReason = StopReason::TargetReached;
  EXPECT_EQ(describeStop(report), "target quality reached");
}
