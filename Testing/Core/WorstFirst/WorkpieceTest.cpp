// SPDX-License-Identifier: BSD-3-Clause
// How wide a mesh is.
#include "WorstFirst/Workpiece.h"
#include "EngineBench.h"

using namespace meshopt;

namespace
{
template <class T>
class Wide : public ::testing::Test
{
};
TYPED_TEST_SUITE(Wide, TestDimensions);

/// `n` cubes along each side, `length` wide.
template <int D>
double widthOf(int n, double length)
{
  MeshInput<D> in = jitteredGrid<D>(n, 0.0);
  for (Vec<D>& x : in.points)
  {
    x *= length;
  }
  return EngineBench<D>(in, Options()).workpiece.widthInEdges();
}
}

/// The mean edge of a cube of six tetrahedra is between its side and its diagonal.
TYPED_TEST(Wide, AsManyEdgesAsTheDiagonalHas)
{
  constexpr int D = TypeParam::dimension;
  const int n = 12; // more cells than are looked at in space
  EXPECT_LT(widthOf<D>(n, 1.0), n * std::sqrt(static_cast<double>(D)));
  EXPECT_GT(widthOf<D>(n, 1.0), n);
}

TYPED_TEST(Wide, InProportionToTheNumberOfEdgesAlone)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_NEAR(widthOf<D>(4, 7.0), widthOf<D>(4, 1.0), 1e-9);
  EXPECT_NEAR(widthOf<D>(8, 1.0), 2.0 * widthOf<D>(4, 1.0), 0.05 * widthOf<D>(8, 1.0));
}
