// SPDX-License-Identifier: BSD-3-Clause
// Building a mesh: errors, numbering, adjacency, what is kept; stars, rings, counts; the audit.
#include "TestMeshes.h"

#include <functional>

namespace meshopt
{
/// Breaks what only the mesh itself may touch.
struct MeshTestAccess
{
  template <int D>
  static auto& cell(SimplexMesh<D>& mesh, Index c)
  {
    return mesh.cells_[c];
  }
  template <int D>
  static auto& data(SimplexMesh<D>& mesh, Index c)
  {
    return mesh.cellData_[c];
  }
  template <int D>
  static auto& point(SimplexMesh<D>& mesh, Index p)
  {
    return mesh.points_[p];
  }
};
}

using namespace meshopt;

namespace
{
template <int D>
MeshInput<D> oneCell()
{
  MeshInput<D> in;
  in.points.assign(D + 1, Vec<D>::Zero());
  Simplex<D> cell;
  for (int i = 0; i <= D; ++i)
  {
    cell[i] = i;
    if (i > 0)
    {
      in.points[i][i - 1] = 1.0;
    }
  }
  in.cells = { cell };
  return in;
}

template <int D>
void expectError(
  const MeshInput<D>& in, const std::vector<std::string>& words, Index cell, Index point)
{
  SimplexMesh<D> mesh = buildMesh(oneCell<D>());
  const auto error = SimplexMesh<D>::build(in, mesh);
  ASSERT_TRUE(error);
  for (const std::string& word : words)
  {
    EXPECT_NE(error->message.find(word), std::string::npos)
      << "'" << word << "' is not in: " << error->message;
  }
  EXPECT_EQ(error->cell, cell) << error->message;
  EXPECT_EQ(error->point, point) << error->message;
  EXPECT_EQ(mesh.numberOfCellSlots(), 0);
  EXPECT_EQ(mesh.numberOfPointSlots(), 0);
}

template <int D>
std::vector<Index> cellsAt(const SimplexMesh<D>& mesh, std::vector<Index> points)
{
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c) &&
      std::all_of(
        points.begin(), points.end(), [&](Index p) { return mesh.localIndex(c, p) >= 0; }))
    {
      cells.push_back(c);
    }
  }
  return cells;
}

std::vector<Index> sorted(std::vector<Index> v)
{
  std::sort(v.begin(), v.end());
  return v;
}

/// n tetrahedra around the edge (0, 1); the last `missing` ones are left out.
MeshInput<3> ringOf(int n, int missing = 0)
{
  MeshInput<3> in;
  in.points = { { 0, 0, -1 }, { 0, 0, 1 } };
  for (int k = 0; k < n; ++k)
  {
    const double a = 2.0 * M_PI * k / n;
    in.points.emplace_back(std::cos(a), std::sin(a), 0.0);
    if (k + missing < n)
    {
      in.cells.push_back({ 0, 1, 2 + k, 2 + (k + 1) % n });
    }
  }
  return in;
}

template <int D>
void reverse(Simplex<D>& cell)
{
  std::swap(cell[0], cell[1]);
}

struct Two
{
  static constexpr int dimension = 2;
};
struct Three
{
  static constexpr int dimension = 3;
};
}

template <class T>
class Mesh : public ::testing::Test
{
};
using Dimensions = ::testing::Types<Two, Three>;
TYPED_TEST_SUITE(Mesh, Dimensions);

// ---- errors --------------------------------------------------------------------------------------

TYPED_TEST(Mesh, PointIdsOutOfRangeAreNamed)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(2, 0.0);
  const Index n = static_cast<Index>(in.points.size());
  for (Index wrong : { n, -1, 2000000000 })
  {
    MeshInput<D> bad = in;
    bad.cells[3][1] = wrong;
    expectError<D>(
      bad, { "Cell 3", "point " + std::to_string(wrong), std::to_string(n) + " points" }, 3, wrong);
  }
}

TYPED_TEST(Mesh, PointTwiceInACellIsNamed)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(2, 0.0);
  in.cells[5][D] = in.cells[5][0];
  expectError<D>(
    in, { "Cell 5", "point " + std::to_string(in.cells[5][0]), "twice" }, 5, in.cells[5][0]);
}

