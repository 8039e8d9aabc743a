// SPDX-License-Identifier: BSD-3-Clause
// Rings around an edge, and what is kept of a mesh: interfaces, listed facets, edges and points.
#include "TestMeshes.h"

using namespace meshopt;

template <class T>
class MeshKept : public ::testing::Test
{
};
TYPED_TEST_SUITE(MeshKept, TestDimensions);

TEST(MeshRing, Closed)
{
  const SimplexMesh<3> mesh = buildMesh(ringOf(5));
  std::vector<Index> ring;
  for (Index c = 0; c < 5; ++c)
  {
    EXPECT_TRUE(mesh.ring(c, 0, 1, false, ring));
    ASSERT_EQ(ring.size(), 5u);
    EXPECT_EQ(ring[0], c);
    EXPECT_EQ(sorted(ring), sorted({ 0, 1, 2, 3, 4 }));
    for (int k = 0; k < 5; ++k) // neighbours in the list are neighbours in the ring
    {
      const int step = std::abs(ring[k] - ring[(k + 1) % 5]);
      EXPECT_TRUE(step == 1 || step == 4);
    }
  }
}

TEST(MeshRing, OpenAtTheSurface)
{
  const SimplexMesh<3> mesh = buildMesh(ringOf(6, 2));
  std::vector<Index> ring;
  for (Index c = 0; c < 4; ++c)
  {
    for (bool acrossKept : { false, true })
    {
      EXPECT_FALSE(mesh.ring(c, 0, 1, acrossKept, ring));
      ASSERT_EQ(ring.size(), 4u);
      const bool up = ring[0] == 0;
      for (int k = 0; k < 4; ++k)
      {
        EXPECT_EQ(ring[k], up ? k : 3 - k);
      }
    }
  }
}

TEST(MeshRing, AcrossKeptFacets)
{
  MeshInput<3> in = ringOf(6);
  in.regions = { 0, 0, 0, 1, 1, 1 };
  const SimplexMesh<3> mesh = buildMesh(in);
  std::vector<Index> ring;
  EXPECT_FALSE(mesh.ring(4, 0, 1, false, ring));
  EXPECT_EQ(sorted(ring), sorted({ 3, 4, 5 }));
  EXPECT_NE(ring[1], 3);
  EXPECT_NE(ring[1], 5);
  EXPECT_FALSE(mesh.ring(4, 0, 1, true, ring));
  EXPECT_EQ(sorted(ring), sorted({ 0, 1, 2, 3, 4, 5 }));

  MeshInput<3> one = ringOf(6); // one kept facet only: an open ring of all cells
  one.keptFacets = { { 1, 4, 0 } };
  const SimplexMesh<3> cut = buildMesh(one);
  EXPECT_FALSE(cut.ring(0, 0, 1, false, ring));
  EXPECT_EQ(sorted(ring), sorted({ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(sorted({ ring.front(), ring.back() }), sorted({ 1, 2 }));
}

// ---- what is kept -------------------------------------------------------------------------------

TYPED_TEST(MeshKept, RegionsAreKeptApart)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  splitRegions(in);
  const SimplexMesh<D> mesh = buildMesh(in);
  Index interfaces = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(mesh.region(c), in.regions[c]);
    EXPECT_EQ(mesh.parent(c), c);
    for (int i = 0; i <= D; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      const bool kept = h == None || in.regions[mesh.cellOf(h)] != in.regions[c];
      EXPECT_EQ(mesh.isKept(c, i), kept);
      interfaces += kept && h != None;
    }
  }
  EXPECT_EQ(interfaces, D == 3 ? 2 * 32 : 2 * 4);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    bool kept = mesh.point(p)[0] == 0.5;
    for (int d = 0; d < D; ++d)
    {
      kept = kept || mesh.point(p)[d] == 0.0 || mesh.point(p)[d] == 1.0;
    }
    EXPECT_EQ(!mesh.isFree(p), kept);
    EXPECT_EQ(mesh.isBoundary(p), kept);
  }
  expectSound(mesh);
}

