// SPDX-License-Identifier: BSD-3-Clause
// The growth of a run: shares of chunks, what comes back, the reserve, and when it is used up.
#include "WorstFirst/GrowthBudget.h"

#include <gtest/gtest.h>

namespace meshopt
{
namespace
{
using worstfirst::GrowthBudget;
using worstfirst::Phase;

constexpr long Allowed = 1000, Reserve = Allowed / worstfirst::ReservedPart, Cells = 500;
constexpr long Usual = worstfirst::WideShrink;

GrowthBudget budget(long mostShrink = -1, bool followsSizes = false)
{
  Options options;
  options.mostShrink = mostShrink;
  return { options, Allowed, Cells, 1.0, followsSizes };
}
}

TEST(GrowthBudget, SharesAllButTheReserveWhenLifting)
{
  const Growth share = budget(100).share(Phase::Lifting, 4);
  EXPECT_EQ(share.left, (Allowed - Reserve) / 4);
  EXPECT_EQ(share.most, (Allowed + 100 - Reserve) / 4);
  EXPECT_FALSE(share.isShort);
}

TEST(GrowthBudget, GivesAllToPolishing)
{
  const Growth share = budget(100).share(Phase::Polishing, 4);
  EXPECT_EQ(share.left, Allowed / 4);
  EXPECT_EQ(share.most, std::numeric_limits<long>::max());
}

TEST(GrowthBudget, LimitsHowManyCellsVanish)
{
  const long shrink = static_cast<long>(worstfirst::ShrinkBudget * Cells);
  EXPECT_EQ(budget().share(Phase::Lifting, 1).most, Allowed + shrink - Reserve);
  EXPECT_GT(budget(-1, true).share(Phase::Lifting, 1).most, 1000 * Allowed);
}

TEST(GrowthBudget, CountsNodesWhereAsked)
{
  // Swaps have removed all cells that may go, and no node.
  const long shrink = static_cast<long>(worstfirst::ShrinkBudget * Cells);
  GrowthBudget b = budget();
  b.takeBack(Phase::Lifting, Allowed - Reserve + shrink, false);
  EXPECT_FALSE(b.share(Phase::Lifting, 1).mayShrink());
  const Growth share = b.share(Phase::Lifting, 2, 0.95);
  EXPECT_TRUE(share.mayShrink());
  EXPECT_NEAR(share.most - share.left, (0.95 - 1.0 + worstfirst::ShrinkBudget) * Cells / 2, 1.0);
  EXPECT_FALSE(b.share(Phase::Lifting, 2, 1.0 - worstfirst::ShrinkBudget).mayShrink());
  // The caller counts cells.
  b = budget(shrink);
  b.takeBack(Phase::Lifting, Allowed - Reserve + shrink, false);
  EXPECT_FALSE(b.share(Phase::Lifting, 2, 0.95).mayShrink());
}

TEST(GrowthBudget, AtTheEndMoreNodesMayVanish)
{
  // As above, and as many nodes as may usually vanish are gone, too.
  GrowthBudget b = budget();
  b.takeBack(Phase::Lifting, Allowed + static_cast<long>(worstfirst::ShrinkBudget * Cells), false);
  const double nodes = 1.0 - worstfirst::ShrinkBudget;
  EXPECT_FALSE(b.share(Phase::Lifting, 1, nodes).mayShrink());
  b.openNodes();
  EXPECT_TRUE(b.share(Phase::Lifting, 1, nodes).mayShrink());
  const double few = 1.0 - worstfirst::ShrinkAtEnd * worstfirst::ShrinkBudget;
  EXPECT_FALSE(b.share(Phase::Lifting, 1, few).mayShrink());
}

TEST(GrowthBudget, TakesBackWhatIsLeft)
{
  GrowthBudget b = budget();
  b.takeBack(Phase::Lifting, 300, false);
  EXPECT_EQ(b.share(Phase::Lifting, 1).left, 300);
  EXPECT_EQ(b.share(Phase::Polishing, 1).left, 300 + Reserve);
  b.takeBack(Phase::Polishing, 50, false);
  EXPECT_EQ(b.share(Phase::Polishing, 1).left, 50);
  EXPECT_LT(b.share(Phase::Lifting, 1).left, 0); // it lives on the reserve
  b.openReserve();
  EXPECT_EQ(b.share(Phase::Lifting, 1).left, 50);
}

TEST(GrowthBudget, IsUsedUpOnlyIfAChangeWasLeftOut)
{
  const long rest = static_cast<long>(worstfirst::UsedUp * Allowed) + worstfirst::OneNode;
  GrowthBudget b = budget();
  EXPECT_FALSE(b.isUsedUp());
  b.takeBack(Phase::Polishing, rest, false);
  EXPECT_FALSE(b.isUsedUp());
  b.takeBack(Phase::Polishing, rest + 1, true);
  EXPECT_FALSE(b.isUsedUp());
  b.takeBack(Phase::Polishing, rest, false); // what was left out stays left out
  EXPECT_TRUE(b.isUsedUp());
}

TEST(GrowthBudget, LetsFewerNodesVanishWhenManyAreGone)
{
  const double least = 1.0 - Usual * worstfirst::ShrinkBudget;
  EXPECT_EQ(budget().mostSwallowed(least + 0.01, Usual), worstfirst::MostSwallowed);
  EXPECT_EQ(budget().mostSwallowed(least - 0.01, Usual), worstfirst::FewestSwallowed);
}

TEST(GrowthBudget, LetsMoreNodesVanishForTheWorstCell)
{
  constexpr long ofWorst = worstfirst::WideShrinkOfWorst;
  const double least = 1.0 - ofWorst * worstfirst::ShrinkBudget;
  ASSERT_LT(least, 1.0 - Usual * worstfirst::ShrinkBudget);
  EXPECT_EQ(budget().mostSwallowed(least + 0.01, ofWorst), worstfirst::MostSwallowed);
  EXPECT_EQ(budget().mostSwallowed(least - 0.01, ofWorst), worstfirst::FewestSwallowed);
}

TEST(GrowthBudget, LetsMoreNodesVanishInAWideMesh)
{
  const auto most = [](double width)
  { return GrowthBudget(Options(), Allowed, Cells, width, false).mostSwallowed(1.0, Usual); };
  EXPECT_EQ(most(1.0), worstfirst::MostSwallowed);
  EXPECT_GT(most(50.0), 4 * worstfirst::MostSwallowed);
  EXPECT_NEAR(most(200.0), 4 * most(50.0), 2);
  // Parts far from each other; lengths that overflow.
  EXPECT_EQ(most(1e15), worstfirst::MostSwallowedAtAll);
  EXPECT_EQ(most(std::numeric_limits<double>::quiet_NaN()), worstfirst::MostSwallowedAtAll);
}

TEST(GrowthBudget, LetsFewerNodesVanishInAPartWhenManyCellsAreGone)
{
  GrowthBudget b = budget(100);
  EXPECT_EQ(b.mostSwallowed(0.0, Usual), worstfirst::MostSwallowed);
  b.takeBack(Phase::Polishing, Allowed + worstfirst::ShrinkAtEnd * 100 - 1, false);
  EXPECT_EQ(b.mostSwallowed(0.0, Usual), worstfirst::MostSwallowed);
  b.takeBack(Phase::Polishing, Allowed + worstfirst::ShrinkAtEnd * 100, false);
  EXPECT_EQ(b.mostSwallowed(1.0, Usual), worstfirst::FewestSwallowed);
}
}
