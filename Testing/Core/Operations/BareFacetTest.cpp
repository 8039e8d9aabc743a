// SPDX-License-Identifier: BSD-3-Clause
// Most polyhedra cannot be refilled better: the quick test that refuses them, against the search.
#include "PolyhedronOfCells.h"

using namespace meshopt;

/// The quick test finds the facet that the search finds, before any candidate is made.
TEST(BareFacet, IsWhatTheSearchFinds)
{
  TestRandom random(13);
  PolyhedronSearch quick, search;
  long bare = 0, first = 0, none = 0;
  for (unsigned seed = 1; seed <= 60; ++seed)
  {
    const MeshInput<3> in = jitteredGrid<3>(4, 0.3, seed);
    const SimplexMesh<3> mesh = buildMesh(in);
    const auto cells = someCells(mesh, Index(seed * 31 % in.cells.size()), 6 + seed % 12, random);
    const Polyhedron p = polyhedronOf(mesh, cells);
    load(search, p);
    const double above = 0.05 * (seed % 17);
    quick.clear();
    for (std::size_t k = 0; k < p.points.size(); ++k)
    {
      quick.addPoint(p.points[k], p.stay[k]);
    }
    ASSERT_TRUE(quick.setBoundary(p.facets));
    const int facet = quick.findBareFacet(
      [&](const PolyhedronSearch::Candidate& t) { return p.quality(t.nodes) > above; });
    const auto isOn = [&](const PolyhedronSearch::Candidate& t, const PolyhedronSearch::Triangle& f)
    {
      const int side = PolyhedronSearch::sideOf(f[0], f[1], f[2]);
      return t.quality > above && std::find(t.sides.begin(), t.sides.end(), side) != t.sides.end();
    };
    int expected = -1;
    for (int k = 0; k < int(p.facets.size()) && expected < 0; ++k)
    {
      const bool isBare = std::none_of(search.candidates().begin(), search.candidates().end(),
        [&](const PolyhedronSearch::Candidate& t) { return isOn(t, p.facets[k]); });
      expected = isBare ? k : -1;
    }
    EXPECT_EQ(facet, expected) << seed;
    const double q = search.search(above, 3000);
    if (facet >= 0)
    {
      EXPECT_EQ(q, PolyhedronSearch::Never);
      EXPECT_EQ(search.bareFacet(), facet);
      EXPECT_EQ(search.steps(), 0);
    }
    // and what it has looked at does not change what the search finds
    quick.findCandidates();
    EXPECT_EQ(quick.candidates().size(), search.candidates().size());
    for (PolyhedronSearch::Candidate& t : quick.candidates())
    {
      t.quality = p.quality(t.nodes);
    }
    EXPECT_EQ(quick.search(above, 3000), q);
    EXPECT_EQ(quick.cells(), search.cells());
    bare += facet >= 0;
    first += facet == 0;
    none += facet < 0;
  }
  EXPECT_GT(bare, 15);
  EXPECT_GT(bare, first);
  EXPECT_GT(none, 15);
}
