// SPDX-License-Identifier: BSD-3-Clause
// Of all edges and faces of a cell that one goes which pays most: against trying them all.
#include "Operations/Reconnect.h"
#include "Mesh/Ids.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
constexpr double Never = -std::numeric_limits<double>::infinity();

/// Cells that have all of these points.
template <int D>
std::vector<Index> cellsAt(const SimplexMesh<D>& mesh, const std::vector<Index>& points)
{
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c) &&
      std::all_of(points.begin(), points.end(), [&](Index p) { return hasId(mesh.nodes(c), p); }))
    {
      cells.push_back(c);
    }
  }
  return cells;
}

/// The point of cell o that cell t has not.
template <int D>
Index other(const SimplexMesh<D>& mesh, Index o, Index t)
{
  return *std::find_if(
    mesh.nodes(o).begin(), mesh.nodes(o).end(), [&](Index p) { return !hasId(mesh.nodes(t), p); });
}

/// The worst cell if the facet of t opposite to its node a goes: each of its nodes is replaced in
/// turn by the node across. In the plane that is the swap of an edge.
template <int D>
double withoutFacet(const Bench<D>& b, Index t, Index a)
{
  std::vector<Index> facet;
  std::copy_if(b.mesh.nodes(t).begin(), b.mesh.nodes(t).end(), std::back_inserter(facet),
    [&](Index p) { return p != a; });
  const std::vector<Index> pair = cellsAt(b.mesh, facet);
  if (pair.size() != 2 || b.mesh.isKept(t, b.mesh.localIndex(t, a)))
  {
    return Never;
  }
  double worst = 1.0;
  for (Index p : facet)
  {
    worst = std::min(
      worst, b.model(exchanged(b.mesh.nodes(t), p, other(b.mesh, pair[0] + pair[1] - t, t))));
  }
  return worst;
}

/// The points around edge (a, b) in order, such that (a, b, ring[0], ring[1]) is positive; empty if
/// they do not close.
std::vector<Index> ringAround(const SimplexMesh<3>& mesh, Index a, Index b)
{
  std::vector<std::array<Index, 2>> arcs;
  for (Index c : cellsAt<3>(mesh, { a, b }))
  {
    std::vector<Index> rest;
    std::copy_if(mesh.nodes(c).begin(), mesh.nodes(c).end(), std::back_inserter(rest),
      [&](Index p) { return p != a && p != b; });
    const bool even = signedVolume({ mesh.point(a), mesh.point(b), mesh.point(rest[0]),
                        mesh.point(rest[1]) }) > 0.0;
    arcs.push_back({ rest[even ? 0 : 1], rest[even ? 1 : 0] });
  }
  std::vector<Index> ring{ arcs[0][0] };
  while (ring.size() < arcs.size())
  {
    const auto next = std::find_if(
      arcs.begin(), arcs.end(), [&](const auto& arc) { return arc[0] == ring.back(); });
    if (next == arcs.end())
    {
      return {};
    }
    ring.push_back((*next)[1]);
  }
  const bool closes = std::any_of(arcs.begin(), arcs.end(),
    [&](const auto& arc) { return arc[0] == ring.back() && arc[1] == ring.front(); });
  return closes ? ring : std::vector<Index>{};
}

/// The best worst quality over all triangulations of the ring points first ... last.
double bestTriangulation(
  const Bench<3>& b, Index low, Index high, const std::vector<Index>& ring, int first, int last)
{
  double best = last - first < 2 ? std::numeric_limits<double>::infinity() : Never;
  for (int k = first + 1; k < last; ++k)
  {
    const Index i = ring[first], m = ring[k], j = ring[last];
    best = std::max(best,
      std::min({ b.model({ i, m, j, high }), b.model({ m, i, j, low }),
        bestTriangulation(b, low, high, ring, first, k),
        bestTriangulation(b, low, high, ring, k, last) }));
  }
  return best;
}

/// The best that any removal of an edge or a face of t can make; Never if none may go.
template <int D>
double bestOfAll(const Bench<D>& b, Index t)
{
  double best = Never;
  const Simplex<D>& nodes = b.mesh.nodes(t);
  for (Index a : nodes)
  {
    best = std::max(best, withoutFacet(b, t, a));
  }
  if constexpr (D == 3)
  {
    for (const auto& e : Local<3>::edges)
    {
      const std::vector<Index> ring = ringAround(b.mesh, nodes[e[0]], nodes[e[1]]);
      if (!ring.empty())
      {
        best = std::max(best,
          bestTriangulation(
            b, nodes[e[0]], nodes[e[1]], ring, 0, static_cast<int>(ring.size()) - 1));
      }
    }
  }
  return best;
}
}

template <class T>
class Reconnecting : public ::testing::Test
{
};
TYPED_TEST_SUITE(Reconnecting, TestDimensions);

