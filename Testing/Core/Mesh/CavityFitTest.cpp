// SPDX-License-Identifier: BSD-3-Clause
// Of all sets of cells on the points of a cavity those that fill it are found: as many as known.
#include "Mesh/CavityFit.h"
#include "Mesh/PinchedPoints.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// A polygon of n corners as a fan at corner 0.
MeshInput<2> polygon(int n)
{
  MeshInput<2> in;
  for (int k = 0; k < n; ++k)
  {
    in.points.emplace_back(std::cos(2.0 * M_PI * k / n), std::sin(2.0 * M_PI * k / n));
  }
  for (int k = 1; k + 1 < n; ++k)
  {
    in.cells.push_back({ 0, k, k + 1 });
  }
  return in;
}

/// All sets of D + 1 of n points.
template <int D>
std::vector<Simplex<D>> allSimplices(int n)
{
  std::vector<Simplex<D>> all;
  std::vector<bool> chosen(n, false);
  std::fill(chosen.begin(), chosen.begin() + D + 1, true);
  do
  {
    Simplex<D> cell;
    for (int p = 0, k = 0; p < n; ++p)
    {
      if (chosen[p])
      {
        cell[k++] = p;
      }
    }
    all.push_back(cell);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return all;
}

template <int D>
std::vector<Index> allCells(const SimplexMesh<D>& mesh)
{
  std::vector<Index> cells(mesh.numberOfCellSlots());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

/// How many of the sets of `size` simplices on the points of a mesh fill all of it.
template <int D>
int fillings(const MeshInput<D>& in, int size)
{
  const SimplexMesh<D> mesh = buildMesh(in);
  const std::vector<Simplex<D>> all = allSimplices<D>(static_cast<int>(in.points.size()));
  std::vector<bool> chosen(all.size(), false);
  std::fill(chosen.begin(), chosen.begin() + size, true);
  int found = 0;
  do
  {
    std::vector<Simplex<D>> cells;
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      if (chosen[k])
      {
        cells.push_back(all[k]);
      }
    }
    found += fillsCavity<D>(mesh, allCells(mesh), cells);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return found;
}

/// A facet or an edge as a cell list has it.
std::vector<Simplex<2>> cellsOf(const SimplexMesh<2>& mesh)
{
  std::vector<Simplex<2>> cells;
  for (Index c : allCells(mesh))
  {
    cells.push_back(mesh.nodes(c));
  }
  return cells;
}
}

/// The Catalan numbers: triangulations of a polygon.
TEST(CavityFit2D, FindsAllTriangulationsOfAPolygon)
{
  EXPECT_EQ(fillings(polygon(4), 2), 2);
  EXPECT_EQ(fillings(polygon(5), 3), 5);
  EXPECT_EQ(fillings(polygon(6), 4), 14);
  for (int size : { 1, 2, 3, 5 }) // a filling without new points has 4
  {
    EXPECT_EQ(fillings(polygon(6), size), 0) << size;
  }
}

/// An octahedron has three diagonals, each with 4 cells around it; and by its points alone 6
/// fillings of 5: a cell with two of the diagonals, two cells above it at the one, and two below
/// at the other.
TEST(CavityFit3D, FindsAllFillingsOfAnOctahedron)
{
  EXPECT_EQ(fillings(ringOf(4), 3), 0);
  EXPECT_EQ(fillings(ringOf(4), 4), 3);
  EXPECT_EQ(fillings(ringOf(4), 5), 6);
}

TEST(CavityFit3D, FlipsOfABipyramid)
{
  const std::vector<Simplex<3>> two{ { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  MeshInput<3> in = ringOf(3);
  const std::vector<Simplex<3>> three = in.cells;
  const SimplexMesh<3> ring = buildMesh(in);
  in.cells = two;
  const SimplexMesh<3> pair = buildMesh(in);
  EXPECT_TRUE(fillsCavity<3>(ring, { 0, 1, 2 }, two));
  EXPECT_TRUE(fillsCavity<3>(pair, { 0, 1 }, three));
  EXPECT_FALSE(fillsCavity<3>(ring, { 0, 1 }, two)); // one cell is missing on either side
  EXPECT_FALSE(fillsCavity<3>(ring, { 0, 1, 2 }, { two[0] }));
  EXPECT_FALSE(fillsCavity<3>(ring, { 0, 1, 2 }, { two[0], two[1], two[1] })); // twice
  EXPECT_FALSE(fillsCavity<3>(ring, { 0, 1, 2 }, {}));
}

/// A node that is joined to both rims of a ring of triangles: two cones that meet in a point only.
TEST(CavityFit2D, ANodeInARingIsNoFilling)
{
  MeshInput<2> in;
  for (double r : { 1.0, 2.0 })
  {
    for (int k = 0; k < 3; ++k)
    {
      in.points.emplace_back(r * std::cos(2.0 * M_PI * k / 3), r * std::sin(2.0 * M_PI * k / 3));
    }
  }
  std::vector<Simplex<2>> cone;
  for (Index k = 0; k < 3; ++k)
  {
    const Index next = (k + 1) % 3;
    in.cells.push_back({ k, 3 + k, 3 + next });
    in.cells.push_back({ k, 3 + next, next });
    cone.push_back({ k, next, 6 });
    cone.push_back({ 3 + k, 3 + next, 6 });
  }
  const SimplexMesh<2> mesh = buildMesh(in);
  EXPECT_TRUE(fillsCavity<2>(mesh, allCells(mesh), cellsOf(mesh)));
  EXPECT_FALSE(fillsCavity<2>(mesh, allCells(mesh), cone));
}

/// A node joined to all of a ring of tetrahedra makes no ring, though all hangs together: Euler's
/// number is 1, that of the ring 0.
TEST(CavityFit3D, ANodeInARingIsNoFilling)
{
  constexpr Index sections =
    4; // triangles across the ring, with a prism of three cells to the next
  MeshInput<3> in;
  for (Index k = 0; k < sections; ++k)
  {
    const double angle = 2.0 * M_PI * k / sections, c = std::cos(angle), s = std::sin(angle);
    in.points.emplace_back(2.0 * c, 2.0 * s, 0.0);
    in.points.emplace_back(3.0 * c, 3.0 * s, 0.0);
    in.points.emplace_back(2.5 * c, 2.5 * s, 1.0);
    const Index a = 3 * k, b = 3 * ((k + 1) % sections);
    in.cells.push_back({ a, a + 1, a + 2, b + 2 });
    in.cells.push_back({ a, a + 1, b + 2, b + 1 });
    in.cells.push_back({ a, b + 1, b + 2, b });
  }
  const SimplexMesh<3> mesh = buildMesh(in);
  std::vector<Simplex<3>> same, cone;
  for (Index c : allCells(mesh))
  {
    same.push_back(mesh.nodes(c));
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      if (mesh.isConstrained(c, i))
      {
        cone.push_back({ f[0], f[1], f[2], 3 * sections });
      }
    }
  }
  ASSERT_EQ(cone.size(), 6u * sections);
  EXPECT_TRUE(fillsCavity<3>(mesh, allCells(mesh), same));
  EXPECT_FALSE(fillsCavity<3>(mesh, allCells(mesh), cone));
}

/// Two parts that are each a filling of a part of the boundary do not hang together: a bubble.
TEST(CavityFit2D, WhatDoesNotHangTogetherIsNoFilling)
{
  MeshInput<2> in = polygon(4);
  const SimplexMesh<2> mesh = buildMesh(in);
  // the square, and a closed surface of four triangles beside it
  const std::vector<Simplex<2>> bubble{ { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 5, 7 },
    { 4, 6, 7 }, { 5, 6, 7 } };
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0, 1 }, bubble));
  EXPECT_TRUE(fillsCavity<2>(mesh, { 0, 1 }, { { 1, 2, 3 }, { 3, 0, 1 } }));
}