TYPED_TEST(Mesh, CoordinatesThatAreNotFiniteAreNamed)
{
  constexpr int D = TypeParam::dimension;
  for (double wrong :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    MeshInput<D> in = jitteredGrid<D>(2, 0.0);
    const Index p = in.cells[0][1];
    in.points[p][D - 1] = wrong;
    expectError<D>(in, { "Point " + std::to_string(p), "cell 0", "finite" }, 0, p);
  }
  MeshInput<D> unused = oneCell<D>(); // a point that no cell uses may be anything
  unused.points.push_back(Vec<D>::Constant(std::numeric_limits<double>::quiet_NaN()));
  const SimplexMesh<D> mesh = buildMesh(unused);
  EXPECT_FALSE(mesh.isPointAlive(D + 1));
  EXPECT_EQ(mesh.countPoints(), D + 1);
  expectSound(mesh);
}

TYPED_TEST(Mesh, FacetWithThreeCellsIsNamed)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = oneCell<D>();
  for (double height : { -1.0, 2.0 })
  {
    in.points.push_back(Vec<D>::Constant(height));
    Simplex<D> cell = in.cells[0];
    cell[0] = static_cast<Index>(in.points.size()) - 1;
    in.cells.push_back(cell);
  }
  expectError<D>(in,
    { D == 3 ? "face" : "edge", "more than two cells", D == 3 ? "1, 3 and 2" : "1 and 2",
      "0, 1 and 2" },
    2, None);
}

TYPED_TEST(Mesh, SameCellTwiceIsNamed)
{
  constexpr int D = TypeParam::dimension;
  for (bool reversed : { false, true })
  {
    MeshInput<D> in = oneCell<D>();
    in.cells.push_back(in.cells[0]);
    if (reversed)
    {
      reverse<D>(in.cells[1]);
    }
    expectError<D>(in, { "Cells 0 and 1", "same points" }, 1, None);
  }
}

TYPED_TEST(Mesh, ArraysOfAWrongLengthAreNamed)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> regions = jitteredGrid<D>(1, 0.0);
  regions.regions.assign(regions.cells.size() + 1, 0);
  expectError<D>(regions,
    { "region", std::to_string(regions.regions.size()),
      std::to_string(regions.cells.size()) + " cells" },
    None, None);
  MeshInput<D> fixed = jitteredGrid<D>(1, 0.0);
  fixed.fixedPoints.assign(fixed.points.size() - 1, 0);
  expectError<D>(fixed,
    { "fixed", std::to_string(fixed.fixedPoints.size()),
      std::to_string(fixed.points.size()) + " points" },
    None, None);
}

TYPED_TEST(Mesh, EmptyInputIsAnEmptyMesh)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(MeshInput<D>());
  EXPECT_EQ(mesh.countCells(), 0);
  EXPECT_EQ(mesh.volume(), 0.0);
  EXPECT_EQ(mesh.eulerCharacteristic(), 0);
  expectSound(mesh);
}

// ---- numbering -----------------------------------------------------------------------------------

TYPED_TEST(Mesh, AWhollyReversedMeshIsRenumbered)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(3, 0.2);
  for (Simplex<D>& cell : in.cells)
  {
    reverse<D>(cell);
  }
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_EQ(mesh.numberOfReorientedCells(), static_cast<Index>(in.cells.size()));
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
  expectSound(mesh);
}

TYPED_TEST(Mesh, SingleReversedCellsAreRenumbered)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> good = jitteredGrid<D>(3, 0.2);
  EXPECT_EQ(buildMesh(good).numberOfReorientedCells(), 0);
  MeshInput<D> in = good;
  Index reversed = 0;
  for (std::size_t c = 0; c < in.cells.size(); c += 3)
  {
    reverse<D>(in.cells[c]);
    ++reversed;
  }
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_EQ(mesh.numberOfReorientedCells(), reversed);
  for (std::size_t c = 0; c < in.cells.size(); ++c)
  {
    if (c % 3 != 0)
    {
      EXPECT_EQ(mesh.nodes(c), good.cells[c]);
    }
  }
  expectSound(mesh);
}

