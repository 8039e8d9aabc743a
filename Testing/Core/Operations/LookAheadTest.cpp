// SPDX-License-Identifier: BSD-3-Clause
// Several changes that pay only together: all of them or none, and an end to trying.
#include "Operations/LookAhead.h"
#include "Operations/NodeMotion.h"
#include "Operations/Reconnect.h"
#include "Polyhedra.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
template <int D>
using Shape = MeanEdgeShape<D>;

/// What the engine does at the lowest level: reconnection, then motion.
template <int D>
struct Repair
{
  Bench<D>& bench;
  Reconnect<D, Shape<D>> reconnect;
  NodeMotion<D, Shape<D>> motion;
  int calls = 0, level = -1;

  bool operator()(Index t, int at)
  {
    ++this->calls;
    this->level = at;
    this->bench.judge.start();
    return this->reconnect.improve(this->bench.judge, t, at) ||
      this->motion.improve(this->bench.judge, t, at);
  }
};

/// Improves all cells under `quality` by single changes until none helps: the rest needs several.
template <int D>
void useUpSingleChanges(Bench<D>& b, double quality)
{
  Repair<D> repair{ b, {}, {} };
  NodeInsertion<D, Shape<D>> insertion;
  for (int round = 0, done = 1; round < 20 && done > 0; ++round)
  {
    done = 0;
    for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
    {
      done += b.mesh.isAlive(t) && b.mesh.quality(t) < quality &&
        (repair(t, Level::Topology) || insertion.improve(b.judge, t, Level::Insertion));
    }
  }
}

template <int D>
constexpr double Bad = D == 3 ? 0.72 : 0.9;

/// A mesh that single changes do not help any more.
template <int D>
struct Stuck : Bench<D>
{
  explicit Stuck(unsigned seed = 1)
    : Bench<D>(jitteredGrid<D>(D == 3 ? 3 : 6, 0.35, seed))
  {
    useUpSingleChanges<D>(*this, Bad<D>);
  }
};
}

template <class T>
class LookingAhead : public ::testing::Test
{
};
TYPED_TEST_SUITE(LookingAhead, TestDimensions);

TYPED_TEST(LookingAhead, InAMeshEachTryRaisesOrRestores)
{
  constexpr int D = TypeParam::dimension;
  int helped = 0, calls = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    Stuck<D> b(seed);
    Repair<D> repair{ b, {}, {} };
    LookAhead<D, Shape<D>> ahead;
    ahead.setImprove(std::ref(repair));
    Bench<D>& bench = b;
    const int done = tryEverywhere(ahead, bench, Level::LookAhead, Bad<D>);
    EXPECT_EQ(triedOf(b.judge.gained, Operation::LookAhead), done); // also what was undone
    EXPECT_TRUE(repair.calls == 0 || repair.level == Level::Topology);
    helped += done;
    calls += repair.calls;
  }
  EXPECT_GE(helped, D == 3 ? 4 : 0);
  EXPECT_GT(calls, 10);
}

/// All that is not as it was is in changed(), not what the last change has made only; and better.
TYPED_TEST(LookingAhead, ReportsAllThatIsAffected)
{
  constexpr int D = TypeParam::dimension;
  Stuck<D> b;
  Repair<D> repair{ b, {}, {} };
  LookAhead<D, Shape<D>> ahead;
  ahead.setImprove(std::ref(repair));
  const SimplexMesh<D> before = b.mesh;
  int several = 0;
  for (Index t = 0; t < before.numberOfCellSlots(); ++t)
  {
    if (!before.isAlive(t) || !(before.quality(t) < Bad<D>))
    {
      continue;
    }
    const auto mark = b.judge.begin();
    repair.calls = 0;
    if (ahead.improve(b.judge, t, Level::LookAhead))
    {
      several += repair.calls > 0;
      const std::vector<Index>& changed = b.judge.changed();
      for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
      {
        const bool isAsBefore = c < before.numberOfCellSlots() && before.isAlive(c) &&
          before.nodes(c) == b.mesh.nodes(c) && before.quality(c) == b.mesh.quality(c);
        if (b.mesh.isAlive(c) && !isAsBefore)
        {
          EXPECT_NE(std::find(changed.begin(), changed.end(), c), changed.end()) << c;
          EXPECT_GT(b.mesh.quality(c), b.judge.required(before.quality(t)));
        }
      }
    }
    b.judge.rollback(mark);
  }
  EXPECT_GE(several, D == 3 ? 1 : 0);
}

