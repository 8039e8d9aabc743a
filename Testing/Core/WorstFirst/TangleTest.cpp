// SPDX-License-Identifier: BSD-3-Clause
// Whether cells may overlap: in sound, tangled, folded and pinched meshes, and what is found when
// no cell is inverted any more.
#include "WorstFirst/Tangle.h"
#include "TestBench.h"

using namespace meshopt;
using worstfirst::Tangle;

namespace
{
/// A grid of 2^D boxes; its only free node is elsewhere.
template <int D>
MeshInput<D> gridWithCentreAt(const Vec<D>& x)
{
  MeshInput<D> in = jitteredGrid<D>(2, 0.0);
  *std::find(in.points.begin(), in.points.end(), Vec<D>::Constant(0.5)) = x;
  return in;
}

/// A place on the unit circle, at a height of 0.
template <int D>
Vec<D> onCircle(double angle)
{
  Vec<D> x = Vec<D>::Zero();
  x[0] = std::cos(angle);
  x[1] = std::sin(angle);
  return x;
}

/// Cells around a point or an edge, one after the other. Their angles can be more than a full turn.
template <int D>
MeshInput<D> spiral(int cells, double angle)
{
  MeshInput<D> in;
  for (int k = 1; k < D; ++k) // the axis
  {
    in.points.push_back(Vec<D>::Zero());
    in.points.back()[D - 1] = D == 2 ? 0.0 : 2.0 * k - 3.0;
  }
  for (int k = 0; k <= cells; ++k)
  {
    in.points.push_back(onCircle<D>(k * angle));
    if (k > 0)
    {
      Simplex<D> cell;
      for (int i = 0; i < D - 1; ++i)
      {
        cell[i] = i;
      }
      cell[D - 1] = D - 2 + k;
      cell[D] = D - 1 + k;
      in.cells.push_back(cell);
    }
  }
  return in;
}

/// Two cells at one facet, on the same side of it.
template <int D>
MeshInput<D> foldedPair()
{
  MeshInput<D> in = oneCell<D>();
  in.points.push_back(Vec<D>::Constant(0.4));
  in.cells.push_back(in.cells[0]);
  in.cells[1][D] = D + 1;
  return in;
}

/// A mesh, and a cell that has only a corner of it.
template <int D>
MeshInput<D> pinched(MeshInput<D> in)
{
  Simplex<D> cell;
  cell[0] = 0; // the grids begin at the origin
  for (int i = 0; i < D; ++i)
  {
    cell[i + 1] = static_cast<Index>(in.points.size());
    in.points.push_back(Vec<D>::Zero());
    in.points.back()[i] = -1.0;
  }
  if (D == 3)
  {
    std::swap(cell[1], cell[2]);
  }
  in.cells.push_back(cell);
  return in;
}
}

template <class T>
class TangleOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(TangleOf, TestDimensions);

TYPED_TEST(TangleOf, SoundMeshesDoNotOverlap)
{
  constexpr int D = TypeParam::dimension;
  const Bench<D> bench(jitteredGrid<D>(3, 0.1));
  for (const bool hadInverted : { false, true }) // then it has been untangled
  {
    const Tangle<D> tangle(bench.mesh, hadInverted);
    EXPECT_FALSE(tangle.mayOverlap());
    EXPECT_FALSE(tangle.hasInverted());
    EXPECT_TRUE(tangle.pinched().empty());
  }
}

TYPED_TEST(TangleOf, MayOverlapUntilNoCellIsInverted)
{
  constexpr int D = TypeParam::dimension;
  Vec<D> outside = Vec<D>::Constant(0.5);
  outside[0] = 1.5;
  Bench<D> bench(gridWithCentreAt<D>(outside));
  ASSERT_LT(bench.worst(), 0.0);
  Tangle<D> tangle(bench.mesh, true);
  EXPECT_TRUE(tangle.mayOverlap());
  EXPECT_TRUE(tangle.hasInverted());
  Index centre = 0;
  while (!bench.mesh.isFree(centre))
  {
    ++centre;
  }
  bench.editor.movePoint(centre, Vec<D>::Constant(0.5));
  tangle.setInverted(1); // one is left: nothing is looked at
  EXPECT_TRUE(tangle.mayOverlap());
  EXPECT_TRUE(tangle.hasInverted());
  tangle.setInverted(0);
  EXPECT_FALSE(tangle.mayOverlap());
  EXPECT_FALSE(tangle.hasInverted());
}