TYPED_TEST(Mesh, EachComponentIsOrientedByItself)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(2, 0.1);
  const std::size_t cells = in.cells.size();
  const Index points = static_cast<Index>(in.points.size());
  for (Index p = 0; p < points; ++p)
  {
    in.points.push_back(in.points[p] + Vec<D>::Constant(5.0));
  }
  for (std::size_t c = 0; c < cells; ++c)
  {
    Simplex<D> cell = in.cells[c];
    for (Index& p : cell)
    {
      p += points;
    }
    reverse<D>(cell);
    in.cells.push_back(cell);
  }
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_EQ(mesh.numberOfReorientedCells(), static_cast<Index>(cells));
  EXPECT_NEAR(mesh.volume(), 2.0, 1e-13);
  EXPECT_EQ(mesh.eulerCharacteristic(), 2);
  expectSound(mesh);
}

TYPED_TEST(Mesh, AReallyInvertedCellStaysNegative)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  Vec<D> middle = Vec<D>::Constant(0.5);
  const auto centre = std::find_if(
    in.points.begin(), in.points.end(), [&](const Vec<D>& x) { return x == middle; });
  ASSERT_NE(centre, in.points.end());
  (*centre)[0] += 0.4; // out of its star
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_EQ(mesh.numberOfReorientedCells(), 0);
  Index negative = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(mesh.nodes(c), in.cells[c]);
    negative += signedVolume(mesh.corners(c)) < 0.0;
  }
  EXPECT_GT(negative, 0);
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
  expectSound(mesh, false);
  EXPECT_FALSE(mesh.audit(true).empty());
}

// ---- adjacency, stars, rings ---------------------------------------------------------------------

TYPED_TEST(Mesh, FacetsLeadToTheCellBehind)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> f = mesh.facet(c, i);
      std::vector<Index> both = cellsAt(mesh, std::vector<Index>(f.begin(), f.end()));
      const Index h = mesh.adjacent(c, i);
      ASSERT_EQ(both.size(), h == None ? 1u : 2u);
      EXPECT_EQ(mesh.isConstrained(c, i), h == None);
      if (h != None)
      {
        const Index o = mesh.cellOf(h);
        EXPECT_EQ(sorted({ c, o }), both);
        EXPECT_EQ(mesh.adjacent(o, mesh.facetOf(h)), mesh.handle(c, i));
      }
      // (facet, node) is an even permutation: the simplex so numbered is positive
      Corners<D> x;
      for (int k = 0; k < D; ++k)
      {
        x[k] = mesh.point(f[k]);
      }
      x[D] = mesh.point(mesh.nodes(c)[i]);
      EXPECT_GT(signedVolume(x), 0.0);
    }
  }
}

TYPED_TEST(Mesh, StarsAreComplete)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  splitRegions(in); // stars reach across kept facets
  const SimplexMesh<D> mesh = buildMesh(in);
  std::vector<Index> star;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    mesh.star(p, star);
    EXPECT_EQ(sorted(star), cellsAt(mesh, { p })) << "point " << p;
  }
}

TEST(MeshRing, LargeStarIsComplete)
{
  const int n = 400; // more than the set of cells holds at first
  const SimplexMesh<3> mesh = buildMesh(ringOf(n));
  std::vector<Index> star, ring;
  mesh.star(0, star);
  EXPECT_EQ(sorted(star), cellsAt(mesh, { 0 }));
  EXPECT_TRUE(mesh.ring(7, 0, 1, false, ring));
  EXPECT_EQ(sorted(ring), cellsAt(mesh, { 0, 1 }));
}

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
  one.constrainedFacets = { { 1, 4, 0 } };
  const SimplexMesh<3> cut = buildMesh(one);
  EXPECT_FALSE(cut.ring(0, 0, 1, false, ring));
  EXPECT_EQ(sorted(ring), sorted({ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(sorted({ ring.front(), ring.back() }), sorted({ 1, 2 }));
}

// ---- what is kept --------------------------------------------------------------------------------

TYPED_TEST(Mesh, RegionsAreKeptApart)
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
      EXPECT_EQ(mesh.isConstrained(c, i), kept);
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
    EXPECT_EQ(mesh.isFixed(p), kept);
    EXPECT_EQ(mesh.isBoundary(p), kept);
  }
  expectSound(mesh);
}