TYPED_TEST(LookingAhead, WithoutRepairOnlyAnInsertionThatPaysIsKept)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(fromOneCorner<D>());
  LookAhead<D, Shape<D>> ahead;
  int calls = 0;
  ahead.setImprove(
    [&](Index, int)
    {
      ++calls;
      return false;
    });
  const double old = b.worst();
  EXPECT_TRUE(ahead.improve(b.judge, 1, Level::LookAhead)); // its centre is all it takes
  EXPECT_GT(b.worst(), b.judge.required(old));
  calls = 0;
  expectRefused(b, [&] { return ahead.improve(b.judge, b.editor.created()[0], Level::LookAhead); });
  EXPECT_GT(calls, 0);
}

/// How often a repair is asked that says it helps and does nothing. `isFar`: the cell is far below
/// its bound.
template <int D>
int numberOfCalls(int level, bool isFar)
{
  Bench<D> b(jitteredGrid<D>(3, 0.0)); // nothing gains here
  b.judge.setWide(isFar ? 1 : None);
  LookAhead<D, Shape<D>> ahead;
  int calls = 0;
  ahead.setImprove(
    [&](Index, int at)
    {
      EXPECT_EQ(at, level == Level::LookAhead ? Level::Topology : Level::Insertion);
      b.judge.start();
      ++calls;
      return true;
    });
  const Index t = cellNear<D>(b.mesh, Vec<D>::Constant(0.5));
  expectRefused(b, [&] { return ahead.improve(b.judge, t, level); });
  return calls;
}

/// It is asked 30 times for each seed; when polishing 120 times, and as often for each of five ways
/// to shake the nodes around, if the cell is far below its bound.
TYPED_TEST(LookingAhead, GivesUpAfterSoManyOperations)
{
  constexpr int D = TypeParam::dimension;
  const Bench<D> b(jitteredGrid<D>(3, 0.0));
  std::vector<Vec<D>> seeds;
  NodeInsertion<D, Shape<D>>::findSeeds(b.mesh, cellNear<D>(b.mesh, Vec<D>::Constant(0.5)), seeds);
  for (int level : { Level::LookAhead, Level::LongLookAhead })
  {
    const int most = level == Level::LookAhead ? 30 : 120;
    const int calls = numberOfCalls<D>(level, false);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(calls % most, 0);
    EXPECT_LE(calls, most * static_cast<int>(seeds.size()));
    const int shakes = level == Level::LookAhead ? 0 : 5;
    EXPECT_EQ(numberOfCalls<D>(level, true), calls + most * shakes);
  }
}

TYPED_TEST(LookingAhead, AsksForTheWorstFirst)
{
  constexpr int D = TypeParam::dimension;
  Stuck<D> b;
  LookAhead<D, Shape<D>> ahead;
  int calls = 0;
  ahead.setImprove(
    [&](Index t, int)
    {
      ++calls;
      for (Index c : b.judge.changed()) // at first those that the insertion has made
      {
        EXPECT_FALSE(b.mesh.isAlive(c) && b.mesh.quality(c) < b.mesh.quality(t));
      }
      return false;
    });
  for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
  {
    if (b.mesh.isAlive(t) && b.mesh.quality(t) < Bad<D>)
    {
      const auto mark = b.judge.begin();
      ahead.improve(b.judge, t, Level::LookAhead);
      b.judge.rollback(mark);
    }
  }
  EXPECT_GT(calls, 10);
}

TYPED_TEST(LookingAhead, NothingWithoutASlotOrRoom)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> slots(fromOneCorner<D>()), room(fromOneCorner<D>());
  LookAhead<D, Shape<D>> ahead;
  ahead.setImprove([](Index, int) { return false; });
  slots.giveAway({});
  expectRefused(slots, [&] { return ahead.improve(slots.judge, 0, Level::LookAhead); });
  room.judge.growth.left = 1;
  expectRefused(room, [&] { return ahead.improve(room.judge, 0, Level::LookAhead); });
  EXPECT_TRUE(room.judge.growth.isShort);
  EXPECT_EQ(room.judge.growth.left, 1);
}
