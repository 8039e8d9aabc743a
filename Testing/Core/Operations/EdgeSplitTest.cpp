// SPDX-License-Identifier: BSD-3-Clause
// Single splits and contractions through the judge: each takes the other back.
#include "Operations/EdgeSplit.h"
#include "Mesh/Ids.h"
#include "Operations/EdgeContraction.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
/// Two triangles with a common edge (0, 1), or n tetrahedra around it.
template <int D>
MeshInput<D> aroundAnEdge()
{
  if constexpr (D == 2)
  {
    MeshInput<2> in;
    in.points = { { -1, 0 }, { 1, 0 }, { 0, 1 }, { 0, -1 } };
    in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
    return in;
  }
  else
  {
    return ringOf(5);
  }
}

/// Splits edge (0, 1) of cell 0 at x, and has the judge accept it if it likes.
template <int D>
bool split(Bench<D>& b, const Vec<D>& x)
{
  const auto mark = b.judge.begin();
  const Index m = b.editor.addPoint(x);
  Proposal<D> p;
  const bool done = m != None && proposeSplit<D>(b.editor, nullptr, { 0, 0, 1, m }, p) &&
    b.judge.measure(p) && b.judge.accept(p);
  done ? b.judge.commit(mark) : b.judge.rollback(mark);
  return done;
}

template <int D>
bool contract(Bench<D>& b, Index v, Index u)
{
  Proposal<D> p;
  return proposeContraction<D>(b.editor, nullptr, v, u, p) && b.judge.measure(p) &&
    b.judge.accept(p);
}

template <int D>
std::multiset<std::set<Index>> cellsOf(const SimplexMesh<D>& mesh)
{
  std::multiset<std::set<Index>> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      cells.insert({ mesh.nodes(c).begin(), mesh.nodes(c).end() });
    }
  }
  return cells;
}
}

template <class T>
class SplittingEdge : public ::testing::Test
{
};
TYPED_TEST_SUITE(SplittingEdge, TestDimensions);

TYPED_TEST(SplittingEdge, HalvesEveryCellAroundIt)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = aroundAnEdge<D>();
  Bench<D> b(in);
  // the worst of all halves: each cell with one end of the edge in the middle
  double worst = 1.0;
  std::multiset<double> halves;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    for (Index end : { 0, 1 })
    {
      Corners<D> x = b.mesh.corners(c);
      x[b.mesh.localIndex(c, end)] = Vec<D>::Zero();
      worst = std::min(worst, MeanEdgeShape<D>::value(x));
      halves.insert(signedVolume(x));
    }
  }
  doUndoAndDo(b, [&] { return split<D>(b, Vec<D>::Zero()); });
  EXPECT_EQ(b.mesh.countCells(), 2 * static_cast<Index>(in.cells.size()));
  EXPECT_EQ(b.worst(), worst);
  EXPECT_EQ(b.judge.growth.left, AnyGrowth - static_cast<long>(in.cells.size()));
  std::multiset<double> volumes;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    if (b.mesh.isAlive(c))
    {
      volumes.insert(signedVolume(b.mesh.corners(c)));
    }
  }
  ASSERT_EQ(volumes.size(), halves.size());
  EXPECT_TRUE(std::equal(volumes.begin(), volumes.end(), halves.begin(),
    [](double one, double other) { return std::fabs(one - other) < 1e-15; }));
}

TYPED_TEST(SplittingEdge, IsTakenBackByAContraction)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(aroundAnEdge<D>());
  const auto before = cellsOf(b.mesh);
  const double worst = b.worst();
  ASSERT_TRUE(split<D>(b, Vec<D>::Zero()));
  const Index m = b.mesh.numberOfPointSlots() - 1;
  for (Index end : { 0, 1 })
  {
    const auto mark = b.judge.begin();
    doUndoAndDo(b, [&] { return contract<D>(b, m, end); });
    EXPECT_EQ(cellsOf(b.mesh), before);
    EXPECT_EQ(b.worst(), worst);
    EXPECT_FALSE(b.mesh.isPointAlive(m));
    EXPECT_EQ(b.judge.growth.left, AnyGrowth);
    b.judge.rollback(mark);
  }
  // into a point of the ring half of the cells are left, and one end has its other side filled
  Proposal<D> p;
  ASSERT_TRUE(proposeContraction<D>(b.editor, nullptr, m, 2, p));
  EXPECT_EQ(p.cavity.size(), static_cast<std::size_t>(b.mesh.countCells()));
  EXPECT_EQ(p.cells.size(), D == 2 ? 2u : 6u); // the link of m less its facets at 2
  for (const Simplex<D>& cell : p.cells)
  {
    EXPECT_TRUE(hasId(cell, 2));
    EXPECT_FALSE(hasId(cell, m));
  }
  EXPECT_EQ(p.oldWorst, b.worst());
}

TYPED_TEST(SplittingEdge, TheJudgeLooksAtTheQuality)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(aroundAnEdge<D>());
  Vec<D> outside = Vec<D>::Zero();
  outside[D - 2] = 3.0; // beyond the ring
  Proposal<D> p;
  const auto mark = b.judge.begin();
  const Index m = b.editor.addPoint(outside);
  ASSERT_TRUE(proposeSplit<D>(b.editor, nullptr, { 0, 0, 1, m }, p)); // topology only
  p.least = 0.0;
  EXPECT_FALSE(b.judge.measure(p));
  b.judge.rollback(mark);
}

TYPED_TEST(SplittingEdge, KeptEdgesAndOthersCellsStay)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = aroundAnEdge<D>();
  Bench<D> away(in);
  away.giveAway({ 3 }); // of the last cell of the plane, of two in space
  expectRefused(away, [&] { return split<D>(away, Vec<D>::Zero()); });
  if (D == 2)
  {
    in.keptFacets.emplace_back();
    in.keptFacets[0][0] = 0;
    in.keptFacets[0][1] = 1;
  }
  else
  {
    in.keptEdges = { { 0, 1 } };
  }
  Bench<D> kept(in);
  expectRefused(kept, [&] { return split<D>(kept, Vec<D>::Zero()); });
  MeshInput<D> open = aroundAnEdge<D>();
  open.cells.pop_back(); // the edge is on the surface now
  Bench<D> surface(open);
  expectRefused(surface, [&] { return split<D>(surface, Vec<D>::Zero()); });
}

TYPED_TEST(SplittingEdge, HeldNodesAreNotContracted)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(aroundAnEdge<D>());
  for (Index v = 0; v < b.mesh.numberOfPointSlots(); ++v) // all are on the surface
  {
    expectRefused(b, [&] { return contract<D>(b, v, v == 0 ? 1 : 0); });
  }
  ASSERT_TRUE(split<D>(b, Vec<D>::Zero()));
  const Index m = b.mesh.numberOfPointSlots() - 1;
  b.giveAway({ 2 });
  expectRefused(b, [&] { return contract<D>(b, m, 0); });
  EXPECT_TRUE(b.editor.isHeldUp());
}
