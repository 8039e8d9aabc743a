// SPDX-License-Identifier: BSD-3-Clause
// Several nodes move at once: to places known by symmetry, and only those that may.
#include "Operations/ClusterMotion.h"
#include "TestBench.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
using Motion = ClusterMotion<D, MeanEdgeShape<D>>;

/// Regular triangles around two neighbours, points 0 and 1, which are displaced by `by`.
MeshInput<2> twoInside(const Vec<2>& by)
{
  MeshInput<2> in;
  const double h = std::sqrt(0.75);
  in.points = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 1.5, h }, { 0.5, h }, { -0.5, h }, { -1, 0 },
    { -0.5, -h }, { 0.5, -h }, { 1.5, -h } };
  in.cells = { { 0, 1, 4 }, { 0, 4, 5 }, { 0, 5, 6 }, { 0, 6, 7 }, { 0, 7, 8 }, { 0, 8, 1 },
    { 1, 2, 3 }, { 1, 3, 4 }, { 1, 8, 9 }, { 1, 9, 2 } };
  in.points[0] += by;
  in.points[1] += by;
  return in;
}

/// A cell that is not worse than those around its free nodes: these may move.
template <int D>
Index worstCell(const Bench<D>& b)
{
  Index worst = 0;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    worst = b.mesh.quality(c) < b.mesh.quality(worst) ? c : worst;
  }
  return worst;
}
}

TEST(MovingCluster2D, BothNodesFindTheirPlaces)
{
  for (const Vec<2>& by : { Vec<2>(0.3, 0.2), Vec<2>(0.0, 0.4), Vec<2>(-0.35, 0.1) })
  {
    Bench<2> b(twoInside(by));
    ASSERT_LT(b.worst(), 0.9);
    Motion<2> motion;
    const Index t = worstCell(b);
    doUndoAndDo(b, [&] { return motion.improve(b.judge, t, 0); });
    EXPECT_GT(b.worst(), 0.95);                                 // all regular: 1
    EXPECT_EQ(triedOf(b.judge.done, Operation::NodeMotion), 1); // done, undone, done
    EXPECT_FALSE(b.judge.changed().empty());
  }
}

template <class T>
class MovingCluster : public ::testing::Test
{
};
TYPED_TEST_SUITE(MovingCluster, TestDimensions);

TYPED_TEST(MovingCluster, OneNodeFindsTheCentreOfARegularStar)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0][0] = 0.4;
  Bench<D> b(in);
  const double best = D == 2 ? 1.0 : MeanEdgeShape<D>::value(buildMesh(oneCell<D>()).corners(0));
  Motion<D> motion;
  const Index t = worstCell(b);
  doUndoAndDo(b, [&] { return motion.improve(b.judge, t, 0); });
  EXPECT_LE(b.worst(), best + 1e-14);
  EXPECT_GT(b.worst(), best - 0.02);
  expectRefused(b, [&] { return motion.improve(b.judge, worstCell(b), 0); }); // it is there
}

/// Nodes of cells that are worse than the one at hand do not move; without a node there is no try.
TYPED_TEST(MovingCluster, NodesOfWorseCellsStay)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0][0] = 0.4;
  Bench<D> b(in);
  Motion<D> motion;
  for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
  {
    if (b.mesh.quality(t) > b.worst())
    {
      expectRefused(b, [&] { return motion.improve(b.judge, t, 0); });
    }
  }
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeMotion), 0);
}

TYPED_TEST(MovingCluster, OnlyWhatIsFreeAndOwned)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0][0] = 0.4;
  Bench<D> away(in);
  const Index t = worstCell(away);
  Index far = 1; // a point that the worst cell has not
  while (away.mesh.localIndex(t, far) >= 0)
  {
    ++far;
  }
  away.giveAway({ far });
  Motion<D> motion;
  expectRefused(away, [&] { return motion.improve(away.judge, t, 0); });
  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints[0] = 1;
  Bench<D> fixed(in);
  expectRefused(fixed, [&] { return motion.improve(fixed.judge, t, 0); });
  EXPECT_EQ(triedOf(fixed.judge.tried, Operation::NodeMotion), 0);
}

TYPED_TEST(MovingCluster, InAMeshEachTryRaisesOrRestores)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 6, 0.3));
  Motion<D> motion;
  EXPECT_GT(tryEverywhere(motion, b, Level::LongLookAhead), 1);
}
