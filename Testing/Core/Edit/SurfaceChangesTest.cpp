// SPDX-License-Identifier: BSD-3-Clause
// The facets of a surface that a change lets go and come, against a search of the whole mesh before
// and after.
#include "SurfaceChangesTesting.h"

using namespace meshopt;

template <class T>
class SurfaceChangesIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(SurfaceChangesIn, TestDimensions);

TYPED_TEST(SurfaceChangesIn, EdgesThatAreDivided)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  box.surface.setsOf = [](Index p) { return static_cast<std::uint32_t>(p) * 2654435761u; };
  int interfaces = 0;
  for (const auto& [edge, cell] : box.surfaceEdges())
  {
    SCOPED_TRACE("edge " + std::to_string(edge[0]) + " " + std::to_string(edge[1]));
    const auto mark = box.editor.begin();
    const Index m = box.editor.addPoint(0.5 * (box.mesh.point(edge[0]) + box.mesh.point(edge[1])));
    ASSERT_TRUE(
      proposeSplit<D>(box.editor, &box.surface, { cell, edge[0], edge[1], m }, box.proposal));
    box.check();
    for (const SurfacePiece<D>& piece : box.surface.changes[0].come)
    {
      interfaces += piece.patch == 2 * D;
    }
    box.editor.rollback(mark);
  }
  EXPECT_GT(interfaces, 0);
}

/// A node may become one with any neighbour that is on all of its patches, unless the cells would
/// not fit.
TYPED_TEST(SurfaceChangesIn, NodesThatVanish)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  std::map<Index, std::set<Index>> patches; // of points
  for (const auto& entry : box.sides())
  {
    for (Index p : entry.first)
    {
      patches[p].insert(box.patchOf(entry.first));
    }
  }
  int checked = 0;
  for (const auto& entry : box.surfaceEdges())
  {
    for (const auto& [v, u] :
      { entry.first, std::array<Index, 2>{ entry.first[1], entry.first[0] } })
    {
      SCOPED_TRACE("node " + std::to_string(v) + " into " + std::to_string(u));
      const std::set<Index>&of = patches[v], &with = patches[u];
      if (std::includes(with.begin(), with.end(), of.begin(), of.end()) &&
        proposeContraction<D>(box.editor, &box.surface, v, u, box.proposal) &&
        fillsCavity<D>(
          box.mesh, box.proposal.cavity, box.proposal.cells, box.proposal.keptChange()))
      {
        box.check();
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, D == 2 ? 10 : 100);
}

/// A facet that goes and comes again is on both lists.
TYPED_TEST(SurfaceChangesIn, FacetsThatComeAgain)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  Index c = 0;
  int i = 0;
  while (!box.mesh.isKept(c, i))
  {
    c += i == D;
    i = i == D ? 0 : i + 1;
  }
  box.proposal.cavity = { c };
  box.proposal.cells = { box.mesh.nodes(c) };
  box.proposal.changesKept = true;
  box.proposal.kept.regions = { box.mesh.region(c) };
  Facet<D> turned = box.mesh.facet(c, i);
  box.proposal.kept.gone = { turned };
  std::swap(turned[0], turned[1]); // ids in any order
  box.proposal.kept.come = { turned };
  box.proposal.kept.patches = { box.mesh.patch(c, i) };
  EXPECT_TRUE(box.changes.allowsReplacement(box.surface, box.mesh, box.proposal));
  ASSERT_EQ(box.surface.changes.size(), 1u);
  Sides<D> one;
  const auto all = box.sides();
  one.insert(*all.find(sortedIds(turned)));
  box.expectPieces(box.surface.changes[0].gone, one);
  box.expectPieces(box.surface.changes[0].come, one);
}

/// Nodes slide: the same facets before and after, where they are. Free nodes that move with them do
/// not count.
TYPED_TEST(SurfaceChangesIn, NodesThatMove)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  TestRandom random(1);
  std::vector<Index> star;
  for (Index v = 0; v < box.mesh.numberOfPointSlots(); ++v)
  {
    if (box.mesh.isFree(v))
    {
      continue;
    }
    SCOPED_TRACE("node " + std::to_string(v));
    box.proposal.clear();
    box.mesh.star(v, box.proposal.cavity);
    const Simplex<D> first = box.mesh.nodes(box.proposal.cavity[0]);
    const Index other = first[0] == v ? first[1] : first[0];
    box.mesh.star(other, star);
    for (Index c : star) // of two nodes the cells of both, each once
    {
      if (std::find(box.proposal.cavity.begin(), box.proposal.cavity.end(), c) ==
        box.proposal.cavity.end())
      {
        box.proposal.cavity.push_back(c);
      }
    }
    const bool bothSlide = !box.mesh.isFree(other);
    Vec<D> by;
    for (double& x : by)
    {
      x = 0.01 * random();
    }
    const Place place{ Freedom::Patch, 0, 0.0 };
    box.proposal.moves.push_back({ v, box.mesh.point(v) + by, place });
    box.proposal.moves.push_back(
      { other, box.mesh.point(other) - by, bothSlide ? place : Place() });
    Sides<D> moved;
    for (const auto& entry : box.sides())
    {
      if (hasId(entry.first, v) || (bothSlide && hasId(entry.first, other)))
      {
        moved.insert(entry);
      }
    }
    box.surface.changes.clear();
    box.changes.beforeMoves(box.surface, box.mesh, box.proposal);
    const auto mark = box.editor.begin();
    for (const auto& move : box.proposal.moves)
    {
      box.editor.movePoint(move.point, move.x);
    }
    EXPECT_TRUE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
    ASSERT_EQ(box.surface.changes.size(), 1u);
    const SurfaceChange<D> change = box.surface.changes[0];
    box.surface.answer = false;
    EXPECT_FALSE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
    box.surface.answer = true;
    ASSERT_EQ(change.gone.size(), change.come.size());
    for (std::size_t k = 0; k < change.gone.size(); ++k)
    {
      EXPECT_EQ(change.gone[k].patch, change.come[k].patch);
      EXPECT_EQ(change.gone[k].region, change.come[k].region);
      for (int n = 0; n < D; ++n)
      {
        const Vec<D> way = change.come[k].x[n] - change.gone[k].x[n];
        EXPECT_TRUE(way.isZero() || way.isApprox(by, 1e-12) || way.isApprox(-by, 1e-12));
      }
    }
    box.editor.rollback(mark);
    box.expectPieces(change.gone, moved); // with patches by their places: not while it is moved
  }
}
