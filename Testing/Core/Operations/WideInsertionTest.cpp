// SPDX-License-Identifier: BSD-3-Clause
// A node comes far from flat cells that lie on each other in layers: their nodes vanish together.
#include "Operations/WideInsertion.h"
#include "Mesh/Predicates.h"
#include "TestBench.h"

using namespace meshopt;

template <class T>
class InsertingFarAway : public ::testing::Test
{
};
TYPED_TEST_SUITE(InsertingFarAway, TestDimensions);

namespace
{
/// A simplex of edge 1 with points on its axis, the first close to the facet opposite to corner D
/// and each `ratio` times as high above it as the one before: the cells between are flat.
template <int D>
MeshInput<D> layers(int count, double ratio = 1.2)
{
  constexpr double lowest = 1e-4;
  MeshInput<D> in;
  Vec<D> foot = Vec<D>::Zero();
  for (int i = 0; i < D; ++i)
  {
    Vec<D> x = Vec<D>::Zero();
    x[0] = i == 1 ? 1.0 : i == 2 ? 0.5 : 0.0;
    x[1] = i == 2 ? std::sqrt(0.75) : 0.0;
    in.points.push_back(x);
    foot += x / D;
  }
  const Vec<D> up = Vec<D>::Unit(D - 1);
  in.points.push_back(foot + std::sqrt((D + 1) / (2.0 * D)) * up);
  double height = lowest;
  for (int k = 0; k < count; ++k, height *= ratio)
  {
    in.points.push_back(foot + height * up);
  }
  const auto add = [&](Simplex<D> cell)
  {
    Corners<D> x;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = in.points[cell[i]];
    }
    if (orientation(x) < 0)
    {
      std::swap(cell[0], cell[1]);
    }
    in.cells.push_back(cell);
  };
  // The bottom cell, then those between one point of the axis and the next; the last is corner D.
  for (int k = 0; k <= count; ++k)
  {
    const Index below = D + k, above = k < count ? D + 1 + k : D;
    for (int skipped = 0; skipped < (k == 0 ? 1 : D); ++skipped)
    {
      Simplex<D> cell;
      for (int i = 0; i < D; ++i)
      {
        cell[i] = i;
      }
      if (k > 0)
      {
        cell[skipped] = below;
      }
      cell[D] = above;
      add(cell);
    }
  }
  return in;
}

/// The quality with one node, at its best place: the centre, from where all cells look the same.
template <int D>
double bestWithOneNode()
{
  MeshInput<D> in = layers<D>(1);
  in.points.back()[D - 1] = in.points[D][D - 1] / (D + 1);
  return Bench<D>(in).worst();
}

constexpr int Layers = 12, MostNodes = 30;
}

TYPED_TEST(InsertingFarAway, NodesOfLayersVanishTogether)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(layers<D>(Layers));
  WideInsertion<D, MeanEdgeShape<D>> wide;
  b.judge.setWide(Layers);
  doUndoAndDo(b,
    [&]
    {
      b.judge.start();
      return wide.improve(b.judge, 0, Level::LongLookAhead);
    });
  EXPECT_NEAR(b.worst(), bestWithOneNode<D>(), 2e-3);
  EXPECT_EQ(b.mesh.countPoints(), D + 2);
  EXPECT_EQ(b.mesh.countCells(), D + 1);
}

TYPED_TEST(InsertingFarAway, ANodeNearbyIsOfLittleUse)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(layers<D>(Layers));
  NodeInsertion<D, MeanEdgeShape<D>> near;
  b.judge.start();
  near.improve(b.judge, 0, Level::Insertion);
  EXPECT_LT(b.worst(), 0.1 * bestWithOneNode<D>());
}

/// In a small mesh a cavity may have fewer cells than these layers.
TYPED_TEST(InsertingFarAway, MoreLayersVanishInALargeMesh)
{
  constexpr int D = TypeParam::dimension;
  constexpr int many = 250, others = 30000;
  for (const bool isLarge : { false, true })
  {
    MeshInput<D> in = layers<D>(many, 1.015);
    const MeshInput<D> apart = layers<D>(0);
    for (int k = 1; isLarge && k <= others; ++k)
    {
      Simplex<D> cell = apart.cells.front();
      for (int i = 0; i <= D; ++i)
      {
        cell[i] += static_cast<Index>(in.points.size());
      }
      for (const Vec<D>& x : apart.points)
      {
        in.points.push_back(x + 2.0 * k * Vec<D>::Unit(0));
      }
      in.cells.push_back(cell);
    }
    Bench<D> b(in);
    WideInsertion<D, MeanEdgeShape<D>> wide;
    b.judge.setWide(many);
    b.judge.start();
    wide.improve(b.judge, 0, Level::LongLookAhead);
    EXPECT_EQ(b.worst() > 0.9 * bestWithOneNode<D>(), isLarge);
  }
}

