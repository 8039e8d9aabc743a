// SPDX-License-Identifier: BSD-3-Clause
// A node goes into the neighbour for which that pays most: against trying them all.
#include "Operations/NodeRemoval.h"
#include "Mesh/Ids.h"
#include "TestBench.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
using Removal = NodeRemoval<D, MeanEdgeShape<D>>;

/// A star whose free node has come close to a corner; its link is displaced at random.
template <int D>
MeshInput<D> pressed(unsigned seed)
{
  TestRandom random(seed);
  MeshInput<D> in = star<D>();
  for (Vec<D>& x : in.points)
  {
    for (int d = 0; d < D; ++d)
    {
      x[d] += 0.15 * random();
    }
  }
  in.points[0] = 0.9 * in.points[1 + seed % (in.points.size() - 1)];
  return in;
}

/// The worst cell after node 0 of a star has gone into u.
template <int D>
double worstWithout(const Bench<D>& b, Index u)
{
  double worst = 1.0;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    if (b.mesh.localIndex(c, u) < 0)
    {
      worst = std::min(worst, b.model(exchanged(b.mesh.nodes(c), 0, u)));
    }
  }
  return worst;
}
}

template <class T>
class RemovingNode : public ::testing::Test
{
};
TYPED_TEST_SUITE(RemovingNode, TestDimensions);

TYPED_TEST(RemovingNode, TakesTheBestOfAllNeighbours)
{
  constexpr int D = TypeParam::dimension;
  int done = 0, left = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    Bench<D> b(pressed<D>(seed));
    const double required = b.judge.required(b.worst());
    double best = -1.0;
    for (Index u = 1; u < b.mesh.numberOfPointSlots(); ++u)
    {
      best = std::max(best, worstWithout(b, u));
    }
    Removal<D> removal;
    const auto remove = [&]
    {
      b.judge.start();
      return removal.improve(b.judge, 0, Level::Insertion);
    };
    if (!(best > required))
    {
      ++left;
      expectRefused(b, remove);
      continue;
    }
    ++done;
    const Index cells = b.mesh.countCells();
    doUndoAndDo(b, remove);
    EXPECT_NEAR(b.worst(), best, 1e-14);
    EXPECT_FALSE(b.mesh.isPointAlive(0));
    EXPECT_EQ(b.mesh.countCells(), 4); // of a hexagon; of an octahedron
    EXPECT_EQ(b.judge.growth.left, AnyGrowth + cells - b.mesh.countCells());
  }
  EXPECT_GT(done, 10);
  EXPECT_EQ(done + left, 20);
}

/// Two right triangles are the best of a square: half of it has 1 / (2 + sqrt(2))^2 of the shape.
TEST(RemovingNode2D, ASquareIsLeftAsTwoTriangles)
{
  MeshInput<2> in;
  in.points = { { 0.45, 0.05 }, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  Bench<2> b(in);
  Removal<2> removal;
  EXPECT_TRUE(removal.improve(b.judge, 0, Level::Insertion));
  EXPECT_EQ(b.mesh.countCells(), 2);
  const double mean = (2.0 + std::sqrt(2.0)) / 3.0;
  EXPECT_NEAR(b.worst(), 0.5 / (mean * mean) / std::sqrt(0.1875), 1e-14); // regular: sqrt(3) / 4
}

TYPED_TEST(RemovingNode, AGoodNodeStaysAndIsNotTriedAgain)
{
  constexpr int D = TypeParam::dimension;
  // in the plane the regular star; in space its node makes what its absence would make, or better
  Bench<D> b(star<D>());
  b.judge.setGain(D == 2 ? 1e-3 : 0.5);
  Removal<D> removal;
  b.editor.setClock(5);
  expectRefused(b, [&] { return removal.improve(b.judge, 0, Level::Insertion); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::EdgeContraction), 1);
  expectRefused(b, [&] { return removal.improve(b.judge, 1, Level::Insertion); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::EdgeContraction), 1);
  b.editor.stamp({ 0 });
  expectRefused(b, [&] { return removal.improve(b.judge, 0, Level::Insertion); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::EdgeContraction), 2);
  EXPECT_EQ(triedOf(b.judge.done, Operation::EdgeContraction), 0);
}

TYPED_TEST(RemovingNode, OnlyWhereItMay)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = pressed<D>(1);
  Removal<D> removal;
  const auto isRefused = [&](Bench<D>& b)
  {
    expectRefused(b, [&] { return removal.improve(b.judge, 0, Level::Insertion); });
    EXPECT_EQ(triedOf(b.judge.tried, Operation::EdgeContraction), 0);
  };
  Bench<D> off(in);
  off.switches.removeNodes = false;
  isRefused(off);
  Bench<D> enough(in); // so many cells are gone that no more may
  enough.judge.growth = { 7, 7 };
  isRefused(enough);
  enough.judge.growth = { 6, 7 };
  EXPECT_TRUE(removal.improve(enough.judge, 0, Level::Insertion));
  MeshInput<D> held = in;
  held.fixedPoints.assign(in.points.size(), 0);
  held.fixedPoints[0] = 1;
  Bench<D> fixed(held);
  isRefused(fixed);
  Bench<D> away(in);
  away.giveAway({ 2 });
  isRefused(away);
  EXPECT_TRUE(away.editor.isHeldUp());
}

TYPED_TEST(RemovingNode, InAMeshEachTryRaisesOrRestores)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 6, 0.35));
  Removal<D> removal;
  EXPECT_GT(tryEverywhere(removal, b, Level::Insertion), D == 3 ? 5 : 1);
}
