// SPDX-License-Identifier: BSD-3-Clause
// Building a mesh: errors, numbering, adjacency; stars, counts.
#include "Mesh/Ids.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
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

template <int D>
void reverse(Simplex<D>& cell)
{
  std::swap(cell[0], cell[1]);
}
}

template <class T>
class Mesh : public ::testing::Test
{
};
TYPED_TEST_SUITE(Mesh, TestDimensions);

// ---- errors -------------------------------------------------------------------------------------

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
  MeshInput<D> border = jitteredGrid<D>(1, 0.0);
  border.borderPoints.assign(border.points.size() + 1, 0);
  expectError<D>(border,
    { "border", std::to_string(border.borderPoints.size()),
      std::to_string(border.points.size()) + " points" },
    None, None);
}

TYPED_TEST(Mesh, EmptyInputIsAnEmptyMesh)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(MeshInput<D>());
  EXPECT_EQ(mesh.countCells(), 0);
  EXPECT_EQ(mesh.volume(), 0.0);
  EXPECT_EQ(eulerCharacteristic(mesh), 0);
  expectSound(mesh);
}

// ---- numbering ----------------------------------------------------------------------------------

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
  EXPECT_EQ(eulerCharacteristic(mesh), 2);
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

// ---- adjacency, stars, rings --------------------------------------------------------------------

/// Both cells lie on the same side of their common facet. To turn one of them would make it
/// inverted.
TYPED_TEST(Mesh, PositiveCellsThatLieOnEachOtherAreNotRenumbered)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in;
  in.points.assign(D + 2, Vec<D>::Zero());
  for (int i = 0; i < D; ++i)
  {
    in.points[i + 1][i] = 1.0;
  }
  in.points[D + 1] = Vec<D>::Constant(0.2); // on the side of the last point
  Simplex<D> first, second;
  std::iota(first.begin(), first.end(), 0);
  second = first;
  second[D] = D + 1;
  in.cells = { first, second };
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_EQ(mesh.numberOfReorientedCells(), 0);
  EXPECT_EQ(mesh.numberOfFoldedFacets(), 1);
  EXPECT_EQ(mesh.nodes(0), first);
  EXPECT_EQ(mesh.nodes(1), second);
  // a third cell, negative, elsewhere: its component alone is turned
  for (int i = 0; i <= D; ++i)
  {
    in.points.push_back(in.points[i] + Vec<D>::Constant(5.0));
  }
  Simplex<D> third = exchanged(exchanged(first, 0, D + 2), 1, D + 3);
  for (int i = 2; i <= D; ++i)
  {
    third[i] = D + 2 + i;
  }
  std::swap(third[D - 1], third[D]);
  in.cells.push_back(third);
  const SimplexMesh<D> three = buildMesh(in);
  EXPECT_EQ(three.numberOfReorientedCells(), 1);
  EXPECT_EQ(three.numberOfFoldedFacets(), 1);
}

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
      EXPECT_EQ(mesh.isKept(c, i), h == None);
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

// ---- counts -------------------------------------------------------------------------------------

TYPED_TEST(Mesh, VolumeAndEulerCharacteristic)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
  EXPECT_EQ(eulerCharacteristic(mesh), 1);
  EXPECT_EQ(mesh.countCells(), D == 3 ? 6 * 3 * 3 * 3 : 2 * 3 * 3);
  EXPECT_EQ(mesh.countPoints(), D == 3 ? 4 * 4 * 4 : 4 * 4);
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
  EXPECT_EQ(eulerCharacteristic(hollow), D == 3 ? 2 : 0); // a shell; a ring
}
