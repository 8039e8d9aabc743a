// SPDX-License-Identifier: BSD-3-Clause
// The ascent by trust, on problems that answer by a list.
#include "Reposition/TrustRegion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace meshopt;

namespace
{
using R = TrustRegion;

/// A unit gradient: a step with trust tau promises a gain of tau. Of that it gains the next of
/// `shares`; when these are used up, nothing.
struct Listed
{
  explicit Listed(std::vector<double> ofSteps = {})
    : shares(std::move(ofSteps))
  {
  }

  std::vector<double> shares;
  std::vector<double> trusts, required; ///< of each step
  double at = 0.0;                      ///< the worst where it is
  double there = 0.0;                   ///< the worst after the step
  int linearized = 0, accepted = 0;

  void linearize(double worst)
  {
    EXPECT_EQ(worst, this->at);
    ++this->linearized;
  }
  double predict(double tau)
  {
    this->trusts.push_back(tau);
    return this->at + tau;
  }
  double tryStep(double least)
  {
    const std::size_t k = this->required.size();
    this->required.push_back(least);
    this->there = this->at + (k < this->shares.size() ? this->shares[k] : 0.0) * this->trusts[k];
    return this->there;
  }
  void accept()
  {
    this->at = this->there;
    ++this->accepted;
  }
};

constexpr double NoEnd = std::numeric_limits<double>::infinity();
}

TEST(TrustRegion, GrowsWhereStepsHoldWhatTheyPromise)
{
  Listed problem({ 1.0, 1.0, 1.0, 1.0 });
  const double worst = ascend(problem, 0.0, 0.5, { NoEnd, 0.0, 4 });
  // tau, 3 tau, 9 tau, 27 tau: a geometric series.
  EXPECT_DOUBLE_EQ(worst, 0.5 * (std::pow(R::Growth, 4) - 1.0) / (R::Growth - 1.0));
  EXPECT_EQ(problem.at, worst);
  EXPECT_EQ(problem.accepted, 4);
  EXPECT_EQ(problem.linearized, 4);
}

TEST(TrustRegion, ShrinksFiveTimesAndGivesUpWhereNothingIsGained)
{
  Listed problem;
  EXPECT_EQ(ascend(problem, 0.0, 1.0, { NoEnd, 0.0, 100 }), 0.0);
  ASSERT_EQ(problem.trusts.size(), std::size_t(R::Trials));
  for (int k = 0; k < R::Trials; ++k)
  {
    EXPECT_DOUBLE_EQ(problem.trusts[k], std::pow(R::Shrinkage, k));
  }
  EXPECT_EQ(problem.linearized, 1); // all from one place
  EXPECT_EQ(problem.accepted, 0);
}

TEST(TrustRegion, ComparesWithWhatWasPromised)
{
  // Taken with more than the least share, with more trust after more than the good share.
  const double little = 0.5 * R::LeastShare, some = 0.5 * (R::LeastShare + R::GoodShare);
  const double much = 0.5 * (1.0 + R::GoodShare);
  Listed problem({ some, much, little, some, some });
  const double worst = ascend(problem, 0.0, 1.0, { NoEnd, 0.0, 5 });
  const double low = R::Growth * R::Shrinkage;
  const std::vector<double> trusts{ 1.0, 1.0, R::Growth, low, low };
  ASSERT_EQ(problem.trusts.size(), trusts.size());
  double at = 0.0;
  for (std::size_t k = 0; k < trusts.size(); ++k)
  {
    EXPECT_DOUBLE_EQ(problem.trusts[k], trusts[k]) << k;
    EXPECT_DOUBLE_EQ(problem.required[k], at + R::LeastShare * trusts[k]) << k;
    at += problem.shares[k] > R::LeastShare ? problem.shares[k] * trusts[k] : 0.0;
  }
  EXPECT_DOUBLE_EQ(worst, at);
  EXPECT_EQ(problem.accepted, 4);
  EXPECT_EQ(problem.linearized, 4); // the refused step and the next one are from one place
}

/// Refusals from one place are counted, not those of the whole search; but all are steps.
TEST(TrustRegion, TrialsBeginAnewWhereAStepIsTaken)
{
  const std::vector<double> shares{ 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5 };
  Listed problem(shares);
  ascend(problem, 0.0, 1.0, { NoEnd, 0.0, 100 });
  EXPECT_EQ(problem.accepted, 2);
  EXPECT_EQ(problem.required.size(), shares.size() + R::Trials);
  Listed ended(shares);
  ascend(ended, 0.0, 1.0, { NoEnd, 0.0, 7 });
  EXPECT_EQ(ended.required.size(), 7u);
  EXPECT_EQ(ended.accepted, 1);
}

TEST(TrustRegion, EndsAtItsGoal)
{
  const std::vector<double> all(9, 1.0);
  Listed there(all);
  EXPECT_EQ(ascend(there, 0.0, 1.0, { 0.0, 0.0, 9 }), 0.0); // enough from the start
  EXPECT_EQ(there.linearized, 0);
  Listed later(all);
  EXPECT_EQ(ascend(later, 0.0, 1.0, { 3.5, 0.0, 9 }), 1.0 + R::Growth); // the first above 3.5
  Listed dear(all);
  EXPECT_EQ(ascend(dear, 0.0, 1.0, { NoEnd, 1.0, 9 }), 0.0); // a step must promise more
  EXPECT_TRUE(dear.required.empty());
  Listed cheap(all);
  EXPECT_GT(ascend(cheap, 0.0, 1.0, { NoEnd, 0.99, 9 }), 0.0);
  Listed unknown(all);
  EXPECT_EQ(ascend(unknown, 0.0, std::nan(""), { NoEnd, 0.0, 9 }), 0.0);
  EXPECT_TRUE(unknown.required.empty());
}
