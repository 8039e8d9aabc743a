// SPDX-License-Identifier: BSD-3-Clause
// One node goes to the best place that its star has: known by symmetry, or by trying all places.
#include "Operations/NodeMotion.h"
#include "TestBench.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
using Motion = NodeMotion<D, MeanEdgeShape<D>>;

/// The free node away from the middle of a regular hexagon or octahedron.
template <int D>
MeshInput<D> starOffCentre(double by)
{
  MeshInput<D> in = star<D>();
  in.points[0][0] = by;
  in.points[0][1] = -0.5 * by;
  return in;
}

/// The worst cell of a mesh whose node 0 is at x.
template <int D>
double worstAt(const Bench<D>& b, const Vec<D>& x)
{
  double worst = 1.0;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    Corners<D> corners = b.mesh.corners(c);
    corners[b.mesh.localIndex(c, 0)] = x;
    worst = std::min(worst, MeanEdgeShape<D>::value(corners));
  }
  return worst;
}

/// The best of the places of a grid in [-1, 1]^D.
template <int D>
double bestOfGrid(const Bench<D>& b, int n)
{
  double best = -1.0;
  int total = 1;
  for (int d = 0; d < D; ++d)
  {
    total *= 2 * n + 1;
  }
  for (int k = 0; k < total; ++k)
  {
    Vec<D> x;
    for (int d = 0, rest = k; d < D; ++d, rest /= 2 * n + 1)
    {
      x[d] = (rest % (2 * n + 1) - n) / double(n);
    }
    best = std::max(best, worstAt<D>(b, x));
  }
  return best;
}
}

template <class T>
class MovingNode : public ::testing::Test
{
};
TYPED_TEST_SUITE(MovingNode, TestDimensions);

TYPED_TEST(MovingNode, FindsTheCentreOfARegularStar)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(starOffCentre<D>(0.5));
  // the regular triangle; the corner of a cube, which is an eighth of an octahedron
  const double best = D == 2 ? 1.0 : MeanEdgeShape<D>::value(buildMesh(oneCell<D>()).corners(0));
  ASSERT_LT(b.worst(), best - 0.1);
  Motion<D> motion;
  doUndoAndDo(b,
    [&]
    {
      b.judge.start();
      return motion.improve(b.judge, 2, 0);
    });
  EXPECT_LE(b.worst(), best + 1e-14);
  EXPECT_GE(b.worst(), best - 1e-3); // the search ends at half a gain
  EXPECT_LT(b.mesh.point(0).norm(), 0.02);
  EXPECT_EQ(b.judge.changed().size(), std::size_t(b.mesh.countCells())); // all its cells
  EXPECT_EQ(triedOf(b.judge.done, Operation::NodeMotion), 1);            // done, undone, done
}

TYPED_TEST(MovingNode, NoPlaceIsBetter)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(3);
  for (int k = 0; k < 5; ++k)
  {
    MeshInput<D> in = starOffCentre<D>(0.3);
    for (Vec<D>& x : in.points)
    {
      for (int d = 0; d < D; ++d)
      {
        x[d] += 0.15 * random();
      }
    }
    Bench<D> b(in);
    const double best = bestOfGrid<D>(b, D == 3 ? 25 : 100);
    Motion<D> motion;
    motion.improve(b.judge, 0, 0);
    EXPECT_GE(b.worst(), best - 1e-3);
    expectSound(b.mesh);
  }
}

TYPED_TEST(MovingNode, InvertedCellsBecomePositive)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(starOffCentre<D>(1.2)); // outside
  ASSERT_LT(b.worst(), 0.0);
  Motion<D> motion;
  EXPECT_TRUE(motion.improve(b.judge, 0, 0));
  EXPECT_GT(b.worst(), 0.5);
  expectSound(b.mesh);
}

TYPED_TEST(MovingNode, StaysWhereItIsBestAndIsNotTriedAgain)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(star<D>());
  Motion<D> motion;
  b.editor.setClock(5);
  expectRefused(b, [&] { return motion.improve(b.judge, 0, 0); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeMotion), 1);
  expectRefused(b, [&] { return motion.improve(b.judge, 1, 0); }); // the same node
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeMotion), 1);
  b.editor.stamp({ 0 }); // something has changed around it
  expectRefused(b, [&] { return motion.improve(b.judge, 0, 0); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeMotion), 2);
  EXPECT_EQ(triedOf(b.judge.done, Operation::NodeMotion), 0);
  // what fails within a transaction is tried again: it may be undone
  b.editor.stamp({ 0 });
  const auto mark = b.judge.begin();
  EXPECT_FALSE(motion.improve(b.judge, 0, 0));
  b.judge.rollback(mark);
  EXPECT_FALSE(motion.improve(b.judge, 0, 0));
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeMotion), 4);
}

TYPED_TEST(MovingNode, OnlyWhatIsFreeAndOwned)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = starOffCentre<D>(0.5);
  Bench<D> away(in);
  away.giveAway({ 1 });
  Motion<D> motion;
  for (Index t = 0; t < away.mesh.numberOfCellSlots(); ++t)
  {
    if (away.mesh.localIndex(t, 1) < 0)
    {
      expectRefused(away, [&] { return motion.improve(away.judge, t, 0); });
    }
  }
  EXPECT_TRUE(away.editor.isHeldUp());
  EXPECT_EQ(triedOf(away.judge.tried, Operation::NodeMotion), 0);
  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints[0] = 1;
  Bench<D> fixed(in);
  expectRefused(fixed, [&] { return motion.improve(fixed.judge, 0, 0); });
  EXPECT_EQ(triedOf(fixed.judge.tried, Operation::NodeMotion), 0);
}

TYPED_TEST(MovingNode, InAMeshEachTryRaisesOrRestores)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 6, 0.3));
  Motion<D> motion;
  EXPECT_GT(tryEverywhere(motion, b, 0), 10);
}