TYPED_TEST(Mesh, ListedFacetsAndFixedPointsAreKept)
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
      if (std::none_of(f.begin(), f.end(), [&](Index p) { return plain.isFixed(p); }))
      {
        inner = c;
        facet = i;
      }
    }
  }
  ASSERT_NE(inner, None);
  Facet<D> kept = plain.facet(inner, facet);
  std::reverse(kept.begin(), kept.end()); // any order
  in.constrainedFacets = { kept };
  for (Index& p : kept)
  {
    p = 0; // nonsense is ignored
  }
  in.constrainedFacets.push_back(kept);
  in.fixedPoints.assign(in.points.size(), 0);
  Index fixed = None;
  for (Index p = 0; p < plain.numberOfPointSlots(); ++p)
  {
    if (!plain.isFixed(p) && plain.localIndex(inner, p) < 0)
    {
      fixed = p;
    }
  }
  ASSERT_NE(fixed, None);
  in.fixedPoints[fixed] = 1;
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_TRUE(mesh.isConstrained(inner, facet));
  const Index h = mesh.adjacent(inner, facet);
  EXPECT_TRUE(mesh.isConstrained(mesh.cellOf(h), mesh.facetOf(h)));
  for (Index p : mesh.facet(inner, facet))
  {
    EXPECT_TRUE(mesh.isFixed(p) && mesh.isBoundary(p));
  }
  EXPECT_TRUE(mesh.isFixed(fixed));
  EXPECT_FALSE(mesh.isBoundary(fixed));
  Index more = 0;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    more += mesh.isFixed(p) && !plain.isFixed(p);
  }
  EXPECT_EQ(more, D + 1);
  expectSound(mesh);
}

TEST(MeshKept, EdgeIsMarkedInAllItsCells)
{
  MeshInput<3> in = ringOf(5);
  EXPECT_FALSE(buildMesh(in).hasConstrainedEdges());
  in.constrainedEdges = { { 1, 0 }, { 77, -3 } };
  const SimplexMesh<3> mesh = buildMesh(in);
  EXPECT_TRUE(mesh.hasConstrainedEdges());
  for (Index c = 0; c < 5; ++c)
  {
    int marked = 0;
    for (int e = 0; e < 6; ++e)
    {
      if (mesh.isEdgeConstrained(c, e))
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
TEST(MeshKept, ListedAtAPointWhereBodiesTouch)
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
    in.constrainedFacets = { { 0, 1, 2 }, { 0, n, n + 1 } };
    in.constrainedEdges = { { 0, 1 }, { 0, n } };
    const SimplexMesh<3> mesh = buildMesh(in);
    EXPECT_EQ(mesh.eulerCharacteristic(), 1);
    int facets = 0, edges = 0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i < 4; ++i)
      {
        facets += mesh.isConstrained(c, i) && mesh.adjacent(c, i) != None;
      }
      for (int e = 0; e < 6; ++e)
      {
        edges += mesh.isEdgeConstrained(c, e);
      }
    }
    EXPECT_EQ(facets, 4);
    EXPECT_EQ(edges, 10);
    expectSound(mesh);
  }
}

/// Two closed fans of triangles that share their centre only: the centre is free by its facets, but
/// one fan would not be seen from the other.
TEST(MeshKept, PinchedPointIsFixed)
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
  EXPECT_TRUE(buildMesh(in).isFixed(0));
  in.cells.resize(5);
  EXPECT_FALSE(buildMesh(in).isFixed(0));
}

// ---- counts --------------------------------------------------------------------------------------

TYPED_TEST(Mesh, VolumeAndEulerCharacteristic)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
  EXPECT_EQ(mesh.eulerCharacteristic(), 1);
  EXPECT_EQ(mesh.countCells(), D == 3 ? 162 : 18);
  EXPECT_EQ(mesh.countPoints(), D == 3 ? 64 : 16);
  MeshInput<D> hole = jitteredGrid<D>(3, 0.0); // the middle box is taken out
  std::vector<Simplex<D>> cells;
  for (const Simplex<D>& cell : hole.cells)
  {
    Vec<D> centre = Vec<D>::Zero();
    for (Index p : cell)
    {
      centre += hole.points[p] / (D + 1);
    }
    if ((centre - Vec<D>::Constant(0.5)).template lpNorm<Eigen::Infinity>() > 1.0 / 6.0)
    {
      cells.push_back(cell);
    }
  }
  hole.cells = cells;
  const SimplexMesh<D> hollow = buildMesh(hole);
  EXPECT_NEAR(hollow.volume(), 1.0 - std::pow(1.0 / 3.0, D), 1e-13);
  EXPECT_EQ(hollow.eulerCharacteristic(), D == 3 ? 2 : 0); // a shell; a ring
}

// ---- the audit -----------------------------------------------------------------------------------