/// The like with a torus of seven points, which leaves Euler's number as it is.
TEST(CavityFit2D, ATorusBesideTheCavityIsNoPartOfIt)
{
  const SimplexMesh<2> mesh = buildMesh(polygon(4));
  std::vector<Simplex<2>> cells = cellsOf(mesh);
  for (Index k = 0; k < 7; ++k)
  {
    const auto id = [&](Index by) { return 4 + (k + by) % 7; };
    cells.push_back({ id(0), id(1), id(3) });
    cells.push_back({ id(0), id(2), id(3) });
  }
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0, 1 }, cells));
}

/// Between two triangles that share corner 0, one within the other. At that corner other sides hang
/// together after than before; all else fits.
TEST(CavityFit2D, WhatHangsTogetherAtAPointHasToStayTogether)
{
  MeshInput<2> in;
  in.points = { { 0, 0 }, { 4, -3 }, { 4, 3 }, { 2.5, 0.8 }, { 2.5, -0.8 } };
  in.cells = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 2, 0, 3 } };
  const SimplexMesh<2> mesh = buildMesh(in);
  EXPECT_TRUE(fillsCavity<2>(mesh, allCells(mesh), in.cells));
  EXPECT_FALSE(
    fillsCavity<2>(mesh, allCells(mesh), { { 0, 1, 3 }, { 0, 2, 4 }, { 1, 2, 4 }, { 1, 4, 3 } }));
}

