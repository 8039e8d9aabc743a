// SPDX-License-Identifier: BSD-3-Clause
// The rules by which one set of cells may come for another: a test for each rule.
#include "TestBench.h"

#include "Mesh/PinchedPoints.h"

using namespace meshopt;

namespace
{
/// Two triangles on a long edge (0, 1), and what comes if it is swapped.
MeshInput<2> diamond()
{
  MeshInput<2> in;
  in.points = { { -1, 0 }, { 1, 0 }, { 0, 0.3 }, { 0, -0.3 } };
  in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  return in;
}

Proposal<2> swap(Bench<2>& b)
{
  Proposal<2> p;
  p.cavity = { 0, 1 };
  p.cells = { { 0, 3, 2 }, { 3, 1, 2 } };
  p.oldWorst = b.mesh.worstQuality(p.cavity);
  p.least = b.judge.required(p.oldWorst);
  EXPECT_TRUE(b.judge.measure(p));
  return p;
}

/// Three tetrahedra around the edge (0, 1) for the two on the triangle of their ring, or back.
Proposal<3> threeToTwo(Bench<3>& b)
{
  Proposal<3> p;
  p.cavity = { 0, 1, 2 };
  p.cells = { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  EXPECT_TRUE(b.judge.measure(p));
  return p;
}

MeshInput<3> bipyramid()
{
  MeshInput<3> in = ringOf(3);
  in.cells = { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  return in;
}

Proposal<3> twoToThree(Bench<3>& b)
{
  Proposal<3> p;
  p.cavity = { 0, 1 };
  p.cells = ringOf(3).cells;
  EXPECT_TRUE(b.judge.measure(p));
  return p;
}

/// Qualities are made up: of the two cells that go, and of those that come.
Proposal<2> swap(Bench<2>& b, std::array<double, 2> old, const std::vector<double>& come)
{
  b.editor.setQuality(0, old[0]);
  b.editor.setQuality(1, old[1]);
  Proposal<2> p = swap(b);
  p.oldWorst = std::min(old[0], old[1]);
  p.qualities = come;
  p.newWorst = *std::min_element(come.begin(), come.end());
  p.least = Proposal<2>::Never;
  return p;
}
}

// ---- numbers that are asked ---------------------------------------------------------------------

TEST(Judge, GainIsLessWhereAllIsTiny)
{
  Bench<2> b(diamond());
  for (double gain : { 1e-3, 1e-2 })
  {
    b.judge.setGain(gain);
    EXPECT_EQ(b.judge.gain(0.5), gain); // 2 gain q at most: that is reached at q = 1/2
    EXPECT_EQ(b.judge.gain(0.9), gain);
    EXPECT_EQ(b.judge.gain(0.1), 2.0 * gain * 0.1);
    EXPECT_EQ(b.judge.gain(-0.1), 2.0 * gain * 0.1);
    EXPECT_EQ(b.judge.gain(0.0), 1e-4 * gain);
    EXPECT_EQ(b.judge.gain(1e-9), 1e-4 * gain);
    for (double q : { -0.4, 0.0, 0.3, 0.8 })
    {
      EXPECT_EQ(b.judge.required(q), q + b.judge.gain(q));
    }
  }
}

TEST(Judge, EnoughIsTheTargetOrTwoGains)
{
  Bench<2> b(diamond());
  b.judge.setTarget(0.6);
  EXPECT_EQ(b.judge.enough(0.2), 0.6 + 0.02);
  EXPECT_EQ(b.judge.enough(0.7), 0.7 + 2.0 * b.judge.gain(0.7));
}

TEST(Judge, ASearchIsToReachEnoughByStepsOfHalfAGain)
{
  Bench<2> b(diamond());
  b.judge.setTarget(0.6);
  const SearchGoal goal = b.judge.goal(0.2, 7);
  EXPECT_EQ(goal.enough, b.judge.enough(0.2));
  EXPECT_EQ(goal.gain, 0.5 * b.judge.gain(0.2));
  EXPECT_EQ(goal.steps, 7);
}

TEST(Judge, DemandsThatWhatComesGains)
{
  Bench<2> b(diamond());
  Proposal<2> p = swap(b);
  b.judge.demand(p);
  EXPECT_EQ(p.least, b.judge.required(p.oldWorst));
  b.judge.demand(p, 0.7); // another cell counts
  EXPECT_EQ(p.least, b.judge.required(0.7));
}

TEST(Judge, CellsMayComeIfGrowthHasRoom)
{
  Bench<2> b(diamond());
  b.judge.growth.left = 2;
  EXPECT_TRUE(b.judge.mayAddCells(2));
  EXPECT_FALSE(b.judge.growth.isShort);
  EXPECT_FALSE(b.judge.mayAddCells(3));
  EXPECT_TRUE(b.judge.growth.isShort); // noted for the report
}

TEST(Judge, AnInsertionGainsAndKeepsTheGuard)
{
  Bench<2> b(diamond());
  b.editor.setQuality(0, 0.12);
  b.editor.setQuality(1, 0.9);
  const double required = b.judge.required(0.12);
  const std::vector<Index> cavity{ 0, 1 };
  const double enough = std::nextafter(required, 1.0);
  EXPECT_FALSE(b.judge.mayInsert(0.12, required, { required, 0.15 }, cavity));
  EXPECT_TRUE(b.judge.mayInsert(0.12, enough, { enough, 0.15 }, cavity));
  b.judge.setGuard(0.17); // of insertions, even where nothing else is guarded
  EXPECT_FALSE(b.judge.mayInsert(0.12, enough, { enough, 0.15 }, cavity));
  EXPECT_TRUE(b.judge.mayInsert(0.12, enough, { enough, 0.17 }, cavity));
}

TEST(Judge, NodesMayGoIfTheSwitchAndGrowthSaySo)
{
  Bench<2> b(diamond());
  EXPECT_TRUE(b.judge.mayRemoveNodes());
  b.judge.growth.most = b.judge.growth.left;
  EXPECT_FALSE(b.judge.mayRemoveNodes());
  b.judge.growth.most = b.judge.growth.left + 1;
  EXPECT_TRUE(b.judge.mayRemoveNodes());
  b.switches.removeNodes = false;
  EXPECT_FALSE(b.judge.mayRemoveNodes());
}

TEST(Judge, CountsWhatIsTriedAndDone)
{
  Bench<2> b(diamond());
  b.judge.count(Operation::EdgeRemoval, true);
  b.judge.count(Operation::EdgeRemoval, false);
  b.judge.count(Operation::LookAhead, false);
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    const bool isEdge = op == static_cast<int>(Operation::EdgeRemoval);
    const bool isAhead = op == static_cast<int>(Operation::LookAhead);
    EXPECT_EQ(b.judge.tried[op], isEdge ? 2 : isAhead ? 1 : 0);
    EXPECT_EQ(b.judge.done[op], isEdge ? 1 : 0);
  }
}

TEST(Judge, AFailureCountsUntilSomethingChanges)
{
  Bench<2> b(diamond());
  EXPECT_TRUE(b.judge.failsAgain(7, 7));
  EXPECT_TRUE(b.judge.failsAgain(8, 7));
  EXPECT_FALSE(b.judge.failsAgain(7, 8)); // changed since
  EXPECT_FALSE(b.judge.failsAgain(0, 0)); // never failed
  b.judge.setFailuresSince(8);
  EXPECT_FALSE(b.judge.failsAgain(8, 7));
  EXPECT_TRUE(b.judge.failsAgain(9, 7));
}

TEST(Judge, SaysWhatIsDemanded)
{
  Bench<2> b(diamond());
  b.judge.setGain(1e-2, 4);
  b.judge.setGuard(0.3, true);
  EXPECT_EQ(b.judge.demand(), (Demand{ 1e-2, 4, 0.3, true }));
  EXPECT_EQ(b.judge.steps(), 4);
}

TEST(Judge, MeasuringEndsAtTheFirstCellThatIsNoBetter)
{
  Bench<2> b(diamond());
  Proposal<2> p;
  p.cells = { { 0, 3, 2 }, { 0, 1, 2 }, { 3, 1, 2 } };
  const double good = b.model(p.cells[0]), bad = b.model(p.cells[1]);
  ASSERT_LT(bad, good);
  EXPECT_TRUE(b.judge.measure(p));
  EXPECT_EQ(p.qualities, (std::vector<double>{ good, bad, b.model(p.cells[2]) }));
  EXPECT_EQ(p.newWorst, bad);
  p.least = bad; // not better than that
  EXPECT_FALSE(b.judge.measure(p));
  EXPECT_EQ(p.qualities.size(), 2u);
  p.least = std::nextafter(bad, 0.0);
  EXPECT_TRUE(b.judge.measure(p));
}

// ---- quality ------------------------------------------------------------------------------------

TEST(Judge, TakesWhatIsBetterThanLeast)
{
  Bench<2> b(diamond());
  Proposal<2> p = swap(b);
  EXPECT_GT(p.newWorst, p.oldWorst);
  p.least = p.newWorst;
  expectRefused(b, [&] { return b.judge.accept(p); });
  p.least = std::nextafter(p.newWorst, 0.0);
  doUndoAndDo(b, [&] { return b.judge.accept(p); });
  EXPECT_EQ(b.worst(), p.newWorst);
}

TEST(Judge, QualitiesThatAreKnownAreNotComputed)
{
  Bench<2> b(diamond());
  Proposal<2> p = swap(b);
  p.qualities.clear();
  ASSERT_TRUE(b.judge.accept(p));
  for (Index c : b.editor.created())
  {
    EXPECT_EQ(b.mesh.quality(c), b.model(b.mesh.nodes(c)));
  }
  Bench<2> known(diamond());
  p = swap(known, { 0.1, 0.1 }, { 0.125, 0.375 }); // not what they are
  ASSERT_TRUE(known.judge.accept(p));
  EXPECT_EQ(known.mesh.quality(known.editor.created()[0]), 0.125);
  EXPECT_EQ(known.mesh.quality(known.editor.created()[1]), 0.375);
}

TEST(Judge, ChangedAreTheCellsSinceStart)
{
  Bench<2> b(diamond());
  b.judge.start();
  EXPECT_TRUE(b.judge.changed().empty());
  Proposal<2> p = swap(b);
  ASSERT_TRUE(b.judge.accept(p));
  std::vector<Index> all = b.editor.created();
  EXPECT_EQ(b.judge.changed(), all);
  Proposal<2> back; // the edge as it was
  back.cavity = b.editor.created();
  back.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  ASSERT_TRUE(b.judge.measure(back));
  ASSERT_TRUE(b.judge.accept(back));
  all.insert(all.end(), b.editor.created().begin(), b.editor.created().end());
  EXPECT_EQ(b.judge.changed(), all);
  b.judge.start();
  EXPECT_TRUE(b.judge.changed().empty());
}

// ---- topology -----------------------------------------------------------------------------------

TEST(Judge, WhereCellsOverlapTheCavityMustBeFilled)
{
  Bench<2> b(diamond());
  Proposal<2> p = swap(b);
  p.cells.pop_back(); // half of it
  p.qualities.pop_back();
  EXPECT_TRUE(b.judge.fits(p)); // geometry is trusted where cells do not overlap
  const std::vector<std::uint8_t> none;
  b.judge.setTangled(true, false, none);
  EXPECT_FALSE(b.judge.fits(p));
  expectRefused(b, [&] { return b.judge.accept(p); });
  p = swap(b);
  EXPECT_TRUE(b.judge.fits(p));
  EXPECT_TRUE(b.judge.accept(p));
}

TEST(Judge, WhereCellsOverlapNoEdgeMayCome)
{
  MeshInput<2> in = diamond(); // and a triangle that lies on it, with the edge that would come
  in.points.emplace_back(5, 0);
  in.cells.push_back({ 2, 3, 4 });
  Bench<2> b(in);
  const Proposal<2> p = swap(b);
  EXPECT_TRUE(b.judge.fits(p));
  const std::vector<std::uint8_t> pinched = pinchedPoints<2>(b.mesh);
  ASSERT_EQ(pinched, (std::vector<std::uint8_t>{ 0, 0, 1, 1, 0 }));
  b.judge.setTangled(true, true, pinched);
  EXPECT_TRUE(b.judge.hasInverted());
  expectRefused(b, [&] { return b.judge.accept(p); });
}

TEST(Judge, KeptEdgesStayUnlessTheProposalSaysOtherwise)
{
  MeshInput<3> in = ringOf(3);
  in.keptEdges = { { 1, 0 } };
  Bench<3> b(in);
  Proposal<3> p = threeToTwo(b);
  expectRefused(b, [&] { return b.judge.accept(p); });
  p.changesKept = true;
  p.kept.goneEdges = { { 0, 1 } };
  p.kept.regions = { 0, 0 };
  EXPECT_TRUE(b.judge.accept(p));
  Bench<3> other(ringOf(3));
  EXPECT_TRUE(other.judge.accept(threeToTwo(other)));
}

// ---- growth -------------------------------------------------------------------------------------

TEST(Judge, NoMoreCellsComeThanMay)
{
  Bench<3> b(bipyramid());
  const Proposal<3> p = twoToThree(b);
  ASSERT_EQ(p.growth(), 1);
  b.judge.growth.left = 0;
  expectRefused(b, [&] { return b.judge.accept(p); });
  EXPECT_TRUE(b.judge.growth.isShort);
  EXPECT_EQ(b.judge.growth.left, 0);
  b.judge.growth.left = 1;
  doUndoAndDo(b, [&] { return b.judge.accept(p); });
  EXPECT_EQ(b.judge.growth.left, 0); // taken once: undoing has given it back
}

TEST(Judge, CellsThatGoMakeRoom)
{
  Bench<3> b(ringOf(3));
  const Proposal<3> p = threeToTwo(b);
  ASSERT_EQ(p.growth(), -1);
  b.judge.growth.left = 0;
  ASSERT_TRUE(b.judge.accept(p));
  EXPECT_EQ(b.judge.growth.left, 1);
  EXPECT_FALSE(b.judge.growth.isShort);
}

TEST(Judge, WithoutASlotNothingHappens)
{
  Bench<3> b(bipyramid());
  b.giveAway({}); // an owner takes slots of its own pool only, and that is empty
  b.judge.growth.left = 7;
  b.judge.setGuard(1.0);
  const auto mark = b.judge.begin();
  const Proposal<3> p = twoToThree(b);
  expectRefused(b, [&] { return b.judge.accept(p); });
  EXPECT_TRUE(b.editor.isHeldUp());
  EXPECT_EQ(b.judge.growth.left, 7);
  EXPECT_TRUE(b.judge.keepsGuard(mark));
  b.judge.commit(mark);
}

// ---- guard --------------------------------------------------------------------------------------

TEST(Judge, BadnessGoesByThirds)
{
  Bench<2> b(diamond());
  const double guard = 0.3;
  b.editor.setQuality(0, 0.31);
  b.editor.setQuality(1, 0.31);
  const auto badness = [&](double q) { return b.judge.badBalance({ q }, { 0, 1 }); };
  EXPECT_EQ(badness(0.05), 0); // no guard, no count
  b.judge.setGuard(guard);
  EXPECT_EQ(badness(0.3), 0);
  EXPECT_EQ(badness(0.29), 1);
  EXPECT_EQ(badness(0.2 + 1e-9), 1);
  EXPECT_EQ(badness(0.2 - 1e-9), 2);
  EXPECT_EQ(badness(0.1 + 1e-9), 2);
  EXPECT_EQ(badness(0.1 - 1e-9), 3);
  EXPECT_EQ(badness(-1.0), 3);
  b.editor.setQuality(1, 0.15); // what goes counts the other way
  EXPECT_EQ(badness(0.29), 1 - 2);
  EXPECT_EQ(b.judge.badBalance({ 0.29, 0.09, 0.5 }, { 0, 1 }), 1 + 3 - 2);
}

TEST(Judge, NoMoreBadCellsThanBefore)
{
  const std::array<double, 2> old{ 0.12, 0.9 };
  const std::vector<double> come{ 0.15, 0.15 }; // the worst is lifted, at the price of another
  const double guard = 0.17;
  Bench<2> b(diamond());
  const Proposal<2> p = swap(b, old, come);
  b.judge.setGuard(guard, true);
  ASSERT_EQ(b.judge.badBalance(come, p.cavity), 1);
  expectRefused(b, [&] { return b.judge.accept(p); });
  b.judge.setGuard(guard, false); // insertions only, which ask for themselves
  EXPECT_TRUE(b.judge.accept(p));

  Bench<2> even(diamond());
  even.judge.setGuard(guard, true);
  EXPECT_TRUE(even.judge.accept(swap(even, { 0.12, 0.16 }, come)));
}

TEST(Judge, TheGuardLetsAnInvertedCellGo)
{
  Bench<2> b(diamond());
  const Proposal<2> p = swap(b, { -0.1, 0.9 }, { 0.01, 0.01 });
  b.judge.setGuard(0.3, true);
  ASSERT_EQ(b.judge.badBalance(p.qualities, p.cavity), 3 + 3 - 3);
  EXPECT_TRUE(b.judge.accept(p));
}

TEST(Judge, WithinATransactionTheGuardIsAskedAtItsEnd)
{
  Bench<2> b(diamond());
  const Proposal<2> p = swap(b, { 0.12, 0.9 }, { 0.15, 0.15 });
  b.judge.setGuard(0.17, true);
  auto mark = b.judge.begin();
  EXPECT_TRUE(b.judge.keepsGuard(mark));
  ASSERT_TRUE(b.judge.accept(p));
  EXPECT_FALSE(b.judge.keepsGuard(mark));
  b.judge.rollback(mark); // takes back the balance, too
  EXPECT_TRUE(b.judge.keepsGuard(mark));
  mark = b.judge.begin();
  const Proposal<2> good = swap(b, { 0.12, 0.9 }, { 0.2, 0.2 });
  ASSERT_TRUE(b.judge.accept(good));
  EXPECT_TRUE(b.judge.keepsGuard(mark));
  b.judge.commit(mark);
}

TEST(Judge, EndsATransactionByTheGuardOfAllItsChanges)
{
  Bench<2> b(diamond());
  const Proposal<2> p = swap(b, { 0.12, 0.9 }, { 0.15, 0.15 });
  b.judge.setGuard(0.17, true);
  expectRefused(b,
    [&]
    {
      const auto mark = b.judge.begin();
      const bool done = b.judge.accept(p);
      EXPECT_TRUE(done);
      return b.judge.endGuarded(mark, done);
    });
  const Proposal<2> good = swap(b, { 0.12, 0.9 }, { 0.2, 0.2 });
  for (bool isGood : { false, true })
  {
    const auto mark = b.judge.begin();
    ASSERT_TRUE(b.judge.accept(good));
    EXPECT_EQ(b.judge.endGuarded(mark, isGood), isGood);
    EXPECT_FALSE(b.editor.inTransaction());
    EXPECT_EQ(b.worst(), isGood ? 0.2 : 0.12);
  }
}

TEST(Judge, RemembersFailuresOutsideOfTransactionsOnly)
{
  Bench<2> b(diamond());
  b.editor.setClock(5);
  const auto mark = b.judge.begin();
  b.judge.noteMoveFailed(2);
  b.judge.noteRemovalFailed(2);
  b.judge.commit(mark);
  EXPECT_EQ(b.mesh.pointData(2).moveFailed, 0u);
  EXPECT_EQ(b.mesh.pointData(2).removeFailed, 0u);
  b.judge.noteMoveFailed(2);
  EXPECT_EQ(b.mesh.pointData(2).moveFailed, b.editor.clock());
  EXPECT_EQ(b.mesh.pointData(2).removeFailed, 0u);
  b.judge.noteRemovalFailed(2);
  EXPECT_EQ(b.mesh.pointData(2).removeFailed, b.editor.clock());
}

/// The history counts what remains. What an operation is worth is another question.
TEST(Judge, WhatIsUndoneIsNotDone)
{
  constexpr auto op = static_cast<int>(Operation::EdgeRemoval);
  Bench<2> b(diamond());
  b.judge.count(Operation::EdgeRemoval, true);
  const auto mark = b.judge.begin();
  b.judge.count(Operation::EdgeRemoval, true);
  b.judge.rollback(mark);
  b.judge.count(Operation::EdgeRemoval, false);
  EXPECT_EQ(b.judge.tried[op], 3);
  EXPECT_EQ(b.judge.done[op], 1);
  EXPECT_EQ(b.judge.gained[op], 2);
}
