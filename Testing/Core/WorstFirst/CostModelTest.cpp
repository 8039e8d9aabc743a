// SPDX-License-Identifier: BSD-3-Clause
// The memory of what passes, tries and polishing have cost, against cases counted by hand.
#include "WorstFirst/CostModel.h"

#include <gtest/gtest.h>

namespace
{
using meshopt::Effort;
using meshopt::worstfirst::CostModel;

TEST(CostModel, WhatAPassEarnsIsNotWasted)
{
  CostModel costs(Effort::Default);
  costs.open(100000, 1000);
  const double all = costs.leftForPass();
  EXPECT_NEAR(all, 0.3 * (100.0 * 100000 + 2500.0 * 1000), 1e-6);
  costs.notePass(1000 * static_cast<long>(costs.pricePerLifted()), 1000);
  EXPECT_EQ(costs.leftForPass(), all);
  costs.notePass(1000, 1000); // a cheap pass does not pay for others
  EXPECT_EQ(costs.leftForPass(), all);
  costs.notePass(50000, 0);
  EXPECT_NEAR(costs.leftForPass(), all - 0.3 * 50000, 1e-6);
}

TEST(CostModel, EachPassMayDoALittleWhateverWasWasted)
{
  CostModel costs(Effort::Default);
  costs.open(1000, 100);
  costs.notePass(100000000, 10);
  EXPECT_NEAR(costs.leftForPass(), 3.0 * 1000, 1e-6);
}

TEST(CostModel, ASmallMeshMayWasteAsMuchAsALargerOne)
{
  CostModel small(Effort::Default), larger(Effort::Default);
  small.open(10, 2);
  larger.open(1000, 200);
  EXPECT_NEAR(small.leftForPass(), 0.3 * 6e5, 1e-6);
  EXPECT_EQ(small.leftForPass(), larger.leftForPass());
}

TEST(CostModel, ASmallMeshWithFewNodesInsideMayWasteLess)
{
  CostModel without(Effort::Default), some(Effort::Default);
  without.open(1000, 0);
  some.open(1000, 60);
  EXPECT_NEAR(without.leftForPass(), 0.3 * 2e5, 1e-6);
  EXPECT_NEAR(some.leftForPass(), 0.3 * (1.0 / 3.0 + 0.3) * 6e5, 1e-6);
}

TEST(CostModel, PastTheTargetNothingIsLimited)
{
  CostModel costs(Effort::Best);
  costs.open(1000, 100);
  costs.notePass(100000000, 10);
  costs.notePolish(1, 0.1);
  costs.notePolish(100000000, 0.1);
  EXPECT_LT(costs.leftForPolish(), 0.0);
  costs.endLimits();
  EXPECT_EQ(costs.leftForPass(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(costs.leftForPolish(), std::numeric_limits<double>::infinity());
}

TEST(CostModel, WhatPolishingMaySpendHasAFactor)
{
  const double wide = CostModel::PolishFactorOfSliding, few = CostModel::PolishFactorOfFew[0];
  CostModel costs(Effort::Quick);
  costs.open(1000, 100);
  const double kept = costs.leftForPolish();
  EXPECT_GT(costs.leftForPolish(wide), 2.0 * kept);
  EXPECT_LT(costs.leftForPolish(few), 0.8 * kept);
  costs.notePolish(1, 0.1);
  costs.notePolish(static_cast<std::int64_t>(0.9 * kept), 0.1);
  EXPECT_LE(costs.leftForPolish(few), 0.0); // since the worst has risen
  EXPECT_GT(costs.leftForPolish(), 0.0);
  costs.notePolish(static_cast<std::int64_t>(costs.leftForPolish(wide)) + 1, 0.1);
  EXPECT_LE(costs.leftForPolish(wide), 0.0);
}

TEST(CostModel, AQuickRunMayWasteLess)
{
  CostModel quick(Effort::Quick), usual(Effort::Default);
  quick.open(1000, 100);
  usual.open(1000, 100);
  EXPECT_LT(quick.leftForPass(), usual.leftForPass());
  EXPECT_LT(quick.pricePerLifted(), usual.pricePerLifted());
}

TEST(CostModel, PatienceFallsWithEachPassInVainAndComesBackWithSuccess)
{
  CostModel costs(Effort::Default);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 400);
  costs.noteTries(CostModel::Insertion, 400, false);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 100);
  EXPECT_EQ(costs.patience(CostModel::Look, 40), 40); // each kind has its own
  for (int pass = 0; pass < 100; ++pass)
  {
    costs.noteTries(CostModel::Insertion, 100, false);
  }
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 25);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 10), 10);
  costs.noteTries(CostModel::Insertion, 25, true);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 400);
}