/// What the change lets go and come at the surface need not be there: a node in a side of a square.
TEST(CavityFit2D, KeptFacetsGoAndComeByTheChange)
{
  const SimplexMesh<2> mesh = buildMesh(polygon(4));
  const std::vector<Simplex<2>> divided{ { 0, 4, 2 }, { 4, 1, 2 } }; // of cell { 0, 1, 2 }
  KeptChange<2> change;
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, divided));
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, divided, &change));
  change.gone = { { 1, 0 } };
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, divided, &change));
  change.come = { { 4, 0 }, { 1, 4 } };
  EXPECT_TRUE(fillsCavity<2>(mesh, { 0 }, divided, &change));
  change.come.pop_back();
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, divided, &change));
}

/// New edges that are there already outside of the cavity: against a look at all cells.
TEST(CavityFit2D, MeetsOthersIsWhatALookAtAllCellsSays)
{
  const MeshInput<2> in = jitteredGrid<2>(4, 0.2);
  const SimplexMesh<2> mesh = buildMesh(in);
  const std::vector<std::uint8_t> pinched(in.points.size(), 0);
  std::vector<std::uint8_t> all(in.points.size(), 1); // no star is trusted
  TestRandom random(4);
  int met = 0, clear = 0;
  for (int k = 0; k < 300; ++k)
  {
    const auto any = [&](int n) { return static_cast<Index>(0.4999 * (random() + 1.0) * n); };
    const std::vector<Index> cavity{ any(32) };
    const Simplex<2> cell{ any(25), any(25), any(25) };
    if (cell[0] == cell[1] || cell[1] == cell[2] || cell[0] == cell[2])
    {
      continue;
    }
    bool expected = false;
    for (int i = 0; i < 3; ++i)
    {
      const Index a = cell[i], b = cell[(i + 1) % 3];
      const auto has = [&](Index c)
      { return mesh.localIndex(c, a) >= 0 && mesh.localIndex(c, b) >= 0; };
      for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
      {
        expected = expected || (has(c) && !has(cavity[0]));
      }
    }
    EXPECT_EQ(meetsOthers<2>(mesh, cavity, { cell }, pinched), expected);
    EXPECT_EQ(meetsOthers<2>(mesh, cavity, { cell }, all), expected);
    ++(expected ? met : clear);
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(clear, 20);
}

TEST(CavityFit3D, KeptEdgesStayOrGoByTheChange)
{
  MeshInput<3> in = ringOf(3);
  in.constrainedEdges = { { 0, 1 }, { 2, 3 } };
  const SimplexMesh<3> mesh = buildMesh(in);
  const std::vector<Simplex<3>> two{ { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  EXPECT_TRUE(keepsEdges<3>(mesh, { 0, 1, 2 }, in.cells));
  EXPECT_FALSE(keepsEdges<3>(mesh, { 0, 1, 2 }, two)); // (0, 1) goes, (2, 3) stays
  KeptChange<3> change;
  EXPECT_FALSE(keepsEdges<3>(mesh, { 0, 1, 2 }, two, &change));
  change.goneEdges = { { 1, 0 } };
  EXPECT_TRUE(keepsEdges<3>(mesh, { 0, 1, 2 }, two, &change));
  in.constrainedEdges.clear();
  const SimplexMesh<3> free = buildMesh(in);
  EXPECT_TRUE(keepsEdges<3>(free, { 0, 1, 2 }, two));
}
