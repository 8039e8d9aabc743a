// SPDX-License-Identifier: BSD-3-Clause
// The Euler characteristic of bodies of which it is known.
#include "Mesh/EulerCharacteristic.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
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

TEST(EulerCharacteristic, InThePlane)
{
  EXPECT_EQ(eulerCharacteristic<2>(std::vector<Simplex<2>>()), 0);
  EXPECT_EQ(eulerCharacteristic<2>({ { 4, 8, 6 } }), 1);
  EXPECT_EQ(eulerCharacteristic<2>({ { 0, 1, 2 }, { 2, 1, 3 } }), 1);
  EXPECT_EQ(eulerCharacteristic<2>({ { 0, 1, 2 }, { 2, 3, 4 } }), 1);    // a common point
  EXPECT_EQ(eulerCharacteristic<2>({ { 0, 1, 2 }, { 3, 4, 5 } }), 2);    // apart
  EXPECT_EQ(eulerCharacteristic<2>(jitteredGrid<2>(5, 0.0).cells), 1);   // a disc
  EXPECT_EQ(eulerCharacteristic<2>(ring(7, 0.5, 1.0).cells), 0);         // one hole
  EXPECT_EQ(eulerCharacteristic<2>(slitSquare(8, 0.25, 0.75).cells), 0); // a slit is a hole
  EXPECT_EQ(eulerCharacteristic<2>(                                      // a sphere
              { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }),
    2);
}

TEST(EulerCharacteristic, InSpace)
{
  EXPECT_EQ(eulerCharacteristic<3>({ { 4, 8, 6, 1 } }), 1);
  EXPECT_EQ(eulerCharacteristic<3>({ { 0, 1, 2, 3 }, { 0, 1, 4, 5 } }), 1); // a common edge
  EXPECT_EQ(eulerCharacteristic<3>({ { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }), 2);
  EXPECT_EQ(eulerCharacteristic<3>(ringOf(6).cells), 1);
  EXPECT_EQ(eulerCharacteristic<3>(cubes(3, [](int, int, int) { return true; })), 1);
  EXPECT_EQ(eulerCharacteristic<3>( // a torus
              cubes(3, [](int i, int j, int k) { return k == 0 && (i != 1 || j != 1); })),
    0);
  const auto eight = [](int i, int j, int k) { return k == 0 && j < 3 && (j != 1 || i % 2 == 0); };
  EXPECT_EQ(eulerCharacteristic<3>(cubes(5, eight)), -1); // two holes
  EXPECT_EQ(eulerCharacteristic<3>(                       // a hollow ball
              cubes(3, [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; })),
    2);
}

/// The order of cells, and that of the points in a cell, does not matter.
TEST(EulerCharacteristic, IsThatOfTheMesh)
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
  EXPECT_EQ(eulerCharacteristic<3>(in.cells), wanted);
  EXPECT_EQ(eulerCharacteristic<3>(turned), wanted);
}