TEST(CostModel, PatienceComesBackByHalfAtAnotherTarget)
{
  CostModel costs(Effort::Default);
  costs.startStage(0.3);
  costs.noteTries(CostModel::Insertion, 400, false);
  costs.startStage(0.3); // the same one goes on
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 100);
  costs.startStage(0.45);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 200);
  EXPECT_EQ(costs.patience(CostModel::Look, 40), 40); // nothing is lost where nothing failed
}

TEST(CostModel, AFewTriesProveNothing)
{
  CostModel costs(Effort::Default);
  costs.noteTries(CostModel::Insertion, 24, false);
  EXPECT_EQ(costs.patience(CostModel::Insertion, 400), 400);
}

TEST(CostModel, PolishingEndsUnlessTheWorstRises)
{
  CostModel costs(Effort::Default), inside(Effort::Default);
  costs.open(10000, 0);
  inside.open(10000, 1000); // with more free nodes it may take longer
  for (CostModel* c : { &costs, &inside })
  {
    c->notePolish(1, 0.1); // the first worst is a rise over nothing
    c->notePolish(300000, 0.102);
  }
  EXPECT_NEAR(costs.leftForPolish(), 34.0 * 10000 - 300000, 1e-6);
  EXPECT_NEAR(inside.leftForPolish(), costs.leftForPolish() + 1250.0 * 1000, 1e-6);
  costs.notePolish(200000, 0.104);
  EXPECT_LT(costs.leftForPolish(), 0.0);
  costs.notePolish(1, 0.106); // 0.1 + 5 % is passed: it starts again
  EXPECT_NEAR(costs.leftForPolish(), 34.0 * 10000, 1e-6);
}

/// However often the worst rises. Other efforts go on.
TEST(CostModel, AQuickRunPolishesOnlySoMuchInAll)
{
  for (Effort effort : { Effort::Quick, Effort::Default })
  {
    CostModel costs(effort);
    costs.open(100000, 0);
    const double perRise = costs.leftForPolish();
    double worst = 0.001, spent = 0.0;
    for (; costs.leftForPolish() > 0.0 && worst < 0.9; worst *= 1.1)
    {
      costs.notePolish(static_cast<std::int64_t>(0.5 * perRise), worst);
      spent += 0.5 * perRise;
    }
    EXPECT_EQ(worst < 0.9, effort == Effort::Quick);
    EXPECT_GE(spent, 3.0 * perRise); // a few rises are paid for
    EXPECT_LE(costs.leftForPolish(), perRise);
  }
}

/// A look-ahead takes some 1e5. With more cells a quick run may spend as much as others.
TEST(CostModel, ASmallMeshMayBePolishedForALookAheadOrTwo)
{
  const auto most = [](Effort effort, long cells)
  {
    CostModel costs(effort);
    costs.open(cells, 0);
    return costs.leftForPolish();
  };
  EXPECT_NEAR(most(Effort::Quick, 10), 1e5, 1e-6);
  EXPECT_NEAR(most(Effort::Quick, 2000), 80.0 * 2000, 1e-6);
  EXPECT_NEAR(most(Effort::Quick, 4000), 2e5, 1e-6);
  EXPECT_NEAR(most(Effort::Default, 10), 2e5, 1e-6);
  CostModel costs(Effort::Quick);
  costs.open(10, 1);
  costs.notePolish(1, 0.1);
  costs.notePolish(99999, 0.1);
  EXPECT_GT(costs.leftForPolish(), 0.0);
  costs.notePolish(2, 0.1);
  EXPECT_LT(costs.leftForPolish(), 0.0);
}
}