TYPED_TEST(MeshKept, ListedFacetsAndFixedPointsAreKept)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  const SimplexMesh<D> plain = buildMesh(in);
  Index inner = None; // a facet with no point at the surface
  int facet = 0;
  for (Index c = 0; c < plain.numberOfCellSlots() && inner == None; ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> f = plain.facet(c, i);
      if (std::none_of(f.begin(), f.end(), [&](Index p) { return !plain.isFree(p); }))
      {
        inner = c;
        facet = i;
      }
    }
  }
  ASSERT_NE(inner, None);
  Facet<D> kept = plain.facet(inner, facet);
  std::reverse(kept.begin(), kept.end()); // any order
  in.keptFacets = { kept };
  for (Index& p : kept)
  {
    p = 0; // nonsense is ignored
  }
  in.keptFacets.push_back(kept);
  in.fixedPoints.assign(in.points.size(), 0);
  Index fixed = None;
  for (Index p = 0; p < plain.numberOfPointSlots(); ++p)
  {
    if (plain.isFree(p) && plain.localIndex(inner, p) < 0)
    {
      fixed = p;
    }
  }
  ASSERT_NE(fixed, None);
  in.fixedPoints[fixed] = 1;
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_TRUE(mesh.isKept(inner, facet));
  const Index h = mesh.adjacent(inner, facet);
  EXPECT_TRUE(mesh.isKept(mesh.cellOf(h), mesh.facetOf(h)));
  for (Index p : mesh.facet(inner, facet))
  {
    EXPECT_TRUE(!mesh.isFree(p) && mesh.isBoundary(p));
  }
  EXPECT_FALSE(mesh.isFree(fixed));
  EXPECT_FALSE(mesh.isBoundary(fixed));
  Index more = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    more += !mesh.isFree(p) && plain.isFree(p);
  }
  EXPECT_EQ(more, D + 1);
  expectSound(mesh);
}

TEST(MeshKept3D, EdgeIsMarkedInAllItsCells)
{
  MeshInput<3> in = ringOf(5);
  EXPECT_FALSE(buildMesh(in).hasKeptEdges());
  in.keptEdges = { { 1, 0 }, { 77, -3 } };
  const SimplexMesh<3> mesh = buildMesh(in);
  EXPECT_TRUE(mesh.hasKeptEdges());
  for (Index c = 0; c < 5; ++c)
  {
    int marked = 0;
    for (int e = 0; e < 6; ++e)
    {
      if (mesh.isEdgeKeptByItself(c, e))
      {
        ++marked;
        EXPECT_LE(mesh.nodes(c)[Local<3>::edges[e][0]], 1);
        EXPECT_LE(mesh.nodes(c)[Local<3>::edges[e][1]], 1);
      }
    }
    EXPECT_EQ(marked, 1);
  }
  expectSound(mesh);
}

/// Two bodies that share one point: what is listed at that point is found in both.
TEST(MeshKept3D, ListedAtAPointWhereBodiesTouch)
{
  for (int order = 0; order < 2; ++order)
  {
    MeshInput<3> in = ringOf(5); // point 0 is the one that is shared
    const std::vector<Simplex<3>> first = in.cells;
    const Index n = static_cast<Index>(in.points.size());
    for (Index p = 1; p < n; ++p)
    {
      in.points.push_back(2.0 * in.points[0] - in.points[p]);
    }
    std::vector<Simplex<3>> second = first;
    for (Simplex<3>& cell : second)
    {
      for (Index& p : cell)
      {
        p += p == 0 ? 0 : n - 1;
      }
    }
    in.cells = order ? second : first;
    const auto& then = order ? first : second;
    in.cells.insert(in.cells.end(), then.begin(), then.end());
    in.keptFacets = { { 0, 1, 2 }, { 0, n, n + 1 } };
    in.keptEdges = { { 0, 1 }, { 0, n } };
    const SimplexMesh<3> mesh = buildMesh(in);
    EXPECT_EQ(eulerCharacteristic(mesh), 1);
    int facets = 0, edges = 0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i < 4; ++i)
      {
        facets += mesh.isKept(c, i) && mesh.adjacent(c, i) != None;
      }
      for (int e = 0; e < 6; ++e)
      {
        edges += mesh.isEdgeKeptByItself(c, e);
      }
    }
    EXPECT_EQ(facets, 4);
    EXPECT_EQ(edges, 10);
    expectSound(mesh);
  }
}

/// Two closed fans of triangles that share their centre only: the centre is free by its facets, but
/// one fan would not be seen from the other.
TEST(MeshKept2D, PinchedPointIsFixed)
{
  MeshInput<2> in;
  in.points.emplace_back(0.0, 0.0);
  for (int fan = 0; fan < 2; ++fan)
  {
    for (int k = 0; k < 5; ++k)
    {
      const double a = 2.0 * M_PI * k / 5 + fan;
      in.points.emplace_back((1.0 + fan) * std::cos(a), (1.0 + fan) * std::sin(a));
      in.cells.push_back({ 0, 1 + 5 * fan + k, 1 + 5 * fan + (k + 1) % 5 });
    }
  }
  EXPECT_FALSE(buildMesh(in).isFree(0));
  in.cells.resize(5);
  EXPECT_TRUE(buildMesh(in).isFree(0));
}
