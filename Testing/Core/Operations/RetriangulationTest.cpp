// SPDX-License-Identifier: BSD-3-Clause
// Polyhedra all of whose fillings can be listed are filled in the best way.
#include "Operations/Retriangulation.h"
#include "Polyhedra.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
using Again = Retriangulation<3, MeanEdgeShape<3>>;

/// An octahedron with axes 0-1, 2-3 and 4-5 of these half lengths, a bit askew, divided along one.
MeshInput<3> octahedron(const Vec<3>& half, int axis, unsigned seed)
{
  TestRandom random(seed);
  MeshInput<3> in;
  for (int d = 0; d < 3; ++d)
  {
    for (double sign : { -1.0, 1.0 })
    {
      Vec<3> x(0.1 * random(), 0.1 * random(), 0.1 * random());
      x[d] += sign * half[d];
      in.points.push_back(x);
    }
  }
  const Index a = 2 * axis, b = a + 1, c = 2 * ((axis + 1) % 3), d = 2 * ((axis + 2) % 3);
  const Index ring[] = { c, d, c + 1, d + 1 };
  for (int k = 0; k < 4; ++k)
  {
    in.cells.push_back({ a, b, ring[k], ring[(k + 1) % 4] });
  }
  return in;
}

double worstOf(const MeshInput<3>& in) { return Bench<3>(in).worst(); }
}

TEST(Retriangulation, TakesTheBestOfThreeDiagonals)
{
  int done = 0, left = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    const Vec<3> half(1.0, 1.0 + 0.05 * seed, 1.0 + 0.1 * seed);
    double best = -1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      best = std::max(best, worstOf(octahedron(half, axis, seed)));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      Bench<3> b(octahedron(half, axis, seed));
      b.switches.insertNodes = false;
      Index t = 0; // becomes the worst
      for (Index c = 0; c < 4; ++c)
      {
        t = b.mesh.quality(c) < b.mesh.quality(t) ? c : t;
      }
      Again again;
      const auto refill = [&]
      {
        b.judge.start();
        return again.improve(b.judge, t, Level::LongLookAhead);
      };
      if (best > b.judge.required(b.worst()))
      {
        ++done;
        doUndoAndDo(b, refill);
        EXPECT_NEAR(b.worst(), best, 1e-12);
        EXPECT_EQ(b.mesh.countCells(), 4);
      }
      else
      {
        ++left;
        expectRefused(b, refill);
      }
    }
  }
  EXPECT_GE(left, 8);
  EXPECT_GE(done, 12);
}

TEST(Retriangulation, NewNodesComeWhereTheyMay)
{
  // all tetrahedra of an icosahedron at one corner: its best filling without a node is far worse
  Bench<3> with(fromOneCorner<3>()), without(fromOneCorner<3>());
  Again again;
  without.switches.insertNodes = false;
  again.improve(without.judge, 0, Level::LongLookAhead);
  EXPECT_EQ(without.mesh.countPoints(), 12);
  doUndoAndDo(with, [&] { return again.improve(with.judge, 0, Level::LongLookAhead); });
  EXPECT_LE(with.worst(), shapeOfRegularCone<3>() + 1e-12);
}

TEST(Retriangulation, NotWhereCellsAreInvertedNorInThePlane)
{
  Bench<3> b(octahedron({ 1.0, 1.0, 1.5 }, 0, 1));
  const std::vector<std::uint8_t> none;
  b.judge.setTangled(true, true, none);
  Again again;
  expectRefused(b, [&] { return again.improve(b.judge, 0, Level::LongLookAhead); });
  EXPECT_EQ(triedOf(b.judge.tried, Operation::Retriangulation), 0);
  Bench<2> plane(fromOneCorner<2>());
  Retriangulation<2, MeanEdgeShape<2>> flat;
  expectRefused(plane, [&] { return flat.improve(plane.judge, 0, Level::LongLookAhead); });
  EXPECT_EQ(triedOf(plane.judge.tried, Operation::Retriangulation), 0);
}

TEST(Retriangulation, KeptFacetsAndOthersCellsStay)
{
  MeshInput<3> in = octahedron({ 1.0, 1.2, 1.6 }, 2, 1); // along the longest: the worst
  Bench<3> free(in);
  free.switches.insertNodes = false;
  Again again;
  ASSERT_TRUE(again.improve(free.judge, 0, Level::LongLookAhead));
  in.keptFacets = { { 4, 5, 0 }, { 4, 5, 1 }, { 4, 5, 2 }, { 4, 5, 3 } };
  Bench<3> kept(in);
  kept.switches.insertNodes = false;
  expectRefused(kept, [&] { return again.improve(kept.judge, 0, Level::LongLookAhead); });
  EXPECT_EQ(triedOf(kept.judge.tried, Operation::Retriangulation), 1);
  Bench<3> edge(octahedron({ 1.0, 1.2, 1.6 }, 2, 1));
  edge.switches.insertNodes = false;
  edge.giveAway({ 0 });
  expectRefused(edge, [&] { return again.improve(edge.judge, 2, Level::LongLookAhead); });
}

TEST(Retriangulation, InAMeshEachTryRaisesOrRestores)
{
  Bench<3> b(jitteredGrid<3>(3, 0.3));
  Again again;
  EXPECT_GT(tryEverywhere(again, b, Level::LongLookAhead, 0.7), 5);
}