TYPED_TEST(InsertingFarAway, NeedsToBeSwitchedOn)
{
  constexpr int D = TypeParam::dimension;
  Bench<D> b(layers<D>(Layers));
  WideInsertion<D, MeanEdgeShape<D>> wide;
  expectRefused(b, [&] { return wide.improve(b.judge, 0, Level::LongLookAhead); });
}

/// Some of the layers must stay: what can be gained with the others is far less.
TYPED_TEST(InsertingFarAway, NoMoreNodesVanishThanMay)
{
  constexpr int D = TypeParam::dimension;
  for (const bool mayRemove : { false, true })
  {
    Bench<D> b(layers<D>(Layers));
    b.switches.removeNodes = mayRemove;
    b.judge.setWide(mayRemove ? Layers / 2 : Layers);
    b.judge.start();
    WideInsertion<D, MeanEdgeShape<D>> wide;
    wide.improve(b.judge, 0, Level::LongLookAhead);
    const int vanished = mayRemove ? Layers / 2 : 0;
    EXPECT_GE(b.mesh.countPoints(), D + 1 + Layers - vanished);
    EXPECT_LT(b.worst(), 0.1 * bestWithOneNode<D>());
  }
}

TYPED_TEST(InsertingFarAway, ACellAloneHasNothingAround)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = layers<D>(1);
  in.cells.resize(1);
  Bench<D> b(in);
  b.judge.setWide(Layers);
  WideInsertion<D, MeanEdgeShape<D>> wide;
  expectRefused(b, [&] { return wide.improve(b.judge, 0, Level::LongLookAhead); });
}

/// The nodes of a layer are kept: the cavity cannot take them in.
TYPED_TEST(InsertingFarAway, KeptNodesStay)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = layers<D>(Layers);
  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints.back() = 1;
  Bench<D> b(in);
  b.judge.setWide(Layers);
  b.judge.start();
  WideInsertion<D, MeanEdgeShape<D>> wide;
  wide.improve(b.judge, 0, Level::LongLookAhead);
  EXPECT_TRUE(b.mesh.isPointAlive(static_cast<Index>(in.points.size()) - 1));
  EXPECT_LT(b.worst(), 0.1 * bestWithOneNode<D>());
}

namespace
{
/// Evaluations of a search at the worst cell, and whether it helps.
template <int D>
std::pair<long, bool> search(const MeshInput<D>& in, bool patiently, bool removes, double gain)
{
  Bench<D> b(in);
  b.switches.removeNodes = removes;
  b.judge.setWide(MostNodes, patiently);
  b.judge.setGain(gain);
  b.judge.start();
  Index worst = 0;
  for (Index c = 1; c < b.mesh.numberOfCellSlots(); ++c)
  {
    worst = b.mesh.quality(c) < b.mesh.quality(worst) ? c : worst;
  }
  WideInsertion<D, MeanEdgeShape<D>> wide;
  EvaluationCount count;
  const bool helps = wide.improve(b.judge, worst, Level::LongLookAhead);
  return { count.take(), helps };
}
}

/// Nothing helps a good mesh in which all nodes stay. Three steps take up to 2, 8 and 32 cells of
/// each group for seeds, and none of them twice.
TYPED_TEST(InsertingFarAway, PatientlyManyPlacesAreTried)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(D == 3 ? 7 : 30, 0.0);
  const auto [few, helped] = search<D>(in, false, false, 1e-3);
  const auto [many, helpedPatiently] = search<D>(in, true, false, 1e-3);
  EXPECT_FALSE(helped || helpedPatiently);
  EXPECT_GT(many, 8 * few);
  EXPECT_LE(many, 16 * few);
}

/// What the first step finds is the same. Some worst cells are helped by the places after it alone.
TEST(InsertingFarAway3D, PatientlyMoreCellsAreHelped)
{
  int helped = 0, helpedPatiently = 0;
  for (int seed = 0; seed < 20; ++seed)
  {
    const MeshInput<3> in = jitteredGrid<3>(5, 0.3, seed);
    const auto [few, first] = search<3>(in, false, true, 1.0);
    const auto [many, all] = search<3>(in, true, true, 1.0);
    EXPECT_TRUE(all || !first);
    EXPECT_TRUE(!first || many == few);
    helped += first;
    helpedPatiently += all;
  }
  EXPECT_GT(helpedPatiently, helped);
}
