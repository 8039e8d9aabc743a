// SPDX-License-Identifier: BSD-3-Clause
// Points found in a frozen mesh: what is dead, flat, moved or away. More is in NodalMetricTest.cpp.
#include "Metric/Background.h"
#include "Mesh/MeshEditor.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class BackgroundOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(BackgroundOf, TestDimensions);

template <int D>
Vec<D> placeOf(const Background<D>& background, const Location<D>& at)
{
  return Background<D>::interpolate(at, [&](Index p) -> Vec<D> { return background.point(p); });
}

template <int D>
Vec<D> randomPoint(TestRandom& random, double low, double high)
{
  Vec<D> x;
  for (int d = 0; d < D; ++d)
  {
    x[d] = low + 0.5 * (high - low) * (random() + 1.0);
  }
  return x;
}
}

TYPED_TEST(BackgroundOf, IsTheMeshAsItWas)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const SimplexMesh<D> before = mesh;
  const Background<D> background(mesh);
  MeshEditor<D> editor(mesh);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    editor.movePoint(p, 3.0 * mesh.point(p));
  }
  ASSERT_EQ(background.numberOfCells(), before.countCells());
  ASSERT_EQ(background.numberOfPoints(), before.numberOfPointSlots());
  for (Index c = 0; c < background.numberOfCells(); ++c)
  {
    EXPECT_EQ(background.nodes(c), before.nodes(c));
  }
  for (Index p = 0; p < background.numberOfPoints(); ++p)
  {
    EXPECT_EQ(background.point(p), before.point(p));
    const Simplex<D>& nodes = background.nodes(background.cellOfPoint(p));
    EXPECT_NE(std::find(nodes.begin(), nodes.end(), p), nodes.end());
  }
  EXPECT_EQ(background.cellOfPoint(None), None);
  EXPECT_EQ(background.cellOfPoint(background.numberOfPoints()), None);
}

/// The nearest point of a square or cube: each coordinate is clamped.
TYPED_TEST(BackgroundOf, OutsideTheNearestPoint)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const Background<D> background(mesh);
  TestRandom random(2);
  for (int k = 0; k < 500; ++k)
  {
    const Vec<D> x = randomPoint<D>(random, -1.0, 2.0);
    const Vec<D> wanted = x.cwiseMax(0.0).cwiseMin(1.0);
    const Index hint = static_cast<Index>(k % (background.numberOfCells() + 1)) - 1; // also None
    const Location<D> at = background.locate(x, hint);
    EXPECT_LT((placeOf<D>(background, at) - wanted).norm(), 1e-9);
    EXPECT_NEAR(at.distance, (x - wanted).norm(), 1e-9);
    EXPECT_EQ(at.nodes, background.nodes(at.cell));
  }
}

/// In a mesh with gaps the walk leaves the mesh before it is there.
TYPED_TEST(BackgroundOf, AcrossGaps)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  in.cells.erase(std::remove_if(in.cells.begin(), in.cells.end(),
                   [&](const Simplex<D>& c)
                   {
                     double x = 0.0;
                     for (Index p : c)
                     {
                       x += in.points[p][0] / (D + 1);
                     }
                     return x > 0.25 && x < 0.75;
                   }),
    in.cells.end());
  const SimplexMesh<D> mesh = buildMesh(in);
  const Background<D> background(mesh);
  Vec<D> x = Vec<D>::Constant(0.3);
  for (Index hint = 0; hint < background.numberOfCells(); ++hint)
  {
    x[0] = 0.9;
    EXPECT_EQ(background.locate(x, hint).distance, 0.0);
    x[0] = 0.6; // .15 from the second part
    const Location<D> at = background.locate(x, hint);
    EXPECT_NEAR(at.distance, 0.15, 1e-12);
    EXPECT_NEAR(placeOf<D>(background, at)[0], 0.75, 1e-12);
  }
}

TEST(Background, DeadCellsAreNotThere)
{
  SimplexMesh<2> mesh = buildMesh(jitteredGrid<2>(2, 0.0));
  MeshEditor<2> editor(mesh);
  std::vector<Index> star;
  mesh.star(4, star); // six cells around the middle, which goes
  const double area = mesh.volume();
  std::vector<Simplex<2>> cells;
  for (Index c : star)
  {
    const int i = mesh.localIndex(c, 4);
    const Facet<2> f = mesh.facet(c, i);
    if (f[0] != 0 && f[1] != 0)
    {
      cells.push_back({ f[0], f[1], 0 });
    }
  }
  ASSERT_EQ(cells.size(), 4u);
  ASSERT_TRUE(editor.replace(star, cells, { 1, 1, 1, 1 }));
  EXPECT_NEAR(mesh.volume(), area, 1e-15);
  EXPECT_GT(mesh.numberOfCellSlots(), mesh.countCells());
  const Background<2> background(mesh);
  EXPECT_EQ(background.numberOfCells(), mesh.countCells());
  EXPECT_EQ(background.cellOfPoint(4), None);
  TestRandom random(4);
  for (int k = 0; k < 200; ++k)
  {
    const Vec<2> x = randomPoint<2>(random, 0.0, 1.0);
    const Location<2> at = background.locate(x, static_cast<Index>(k % background.numberOfCells()));
    EXPECT_EQ(at.distance, 0.0);
    EXPECT_EQ(std::count(at.nodes.begin(), at.nodes.end(), 4), 0);
    EXPECT_LT((placeOf<2>(background, at) - x).norm(), 1e-14);
  }
}

TEST(Background, FlatCellsContainNothing)
{
  MeshInput<2> in;
  in.points = { { 0, 0 }, { 1, 0 }, { 0.5, 0 }, { 0.5, 1 } };
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 }, { 2, 1, 3 } }; // the first one is flat
  const Background<2> background(buildMesh(in));
  for (Index hint : { None, 0, 1, 2 })
  {
    for (double x : { 0.3, 0.7 })
    {
      const Location<2> at = background.locate(Vec<2>(x, 0.1), hint);
      EXPECT_EQ(at.cell, x < 0.5 ? 1 : 2);
      EXPECT_EQ(at.distance, 0.0);
    }
  }
  // Alone a flat cell has its nearest point.
  in.cells.resize(1);
  const Background<2> flat(buildMesh(in));
  const Location<2> at = flat.locate(Vec<2>(0.3, 0.2));
  EXPECT_EQ(at.cell, 0);
  EXPECT_NEAR(at.distance, 0.2, 1e-15);
  EXPECT_LT((placeOf<2>(flat, at) - Vec<2>(0.3, 0.0)).norm(), 1e-15);
}

TEST(Background, WithoutCellsNothingIsFound)
{
  EXPECT_EQ(Background<3>(SimplexMesh<3>()).locate(Vec<3>::Zero()).cell, None);
}