TYPED_TEST(TangleOf, FindsPositiveCellsThatLieOnEachOther)
{
  constexpr int D = TypeParam::dimension;
  const Bench<D> more(spiral<D>(7, 0.95)), less(spiral<D>(7, 0.85)); // 6.65 and 5.95; 2 pi = 6.28
  ASSERT_GT(more.worst(), 0.0);
  ASSERT_GT(less.worst(), 0.0);
  EXPECT_TRUE(Tangle<D>(more.mesh, true).mayOverlap());
  EXPECT_FALSE(Tangle<D>(more.mesh, true).hasInverted());
  EXPECT_FALSE(Tangle<D>(less.mesh, true).mayOverlap());
  EXPECT_FALSE(Tangle<D>(more.mesh, false).mayOverlap()); // a mesh that was sound is not looked at
}

/// The check is dear. What it has found holds for the rest of the run.
TYPED_TEST(TangleOf, LooksOnceOnly)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> bench(spiral<D>(7, 0.95));
  Tangle<D> tangle(bench.mesh, true);
  ASSERT_TRUE(tangle.mayOverlap());
  for (int k = 0; k <= 7; ++k)
  {
    bench.editor.movePoint(D - 1 + k, onCircle<D>(0.85 * k));
  }
  tangle.setInverted(0);
  EXPECT_TRUE(tangle.mayOverlap());
  EXPECT_FALSE(Tangle<D>(bench.mesh, true).mayOverlap());
}

TYPED_TEST(TangleOf, FoldedCellsMayOverlapThoughNoneIsInverted)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = foldedPair<D>();
  const Bench<D> bench(in);
  ASSERT_EQ(bench.mesh.numberOfFoldedFacets(), 1);
  Tangle<D> tangle(bench.mesh, false);
  EXPECT_TRUE(tangle.mayOverlap());
  EXPECT_FALSE(tangle.hasInverted());
  tangle.setInverted(0);
  EXPECT_TRUE(tangle.mayOverlap());
}

/// In space they are looked for only if the mesh had inverted cells.
TYPED_TEST(TangleOf, PinchedMeshesMayOverlap)
{
  constexpr int D = TypeParam::dimension;
  const Bench<D> bench(pinched(jitteredGrid<D>(2, 0.0)));
  ASSERT_GT(bench.worst(), 0.0);
  for (const bool hadInverted : { false, true })
  {
    const bool isFound = hadInverted || D == 2;
    const Tangle<D> tangle(bench.mesh, hadInverted);
    EXPECT_EQ(tangle.mayOverlap(), isFound);
    EXPECT_FALSE(tangle.hasInverted());
    std::vector<std::uint8_t> expected(bench.mesh.numberOfPointSlots(), 0);
    expected[0] = 1;
    EXPECT_EQ(tangle.pinched(), isFound ? expected : std::vector<std::uint8_t>());
  }
}

TEST(Tangle2D, PinchedPointsAreLookedForInSmallMeshesOnly)
{
  for (const int n : { 99, 100 }) // 2 n^2 cells in the grid
  {
    const Bench<2> bench(pinched(jitteredGrid<2>(n, 0.0)));
    const bool isSmall = 2 * n * n + 1 < worstfirst::CellsPerChunk;
    EXPECT_EQ(Tangle<2>(bench.mesh, false).mayOverlap(), isSmall) << n;
    EXPECT_TRUE(Tangle<2>(bench.mesh, true).mayOverlap()) << n;
  }
}
