// SPDX-License-Identifier: BSD-3-Clause
// A node goes into each of its neighbours in turn: which cells are left, and who must stay.
#include "Operations/EdgeContraction.h"
#include "Mesh/Ids.h"
#include "StillSurface.h"
#include "TestBench.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <int D>
bool contract(Bench<D>& b, Index v, Index u, double least = Proposal<D>::Never)
{
  Proposal<D> p;
  if (!proposeContraction<D>(b.editor, nullptr, v, u, p))
  {
    return false;
  }
  p.least = least;
  return b.judge.measure(p) && b.judge.accept(p);
}
}

template <class T>
class Contracting : public ::testing::Test
{
};
TYPED_TEST_SUITE(Contracting, TestDimensions);

/// The middle of a regular star goes into a corner: the cells that have not that corner get it.
TYPED_TEST(Contracting, LeavesTheCellsWithoutTheNeighbour)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = star<D>();
  for (Index u = 1; u < static_cast<Index>(in.points.size()); ++u)
  {
    Bench<D> b(in);
    std::set<std::set<Index>> expected;
    double worst = 1.0;
    for (const Simplex<D>& cell : in.cells)
    {
      if (!hasId(cell, u))
      {
        const Simplex<D> left = exchanged(cell, 0, u);
        expected.insert({ left.begin(), left.end() });
        worst = std::min(worst, b.model(left));
      }
    }
    ASSERT_EQ(expected.size(), 4u); // of six triangles, of eight tetrahedra
    expectRefused(b, [&] { return contract<D>(b, 0, u, worst); }); // no better than that
    doUndoAndDo(
      b, [&] { return contract<D>(b, 0, u, std::nextafter(worst, -1.0)); }, D == 3);
    std::set<std::set<Index>> cells;
    for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
    {
      if (b.mesh.isAlive(c))
      {
        cells.insert({ b.mesh.nodes(c).begin(), b.mesh.nodes(c).end() });
      }
    }
    EXPECT_EQ(cells, expected);
    EXPECT_EQ(b.worst(), worst);
    EXPECT_FALSE(b.mesh.isPointAlive(0));
    EXPECT_EQ(b.judge.growth.left, AnyGrowth + static_cast<long>(in.cells.size()) - 4);
  }
}

/// Topology only: that the cells turn over is for the judge to see.
TYPED_TEST(Contracting, TheJudgeRefusesWhatTurnsOver)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 5, 0.2));
  int refused = 0, done = 0;
  for (Index v = 0; v < b.mesh.numberOfPointSlots(); ++v)
  {
    if (!b.mesh.isFree(v))
    {
      continue;
    }
    std::vector<Index> star;
    b.mesh.star(v, star);
    for (Index u : b.mesh.nodes(star[0]))
    {
      if (u == v)
      {
        continue;
      }
      Proposal<D> p;
      ASSERT_TRUE(proposeContraction<D>(b.editor, nullptr, v, u, p));
      EXPECT_EQ(p.cavity.size(), star.size());
      EXPECT_EQ(p.oldWorst, b.mesh.worstQuality(star));
      double worst = 1.0, volume = 0.0;
      for (const Simplex<D>& cell : p.cells)
      {
        worst = std::min(worst, b.model(cell));
        Corners<D> x;
        for (int i = 0; i <= D; ++i)
        {
          x[i] = b.mesh.point(cell[i]);
        }
        volume += signedVolume(x);
      }
      for (Index c : p.cavity)
      {
        volume -= signedVolume(b.mesh.corners(c));
      }
      EXPECT_NEAR(volume, 0.0, 1e-14); // they fill the cavity, some inside out perhaps
      if (worst > 0.0)
      {
        ++done;
        const auto mark = b.judge.begin();
        doUndoAndDo(b, [&] { return contract<D>(b, v, u, 0.0); });
        b.judge.rollback(mark);
      }
      else
      {
        ++refused;
        expectRefused(b, [&] { return contract<D>(b, v, u, 0.0); });
      }
    }
  }
  EXPECT_GT(done + refused, 10);
  EXPECT_GT(done, 0);
}

TYPED_TEST(Contracting, WhatIsHeldOrAnothersStays)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  Bench<D> b(in);
  for (Index v = 1; v < b.mesh.numberOfPointSlots(); ++v) // they are on the surface
  {
    expectRefused(b, [&] { return contract<D>(b, v, 0); });
  }
  b.giveAway({ 3 });
  expectRefused(b, [&] { return contract<D>(b, 0, 1); });
  EXPECT_TRUE(b.editor.isHeldUp());
  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints[0] = 1;
  Bench<D> fixed(in);
  expectRefused(fixed, [&] { return contract<D>(fixed, 0, 1); });
}

namespace
{
/// Any two of its points may become one.
class Joining final : public StillSurface<3>
{
public:
  bool mayJoin(const SimplexMesh<3>&, const std::vector<Index>&, Index, Index) const override
  {
    return true;
  }
};

/// Point 0 lies in the middle of a ring of four, a little below it, on the interface of two
/// regions. Above it are four cells up to the top; with `ears` two cells between it and the ring,
/// on which the top stands. Both collapse when it goes into a point of the ring that they share.
MeshInput<3> dented(bool ears)
{
  MeshInput<3> in;
  in.points = { { 0, 0, -0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -2 },
    { 0, 0, 1 } };
  for (Index k = 0; k < 4; ++k)
  {
    const Index a = 1 + k, b = 1 + (k + 1) % 4;
    in.cells.push_back({ 5, a, b, 0 });
    in.regions.push_back(2);
    if (!ears)
    {
      in.cells.push_back({ 0, a, b, 6 });
      in.regions.push_back(1);
    }
  }
  for (const Simplex<3>& cell :
    { Simplex<3>{ 0, 1, 2, 3 }, { 0, 1, 3, 4 }, { 1, 2, 3, 6 }, { 1, 3, 4, 6 } })
  {
    if (ears)
    {
      in.cells.push_back(cell);
      in.regions.push_back(1);
    }
  }
  return in;
}
}

/// There the cells behind would have to learn that their facets lie between regions now. (Once they
/// did not, and a walk around such a facet never ended.)
TEST(EdgeContraction, NoEarsAtAnInterface)
{
  for (Index u = 1; u <= 4; ++u)
  {
    for (bool ears : { false, true })
    {
      SCOPED_TRACE(u);
      Bench<3> b(dented(ears));
      const Joining surface;
      Proposal<3> p;
      const bool proposed = proposeContraction<3>(b.editor, &surface, 0, u, p);
      // Points 1 and 3 are in both ears. Into 2 and 4, one ear would become flat.
      EXPECT_EQ(proposed, !ears || u % 2 == 0);
      p.least = 0.0;
      EXPECT_EQ(proposed && b.judge.measure(p) && b.judge.accept(p), !ears);
      expectSound(b.mesh, true);
    }
  }
}