TYPED_TEST(Mesh, AuditFindsWhatIsBroken)
{
  constexpr int D = TypeParam::dimension;
  using Access = MeshTestAccess;
  using M = SimplexMesh<D>;
  MeshInput<D> in = jitteredGrid<D>(4, 0.1);
  splitRegions(in);
  const M good = buildMesh(in);
  expectSound(good);
  Index c = None; // a cell without a kept facet, and its first free node
  for (Index k = 0; k < good.numberOfCellSlots() && c == None; ++k)
  {
    c = (good.cellData(k).flags & M::FacetBits) == 0 ? k : None;
  }
  Index s = None, side = 0;  // a facet at the surface
  Index r = None, rSide = 0; // one between regions
  for (Index k = 0; k < good.numberOfCellSlots(); ++k)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (good.adjacent(k, i) == None)
      {
        s = k;
        side = i;
      }
      else if (good.isConstrained(k, i))
      {
        r = k;
        rSide = i;
      }
    }
  }
  ASSERT_TRUE(c != None && s != None && r != None);
  struct Case
  {
    const char* word;
    std::function<void(M&)> damage;
  };
  const std::vector<Case> cases = {
    { "not positive", [&](M& m) { reverse<D>(Access::cell(m, c).nodes); } },
    { "dead point",
      [&](M& m) { Access::point(m, m.nodes(c)[0]).flags &= std::uint8_t(~M::PointAlive); } },
    { "dead point", [&](M& m) { Access::cell(m, c).nodes[0] = m.numberOfPointSlots(); } },
    { "dead cell", [&](M& m) { Access::data(m, c).flags = 0; } },
    { "not the facet",
      [&](M& m) { std::swap(Access::cell(m, c).adjacent[0], Access::cell(m, c).adjacent[1]); } },
    { "surface but not kept", [&](M& m) { Access::cell(m, c).adjacent[0] = None; } },
    { "surface but not kept",
      [&](M& m) { Access::data(m, s).flags &= std::uint16_t(~(1u << side)); } },
    { "one side only", [&](M& m) { Access::data(m, r).flags &= std::uint16_t(~(1u << rSide)); } },
    { "between regions", [&](M& m) { Access::data(m, c).region = 7; } },
    { "is free",
      [&](M& m) { Access::point(m, m.facet(s, side)[0]).flags &= std::uint8_t(~M::PointFixed); } },
    { "is free",
      [&](M& m)
      { Access::point(m, m.facet(s, side)[0]).flags &= std::uint8_t(~M::PointBoundary); } },
    { "does not use it", [&](M& m) { Access::point(m, m.nodes(c)[0]).cell = s; } },
  };
  for (std::size_t k = 0; k < cases.size(); ++k)
  {
    if (std::string(cases[k].word) == "does not use it" &&
      good.localIndex(s, good.nodes(c)[0]) >= 0)
    {
      continue;
    }
    M mesh = good;
    cases[k].damage(mesh);
    std::string all;
    for (const std::string& fault : mesh.audit(true))
    {
      all += fault + "\n";
    }
    EXPECT_NE(all.find(cases[k].word), std::string::npos)
      << "case " << k << ": '" << cases[k].word << "' is not in:\n"
      << all;
  }
}

TYPED_TEST(Mesh, AuditFindsUnusedAndDoubleCells)
{
  constexpr int D = TypeParam::dimension;
  using M = SimplexMesh<D>;
  MeshInput<D> in = oneCell<D>();
  in.points.push_back(Vec<D>::Constant(9.0));
  M unused = buildMesh(in);
  expectSound(unused);
  MeshTestAccess::point(unused, D + 1).flags |= M::PointAlive;
  EXPECT_EQ(unused.audit(true).size(), 1u);

  const Index n = D + 1; // a copy of the cell that gets the first one's points
  for (Index p = 0; p < n; ++p)
  {
    in.points.push_back(in.points[p] + Vec<D>::Constant(3.0));
  }
  Simplex<D> copy = in.cells[0];
  for (Index& p : copy)
  {
    p += n + 1;
  }
  in.cells.push_back(copy);
  M twice = buildMesh(in);
  expectSound(twice);
  MeshTestAccess::cell(twice, 1).nodes = twice.nodes(0);
  bool found = false;
  for (const std::string& fault : twice.audit(true))
  {
    found = found || fault.find("stands twice") != std::string::npos;
  }
  EXPECT_TRUE(found);
}
