// SPDX-License-Identifier: BSD-3-Clause
// The rules by which nodes may move: a test for each rule.
#include "TestBench.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
/// A hexagon whose middle node is off its centre.
MeshInput<2> hexagon()
{
  MeshInput<2> in = star<2>();
  in.points[0] = Vec<2>(0.5, 0.1);
  return in;
}

Proposal<2> moveTo(Bench<2>& b, const Vec<2>& x)
{
  Proposal<2> p;
  b.editor.star(0, p.cavity);
  p.moves.push_back({ 0, x, {} });
  p.oldWorst = p.least = b.mesh.worstQuality(p.cavity);
  return p;
}

const Vec<2> Centre(0.0, 0.0), Corner(0.9, 0.0), Outside(1.5, 0.0);
}

TEST(JudgeMotion, TakesAMoveByWhichAllCellsAreBetterThanLeast)
{
  Bench<2> b(hexagon());
  const Proposal<2> p = moveTo(b, Centre);
  b.judge.start();
  b.judge.growth.left = 0; // no cell comes
  doUndoAndDo(b, [&] { return b.judge.accept(p); });
  EXPECT_EQ(b.mesh.point(0), Centre);
  EXPECT_NEAR(b.worst(), 1.0, 1e-15); // six regular triangles
  EXPECT_EQ(b.judge.growth.left, 0);
  // both times it was done
  std::vector<Index> twice = p.cavity;
  twice.insert(twice.end(), p.cavity.begin(), p.cavity.end());
  EXPECT_EQ(b.judge.changed(), twice);
}

TEST(JudgeMotion, WhatASearchHasFoundMustGain)
{
  Bench<2> b(hexagon());
  Proposal<2> p = moveTo(b, Centre);
  b.judge.demand(p);
  EXPECT_EQ(p.least, p.oldWorst); // of the cells themselves
  EXPECT_EQ(p.leastFound, b.judge.required(p.oldWorst));
  p.newWorst = p.leastFound;
  expectRefused(b, [&] { return b.judge.accept(p); });
  p.newWorst = std::nextafter(p.leastFound, 1.0);
  EXPECT_TRUE(b.judge.accept(p));
}

TEST(JudgeMotion, OneCellThatIsNoBetterIsEnoughToRefuse)
{
  Bench<2> b(hexagon());
  Proposal<2> p = moveTo(b, Corner);
  expectRefused(b, [&] { return b.judge.accept(p); });
  Vec<2> slightly = 0.9 * b.mesh.point(0);
  p = moveTo(b, slightly);
  Bench<2> same(hexagon());
  Proposal<2> copy = moveTo(same, slightly);
  ASSERT_TRUE(same.judge.accept(copy));
  p.least = same.worst(); // not better than that
  expectRefused(b, [&] { return b.judge.accept(p); });
  p.least = std::nextafter(p.least, 0.0);
  EXPECT_TRUE(b.judge.accept(p));
}

TEST(JudgeMotion, ChangedIsEmptyAfterARefusal)
{
  Bench<2> b(hexagon());
  b.judge.start();
  EXPECT_FALSE(b.judge.accept(moveTo(b, Corner)));
  EXPECT_TRUE(b.judge.changed().empty());
}

TEST(JudgeMotion, WhoAsksAlsoSeesTheNodesWhereTheyGo)
{
  Bench<2> b(hexagon());
  const Proposal<2> p = moveTo(b, Centre);
  int asked = 0;
  const auto also = [&](bool answer)
  {
    return [&b, &asked, answer]
    {
      ++asked;
      EXPECT_EQ(b.mesh.point(0), Centre);
      return answer;
    };
  };
  expectRefused(b, [&] { return b.judge.acceptIf(p, also(false)); });
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(b.judge.acceptIf(p, also(true)));
  EXPECT_EQ(asked, 2);
}

TEST(JudgeMotion, APositiveCellStaysPositiveWhereThatIsAsked)
{
  Bench<2> b(hexagon());
  Proposal<2> p = moveTo(b, Outside);
  p.least = Proposal<2>::Never;
  p.keepsPositive = true;
  expectRefused(b, [&] { return b.judge.accept(p); });
  p.keepsPositive = false;
  EXPECT_TRUE(b.judge.accept(p));
  EXPECT_LT(b.worst(), 0.0);
  p = moveTo(b, Outside + Vec<2>(0.5, 0.0)); // what is not positive may stay so
  p.least = Proposal<2>::Never;
  p.keepsPositive = true;
  const Snapshot<2> before(b.editor);
  EXPECT_TRUE(b.judge.accept(p));
  EXPECT_FALSE(Snapshot<2>(b.editor) == before);
}