TYPED_TEST(Reconnecting, TakesTheBestOfAllEdgesAndFaces)
{
  constexpr int D = TypeParam::dimension;
  int done = 0, left = 0;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 8, 0.35, seed));
    Reconnect<D, MeanEdgeShape<D>> reconnect;
    for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
    {
      const double expected = bestOfAll(b, t);
      const bool pays = expected > b.judge.required(b.mesh.quality(t));
      const auto mark = b.judge.begin();
      b.judge.start();
      const bool helps = reconnect.improve(b.judge, t, 0);
      EXPECT_EQ(helps, pays) << "cell " << t;
      if (helps)
      {
        EXPECT_NEAR(b.mesh.worstQuality(b.judge.changed()), expected, 1e-12) << "cell " << t;
      }
      ++(helps ? done : left);
      b.judge.rollback(mark);
    }
  }
  EXPECT_GT(done, 20);
  EXPECT_GT(left, 20);
}

/// The long edge of two flat triangles goes. Half lengths are 1 and h: the cells that come have
/// sides of 2 h and twice sqrt(1 + h^2).
TEST(Reconnecting2D, SwapsTheLongEdgeOfADiamond)
{
  const double h = 0.3;
  MeshInput<2> in;
  in.points = { { -1, 0 }, { 1, 0 }, { 0, h }, { 0, -h } };
  in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  Bench<2> b(in);
  Reconnect<2, MeanEdgeShape<2>> reconnect;
  const auto swap = [&] { return reconnect.improve(b.judge, 0, 0); };
  doUndoAndDo(b, swap);
  const double mean = 2.0 / 3.0 * (h + std::sqrt(1.0 + h * h));
  EXPECT_NEAR(b.worst(), h / (mean * mean) / std::sqrt(0.1875), 1e-14);
  expectRefused(b, [&] { return reconnect.improve(b.judge, b.editor.created()[0], 0); });
  EXPECT_EQ(triedOf(b.judge.done, Operation::EdgeRemoval), 1); // done, undone, done
}

/// Two tetrahedra on a triangle, their apexes close to it: no edge can go, the face does.
TEST(Reconnecting3D, TheFaceOfAFlatBipyramidGoes)
{
  MeshInput<3> in = ringOf(3);
  in.points[0][2] = -0.3;
  in.points[1][2] = 0.3;
  in.cells = { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  Bench<3> b(in);
  Reconnect<3, MeanEdgeShape<3>> reconnect;
  const double best = bestOfAll(b, 0);
  doUndoAndDo(b, [&] { return reconnect.improve(b.judge, 0, 0); });
  EXPECT_EQ(b.mesh.countCells(), 3);
  EXPECT_NEAR(b.worst(), best, 1e-14);
  EXPECT_EQ(triedOf(b.judge.done, Operation::FaceRemoval), 1); // done, undone, done
  EXPECT_EQ(triedOf(b.judge.done, Operation::EdgeRemoval), 0);
  Bench<3> full(in);
  full.judge.growth.left = 0; // it would bring one cell
  expectRefused(full, [&] { return reconnect.improve(full.judge, 0, 0); });
  EXPECT_TRUE(full.judge.growth.isShort);
  EXPECT_EQ(triedOf(full.judge.tried, Operation::FaceRemoval), 1);
  EXPECT_EQ(triedOf(full.judge.done, Operation::FaceRemoval), 0); // found, but refused
}

/// Whatever is kept or another worker's: no change.
TYPED_TEST(Reconnecting, LeavesWhatIsKept)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(D == 3 ? 2 : 4, 0.3);
  in.regions.resize(in.cells.size());
  for (std::size_t c = 0; c < in.cells.size(); ++c)
  {
    in.regions[c] = static_cast<Index>(c); // each cell for itself: all facets are kept
  }
  Bench<D> b(in);
  Reconnect<D, MeanEdgeShape<D>> reconnect;
  EXPECT_EQ(tryEverywhere(reconnect, b, 0, 2.0), 0);
  in.regions.clear();
  Bench<D> away(in);
  std::vector<Index> others; // all points but those of one cell
  for (Index p = 0; p < away.mesh.numberOfPointSlots(); ++p)
  {
    if (!hasId(away.mesh.nodes(0), p))
    {
      others.push_back(p);
    }
  }
  away.giveAway(others);
  expectRefused(away, [&] { return reconnect.improve(away.judge, 0, 0); });
  EXPECT_TRUE(away.editor.isHeldUp());
}

TYPED_TEST(Reconnecting, InAMeshEachTryRaisesOrRestores)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(jitteredGrid<D>(D == 3 ? 3 : 6, 0.35));
  Reconnect<D, MeanEdgeShape<D>> reconnect;
  EXPECT_GT(tryEverywhere(reconnect, b, 0), 3);
}
