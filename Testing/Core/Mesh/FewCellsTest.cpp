// SPDX-License-Identifier: BSD-3-Clause
// The Euler characteristic of bodies of which it is known, and what hangs together.
#include "Mesh/FewCells.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
FewCells<D> load(const std::vector<Simplex<D>>& cells, LocalNumbers& numbers)
{
  FewCells<D> few;
  few.load(cells, numbers, [](std::size_t, int) { return false; });
  few.connect(numbers.size());
  return few;
}

/// By FewCells, which must agree with the count of all faces, sorted.
template <int D>
long euler(const std::vector<Simplex<D>>& cells)
{
  LocalNumbers numbers;
  const FewCells<D> few = load<D>(cells, numbers);
  std::vector<Index> seen(static_cast<std::size_t>(numbers.size()), None);
  const long number = few.eulerCharacteristic(numbers.size(), seen);
  EXPECT_EQ(number, eulerCharacteristic<D>(cells));
  return number;
}

template <int D>
bool isOnePiece(const std::vector<Simplex<D>>& cells)
{
  LocalNumbers numbers;
  FewCells<D> few = load<D>(cells, numbers);
  const bool is = few.isOnePiece();
  EXPECT_EQ(few.isOnePiece(), is); // the forest is as it was
  return is;
}

/// The cells of a grid of cubes of which `has(i, j, k)` is true.
template <class F>
std::vector<Simplex<3>> cubes(int n, F&& has)
{
  const MeshInput<3> in = jitteredGrid<3>(n, 0.0);
  std::vector<Simplex<3>> cells;
  for (const Simplex<3>& c : in.cells)
  {
    Vec<3> middle = Vec<3>::Zero();
    for (Index p : c)
    {
      middle += in.points[p] * (n / 4.0);
    }
    if (has(int(middle[0]), int(middle[1]), int(middle[2])))
    {
      cells.push_back(c);
    }
  }
  return cells;
}
}

TEST(FewCells, EulerCharacteristicInThePlane)
{
  EXPECT_EQ(euler<2>(std::vector<Simplex<2>>()), 0);
  EXPECT_EQ(euler<2>({ { 4, 8, 6 } }), 1);
  EXPECT_EQ(euler<2>({ { 0, 1, 2 }, { 2, 1, 3 } }), 1);
  EXPECT_EQ(euler<2>({ { 0, 1, 2 }, { 2, 3, 4 } }), 1);    // a common point
  EXPECT_EQ(euler<2>({ { 0, 1, 2 }, { 3, 4, 5 } }), 2);    // apart
  EXPECT_EQ(euler<2>(jitteredGrid<2>(5, 0.0).cells), 1);   // a disc
  EXPECT_EQ(euler<2>(ring(7, 0.5, 1.0).cells), 0);         // one hole
  EXPECT_EQ(euler<2>(slitSquare(8, 0.25, 0.75).cells), 0); // a slit is a hole
  EXPECT_EQ(euler<2>(                                      // a sphere
              { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }),
    2);
}

TEST(FewCells, EulerCharacteristicInSpace)
{
  EXPECT_EQ(euler<3>({ { 4, 8, 6, 1 } }), 1);
  EXPECT_EQ(euler<3>({ { 0, 1, 2, 3 }, { 0, 1, 4, 5 } }), 1); // a common edge
  EXPECT_EQ(euler<3>({ { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }), 2);
  EXPECT_EQ(euler<3>(ringOf(6).cells), 1);
  EXPECT_EQ(euler<3>(cubes(3, [](int, int, int) { return true; })), 1);
  EXPECT_EQ(euler<3>( // a torus
              cubes(3, [](int i, int j, int k) { return k == 0 && (i != 1 || j != 1); })),
    0);
  const auto eight = [](int i, int j, int k) { return k == 0 && j < 3 && (j != 1 || i % 2 == 0); };
  EXPECT_EQ(euler<3>(cubes(5, eight)), -1); // two holes
  EXPECT_EQ(euler<3>(                       // a hollow ball
              cubes(3, [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; })),
    2);
}

/// The order of cells, and that of the points in a cell, does not matter.
TEST(FewCells, EulerCharacteristicIsThatOfTheMesh)
{
  MeshInput<3> in = jitteredGrid<3>(3, 0.2);
  in.cells.erase(in.cells.begin() + 40, in.cells.begin() + 60);
  std::vector<Simplex<3>> turned = in.cells;
  std::reverse(turned.begin(), turned.end());
  for (Simplex<3>& c : turned)
  {
    std::rotate(c.begin(), c.begin() + 1, c.end());
  }
  const long wanted = eulerCharacteristic(buildMesh(in));
  EXPECT_EQ(euler<3>(in.cells), wanted);
  EXPECT_EQ(euler<3>(turned), wanted);
}

/// Over facets only: not over points, nor edges.
TEST(FewCells, OnePieceIsConnectedOverFacets)
{
  EXPECT_TRUE(isOnePiece<2>({ { 4, 8, 6 } }));
  EXPECT_TRUE(isOnePiece<2>({ { 0, 1, 2 }, { 2, 1, 3 }, { 3, 1, 4 } }));
  EXPECT_FALSE(isOnePiece<2>({ { 0, 1, 2 }, { 2, 3, 4 } }));
  EXPECT_TRUE(isOnePiece<3>({ { 0, 1, 2, 3 }, { 9, 2, 1, 0 } }));
  EXPECT_FALSE(isOnePiece<3>({ { 0, 1, 2, 3 }, { 0, 1, 4, 5 } }));
  EXPECT_TRUE(isOnePiece<3>(ringOf(6).cells));
}

TEST(FewCells, JoinedCellsComeApartAgain)
{
  LocalNumbers numbers;
  FewCells<2> few = load<2>({ { 7, 3, 5 }, { 5, 3, 9 }, { 9, 3, 2 } }, numbers);
  ASSERT_EQ(few.joints.size(), 2u);
  EXPECT_TRUE(few.join(0));
  EXPECT_FALSE(few.join(0));
  EXPECT_TRUE(few.join(1));
  EXPECT_EQ(few.root(0), few.root(2));
  few.separate(0);
  few.separate(1);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(few.root(k), k);
  }
}

/// Each set of points has a number of its own, whatever their order.
TEST(FewCells, FacetsAsNumbers)
{
  constexpr Index last = FewCells<3>::MostPoints - 1;
  EXPECT_EQ(FewCells<3>::facetOf(FewCells<3>::keyOf({ last, 0, 77 })), (Facet<3>{ 0, 77, last }));
  EXPECT_EQ(FewCells<3>::keyOf({ last, 0, 77 }), FewCells<3>::keyOf({ 0, 77, last }));
  EXPECT_NE(FewCells<3>::keyOf({ 1, 2, 3 }), FewCells<3>::keyOf({ 1, 2, 4 }));
  EXPECT_EQ(FewCells<2>::facetOf(FewCells<2>::keyOf({ last, 5 })), (Facet<2>{ 5, last }));
}
