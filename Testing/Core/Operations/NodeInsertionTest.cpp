// SPDX-License-Identifier: BSD-3-Clause
// A node comes: into polygons and polyhedra whose best node is known, and never at the price of
// more bad cells than before.
#include "Operations/NodeInsertion.h"
#include "Polyhedra.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
template <int D>
using Insertion = NodeInsertion<D, MeanEdgeShape<D>>;
}

template <class T>
class InsertingNode : public ::testing::Test
{
};
TYPED_TEST_SUITE(InsertingNode, TestDimensions);

/// A regular hexagon or icosahedron, all cells at one corner: the best node is that in the middle.
TYPED_TEST(InsertingNode, FindsTheCentreOfARegularPolyhedron)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = fromOneCorner<D>();
  const Index facets = D == 2 ? 6 : 20;
  const double best = shapeOfRegularCone<D>();
  // an ear of the hexagon is left with a smaller cavity that gains, too
  for (Index t = D == 2; t < static_cast<Index>(in.cells.size()) - (D == 2); ++t)
  {
    Bench<D> b(in);
    const double old = b.worst();
    const Index cells = b.mesh.countCells();
    Insertion<D> insertion;
    const auto insert = [&]
    {
      b.judge.start();
      return insertion.improve(b.judge, t, Level::Insertion);
    };
    doUndoAndDo(b, insert);
    EXPECT_GT(b.worst(), b.judge.required(old)) << "cell " << t;
    EXPECT_LE(b.worst(), best + 1e-12);
    EXPECT_GE(b.worst(), best - 2e-3) << "cell " << t;
    EXPECT_EQ(b.mesh.countCells(), facets);
    EXPECT_EQ(b.mesh.countPoints(), static_cast<Index>(in.points.size()) + 1);
    EXPECT_EQ(b.judge.growth.left, AnyGrowth - facets + cells);
    EXPECT_EQ(b.judge.changed().size(), static_cast<std::size_t>(facets));
    expectRefused(b, insert); // a second one is no use
  }
}

TYPED_TEST(InsertingNode, NeedsRoomForItsCells)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(fromOneCorner<D>());
  // Whatever cavity is taken: f of its facets less its cells are at least D, as it has no inner
  // point.
  b.judge.growth.left = D - 1;
  Insertion<D> insertion;
  expectRefused(b, [&] { return insertion.improve(b.judge, 0, Level::Insertion); });
  EXPECT_TRUE(b.judge.growth.isShort);
  EXPECT_EQ(b.judge.growth.left, D - 1);
  EXPECT_EQ(triedOf(b.judge.tried, Operation::NodeInsertion), 1);
  EXPECT_EQ(triedOf(b.judge.done, Operation::NodeInsertion), 0);
}

TYPED_TEST(InsertingNode, NeedsASlot)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(fromOneCorner<D>());
  b.giveAway({}); // an owner takes slots of its own pool only, and that is empty
  Insertion<D> insertion;
  expectRefused(b, [&] { return insertion.improve(b.judge, 0, Level::Insertion); });
  EXPECT_TRUE(b.editor.isHeldUp());
}

TYPED_TEST(InsertingNode, StaysOnThisSideOfWhatIsKept)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  splitRegions(in);
  Bench<D> b(in);
  Insertion<D> insertion;
  EXPECT_GE(tryEverywhere(insertion, b, Level::Insertion), D == 3 ? 5 : 0); // looks at kept facets
}

TYPED_TEST(InsertingNode, BringsNoMoreBadCellsThanItTakes)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 3 ? 3 : 8, 0.35);
  int guarded = 0, free = 0;
  for (double guard : { -1.0, 0.8, 0.9, 1.0 })
  {
    Bench<D> b(in);
    const auto bad = [&] // a cell under the guard counts once, twice, three times
    {
      long n = 0;
      for (double q : sortedQualities(b.mesh))
      {
        for (int third = 1; third <= 3; ++third)
        {
          n += q < guard * (third / 3.0);
        }
      }
      return n;
    };
    b.judge.setGuard(guard);
    Insertion<D> insertion;
    for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
    {
      const long before = bad();
      const auto mark = b.judge.begin();
      if (b.mesh.isAlive(t) && b.mesh.quality(t) < 0.6 &&
        insertion.improve(b.judge, t, Level::Insertion))
      {
        EXPECT_LE(bad(), before) << "guard " << guard << ", cell " << t;
        ++(guard < 0.0 ? free : guarded);
      }
      b.judge.rollback(mark);
    }
  }
  EXPECT_GT(free, D == 3 ? 10 : 2);
  EXPECT_LT(guarded, 3 * free);
}

TEST(InsertingNode3D, SeedsAreWhereABestNodeCanBe)
{
  const SimplexMesh<3> mesh = buildMesh(oneCell<3>()); // all its facets are kept
  std::vector<Vec<3>> seeds;
  Insertion<3>::findSeeds(mesh, 0, seeds);
  ASSERT_EQ(seeds.size(), 4u * 2 + 1 + 4 + 6);
  const Corners<3> x = mesh.corners(0);
  for (int i = 0; i < 4; ++i)
  {
    const Facet<3> f = mesh.facet(0, i);
    const double cap = facetCap(mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]));
    Corners<3> best{ mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]), seeds[2 * i] };
    EXPECT_NEAR(MeanEdgeShape<3>::value(best), cap, 1e-9);
    EXPECT_EQ(seeds[2 * i + 1], Vec<3>(0.5 * (seeds[2 * i] + x[i])));
  }
  EXPECT_NEAR((seeds[8] - Vec<3>::Constant(0.25)).norm(), 0.0, 1e-15);
}