TEST(JudgeMotion, QualitiesThatAreKnownAreNotComputed)
{
  Bench<2> b(hexagon());
  Proposal<2> p = moveTo(b, Corner);
  p.least = 0.0;
  p.qualities = { 0.5, 0.51, 0.52, 0.53, 0.54, 0.55 }; // not what they are
  ASSERT_TRUE(b.judge.accept(p));
  for (std::size_t k = 0; k < p.cavity.size(); ++k)
  {
    EXPECT_EQ(b.mesh.quality(p.cavity[k]), p.qualities[k]);
  }
}

TEST(JudgeMotion, SeveralNodesMoveAtOnceOrNone)
{
  MeshInput<3> in = jitteredGrid<3>(3, 0.25);
  Bench<3> b(in);
  std::vector<Index> free;
  for (Index p = 0; p < b.mesh.numberOfPointSlots(); ++p)
  {
    if (b.mesh.isFree(p))
    {
      free.push_back(p);
    }
  }
  ASSERT_EQ(free.size(), 8u); // (3 - 1)^3
  Proposal<3> p;
  const SimplexMesh<3> even = buildMesh(jitteredGrid<3>(3, 0.0));
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<3>& nodes = b.mesh.nodes(c);
    if (std::any_of(nodes.begin(), nodes.end(), [&](Index v) { return b.mesh.isFree(v); }))
    {
      p.cavity.push_back(c);
    }
  }
  for (Index v : free)
  {
    p.moves.push_back({ v, even.point(v), {} });
  }
  p.oldWorst = p.least = b.mesh.worstQuality(p.cavity);
  doUndoAndDo(b, [&] { return b.judge.accept(p); });
  for (Index v : free)
  {
    EXPECT_EQ(b.mesh.point(v), even.point(v));
  }
  p.moves.back().x = Vec<3>::Zero(); // one of them goes astray
  p.moves.front().x += Vec<3>::Constant(0.01);
  expectRefused(b, [&] { return b.judge.accept(p); });
}

TEST(JudgeMotion, ThePlaceOnTheSurfaceGoesWithTheNode)
{
  Bench<2> b(hexagon());
  const Place before{ Freedom::Curve, 3, 0.25 }, after{ Freedom::Curve, 3, 0.75 };
  b.editor.setPlace(0, before);
  Proposal<2> p = moveTo(b, Centre);
  p.moves[0].place = after;
  const auto mark = b.judge.begin();
  ASSERT_TRUE(b.judge.accept(p));
  EXPECT_EQ(b.mesh.place(0).parameter, after.parameter);
  b.judge.rollback(mark);
  EXPECT_EQ(b.mesh.place(0).parameter, before.parameter);
  p.moves[0].place = Place(); // a free node has none: that of the mesh stays
  ASSERT_TRUE(b.judge.accept(p));
  EXPECT_EQ(b.mesh.place(0).part, before.part);
  EXPECT_EQ(b.mesh.place(0).parameter, before.parameter);
}

TEST(JudgeMotion, NoMoreBadCellsThanBefore)
{
  const double guard = 0.5;
  const auto moved = [&](double oldWorst, bool all)
  {
    Bench<2> b(hexagon());
    Proposal<2> p = moveTo(b, Centre);
    p.qualities.assign(6, 0.4); // each is bad, before it was one
    for (std::size_t k = 0; k < 6; ++k)
    {
      b.editor.setQuality(p.cavity[k], k == 0 ? oldWorst : 0.9);
    }
    p.oldWorst = p.least = oldWorst;
    b.judge.setGuard(guard, all);
    const Snapshot<2> before(b.editor);
    const bool done = b.judge.accept(p);
    EXPECT_EQ(Snapshot<2>(b.editor) == before, !done);
    return done;
  };
  EXPECT_FALSE(moved(0.3, true));
  EXPECT_TRUE(moved(0.3, false));
  EXPECT_TRUE(moved(-0.3, true)); // an inverted cell goes at any price
}

TEST(JudgeMotion, BadCellsOfMovesAreCounted)
{
  Bench<2> b(hexagon());
  b.judge.setGuard(0.5);
  Proposal<2> p = moveTo(b, Centre);
  p.qualities.assign(6, 0.4);
  p.least = 0.0;
  for (Index c : p.cavity)
  {
    b.editor.setQuality(c, 0.9);
  }
  const auto mark = b.judge.begin();
  ASSERT_TRUE(b.judge.accept(p));
  EXPECT_FALSE(b.judge.keepsGuard(mark));
  b.judge.rollback(mark);
}

TEST(JudgeMotion, StampsStarsOrOnlyTheNode)
{
  for (bool stars : { true, false })
  {
    Bench<2> b(hexagon());
    b.judge.setStampsStars(stars);
    const std::uint32_t before = b.editor.clock();
    ASSERT_TRUE(b.judge.accept(moveTo(b, Centre)));
    for (Index p = 0; p < 7; ++p)
    {
      EXPECT_EQ(b.mesh.pointData(p).stamp > before, stars || p == 0) << p;
    }
  }
}
