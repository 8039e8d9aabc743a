// SPDX-License-Identifier: BSD-3-Clause
// What fills no cavity although most of it fits: cases for single conditions.
#include "Mesh/CavityFit.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
std::vector<Index> allCells(const SimplexMesh<D>& mesh)
{
  std::vector<Index> cells(mesh.numberOfCellSlots());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

std::vector<Simplex<2>> cellsOf(const SimplexMesh<2>& mesh)
{
  std::vector<Simplex<2>> cells;
  for (Index c : allCells(mesh))
  {
    cells.push_back(mesh.nodes(c));
  }
  return cells;
}

MeshInput<2> square()
{
  MeshInput<2> in;
  in.points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 } };
  return in;
}
}

/// A node that is joined to both rims of a ring of triangles: two cones that meet in a point only.
TEST(CavityFitCondition2D, ANodeInARingIsNoFilling)
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

/// A node joined to all of a ring of tetrahedra makes no ring, though all is connected: Euler's
/// number is 1, that of the ring 0.
TEST(CavityFitCondition3D, ANodeInARingIsNoFilling)
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
      if (mesh.isKept(c, i))
      {
        cone.push_back({ f[0], f[1], f[2], 3 * sections });
      }
    }
  }
  ASSERT_EQ(cone.size(), 6u * sections);
  EXPECT_TRUE(fillsCavity<3>(mesh, allCells(mesh), same));
  EXPECT_FALSE(fillsCavity<3>(mesh, allCells(mesh), cone));
}

/// Two parts that are each a filling of a part of the boundary are not connected: a bubble.
TEST(CavityFitCondition2D, WhatIsNotConnectedIsNoFilling)
{
  MeshInput<2> in = square();
  const SimplexMesh<2> mesh = buildMesh(in);
  // the square, and a closed surface of four triangles beside it
  const std::vector<Simplex<2>> bubble{ { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 5, 7 },
    { 4, 6, 7 }, { 5, 6, 7 } };
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0, 1 }, bubble));
  EXPECT_TRUE(fillsCavity<2>(mesh, { 0, 1 }, { { 1, 2, 3 }, { 3, 0, 1 } }));
}

/// The like with a torus of seven points, which leaves Euler's number as it is.
TEST(CavityFitCondition2D, ATorusBesideTheCavityIsNoPartOfIt)
{
  const SimplexMesh<2> mesh = buildMesh(square());
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
TEST(CavityFitCondition2D, WhatHangsTogetherAtAPointHasToStayTogether)
{
  MeshInput<2> in;
  in.points = { { 0, 0 }, { 4, -3 }, { 4, 3 }, { 2.5, 0.8 }, { 2.5, -0.8 } };
  in.cells = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 2, 0, 3 } };
  const SimplexMesh<2> mesh = buildMesh(in);
  EXPECT_TRUE(fillsCavity<2>(mesh, allCells(mesh), in.cells));
  EXPECT_FALSE(
    fillsCavity<2>(mesh, allCells(mesh), { { 0, 1, 3 }, { 0, 2, 4 }, { 1, 2, 4 }, { 1, 4, 3 } }));
}
