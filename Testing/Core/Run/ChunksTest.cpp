// SPDX-License-Identifier: BSD-3-Clause
// The points of a mesh are shared out: each once, in equal parts, by planes across the long side.
#include "Run/Chunks.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
std::vector<Index> ownersOf(MeshEditor<D>& editor, int n, double shift)
{
  Chunks<D> chunks;
  chunks.assign(editor, n, shift);
  std::vector<Index> owners;
  for (Index p = 0; p < editor.mesh().numberOfPointSlots(); ++p)
  {
    owners.push_back(editor.mesh().pointData(p).owner);
  }
  return owners;
}

/// A box that is longest along `axis`.
template <int D>
MeshInput<D> longBox(int n, int axis)
{
  MeshInput<D> in = jitteredGrid<D>(n, 0.2);
  for (Vec<D>& x : in.points)
  {
    x[axis] *= 3.0;
  }
  return in;
}
}

template <class T>
class ChunksOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(ChunksOf, TestDimensions);

TYPED_TEST(ChunksOf, EveryPointHasOneOwnerAndPartsAreEqual)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 6 : 20, 0.2));
  MeshEditor<D> editor(mesh);
  const long points = mesh.countPoints();
  for (int n = 1; n <= 16; ++n)
  {
    std::vector<long> sizes(n, 0);
    for (Index owner : ownersOf(editor, n, 0.0))
    {
      ASSERT_GE(owner, 0);
      ASSERT_LT(owner, n);
      ++sizes[owner];
    }
    for (long size : sizes) // each bisection rounds once; four of them at most
    {
      EXPECT_NEAR(static_cast<double>(size), static_cast<double>(points) / n, 4.0) << n;
    }
  }
}

TYPED_TEST(ChunksOf, TwoArePartedAcrossTheLongestSide)
{
  constexpr int D = TypeParam::dimension;
  for (int axis = 0; axis < D; ++axis)
  {
    SimplexMesh<D> mesh = buildMesh(longBox<D>(5, axis));
    MeshEditor<D> editor(mesh);
    const std::vector<Index> owners = ownersOf(editor, 2, 0.0);
    double low = 0.0, high = 3.0; // the last of the first chunk, the first of the other
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      const double x = mesh.point(p)[axis];
      (owners[p] == 0 ? low : high) = owners[p] == 0 ? std::max(low, x) : std::min(high, x);
    }
    EXPECT_LE(low, high);
    EXPECT_NEAR(low, 1.5, 0.6); // by the median
  }
}

TYPED_TEST(ChunksOf, ShiftsMoveTheBorders)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 6 : 20, 0.2));
  MeshEditor<D> editor(mesh);
  const double points = static_cast<double>(mesh.countPoints());
  for (double shift : { -0.3, 0.0, 0.3 })
  {
    const std::vector<Index> owners = ownersOf(editor, 2, shift);
    const auto first = std::count(owners.begin(), owners.end(), 0);
    EXPECT_EQ(first, static_cast<long>(points * (1.0 + shift) / 2.0));
  }
  EXPECT_NE(ownersOf(editor, 8, 0.3), ownersOf(editor, 8, -0.3));
  EXPECT_EQ(ownersOf(editor, 8, 0.3), ownersOf(editor, 8, 0.3));
}

/// Points at the same place along the axis are told apart by their numbers.
TEST(Chunks2D, TiesGoById)
{
  MeshInput<2> in = jitteredGrid<2>(3, 0.0);
  for (Vec<2>& x : in.points)
  {
    x[1] *= 0.1;
  }
  SimplexMesh<2> mesh = buildMesh(in);
  MeshEditor<2> editor(mesh);
  const std::vector<Index> owners = ownersOf(editor, 4, 0.0);
  for (Index p = 0; p < 16; ++p)
  {
    EXPECT_EQ(owners[p], p % 4); // columns of four points
  }
}

TYPED_TEST(ChunksOf, DeadPointsAreLeftAlone)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(3, 0.2);
  in.points.insert(in.points.end(), 3, Vec<D>::Constant(100.0)); // no cell uses them
  SimplexMesh<D> mesh = buildMesh(in);
  MeshEditor<D> editor(mesh);
  const Index unused = mesh.numberOfPointSlots() - 1;
  editor.setPointOwner(unused, 77);
  const std::vector<Index> owners = ownersOf(editor, 2, 0.0);
  EXPECT_EQ(owners[unused], 77);
  EXPECT_NEAR(static_cast<double>(std::count(owners.begin(), owners.begin() + unused - 2, 0)),
    0.5 * mesh.countPoints(), 1.0);
}
