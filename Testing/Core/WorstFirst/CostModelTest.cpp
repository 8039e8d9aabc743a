// SPDX-License-Identifier: BSD-3-Clause
// The memory of what passes, tries and polishing have cost, against cases counted by hand.
#include "WorstFirst/CostModel.h"

#include <gtest/gtest.h>

namespace
{
using meshopt::Effort;
using meshopt::worstfirst::CostModel;

TEST(CostModel, APassIsDearByWhatItPaidForEachLiftedCell)
{
  CostModel costs(Effort::Default);
  EXPECT_FALSE(costs.isDear(0, 0.3)); // nothing is known yet
  costs.notePass(0, 0.3, 1000000, 100);
  EXPECT_FALSE(costs.isDear(0, 0.3));
  costs.notePass(0, 0.3, 1000000, 10);
  EXPECT_TRUE(costs.isDear(0, 0.3));
  EXPECT_FALSE(costs.isDear(1, 0.3));
  EXPECT_FALSE(costs.isDear(0, 0.45));
}

TEST(CostModel, ACheapRepairDoesNotMakeADearPassCheap)
{
  CostModel costs(Effort::Default);
  costs.notePass(2, 0.3, 1000000, 1);
  costs.notePass(2, 0.3, 1000, 1000);
  EXPECT_TRUE(costs.isDear(2, 0.3));
}

TEST(CostModel, APassThatLiftsNoneOrLosesSomeIsCountedAsIfItHadLiftedOne)
{
  CostModel costs(Effort::Default);
  costs.notePass(0, 0.6, 1000, -5);
  EXPECT_FALSE(costs.isDear(0, 0.6));
  costs.notePass(0, 0.6, 1000000, -5);
  EXPECT_TRUE(costs.isDear(0, 0.6));
}

TEST(CostModel, AQuickRunFindsPassesDearEarlier)
{
  CostModel quick(Effort::Quick), usual(Effort::Default);
  for (CostModel* costs : { &quick, &usual })
  {
    costs->notePass(0, 0.3, 300000, 10);
  }
  EXPECT_TRUE(quick.isDear(0, 0.3));
  EXPECT_FALSE(usual.isDear(0, 0.3));
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
  constexpr long cells = 10000;
  CostModel costs(Effort::Default);
  costs.notePolish(1, 0.1); // the first worst is a rise over nothing
  costs.notePolish(1000000, 0.102);
  EXPECT_TRUE(costs.mayPolish(cells));
  costs.notePolish(800000, 0.104);
  EXPECT_FALSE(costs.mayPolish(cells));
  EXPECT_TRUE(costs.mayPolish(10 * cells)); // by the cells of the mesh
  costs.notePolish(1, 0.106);               // 0.1 + 5 % is passed: it starts again
  EXPECT_TRUE(costs.mayPolish(cells));
}

TEST(CostModel, ASmallMeshMayBePolishedForALookAheadOrTwo)
{
  CostModel costs(Effort::Quick);
  costs.notePolish(1, 0.1);
  costs.notePolish(299999, 0.1);
  EXPECT_TRUE(costs.mayPolish(10));
  costs.notePolish(2, 0.1);
  EXPECT_FALSE(costs.mayPolish(10));
}
}
